//! Doppler division: transmitter i turns by e^{+j2πim/M} on chirp m, M = N_tx + 1, and one of the M bands stays empty.
//!
//! Taking a transmitter's turn out puts its echo at the true Doppler, and those of the others i'/M of the span away.
//! A target at Doppler f therefore fills the bands f, f + 1/M, … f + (N_tx − 1)/M and leaves f − 1/M empty. Summed over
//! channels, a wrong fold keeps N_tx − 1 of N_tx echoes: too much for a threshold to tell, but its missing band is full.

use crate::cfar::{DETECTED, TESTED};
use crate::noncoherent::sum_over_channels;
use crate::range_doppler::RangeDoppler;
use artifact::cube::CubeHeader;
use artifact::radar::Multiplexing;
use artifact::rdm::RdmFrame;
use num_complex::Complex32;
use rayon::prelude::*;

/// Channel of the cube that a channel of the map is made from, and the cycles per chirp to take out of it.
pub(crate) fn source_of(header: &CubeHeader, channel: usize) -> (usize, f64) {
    let receivers = header.radar.array.rx_m.len();
    match header.radar.array.multiplexing {
        Multiplexing::Ddm => (channel % receivers, band_cycles(header, channel / receivers)),
        Multiplexing::Simultaneous | Multiplexing::Tdm | Multiplexing::Bpm => (channel, 0.0),
    }
}

/// Takes back detections whose fold is not the one that leaves the empty band emptiest.
pub(crate) fn keep_true_folds(
    header: &CubeHeader,
    transform: &RangeDoppler,
    samples: &[Complex32],
    values: &[Complex32],
    mask: &mut [u8],
) {
    let cells = transform.cells();
    let empty = empty_band(header, transform, samples);
    let bands: Vec<Vec<f64>> =
        values.chunks_exact(cells * header.radar.array.rx_m.len()).map(|v| sum_over_channels(v, cells)).collect();
    for (cell, state) in mask.iter_mut().enumerate().filter(|(_, state)| **state == DETECTED) {
        if bands.iter().any(|band| band[cell] < empty[cell]) {
            *state = TESTED;
        }
    }
}

/// Whether the fold of a cell is beyond doubt: its empty band holds less than a quarter of the weakest full one.
///
/// A second vehicle in the same range cell that is less than 6 dB weaker fills the band and is flagged here.
pub(crate) fn fold_is_certain(header: &CubeHeader, map: &RdmFrame, row: usize, column: usize) -> bool {
    if header.radar.array.multiplexing != Multiplexing::Ddm {
        return false;
    }
    let [chirps, samples] = [header.radar.waveform.chirps as usize, header.radar.waveform.range_cells()];
    let (transmitters, receivers) = (header.radar.array.tx_m.len(), header.radar.array.rx_m.len());
    let power = |tx: usize, row: usize| -> f64 {
        let channels = tx * receivers..(tx + 1) * receivers;
        channels.map(|c| f64::from(map.values[(c * chirps + row) * samples + column].norm_sqr())).sum()
    };
    // Transmitter 0 seen one band below is the empty band; rounding to a whole row matters little against 6 dB.
    let band_rows = (chirps as f64 / (transmitters + 1) as f64).round() as usize;
    let empty = power(0, (row + chirps - band_rows % chirps) % chirps);
    (0..transmitters).all(|tx| 4.0 * empty < power(tx, row))
}

/// i/M.
pub(crate) fn band_cycles(header: &CubeHeader, transmitter: usize) -> f64 {
    transmitter as f64 / (header.radar.array.tx_m.len() + 1) as f64
}

fn empty_band(header: &CubeHeader, transform: &RangeDoppler, samples: &[Complex32]) -> Vec<f64> {
    let turn_cycles = band_cycles(header, header.radar.array.tx_m.len());
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
