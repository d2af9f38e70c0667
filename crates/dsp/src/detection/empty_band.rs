//! Velocity fold under Doppler division, resolved by the band that stays empty
//! ([`crate::spectrum::doppler_bands`]).
//!
//! A target at Doppler f fills the bands f, f + 1/M, … f + (N_tx − 1)/M and leaves f − 1/M empty. Summed over
//! channels, a wrong fold retains N_tx − 1 of N_tx echoes: too many to be rejected by a threshold, but its
//! empty band is full.

use crate::detection::cfar::{DETECTED, TESTED};
use crate::spectrum::division::Division;
use crate::spectrum::doppler_bands::band_cycles;
use crate::spectrum::map_transform::RangeDoppler;
use crate::spectrum::noncoherent::sum_over_channels;
use crate::spectrum::window::transform;
use artifact::Radar;
use artifact::radar::Multiplexing;
use artifact::rdm::RdmFrame;
use artifact::units::power;
use num_complex::{Complex32, Complex64};
use rayon::prelude::*;

/// Withdraws detections whose fold is not the one with the emptiest empty band.
pub(crate) fn keep_true_folds(
    transform: &RangeDoppler,
    samples: &[Complex32],
    values: &[Complex32],
    mask: &mut [u8],
) {
    let cells = transform.cells();
    let empty = empty_band(transform, samples);
    let bands: Vec<Vec<f64>> = values
        .chunks_exact(cells * transform.division().receivers)
        .map(|v| sum_over_channels(v, cells))
        .collect();
    for (cell, state) in mask.iter_mut().enumerate().filter(|(_, state)| **state == DETECTED) {
        if bands.iter().any(|band| band[cell] < empty[cell]) {
            *state = TESTED;
        }
    }
}

/// Whether the band of a cell is beyond doubt: its empty band holds less than a quarter of the weakest full
/// one. Velocities whole spans of the map away fill the same bands.
///
/// A second vehicle in the same range cell that is less than 6 dB weaker fills the band and is flagged here.
pub(crate) fn fold_is_certain(
    &Division { multiplexing, transmitters, receivers, .. }: &Division,
    map: &RdmFrame,
    [chirps, samples]: [usize; 2],
    [row, column]: [usize; 2],
) -> bool {
    if multiplexing != Multiplexing::Ddm {
        return false;
    }
    let of_band = |tx: usize, row: usize| -> f64 {
        let channels = tx * receivers..(tx + 1) * receivers;
        channels.map(|c| power(map.values[(c * chirps + row) * samples + column])).sum()
    };
    // Transmitter 0 seen one band below is the empty band; rounding to a whole row is negligible against 6
    // dB.
    let band_rows = (chirps as f64 / (transmitters + 1) as f64).round() as usize;
    let empty = of_band(0, (row + chirps - band_rows % chirps) % chirps);
    (0..transmitters).all(|tx| 4.0 * empty < of_band(tx, row))
}

/// Empty bands of a map's cells, read from the map alone.
pub(crate) struct EmptyBands {
    division: Division,
    rows: usize,
    columns: usize,
    /// Distance in rows and weight of the cells whose sum is that of the row a band below.
    weights: Vec<(usize, Complex64)>,
}

/// Weight of a row, over a whole row's, that is left out: below the rounding of the map's values.
const NEGLIGIBLE_WEIGHT: f64 = 1e-7;

impl EmptyBands {
    /// Empty bands of a radar's maps; `None` unless bands divide its transmitters.
    pub(crate) fn of(radar: &Radar) -> Option<Self> {
        let (division, rows) = (Division::of(radar), radar.waveform.chirps as usize);
        (division.multiplexing == Multiplexing::Ddm).then_some(())?;
        let below = band_cycles(&division, 1) * rows as f64;
        // The spectrum between its rows, Σ e^{j2πm(k + below)/N}/N over the chirps m.
        let rect = vec![1.0; rows];
        let weight = |k: usize| transform(&rect, k as f64 + below) / rows as f64;
        let weights = (0..rows).map(|k| (k, weight(k)));
        let weights = weights.filter(|(_, weight)| weight.norm() > NEGLIGIBLE_WEIGHT).collect();
        Some(Self { division, rows, columns: radar.waveform.range_cells(), weights })
    }

    /// Whether a cell of a map `[channel, doppler, range]` is another fold of an echo: its empty band holds
    /// more than one of its full ones, as [`keep_true_folds`] decides.
    pub(crate) fn is_wrong_fold(&self, values: &[Complex32], [row, column]: [usize; 2]) -> bool {
        let value = |channel: usize, row: usize| {
            let value = values[(channel * self.rows + row) * self.columns + column];
            Complex64::new(f64::from(value.re), f64::from(value.im))
        };
        let receivers = self.division.receivers;
        let below = |rx: usize| -> Complex64 {
            self.weights.iter().map(|(k, weight)| weight * value(rx, (row + k) % self.rows)).sum()
        };
        let empty: f64 = (0..receivers).map(|rx| below(rx).norm_sqr()).sum();
        (0..self.division.transmitters).any(|tx| {
            let channels = tx * receivers..(tx + 1) * receivers;
            channels.map(|channel| value(channel, row).norm_sqr()).sum::<f64>() < empty
        })
    }
}

fn empty_band(transform: &RangeDoppler, samples: &[Complex32]) -> Vec<f64> {
    let turn_cycles = band_cycles(transform.division(), transform.division().transmitters);
    let maps: Vec<Vec<f64>> = samples
        .par_chunks_exact(transform.samples())
        .map(|receiver| sum_over_channels(&transform.channel(receiver, turn_cycles), transform.cells()))
        .collect();
    let mut sum = vec![0.0; transform.cells()];
    for map in &maps {
        sum.iter_mut().zip(map).for_each(|(total, power)| *total += power);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::cube::{CubeFrame, CubeHeader};
    use artifact::settings::Noise;
    use radar::aperture::Preset;
    use radar::paper;

    /// Noise on every receiver, with bands that are a whole and no whole number of rows apart.
    #[test]
    fn wrong_folds_of_a_map_are_those_that_its_samples_tell() {
        for chirps in [16, 14] {
            let mut radar =
                paper::radar([0.0; 3], paper::waveform(8, chirps), Preset::ThreeByFour.elements());
            radar.array.multiplexing = Multiplexing::Ddm;
            let header = CubeHeader {
                radar,
                noise: Noise::Absent,
                dsp: paper::processing(),
                unit: Default::default(),
            };
            let transform = RangeDoppler::new(&header).unwrap();
            let values = |i: usize| Complex32::from_polar((i % 7) as f32, (i * i % 1009) as f32);
            let samples: Vec<Complex32> = (0..4 * transform.samples()).map(values).collect();
            let frame = CubeFrame { index: 0, time_s: 0.0, samples, error: Default::default() };
            let map = transform.all_channels(&frame).unwrap();
            let mut mask = vec![DETECTED; transform.cells()];
            keep_true_folds(&transform, &frame.samples, &map, &mut mask);
            let bands = EmptyBands::of(&header.radar).unwrap();
            let told = |cell: usize| bands.is_wrong_fold(&map, [cell / 8, cell % 8]);
            assert!((0..mask.len()).all(|cell| told(cell) == (mask[cell] == TESTED)), "{chirps} chirps");
            assert!(mask.contains(&TESTED) && mask.contains(&DETECTED));
        }
    }

    /// Squares below 1.2e-38 lose digits in single precision, and those below 1.4e-45 are 0.
    #[test]
    fn a_fold_is_as_certain_however_faint_the_echo_is() {
        let division = Division {
            multiplexing: Multiplexing::Ddm,
            transmitters: 1,
            receivers: 1,
            slots: 1,
            map_channels: 1,
        };
        for amplitude in [1e-8_f32, 1e-20, 1e-24, 1e-30] {
            for (below, is_certain) in [(4.0, true), (1.5, false)] {
                // Of four rows the bands have two each: the empty band of row 0 is row 2.
                let mut values = vec![Complex32::ZERO; 4];
                values[0] = Complex32::new(amplitude, 0.0);
                values[2] = Complex32::new(0.0, amplitude / below);
                let map = RdmFrame {
                    index: 0,
                    time_s: 0.0,
                    values,
                    mask: vec![],
                    detections: 0,
                    cells: 0,
                    assumed_floor: None,
                };
                let found = fold_is_certain(&division, &map, [4, 1], [0, 0]);
                assert_eq!(found, is_certain, "{amplitude:e}, 1/{below} in the empty band");
            }
        }
    }
}
