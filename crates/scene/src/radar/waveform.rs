//! `[radar.waveform]`: the chirps and their times.

use crate::document::errors::Rule;
use crate::document::keys::waveform::{
    CHIRPS, IDLE, SAMPLE_RATE, SAMPLES, SLOPE, STAGGER, START_FREQUENCY, SUB_FRAME_IDLE,
};
use crate::document::section::Section;
use crate::wording::allowed_range::AllowedRange;
use artifact::radar::{Sampling, Schedule, Waveform};

/// Frequencies at which any radar's sweep ends; beyond them lies thermal radiation.
const SWEEP_ENDS_GHZ: AllowedRange = AllowedRange::Between(0.1, 2000.0);

/// Reads the chirps of a frame and their start times.
pub(crate) fn read_waveform(section: &Section<'_>, sampling: Sampling) -> (Waveform, Schedule) {
    let start_ghz = section.or_default(&START_FREQUENCY);
    let slope_mhz_per_us = section.or_default(&SLOPE);
    let sample_rate_msps = section.or_default(&SAMPLE_RATE);
    let idle_us = section.or_default(&IDLE);
    let samples = section.or_default(&SAMPLES) as u32;
    let chirps = section.or_default(&CHIRPS) as u32;
    if slope_mhz_per_us == 0.0 {
        section.note(SLOPE.name, Rule::NoSlope);
    }
    let (stagger_s, later_us) = read_stagger(section);
    let interval_s = |idle_us: f64| (f64::from(samples) / sample_rate_msps + idle_us + later_us) / 1e6;
    let sub_frame_intervals_s: Vec<f64> = read_sub_frames(section).into_iter().map(interval_s).collect();
    let end_ghz = start_ghz + 1e-3 * slope_mhz_per_us * f64::from(samples) / sample_rate_msps;
    if !SWEEP_ENDS_GHZ.holds(end_ghz) {
        section.note(SLOPE.name, Rule::SweepTooLong { end_ghz, allowed: SWEEP_ENDS_GHZ });
    }
    let waveform = Waveform {
        start_frequency_hz: start_ghz * 1e9,
        slope_hz_per_s: slope_mhz_per_us * 1e12,
        sample_rate_hz: sample_rate_msps * 1e6,
        sampling,
        samples,
        chirp_interval_s: sub_frame_intervals_s.first().copied().unwrap_or(interval_s(idle_us)),
        chirps,
    };
    (waveform, Schedule { sub_frame_intervals_s, stagger_s })
}

/// Idle time of each sub-frame, µs; empty for a frame without sub-frames.
fn read_sub_frames(section: &Section<'_>) -> Vec<f64> {
    let key = SUB_FRAME_IDLE.name;
    if section.has(key) && section.has(IDLE.name) {
        section.note(key, Rule::Contradiction { key, other: IDLE.name });
    }
    section.read(&SUB_FRAME_IDLE).unwrap_or_default()
}

/// Delay in s of each chirp of a period relative to its start at the mean interval, and the time in µs by
/// which that interval exceeds the one without stagger.
fn read_stagger(section: &Section<'_>) -> (Vec<f64>, f64) {
    let longer_us = section.read(&STAGGER).unwrap_or_default();
    let mean_us = longer_us.iter().sum::<f64>() / longer_us.len().max(1) as f64;
    let mut later_us = 0.0;
    let stagger_s = longer_us.iter().map(|longer_us| {
        let this_us = later_us;
        later_us += longer_us - mean_us;
        this_us / 1e6
    });
    (stagger_s.collect(), mean_us)
}
