//! Random errors of elements drawn from the seed: gains in dB and phases, normally distributed, added to
//! those that the scene lists.

use crate::impairments::noise::NoiseStream;
use artifact::Radar;
use artifact::radar::{ElementError, ElementSpread};

/// Radar with the errors drawn from its spread and a scene's seed listed; the same in all frames.
pub fn with_drawn_errors(radar: &Radar, seed: u64) -> Radar {
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

/// Error of element `of`, [end, index] with end 0 the transmitters: from its own random stream, so that
/// additional elements leave it unchanged.
fn error(spread: ElementSpread, seed: u64, of: [u64; 2]) -> ElementError {
    // Mean power 2: real and imaginary part are independent, with variance 1.
    let normal = NoiseStream::of(seed, "fmcw-echo/element-errors", &of).next_sample(2.0);
    ElementError {
        gain_db: spread.gain_db * normal.re,
        phase_rad: spread.phase_rad * normal.im,
        delay_s: 0.0,
    }
}
