//! Doppler division: transmitter i turns by e^{+j2πim/M} on chirp m, M = N_tx + 1, and one of the M bands
//! stays empty.
//!
//! Taking a transmitter's turn out puts its echo at the true Doppler, and those of the others i'/M of the
//! span away.

use artifact::cube::CubeHeader;
use artifact::radar::Multiplexing;

/// Channel of the cube that a channel of the map is made from, and the cycles per chirp to take out of it.
pub(crate) fn source_of(header: &CubeHeader, channel: usize) -> (usize, f64) {
    let receivers = header.radar.array.rx_m.len();
    match header.radar.array.multiplexing {
        Multiplexing::Ddm => (channel % receivers, band_cycles(header, channel / receivers)),
        Multiplexing::Simultaneous | Multiplexing::Tdm | Multiplexing::Bpm => (channel, 0.0),
    }
}

/// i/M.
pub(crate) fn band_cycles(header: &CubeHeader, transmitter: usize) -> f64 {
    transmitter as f64 / (header.radar.array.tx_m.len() + 1) as f64
}
