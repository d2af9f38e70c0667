//! Errors of elements that the seed draws: gains in dB and phases, each normal, beside those that the scene
//! lists.

use crate::impairments::noise::NoiseStream;
use artifact::Radar;
use artifact::radar::{ElementError, ElementSpread};

/// The radar with the errors that its spread and a scene's seed make, listed; the same in all frames.
pub fn drawn(radar: &Radar, seed: u64) -> Radar {
    let mut drawn = radar.clone();
    let spread = std::mem::take(&mut drawn.hardware.spread);
    if spread != ElementSpread::default() {
        let (tx, rx) = (radar.array.tx_m.len(), radar.array.rx_m.len());
        add(&mut drawn.hardware.tx, tx, |element| error(spread, seed, [0, element]));
        add(&mut drawn.hardware.rx, rx, |element| error(spread, seed, [1, element]));
    }
    drawn
}

fn add(errors: &mut Vec<ElementError>, elements: usize, more: impl Fn(u64) -> ElementError) {
    errors.resize(elements, ElementError::default());
    for (element, error) in errors.iter_mut().enumerate() {
        let more = more(element as u64);
        error.gain_db += more.gain_db;
        error.phase_rad += more.phase_rad;
    }
}

/// Error of an element of an end, 0 where it transmits: from a stream of its own, so that none moves
/// when others come.
fn error(spread: ElementSpread, seed: u64, of: [u64; 2]) -> ElementError {
    // Of mean power 2: real and imaginary part are independent, of variance 1.
    let normal = NoiseStream::of(seed, "fmcw-echo/element-errors", &of).next_sample(2.0);
    ElementError {
        gain_db: spread.gain_db * normal.re,
        phase_rad: spread.phase_rad * normal.im,
        delay_s: 0.0,
    }
}
