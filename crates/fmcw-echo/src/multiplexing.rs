//! Which transmissions make up one row (channel, chirp) of a cube, and when each starts (interface.md, tdm and ddm).

use artifact::Radar;
use artifact::radar::Multiplexing;
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// The transmissions whose sum is the row `[channel, chirp, ..]` of a cube: one, or with Doppler division all.
pub fn row(radar: &Radar, channel: usize, chirp: usize) -> Vec<Transmission> {
    let receivers = radar.array.rx_m.len();
    match radar.array.multiplexing {
        Multiplexing::Simultaneous | Multiplexing::Tdm => {
            let (tx, rx) = (channel / receivers, channel % receivers);
            vec![Transmission::new(radar, tx, rx, chirp, Complex64::ONE)]
        }
        Multiplexing::Ddm => {
            let transmitters = radar.array.tx_m.len();
            let turn = |tx| doppler_division_turn(tx, chirp, transmitters);
            (0..transmitters).map(|tx| Transmission::new(radar, tx, channel, chirp, turn(tx))).collect()
        }
    }
}

/// One chirp from one transmit element to one receive element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transmission {
    /// p_t, world metres.
    pub tx_m: DVec3,
    /// p_r, world metres.
    pub rx_m: DVec3,
    /// Its first sample, from the frame's first sample.
    pub start_s: f64,
    /// Factor of its IF value.
    pub turn: Complex64,
}

impl Transmission {
    /// A chirp that would start at any moment.
    pub(crate) fn starting_at(radar: &Radar, tx: usize, rx: usize, start_s: f64) -> Self {
        Self { start_s, ..Self::new(radar, tx, rx, 0, Complex64::ONE) }
    }

    fn new(radar: &Radar, tx: usize, rx: usize, chirp: usize, turn: Complex64) -> Self {
        Self {
            tx_m: DVec3::from_array(radar.array.tx_m[tx]),
            rx_m: DVec3::from_array(radar.array.rx_m[rx]),
            start_s: radar.chirp_start_s(tx, chirp),
            turn,
        }
    }
}

/// e^{+j2πim/M}, M = N_tx + 1, with im reduced modulo M in integers.
fn doppler_division_turn(tx: usize, chirp: usize, transmitters: usize) -> Complex64 {
    let bands = transmitters + 1;
    Complex64::cis(TAU * (tx * chirp % bands) as f64 / bands as f64)
}
