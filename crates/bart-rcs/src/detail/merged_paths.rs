//! Merging of paths whose phases stay together over band, elements and frame.

use crate::detail::sampled_chirps::{SampledChirp, strength};
use crate::frame::path_plan::SampledBand;
use crate::frame::path_sum::moved_to;
use crate::joins::scatterer::{scaled, sum};
use artifact::Radar;
use artifact::paths::{Amplitude, Path};
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use num_complex::Complex64;
use radar::aperture::axes;
use std::f64::consts::{PI, TAU};

/// Phase rotation of a path, the criterion for merging.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PhaseRotations {
    /// Length L₁ + L₂ at the frame's middle from the radar's position, m.
    pub(crate) length_m: f64,
    /// Cycles over the frame, over the transmit row [right, up] and over the receive row.
    pub(crate) cycles: [f64; 5],
}

/// Extents over which phase rotations are counted.
pub(crate) struct Extents<'a> {
    radar: &'a Radar,
    middle: SampledChirp,
    right: DVec3,
    up: DVec3,
    /// Extents of the rows of transmit and of receive elements, [right, up].
    rows_m: [[f64; 2]; 2],
}

impl<'a> Extents<'a> {
    pub(crate) fn of(radar: &'a Radar) -> Self {
        let [right, _, up] = axes(radar);
        let extent = |elements: &[[f64; 3]], axis: DVec3| {
            let along = elements.iter().map(|p| axis.dot(DVec3::from_array(*p)));
            let (low, high) = along.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
            (high - low).max(0.0)
        };
        let rows_m = [&radar.array.tx_m, &radar.array.rx_m].map(|row| [extent(row, right), extent(row, up)]);
        Self { radar, middle: SampledChirp::middle(radar), right, up, rows_m }
    }

    pub(crate) fn turns(&self, path: &Path) -> PhaseRotations {
        let legs_m = self.middle.legs_m(path);
        let [tx, rx] = legs_m.map(|leg| leg / leg.length());
        let wavelength_m = self.radar.waveform.wavelength_m();
        let [(_, tx_mps), (_, rx_mps)] = moved_to(path, self.radar.frame_middle_s());
        let rate_mps = tx.dot(tx_mps) + rx.dot(rx_mps);
        let [of_tx, of_rx] = self.rows_m;
        let ways_m = [
            rate_mps * self.radar.frame_duration_s(),
            tx.dot(self.right) * of_tx[0],
            tx.dot(self.up) * of_tx[1],
            rx.dot(self.right) * of_rx[0],
            rx.dot(self.up) * of_rx[1],
        ];
        PhaseRotations {
            length_m: legs_m[0].length() + legs_m[1].length(),
            cycles: ways_m.map(|way_m| way_m / wavelength_m),
        }
    }
}

/// Merges paths of one target, order and part of the frame and the array whose phases differ by at most
/// about `spread_rad` from their mean's at the ends of band, rows and frame; in the order of their cells.
///
/// The slope a′ makes a path linear over the band: for a phase that varies by ±θ there the error is θ²/4.
pub(crate) fn merged(radar: &Radar, paths: &[Path], spread_rad: f64) -> Vec<Path> {
    let extents = Extents::of(radar);
    let band_m = SPEED_OF_LIGHT_MPS / radar.waveform.bandwidth_hz().abs();
    let length_m = 4.0 / PI * spread_rad.sqrt() * band_m;
    let cycles = 2.0 / PI * spread_rad;
    let key = |path: &Path| {
        let turns = extents.turns(path);
        let cell = |value: f64, size: f64| (value / size).floor() as i64;
        let part = [
            path.curve.span.map(|span| (span.moments, span.moment)),
            path.curve.array_span.map(|span| (span.places, span.place)),
        ];
        // The sides of a row differ in their directions' signs alone.
        let side = path.curve.array_side.map(|side| side.transmit.map(f64::to_bits));
        (
            path.target,
            path.order,
            part,
            side,
            cell(turns.length_m, length_m),
            turns.cycles.map(|c| cell(c, cycles)),
        )
    };
    let mut keyed: Vec<_> = paths.iter().map(|path| (key(path), path)).collect();
    keyed.sort_by_key(|(key, _)| *key);
    let groups: Vec<Vec<&Path>> = keyed
        .chunk_by(|a, b| a.0 == b.0)
        .map(|group| group.iter().map(|(_, path)| *path).collect())
        .collect();
    let band = SampledBand::of(&radar.waveform);
    groups.iter().map(|group| one_of(radar, &band, &extents.middle, group)).collect()
}

/// Sum of a group at the amplitude-weighted mean of its points; named after its strongest member.
fn one_of(radar: &Radar, band: &SampledBand, middle: &SampledChirp, group: &[&Path]) -> Path {
    if let [alone] = group {
        return **alone;
    }
    let weights = weights(radar, group);
    let mean = |of: &dyn Fn(&Path) -> [f64; 3]| {
        let weighed = group.iter().zip(&weights).map(|(path, weight)| *weight * DVec3::from_array(of(path)));
        weighed.sum::<DVec3>().to_array()
    };
    let strongest = (1..group.len()).fold(0, |best, i| if weights[i] > weights[best] { i } else { best });
    let mut one = Path {
        apparent_tx_m: mean(&|path| path.apparent_tx_m),
        apparent_tx_mps: mean(&|path| path.apparent_tx_mps),
        apparent_rx_m: mean(&|path| path.apparent_rx_m),
        apparent_rx_mps: mean(&|path| path.apparent_rx_mps),
        ..*group[strongest]
    };
    let node = CentredPath::of(radar, middle, &one);
    let mut samples = [Amplitude::default(); 3];
    for path in group {
        let from = CentredPath::of(radar, middle, path);
        for (total, k) in samples.iter_mut().zip(band.wavenumbers_per_m()) {
            let offset_hz = k * SPEED_OF_LIGHT_MPS / TAU - band.centre_hz;
            let factor = Complex64::from_polar(from.over(&node), -k * (from.length_m - node.length_m));
            let slope = scaled(&path.slope_m_per_hz, Complex64::from(offset_hz));
            *total = sum(total, &scaled(&sum(&path.amplitude_m, &slope), factor));
        }
    }
    (one.amplitude_m, one.slope_m_per_hz) = band.line(&samples);
    one
}

/// Weights of the group's amplitudes in the radar's polarization; equal if all are zero.
fn weights(radar: &Radar, group: &[&Path]) -> Vec<f64> {
    let (p, q) = radar.array.polarization.indices();
    let of: Vec<f64> = group.iter().map(|path| path.amplitude_m[p][q].norm()).collect();
    let total: f64 = of.iter().sum();
    if total > 0.0 { of.iter().map(|w| w / total).collect() } else { vec![1.0 / of.len() as f64; of.len()] }
}

/// A path seen from the centre of the radar.
struct CentredPath {
    length_m: f64,
    strength: f64,
}

impl CentredPath {
    fn of(radar: &Radar, middle: &SampledChirp, path: &Path) -> Self {
        let legs_m = middle.legs_m(path);
        Self { length_m: legs_m[0].length() + legs_m[1].length(), strength: strength(radar, legs_m) }
    }

    /// Amplitude referred to `node`; 0 if no element receives it.
    fn over(&self, node: &Self) -> f64 {
        if node.strength > 0.0 { self.strength / node.strength } else { 0.0 }
    }
}
