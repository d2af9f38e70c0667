//! Transmissions that make up one row (channel, chirp) of a cube, and their start times (interface.md: tdm,
//! ddm and bpm).

use artifact::Radar;
use artifact::radar::{ElementError, Multiplexing, code_sign};
use artifact::units::amplitude_from_db;
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Transmissions whose sum is the row `[channel, chirp, ..]` of a cube: one, or all of them with Doppler
/// division or codes.
pub fn row(radar: &Radar, channel: usize, chirp: usize) -> Vec<Transmission> {
    let receivers = radar.array.rx_m.len();
    match radar.array.multiplexing {
        Multiplexing::Simultaneous | Multiplexing::Tdm => {
            let (tx, rx) = (channel / receivers, channel % receivers);
            vec![Transmission::new(radar, tx, rx, chirp, element_factor(radar, tx, rx))]
        }
        Multiplexing::Ddm => {
            let transmitters = radar.array.tx_m.len();
            let turn =
                |tx| doppler_division_turn(tx, chirp, transmitters) * element_factor(radar, tx, channel);
            (0..transmitters).map(|tx| Transmission::new(radar, tx, channel, chirp, turn(tx))).collect()
        }
        Multiplexing::Bpm => {
            let (slot, rx) = (channel / receivers, channel % receivers);
            let start_s = radar.chirp_start_s(slot, chirp);
            let coded = |tx| Transmission {
                turn: code_sign(tx, slot) * element_factor(radar, tx, rx),
                ..Transmission::starting_at(radar, tx, rx, start_s)
            };
            (0..radar.array.tx_m.len()).map(coded).collect()
        }
    }
}

/// One chirp from one transmit element to one receive element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transmission {
    /// Position p_t of the transmit element, world metres.
    pub tx_m: DVec3,
    /// Position p_r of the receive element, world metres.
    pub rx_m: DVec3,
    /// Time of the chirp's first sample, from the frame's first sample, s.
    pub start_s: f64,
    /// Factor on its IF value.
    pub turn: Complex64,
    /// Total delay of both elements' feed lines, s; added to the propagation delay.
    pub line_delay_s: f64,
    /// Delay of the receiver's feed line, s: the wave arrived earlier by this time.
    pub receiver_delay_s: f64,
}

impl Transmission {
    /// A chirp starting at any time, from elements without gain and phase errors.
    pub(crate) fn starting_at(radar: &Radar, tx: usize, rx: usize, start_s: f64) -> Self {
        Self { start_s, ..Self::new(radar, tx, rx, 0, Complex64::ONE) }
    }

    /// Positions of both elements, world metres.
    pub(crate) fn ends_m(&self) -> [[f64; 3]; 2] {
        [self.tx_m, self.rx_m].map(|end| end.to_array())
    }

    fn new(radar: &Radar, tx: usize, rx: usize, chirp: usize, turn: Complex64) -> Self {
        Self {
            tx_m: DVec3::from_array(radar.array.tx_m[tx]),
            rx_m: DVec3::from_array(radar.array.rx_m[rx]),
            start_s: radar.chirp_start_s(tx, chirp),
            turn,
            line_delay_s: line_delay_s(&radar.hardware.tx, tx) + line_delay_s(&radar.hardware.rx, rx),
            receiver_delay_s: line_delay_s(&radar.hardware.rx, rx),
        }
    }
}

/// Gain and phase errors of both elements as a factor.
pub(crate) fn element_factor(radar: &Radar, tx: usize, rx: usize) -> Complex64 {
    factor(&radar.hardware.tx, tx) * receiver_factor(radar, rx)
}

/// Gain and phase error of a receive element alone as a factor.
pub(crate) fn receiver_factor(radar: &Radar, rx: usize) -> Complex64 {
    factor(&radar.hardware.rx, rx)
}

fn factor(errors: &[ElementError], element: usize) -> Complex64 {
    let error = errors.get(element).copied().unwrap_or_default();
    Complex64::from_polar(amplitude_from_db(error.gain_db), error.phase_rad)
}

pub(crate) fn line_delay_s(errors: &[ElementError], element: usize) -> f64 {
    errors.get(element).map_or(0.0, |error| error.delay_s)
}

/// Transmitter i's factor on chirp m, e^{+j2πim/M}, M = N_tx + 1, with im reduced modulo M in integers.
fn doppler_division_turn(tx: usize, chirp: usize, transmitters: usize) -> Complex64 {
    let bands = transmitters + 1;
    Complex64::cis(TAU * (tx * chirp % bands) as f64 / bands as f64)
}
