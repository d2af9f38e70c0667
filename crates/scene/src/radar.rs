//! `[radar]`: where the radar stands, what it sends, and its link. Its antenna array is in `array.rs`.

use crate::array::{Mount, read_array};
use crate::document::Section;
use crate::errors::{Allowed, Rule};
use crate::hardware::read_hardware;
use crate::keys;
use crate::models::Models;
use artifact::radar::{Hardware, Link, Multiplexing, Radar, Sampling, Schedule, Waveform};
use artifact::units::watts_from_dbm;

/// Coordinates beyond this are a slip of units; within it f64 resolves 1.5e-11 m, 4e-9 of a wavelength at 77 GHz.
pub(crate) const COORDINATES_M: Allowed = Allowed::Between(-1e5, 1e5);

/// A sweep of any radar ends within; beyond it wavelengths are those of heat.
const SWEEP_ENDS_GHZ: Allowed = Allowed::Between(0.1, 2000.0);

/// Values of a frame's cube: at 8 bytes each one GiB, of which the stages hold a few.
const CUBE_LIMIT: u64 = 1 << 27;

/// The radar of a scene, defaults where it says nothing.
pub(crate) fn read_radar(section: &Section<'_>, models: &mut Models) -> Radar {
    let waveform_section = section.section(&keys::WAVEFORM);
    let receiver = section.section(&keys::RECEIVER);
    let words = [("complex", Sampling::Complex), ("real", Sampling::Real)];
    let sampling = receiver.word("sampling", &words).unwrap_or(Sampling::Complex);
    let (waveform, schedule) = read_waveform(&waveform_section, sampling);
    let mount = Mount {
        position_m: section.vector("position_m", COORDINATES_M).unwrap_or([0.0, 0.0, 6.0]),
        boresight_az_rad: degrees(section, "boresight_az_deg", 360.0),
        boresight_el_rad: degrees(section, "boresight_el_deg", 90.0),
        half_wavelength_m: 0.5 * waveform.wavelength_m(),
    };
    let array_section = section.section(&keys::ARRAY);
    let mut radar = Radar {
        position_m: mount.position_m,
        boresight_az_rad: mount.boresight_az_rad,
        boresight_el_rad: mount.boresight_el_rad,
        waveform,
        schedule,
        array: read_array(&array_section, &mount, models),
        link: read_link(&section.section(&keys::LINK)),
        hardware: Hardware::default(),
    };
    let elements = [radar.array.tx_m.len(), radar.array.rx_m.len()];
    radar.hardware = read_hardware(section, &receiver, &array_section, elements);
    check_cube(&waveform_section, &radar);
    let divided = match radar.array.multiplexing {
        Multiplexing::Ddm => Some("ddm"),
        Multiplexing::Bpm => Some("bpm"),
        Multiplexing::Simultaneous | Multiplexing::Tdm => None,
    };
    if let Some(multiplexing) = divided.filter(|_| !radar.schedule.is_uniform()) {
        waveform_section.note("stagger_us", Rule::StaggeredDivision { multiplexing });
    }
    radar
}

fn degrees(section: &Section<'_>, key: &'static str, limit: f64) -> f64 {
    section.number(key, Allowed::Between(-limit, limit)).unwrap_or(0.0).to_radians()
}

fn read_waveform(section: &Section<'_>, sampling: Sampling) -> (Waveform, Schedule) {
    let start_ghz = section.number("start_frequency_ghz", Allowed::Between(0.1, 1000.0)).unwrap_or(77.0);
    let slope_mhz_per_us = section.number("slope_mhz_per_us", Allowed::Between(-1e4, 1e4)).unwrap_or(12.5);
    let sample_rate_msps = section.number("sample_rate_msps", Allowed::Between(1e-3, 1e5)).unwrap_or(5.12);
    let idle_us = section.number("idle_us", Allowed::Between(0.0, 1e6)).unwrap_or(10.0);
    // Fewer than 8 samples leave no range cells for guard and training; 2^16 are beyond any radar's chirp.
    let samples = section.integer("samples", Allowed::Between(8.0, 65536.0)).unwrap_or(256) as u32;
    let chirps = section.integer("chirps", Allowed::Between(1.0, 65536.0)).unwrap_or(128) as u32;
    if slope_mhz_per_us == 0.0 {
        section.note("slope_mhz_per_us", Rule::NoSlope);
    }
    let (stagger_s, later_us) = read_stagger(section);
    let interval_s = |idle_us: f64| (f64::from(samples) / sample_rate_msps + idle_us + later_us) / 1e6;
    let sub_frame_intervals_s: Vec<f64> = read_sub_frames(section).into_iter().map(interval_s).collect();
    let end_ghz = start_ghz + 1e-3 * slope_mhz_per_us * f64::from(samples) / sample_rate_msps;
    if !SWEEP_ENDS_GHZ.holds(end_ghz) {
        section.note("slope_mhz_per_us", Rule::SweepTooLong { end_ghz, allowed: SWEEP_ENDS_GHZ });
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

/// Idle time of each sub-frame, µs; empty where the frame has no parts.
fn read_sub_frames(section: &Section<'_>) -> Vec<f64> {
    // Two tell a velocity; more than eight no radar sends.
    let idle_us = section.numbers("sub_frame_idle_us", Allowed::Between(2.0, 8.0), Allowed::Between(0.0, 1e6));
    if section.has("sub_frame_idle_us") && section.has("idle_us") {
        section.note("sub_frame_idle_us", Rule::Contradiction { key: "sub_frame_idle_us", other: "idle_us" });
    }
    idle_us.unwrap_or_default()
}

/// By how much each chirp of a turn starts later than at the mean interval, s, and by how much that is longer than without, µs.
fn read_stagger(section: &Section<'_>) -> (Vec<f64>, f64) {
    let longer_us = section.numbers("stagger_us", Allowed::Between(2.0, 64.0), Allowed::Between(0.0, 1e6));
    let longer_us = longer_us.unwrap_or_default();
    let mean_us = longer_us.iter().sum::<f64>() / longer_us.len().max(1) as f64;
    let mut later_us = 0.0;
    let stagger_s = longer_us.iter().map(|longer_us| {
        let this_us = later_us;
        later_us += longer_us - mean_us;
        this_us / 1e6
    });
    (stagger_s.collect(), mean_us)
}

fn read_link(section: &Section<'_>) -> Link {
    let transmit_power_dbm = section.number("transmit_power_dbm", Allowed::Between(-200.0, 200.0)).unwrap_or(12.0);
    let antenna_gain_db = section.number("antenna_gain_dbi", Allowed::Between(-100.0, 100.0)).unwrap_or(10.0);
    Link { transmit_power_w: watts_from_dbm(transmit_power_dbm), antenna_gain_db }
}

fn check_cube(section: &Section<'_>, radar: &Radar) {
    let channels = radar.map_channels() as u64;
    let (chirps, samples) = (u64::from(radar.waveform.chirps), u64::from(radar.waveform.samples));
    if channels * chirps * samples > CUBE_LIMIT {
        section.note("samples", Rule::CubeTooLarge { channels, chirps, samples, limit: CUBE_LIMIT });
    }
}

/// Frames and the time from one to the next; a single frame may last longer than that.
pub(crate) fn read_frames(root: &Section<'_>, radar: &Radar) -> (u32, f64) {
    let frames = root.integer("frames", Allowed::Between(1.0, 1e6)).unwrap_or(1) as u32;
    let interval_s = root.number("frame_interval_s", Allowed::Above(0.0, 1e4)).unwrap_or(0.1);
    let duration_s = radar.cycle_duration_s();
    // A recording has as many frames as fit into it.
    let are_several = frames > 1 || (root.has("traffic") && !root.has("frames"));
    if are_several && interval_s < duration_s {
        root.note("frame_interval_s", Rule::FramesOverlap { interval_s, duration_s });
    }
    (frames * radar.schedule.sub_frames(), interval_s)
}
