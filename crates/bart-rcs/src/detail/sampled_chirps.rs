//! Fields of path tables at selected samples of a cube: pairs of elements, moments of the frame, instants of
//! the sweep.

use crate::frame::path_sum::apparent_m;
use artifact::Radar;
use artifact::paths::Path;
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use num_complex::Complex64;
use radar::aperture::{axes, pattern_amplitude};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// A chirp between a pair of elements, at a time after the frame's first sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SampledChirp {
    pub(crate) tx_m: DVec3,
    pub(crate) rx_m: DVec3,
    pub(crate) seconds: f64,
}

impl SampledChirp {
    /// Chirp from the radar's position at the frame's middle.
    pub(crate) fn middle(radar: &Radar) -> Self {
        let place_m = DVec3::from_array(radar.position_m);
        Self { tx_m: place_m, rx_m: place_m, seconds: radar.frame_middle_s() }
    }

    /// Legs x_a − p_t and x_b − p_r.
    pub(crate) fn legs_m(&self, path: &Path) -> [DVec3; 2] {
        let [from_tx_m, from_rx_m] = apparent_m(path, self.seconds);
        [from_tx_m - self.tx_m, from_rx_m - self.rx_m]
    }

    /// Share of a path that represents a part of the frame.
    fn share(&self, path: &Path) -> f64 {
        let ends_m = [self.tx_m.to_array(), self.rx_m.to_array()];
        path.curve.share(self.seconds, ends_m)
    }
}

/// Product of both elements' gains over L₁L₂, 1/m².
pub(crate) fn strength(radar: &Radar, legs_m: [DVec3; 2]) -> f64 {
    let axes = axes(radar);
    let gain = |leg: &DVec3| pattern_amplitude(radar, &axes, *leg / leg.length());
    legs_m.iter().map(|leg| gain(leg) / leg.length()).product()
}

/// Chirps, each at equidistant instants of the sampled sweep.
pub(crate) struct SampledChirps<'a> {
    radar: &'a Radar,
    chirps: Vec<SampledChirp>,
    instants: usize,
}

impl<'a> SampledChirps<'a> {
    /// Makes `count` chirps evenly spread over pairs and moments; sequences with different `start`s share no
    /// chirp.
    ///
    /// Moments are denser at the frame's ends, like Chebyshev points, so that a fit does not diverge between
    /// them.
    pub(crate) fn new(radar: &'a Radar, count: usize, instants: usize, start: f64) -> Self {
        let pick = |list: &[[f64; 3]], share: f64| {
            let element = list.get((share * list.len() as f64) as usize);
            DVec3::from_array(*element.unwrap_or(&radar.position_m))
        };
        // Powers of the plastic number: the lowest discrepancy known for three dimensions (M. Roberts 2018).
        let chirp = |i: usize| {
            let share = |step: f64| (start + step * (i as f64 + 1.0)).fract();
            let moment = 0.5 - 0.5 * (PI * share(0.819_172_513)).cos();
            SampledChirp {
                tx_m: pick(&radar.array.tx_m, share(0.671_043_607)),
                rx_m: pick(&radar.array.rx_m, share(0.549_700_478)),
                seconds: moment * radar.frame_duration_s(),
            }
        };
        Self { radar, chirps: (0..count).map(chirp).collect(), instants }
    }

    /// Number of values of a field.
    pub(crate) fn len(&self) -> usize {
        self.chirps.len() * self.instants
    }

    /// Conjugate IF samples of all paths without the link amplitude, in the radar's polarization,
    /// `[chirp][instant]`.
    ///
    /// Runs of paths are summed in order, so the result is bit-identical for any number of threads.
    pub(crate) fn field(&self, paths: &[Path]) -> Vec<Complex64> {
        const PATHS_PER_RUN: usize = 1024;
        let zero = || vec![Complex64::ZERO; self.len()];
        let of_run = |run: &[Path]| {
            let mut sums = zero();
            run.iter().for_each(|path| self.add(path, &mut sums));
            sums
        };
        let runs: Vec<Vec<Complex64>> = paths.par_chunks(PATHS_PER_RUN).map(of_run).collect();
        runs.iter().fold(zero(), |sums, run| sums.iter().zip(run).map(|(a, b)| a + b).collect())
    }

    /// Fields of a path of a = 1 m, and of one of a′ = 1 m per half of the band.
    pub(crate) fn columns(&self, path: &Path) -> [Vec<Complex64>; 2] {
        let mut columns = [Vec::with_capacity(self.len()), Vec::with_capacity(self.len())];
        let half_band_hz = self.half_band_hz();
        for chirp in &self.chirps {
            let mut tone = self.tone(chirp, path);
            for _ in 0..self.instants {
                columns[0].push(tone.value);
                columns[1].push(tone.value * (tone.offset_hz / half_band_hz));
                tone.advance();
            }
        }
        columns
    }

    pub(crate) fn half_band_hz(&self) -> f64 {
        0.5 * self.radar.waveform.bandwidth_hz().abs()
    }

    fn add(&self, path: &Path, sums: &mut [Complex64]) {
        let (p, q) = self.radar.array.polarization.indices();
        let (amplitude_m, slope_m_per_hz) = (path.amplitude_m[p][q], path.slope_m_per_hz[p][q]);
        for (chirp, sums) in self.chirps.iter().zip(sums.chunks_mut(self.instants)) {
            let mut tone = self.tone(chirp, path);
            for sum in sums {
                *sum += (amplitude_m + slope_m_per_hz * tone.offset_hz) * tone.value;
                tone.advance();
            }
        }
    }

    /// Phase of a path through the sweep: e^{−j2π[(f₀ + μt)τ − ½μτ²]} at f = f₀ + μ(t − τ).
    fn tone(&self, chirp: &SampledChirp, path: &Path) -> ChirpTone {
        let waveform = &self.radar.waveform;
        let legs_m = chirp.legs_m(path);
        let delay_s = legs_m.iter().map(|leg| leg.length()).sum::<f64>() / SPEED_OF_LIGHT_MPS;
        let step_s = f64::from(waveform.samples) / waveform.sample_rate_hz / self.instants as f64;
        let (first_hz, step_hz) = (0.5 * step_s * waveform.slope_hz_per_s, step_s * waveform.slope_hz_per_s);
        let cycles =
            (waveform.start_frequency_hz + first_hz - 0.5 * waveform.slope_hz_per_s * delay_s) * delay_s;
        let behind_hz = waveform.slope_hz_per_s * delay_s;
        ChirpTone {
            value: Complex64::from_polar(
                chirp.share(path) * strength(self.radar, legs_m),
                -TAU * cycles.fract(),
            ),
            turn: Complex64::cis(-TAU * step_hz * delay_s),
            offset_hz: waveform.start_frequency_hz + first_hz - behind_hz - waveform.centre_frequency_hz(),
            step_hz,
        }
    }
}

/// A unit path at one instant of the sweep.
struct ChirpTone {
    value: Complex64,
    turn: Complex64,
    /// Frequency offset f − f_c.
    offset_hz: f64,
    step_hz: f64,
}

impl ChirpTone {
    fn advance(&mut self) {
        self.value *= self.turn;
        self.offset_hz += self.step_hz;
    }
}

pub(crate) fn power(field: &[Complex64]) -> f64 {
    field.iter().map(|x| x.norm_sqr()).sum()
}

pub(crate) fn difference(a: &[Complex64], b: &[Complex64]) -> Vec<Complex64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
