//! Slow, obvious form: every sample of every path from the formulas of interface.md, one by one, in f64.
//!
//! It shares only the radar's data, the link amplitude and the schedule of transmissions with
//! [`crate::sums::direct_sum`], and is never optimised.

use crate::impairments::oscillator::Oscillator;
use crate::links::multiplexing::{Transmission, row};
use artifact::Radar;
use artifact::paths::Path;
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use num_complex::Complex64;
use radar::aperture::{axes, pattern_amplitude};
use radar::beat::if_cycles;
use radar::link::link_amplitude;
use radar::path_kinematics::from_hub_m;
use std::f64::consts::TAU;

/// All samples of a cube, √W, row-major `[channel, chirp, sample]`.
pub fn cube(radar: &Radar, centre_frequency_hz: f64, paths: &[Path]) -> Vec<Complex64> {
    let mut samples = Vec::new();
    for channel in 0..radar.cube_channels() {
        for chirp in 0..radar.waveform.chirps as usize {
            for sample in 0..radar.waveform.samples as usize {
                samples.push(cube_sample(radar, centre_frequency_hz, paths, [channel, chirp, sample], None));
            }
        }
    }
    samples
}

/// One sample of a cube at `[channel, chirp, sample]`: the sum over its transmissions and all paths, √W, each
/// rotated by the difference of the oscillator's phases at reception and departure, if there is an
/// oscillator.
pub fn cube_sample(
    radar: &Radar,
    centre_frequency_hz: f64,
    paths: &[Path],
    at: [usize; 3],
    oscillator: Option<&Oscillator>,
) -> Complex64 {
    let [channel, chirp, sample] = at;
    let mut sum = Complex64::ZERO;
    for transmission in row(radar, channel, chirp) {
        let time_s = transmission.start_s + sample as f64 / radar.waveform.sample_rate_hz;
        for path in paths {
            let value =
                transmission.turn * if_sample(radar, centre_frequency_hz, path, &transmission, sample);
            let delay_s = || legs_at(path, &transmission, time_s).delay_s() + transmission.line_delay_s;
            sum += oscillator.map_or(value, |oscillator| value * oscillator.rotation(time_s, delay_s()));
        }
    }
    sum
}

/// IF value of one path, `√(P_tG_tG_r)·λ/(4π)^{3/2}·conj a(f)/(L₁L₂)·e^{j2π[f₀τ + μtτ − ½μτ²]}` with f = f₀ +
/// μ(t − τ), times its share of the echo at that time, if it represents a part of the frame.
pub fn if_sample(
    radar: &Radar,
    centre_frequency_hz: f64,
    path: &Path,
    transmission: &Transmission,
    sample: usize,
) -> Complex64 {
    let waveform = &radar.waveform;
    let t = sample as f64 / waveform.sample_rate_hz;
    let legs = legs_at(path, transmission, transmission.start_s + t);
    let tau = legs.delay_s() + transmission.line_delay_s;
    let frequency_hz = waveform.start_frequency_hz + waveform.slope_hz_per_s * (t - tau);
    let amplitude = amplitude_m(radar, path, frequency_hz - centre_frequency_hz).conj();
    let share = path.curve.share(transmission.start_s + t, transmission.ends_m());
    let gain = share * link_amplitude(radar) * legs.gain(radar);
    gain * amplitude * Complex64::cis(TAU * if_cycles(waveform, t, tau).fract())
}

/// Both legs of a path at one sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Legs {
    /// Vector x_a(t_s) − p_t; its length is L₁.
    pub departing_m: DVec3,
    /// Vector x_b(t_s) − p_r; its length is L₂.
    pub arriving_m: DVec3,
}

impl Legs {
    /// Delay τ = (L₁ + L₂)/c.
    pub fn delay_s(&self) -> f64 {
        (self.departing_m.length() + self.arriving_m.length()) / SPEED_OF_LIGHT_MPS
    }

    /// Amplitude gain of both elements towards departure and arrival, over L₁L₂.
    pub fn gain(&self, radar: &Radar) -> f64 {
        let axes = axes(radar);
        let towards = |leg: DVec3| pattern_amplitude(radar, &axes, leg / leg.length());
        let pattern = towards(self.departing_m) * towards(self.arriving_m);
        pattern / (self.departing_m.length() * self.arriving_m.length())
    }
}

/// Legs of a path received at `time_s` into the frame.
///
/// The scattering time t_s = T − |x_b(t_s) − p_r|/c is iterated from T. One step reduces its error by c/v
/// (3e7 at 10 m/s), so that four steps leave none at any speed accepted by this crate (1e-5·c).
pub fn legs_at(path: &Path, transmission: &Transmission, time_s: f64) -> Legs {
    let (curve, rim) = (&path.curve, path.curve.rim);
    let at = |point_m: [f64; 3], velocity_mps: [f64; 3], acceleration_mps2: [f64; 3], t: f64| {
        let way_m =
            DVec3::from_array(velocity_mps) * t + DVec3::from_array(acceleration_mps2) * (0.5 * t * t);
        DVec3::from_array(point_m) + way_m + rim.map_or(DVec3::ZERO, |rim| from_hub_m(&rim, way_m))
    };
    let arriving_m =
        |t: f64| at(path.apparent_rx_m, path.apparent_rx_mps, curve.apparent_rx_mps2, t) - transmission.rx_m;
    let arrival_s = time_s - transmission.receiver_delay_s;
    let mut scattering_time_s = arrival_s;
    for _ in 0..4 {
        scattering_time_s = arrival_s - arriving_m(scattering_time_s).length() / SPEED_OF_LIGHT_MPS;
    }
    Legs {
        departing_m: at(path.apparent_tx_m, path.apparent_tx_mps, curve.apparent_tx_mps2, scattering_time_s)
            - transmission.tx_m,
        arriving_m: arriving_m(scattering_time_s),
    }
}

/// Amplitude a + (f − f_c)·a′ in the array's polarization, metres.
fn amplitude_m(radar: &Radar, path: &Path, offset_hz: f64) -> Complex64 {
    let (receive, transmit) = radar.array.polarization.indices();
    path.amplitude_m[receive][transmit] + offset_hz * path.slope_m_per_hz[receive][transmit]
}
