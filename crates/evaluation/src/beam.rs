//! Response of the beam in a point's direction to an echo.
//!
//! Transmitters that send one after the other, or in codes over a block of chirps, see an echo at different
//! times. Processing removes the phases by which the echo turns meanwhile with the velocity of the point; in
//! a wrong fold it removes others, and finds the echo in a wrong direction (`docs/physics.md` §7). What
//! remains then is part of the response.

use artifact::radar::{Multiplexing, Radar, code_sign};
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Mean over transmitters times mean over receivers of an echo's values, whose apparent points lie in two
/// `directions` from the array, with the phases of the direction `toward` removed; `faster_mps`: radial
/// velocity of the echo beyond that with which the phases of slots were removed.
pub(crate) fn beam_response(
    radar: &Radar,
    [there, back]: [DVec3; 2],
    toward: DVec3,
    faster_mps: f64,
) -> Complex64 {
    let wavenumber = TAU / radar.waveform.wavelength_m();
    let phase = |element: &[f64; 3], direction: DVec3| {
        let offset = DVec3::from(*element) - DVec3::from(radar.position_m);
        Complex64::cis(-wavenumber * offset.dot(direction))
    };
    let (transmit, receive) = (&radar.array.tx_m, &radar.array.rx_m);
    let sent: Vec<Complex64> = transmit.iter().map(|tx| phase(tx, there)).collect();
    let steered: Vec<Complex64> = transmit.iter().map(|tx| phase(tx, -toward)).collect();
    let received: Complex64 = receive.iter().map(|rx| phase(rx, back - toward)).sum();
    let turn_radps = 2.0 * wavenumber * faster_mps;
    transmitted(radar, [&sent, &steered], turn_radps) * received / receive.len().max(1) as f64
}

/// Mean over transmitters of what is sent, steered; `turn_radps`: phase by which the echo turns in a second
/// more than was removed.
fn transmitted(radar: &Radar, [sent, steered]: [&[Complex64]; 2], turn_radps: f64) -> Complex64 {
    let count = sent.len().max(1) as f64;
    let slots = radar.slots();
    let middle_s = (0..slots).map(|slot| radar.chirp_start_s(slot, 0)).sum::<f64>() / slots as f64;
    let turned = |slot: usize| Complex64::cis(turn_radps * (radar.chirp_start_s(slot, 0) - middle_s));
    let both = || sent.iter().zip(steered);
    match radar.array.multiplexing {
        Multiplexing::Simultaneous | Multiplexing::Ddm => {
            both().map(|(a, b)| a * b).sum::<Complex64>() / count
        }
        Multiplexing::Tdm => {
            both().enumerate().map(|(tx, (a, b))| a * b * turned(tx)).sum::<Complex64>() / count
        }
        Multiplexing::Bpm => {
            let coded = |values: &[Complex64], slot: usize| -> Complex64 {
                values.iter().enumerate().map(|(code, value)| value * code_sign(code, slot)).sum()
            };
            let of_slot = |slot: usize| coded(sent, slot) * coded(steered, slot) * turned(slot);
            (0..slots).map(of_slot).sum::<Complex64>() / (slots as f64 * count)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use radar::aperture::Preset;
    use radar::paper;

    /// Phases by which the slots of a radar turn, for an echo straight ahead.
    fn ahead(multiplexing: Multiplexing, turn_radps: f64, steered: &[Complex64]) -> f64 {
        let mut radar = paper::radar([0.0; 3], paper::waveform(64, 32), Preset::ThreeByFour.elements());
        radar.array.multiplexing = multiplexing;
        let sent = vec![Complex64::ONE; radar.array.tx_m.len()];
        let steered = if steered.is_empty() { &sent } else { steered };
        transmitted(&radar, [&sent, steered], turn_radps).norm()
    }

    #[test]
    fn in_the_right_fold_every_transmitter_adds_in_phase() {
        use Multiplexing::{Bpm, Ddm, Simultaneous, Tdm};
        for multiplexing in [Simultaneous, Tdm, Ddm, Bpm] {
            assert!((ahead(multiplexing, 0.0, &[]) - 1.0).abs() < 1e-12, "{multiplexing:?}");
        }
    }

    /// One turn per block: without the phases of the slots the beam ahead would be in full.
    #[test]
    fn in_a_wrong_fold_the_beam_ahead_has_no_echo_and_the_beam_that_was_found_has_all_of_it() {
        let mut radar = paper::radar([0.0; 3], paper::waveform(64, 32), Preset::ThreeByFour.elements());
        radar.array.multiplexing = Multiplexing::Tdm;
        let turn_radps = TAU / radar.repetition_interval_s();
        assert!(ahead(Multiplexing::Tdm, turn_radps, &[]) < 1e-12);
        let count = radar.array.tx_m.len();
        let found: Vec<Complex64> =
            (0..count).map(|tx| Complex64::cis(-TAU * tx as f64 / count as f64)).collect();
        assert!((ahead(Multiplexing::Tdm, turn_radps, &found) - 1.0).abs() < 1e-12);
        // Three codes of four slots, all steered ahead: 3² of 12 in the first slot, 1 in each of the others.
        radar.array.multiplexing = Multiplexing::Bpm;
        let turn_radps = TAU / radar.repetition_interval_s();
        assert!((ahead(Multiplexing::Bpm, turn_radps, &[]) - 8.0 / 12.0).abs() < 1e-9);
    }
}
