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
use artifact::radar::Multiplexing;
use artifact::rdm::RdmFrame;
use num_complex::Complex32;
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
    let power = |tx: usize, row: usize| -> f64 {
        let channels = tx * receivers..(tx + 1) * receivers;
        channels.map(|c| f64::from(map.values[(c * chirps + row) * samples + column].norm_sqr())).sum()
    };
    // Transmitter 0 seen one band below is the empty band; rounding to a whole row is negligible against 6
    // dB.
    let band_rows = (chirps as f64 / (transmitters + 1) as f64).round() as usize;
    let empty = power(0, (row + chirps - band_rows % chirps) % chirps);
    (0..transmitters).all(|tx| 4.0 * empty < power(tx, row))
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
