//! Phase noise of the oscillator shared by all elements: one random process per frame, and the part of it
//! that remains in an echo.
//!
//! The oscillator's phase is φ(T), stationary, with the two-sided spectral density L(|f|) rad²/Hz, the
//! single-sideband noise of data sheets (IEEE Std 1139: L = S_φ/2, S_φ one-sided). A wave sent at T − τ is
//! mixed with the oscillator at T: an echo of delay τ is rotated by φ(T) − φ(T − τ), with density
//! 4·L(f)·sin²(πfτ) on either side of its line. Near targets retain almost no slow noise ("range
//! correlation": Budge, Burt, IEEE National Radar Conf. 1993, 185).

use crate::impairments::noise::NoiseStream;
use artifact::Radar;
use artifact::radar::{OSCILLATOR_SAMPLES_LIMIT, PhaseNoise};
use artifact::units::SPEED_OF_LIGHT_MPS;
use num_complex::Complex64;
use rustfft::FftPlanner;
use std::f64::consts::TAU;

/// Phase of a radar's oscillator over a frame and, before it, over the longest echo delay.
pub struct Oscillator {
    /// Phase φ at equal steps, rad; periodic.
    phase_rad: Vec<f64>,
    steps_per_s: f64,
    rate_rms_rad_per_s: f64,
}

/// Steps per sample: interpolation from eight neighbours is accurate to 1.5e-4 of the fastest component.
const STEPS_PER_SAMPLE: usize = 4;
/// Number of values around a time from which its phase is interpolated.
const NEIGHBOURS: usize = 8;
/// Time held before the frame's first sample: a round trip of 1.5 km. If echoes take longer, it is twice
/// their delay.
const BEFORE_S: f64 = 1e-5;
/// Minimum period in units of the longest delay: for a random-walk phase, L ∝ 1/f², φ(T) − φ(T − τ) has the
/// variance (1 − τ/P)·τ under a period P, here 3 % or 0.14 dB too little.
const DELAYS: f64 = 32.0;
/// Maximum number of sample intervals of a frame and the time before it: half a second at 5.12 MHz, whose
/// phase takes 70 MB.
pub(crate) const SAMPLES_MAX: usize = 2 * OSCILLATOR_SAMPLES_LIMIT;

impl Oscillator {
    /// Oscillator of one frame for echoes up to this delay; `None` if the radar's is ideal.
    pub fn of(radar: &Radar, seed: u64, frame: u32, longest_delay_s: f64) -> Option<Self> {
        let noise = &radar.hardware.phase_noise;
        if noise.is_empty() {
            return None;
        }
        let (count, rate_hz) = (samples_of(radar, longest_delay_s), radar.waveform.sample_rate_hz);
        let step_hz = rate_hz / count as f64;
        let powers = powers(noise, step_hz, count);
        let rate = |(k, power): (usize, &f64)| 2.0 * power * (TAU * (k + 1) as f64 * step_hz).powi(2);
        let rate_square: f64 = powers.iter().enumerate().map(rate).sum();
        let mut stream = NoiseStream::of(seed, "fmcw-echo/phase-noise", &[u64::from(frame)]);
        let mut spectrum = vec![Complex64::ZERO; STEPS_PER_SAMPLE * count];
        for (part, power) in spectrum[1..].iter_mut().zip(powers) {
            *part = stream.next_sample(power);
        }
        FftPlanner::new().plan_fft_inverse(spectrum.len()).process(&mut spectrum);
        let phase_rad = spectrum.into_iter().map(|value| 2.0 * value.re).collect();
        Some(Self {
            phase_rad,
            steps_per_s: STEPS_PER_SAMPLE as f64 * rate_hz,
            rate_rms_rad_per_s: rate_square.sqrt(),
        })
    }

    /// Phase φ, rad, `time_s` after the frame's first sample, or shortly before it.
    pub fn phase_rad(&self, time_s: f64) -> f64 {
        self.phases_rad(time_s, 1)[0]
    }

    /// Rotation e^{j[φ(T) − φ(T − τ)]} of an echo of delay τ received at T.
    pub fn rotation(&self, time_s: f64, delay_s: f64) -> Complex64 {
        Complex64::cis(self.phase_rad(time_s) - self.phase_rad(time_s - delay_s))
    }

    /// Phases φ at a time and at one, two, … samples later.
    pub(crate) fn phases_rad(&self, time_s: f64, samples: usize) -> Vec<f64> {
        let place = time_s * self.steps_per_s;
        let below = place.floor();
        let shares = lagrange(place - below);
        let length = self.phase_rad.len();
        let first = (below as i64 - (NEIGHBOURS as i64 / 2 - 1)).rem_euclid(length as i64) as usize;
        let at = |sample: usize| {
            let start = (first + sample * STEPS_PER_SAMPLE) % length;
            let value = |(i, share): (usize, &f64)| share * self.phase_rad[(start + i) % length];
            shares.iter().enumerate().map(value).sum()
        };
        (0..samples).map(at).collect()
    }

    /// Root mean square of dφ/dt, rad/s.
    pub(crate) fn rate_rms_rad_per_s(&self) -> f64 {
        self.rate_rms_rad_per_s
    }
}

/// Memory of the phase and of the transform that generates it, for echoes within the waveform's range, bytes.
pub(crate) fn memory_estimate_bytes(radar: &Radar) -> u64 {
    let delay_s = 2.0 * radar.waveform.range_max_m() / SPEED_OF_LIGHT_MPS;
    let needed =
        if radar.hardware.phase_noise.is_empty() { 0 } else { samples_of(radar, delay_s) * STEPS_PER_SAMPLE };
    (needed * (size_of::<f64>() + 2 * size_of::<Complex64>())) as u64
}

/// Number of sample intervals of a frame and the time before it, rounded up to a length with fast transforms.
pub(crate) fn samples_of(radar: &Radar, longest_delay_s: f64) -> usize {
    let before_s = if longest_delay_s <= BEFORE_S { BEFORE_S } else { 2.0 * longest_delay_s };
    let needed_s = (radar.frame_duration_s() + before_s).max(DELAYS * longest_delay_s);
    let needed = (needed_s * radar.waveform.sample_rate_hz).ceil();
    (needed as usize).min(1 << (usize::BITS - 2)).next_power_of_two()
}

/// Powers of φ's Fourier coefficients at 1, 2, … over the time, below half the sample rate: the rest is
/// outside the IF filter.
fn powers(noise: &[PhaseNoise], step_hz: f64, count: usize) -> Vec<f64> {
    (1..count / 2).map(|k| density(noise, k as f64 * step_hz) * step_hz).collect()
}

/// Density L(f), rad²/Hz: linear in dB over log f between the given frequencies, constant outside the first
/// and last.
pub fn density(noise: &[PhaseNoise], offset_hz: f64) -> f64 {
    let above = noise.partition_point(|point| point.offset_hz <= offset_hz);
    let dbc_per_hz = match (above.checked_sub(1).map(|below| noise[below]), noise.get(above)) {
        (Some(below), Some(above)) => {
            let share = (offset_hz / below.offset_hz).ln() / (above.offset_hz / below.offset_hz).ln();
            below.dbc_per_hz + share * (above.dbc_per_hz - below.dbc_per_hz)
        }
        (Some(point), None) => point.dbc_per_hz,
        (None, Some(point)) => point.dbc_per_hz,
        (None, None) => f64::NEG_INFINITY,
    };
    10.0_f64.powf(0.1 * dbc_per_hz)
}

/// Weights of eight neighbours for a value `t` of a step after the fourth.
fn lagrange(t: f64) -> [f64; NEIGHBOURS] {
    let place = |i: usize| i as f64 - (NEIGHBOURS as f64 / 2.0 - 1.0);
    std::array::from_fn(|i| {
        let others = (0..NEIGHBOURS).filter(|other| *other != i);
        others.map(|other| (t - place(other)) / (place(i) - place(other))).product()
    })
}
