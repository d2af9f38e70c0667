//! The row of an array whose angle spectrum range–azimuth–Doppler tensors hold, transformed forward and back.
//!
//! The spectrum at the sine u is Σ x·e^{+jπp·u}, where p is a channel's place along the row in half
//! wavelengths: for a row at whole half wavelengths, the Fourier transform of the channels, zero-padded to
//! the number n of sines, u = 2j/n − 1. A channel is then the mean of the spectrum times e^{−jπp·u}, provided
//! that no two places coincide modulo n. Of an array with several rows the first of the longest is used, of
//! channels at one place their mean.

use artifact::Radar;
use num_complex::Complex64;
use pipeline::host::failure::Failure;
use std::f64::consts::PI;

/// Number of sines in a tensor, as in RADDet and CARRADA.
pub(crate) const AZIMUTHS: usize = 256;

/// The longest row of an array.
pub(crate) struct AzimuthRow {
    /// Channels of the row, each with its factors at all sines.
    weights: Vec<(usize, Vec<Complex64>)>,
}

impl AzimuthRow {
    /// The row of a radar.
    ///
    /// # Errors
    /// Elements that are not specified in half wavelengths.
    pub(crate) fn of(radar: &Radar) -> Result<Self, Failure> {
        let places = places(radar);
        if places.len() != radar.virtual_channels() {
            return Err(Failure::refused("its elements have other places than half wavelengths"));
        }
        Ok(Self { weights: weights(&places) })
    }

    /// The row of a radar whose spectrum determines all of its channels.
    ///
    /// # Errors
    /// Those of [`Self::of`], and channels outside the row, at the same place, or between half wavelengths.
    pub(crate) fn invertible(radar: &Radar) -> Result<Self, Failure> {
        let row = Self::of(radar)?;
        let places = places(radar);
        let is_whole = |along: f64| (along - along.round()).abs() < SAME_PLACE;
        let mut cells: Vec<i64> = (places.iter().map(|place| place[0]))
            .filter(|along| is_whole(*along))
            .map(|along| (along.round() as i64).rem_euclid(AZIMUTHS as i64))
            .collect();
        cells.sort_unstable();
        cells.dedup();
        if row.weights.len() != places.len() || cells.len() != places.len() {
            let rule = "an angle spectrum tells the channels of one row alone, each in a place of its own, \
                        whole half wavelengths apart";
            return Err(Failure::refused(rule));
        }
        Ok(row)
    }

    /// Spectrum of the values of all channels.
    pub(crate) fn spectrum(&self, channels: &[Complex64]) -> Vec<Complex64> {
        let mut spectrum = vec![Complex64::ZERO; AZIMUTHS];
        for (channel, weights) in &self.weights {
            let value = channels[*channel];
            spectrum.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += value * weight);
        }
        spectrum
    }

    /// Values of all channels of an [invertible](Self::invertible) row.
    pub(crate) fn channels(&self, spectrum: &[Complex64]) -> Vec<Complex64> {
        let mut channels = vec![Complex64::ZERO; self.weights.len()];
        for (channel, weights) in &self.weights {
            let sum: Complex64 = spectrum.iter().zip(weights).map(|(x, weight)| x * weight.conj()).sum();
            channels[*channel] = sum / AZIMUTHS as f64;
        }
        channels
    }
}

/// Sines of the tensor's azimuth cells, positive to the right along the boresight.
pub(crate) fn sines() -> Vec<f64> {
    (0..AZIMUTHS).map(|cell| 2.0 * cell as f64 / AZIMUTHS as f64 - 1.0).collect()
}

/// Distance in half wavelengths within which places are equal.
const SAME_PLACE: f64 = 1e-6;

fn weights(places: &[[f64; 2]]) -> Vec<(usize, Vec<Complex64>)> {
    let row = longest_row(places);
    let weight = |channel: &usize| {
        let along = places[*channel][0];
        let alike = row.iter().filter(|other| (places[**other][0] - along).abs() < SAME_PLACE).count();
        let factor = |sine: f64| Complex64::from_polar(1.0 / alike as f64, PI * along * sine);
        (*channel, sines().into_iter().map(factor).collect())
    };
    row.iter().map(weight).collect()
}

/// Places of the transmit–receive pairs, [right, up] in half wavelengths.
fn places(radar: &Radar) -> Vec<[f64; 2]> {
    let (tx, rx) = (&radar.array.tx_half_wavelengths, &radar.array.rx_half_wavelengths);
    tx.iter().flat_map(|t| rx.iter().map(move |r| [t[0] + r[0], t[1] + r[1]])).collect()
}

/// Channels of the first of the rows with the most places.
fn longest_row(places: &[[f64; 2]]) -> Vec<usize> {
    let row_of = |height: f64| -> Vec<usize> {
        (0..places.len()).filter(|channel| (places[*channel][1] - height).abs() < SAME_PLACE).collect()
    };
    let distinct = |row: &[usize]| {
        let mut along: Vec<f64> = row.iter().map(|channel| places[*channel][0]).collect();
        along.sort_by(f64::total_cmp);
        along.dedup_by(|a, b| (*a - *b).abs() < SAME_PLACE);
        along.len()
    };
    let rows = places.iter().map(|place| row_of(place[1]));
    let longest =
        |best: Vec<usize>, row: Vec<usize>| if distinct(&row) > distinct(&best) { row } else { best };
    rows.fold(vec![], longest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use radar::{aperture::Preset, paper};

    fn radar(places: &[[f64; 2]]) -> Radar {
        let mut radar = paper::radar([0.0; 3], paper::waveform(16, 8), Preset::OneByFour.elements());
        radar.array.tx_half_wavelengths = vec![[0.0, 0.0]];
        radar.array.rx_half_wavelengths = places.to_vec();
        radar.array.tx_m = vec![[0.0; 3]];
        radar.array.rx_m = vec![[0.0; 3]; places.len()];
        radar
    }

    #[test]
    fn the_longest_row_is_taken_and_channels_in_one_place_are_averaged() {
        let places = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 1.0], [2.0, 1.0]];
        assert_eq!(longest_row(&places), [2, 3, 4, 5]);
        assert_eq!((sines()[0], sines()[AZIMUTHS / 2]), (-1.0, 0.0));
    }

    #[test]
    fn channels_of_a_spectrum_are_those_that_it_is_of() {
        let row =
            AzimuthRow::invertible(&radar(&[[5.0, 0.0], [-3.0, 0.0], [0.0, 0.0], [100.0, 0.0]])).unwrap();
        let channels: Vec<Complex64> =
            (0..4).map(|i| Complex64::from_polar(1.0 + i as f64, i as f64)).collect();
        let found = row.channels(&row.spectrum(&channels));
        assert!(found.iter().zip(&channels).all(|(a, b)| (a - b).norm() < 1e-12), "{found:?}");
    }

    #[test]
    fn channels_that_a_spectrum_does_not_tell_apart_are_refused() {
        let second_row = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let one_place = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]];
        let a_turn_apart = [[0.0, 0.0], [256.0, 0.0]];
        let between = [[0.0, 0.0], [0.5, 0.0]];
        for places in [&second_row[..], &one_place, &a_turn_apart, &between] {
            let refused = AzimuthRow::invertible(&radar(places)).err().unwrap().to_string();
            assert!(refused.contains("one row alone"), "{places:?}: {refused}");
        }
    }
}
