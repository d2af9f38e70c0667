//! Doppler division: transmitter i is rotated by e^{+j2πim/M} on chirp m, M = N_tx + 1, and one of the M
//! bands stays empty.
//!
//! Removing a transmitter's rotation places its echo at the true Doppler, and those of the others i'/M of the
//! span away.

use crate::spectrum::division::Division;
use artifact::radar::Multiplexing;

/// Channel of the cube from which a channel of the map is made, and the cycles per chirp to remove from it.
pub(crate) fn source_of(division: &Division, channel: usize) -> (usize, f64) {
    let receivers = division.receivers;
    match division.multiplexing {
        Multiplexing::Ddm => (channel % receivers, band_cycles(division, channel / receivers)),
        Multiplexing::Simultaneous | Multiplexing::Tdm | Multiplexing::Bpm => (channel, 0.0),
    }
}

/// Cycles per chirp by which transmitter i is rotated under Doppler division, i/M, M = N_tx + 1.
pub(crate) fn band_cycles(division: &Division, transmitter: usize) -> f64 {
    transmitter as f64 / (division.transmitters + 1) as f64
}
