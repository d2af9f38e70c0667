//! Range–azimuth–Doppler tensors: the angle spectrum over the virtual row in every cell of a map.
//!
//! The spectrum at the sine u is Σ x·e^{+jπp·u}, p a channel's place along the row in half wavelengths: on a
//! row of whole half wavelengths what a Fourier transform of the channels has, padded by zeros to the number
//! of sines, u = 2j/n − 1. Values of a channel are those of the map, its window and calibration in them, free
//! of the phases of time and code division. Of an array with several rows the first of the longest is taken,
//! of channels in one place their mean.

use artifact::Radar;
use artifact::cube::CubeHeader;
use artifact::rdm::RdmFrame;
use dsp::angle::VirtualArray;
use num_complex::{Complex32, Complex64};
use pipeline::host::failure::Failure;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Sines of a tensor, as RADDet and CARRADA have them.
pub(crate) const AZIMUTHS: usize = 256;

/// Values of a tensor: 1 GiB.
const TENSOR_LIMIT: u64 = 1 << 27;

/// The angle spectrum of one radar.
pub(crate) struct AngleSpectrum {
    array: VirtualArray,
    velocities_mps: Vec<f64>,
    ranges: usize,
    /// Channels of the row, each with the factor of its value at every sine.
    weights: Vec<(usize, Vec<Complex64>)>,
}

/// Tensor of a frame.
pub(crate) struct Tensor {
    /// Range cells, sines, Doppler cells.
    pub(crate) shape: [usize; 3],
    /// Values of each range, row-major `[azimuth, doppler]`: near to far, left to right, approaching to
    /// receding.
    pub(crate) by_range: Vec<Vec<Complex32>>,
}

impl AngleSpectrum {
    /// The spectrum of maps that this header describes.
    ///
    /// # Errors
    /// A radar that no receiver is made of, places of other elements than it has, or tensors that are too
    /// large.
    pub(crate) fn of(header: &CubeHeader) -> Result<Self, Failure> {
        dsp::Receiver::new(header).map_err(Failure::refused)?;
        let (radar, waveform) = (&header.radar, &header.radar.waveform);
        if places(radar).len() != radar.virtual_channels() {
            return Err(Failure::refused("its elements have other places than half wavelengths"));
        }
        let values = waveform.range_cells() as u64 * u64::from(waveform.chirps) * AZIMUTHS as u64;
        if values > TENSOR_LIMIT {
            let rule = format!("tensors of {values} values; {TENSOR_LIMIT} are the most that are made");
            return Err(Failure::refused(rule));
        }
        Ok(Self {
            array: VirtualArray::new(header),
            velocities_mps: dsp::velocity_axis_mps(header),
            ranges: waveform.range_cells(),
            weights: weights(radar),
        })
    }

    /// The tensor of a map.
    pub(crate) fn tensor(&self, map: &RdmFrame) -> Tensor {
        let doppler = self.velocities_mps.len();
        let of_range = |range: usize| {
            let mut values = vec![Complex32::ZERO; AZIMUTHS * doppler];
            for row in 0..doppler {
                for (azimuth, value) in self.of_cell(map, [row, range]).into_iter().enumerate() {
                    values[azimuth * doppler + row] = Complex32::new(value.re as f32, value.im as f32);
                }
            }
            values
        };
        let by_range: Vec<Vec<Complex32>> = (0..self.ranges).into_par_iter().map(of_range).collect();
        Tensor { shape: [self.ranges, AZIMUTHS, doppler], by_range }
    }

    fn of_cell(&self, map: &RdmFrame, cell: [usize; 2]) -> Vec<Complex64> {
        let channels = self.array.snapshot(map, cell, self.velocities_mps[cell[0]]);
        let mut spectrum = vec![Complex64::ZERO; AZIMUTHS];
        for (channel, weights) in &self.weights {
            let value = channels[*channel];
            spectrum.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += value * weight);
        }
        spectrum
    }
}

/// Sines of the tensor's azimuth cells, positive to the right along the boresight.
pub(crate) fn sines() -> Vec<f64> {
    (0..AZIMUTHS).map(|cell| 2.0 * cell as f64 / AZIMUTHS as f64 - 1.0).collect()
}

/// Places in half wavelengths that count as one.
const SAME_PLACE: f64 = 1e-6;

fn weights(radar: &Radar) -> Vec<(usize, Vec<Complex64>)> {
    let places = places(radar);
    let row = longest_row(&places);
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

    #[test]
    fn the_longest_row_is_taken_and_channels_in_one_place_are_averaged() {
        let places = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 1.0], [2.0, 1.0]];
        assert_eq!(longest_row(&places), [2, 3, 4, 5]);
        assert_eq!((sines()[0], sines()[AZIMUTHS / 2]), (-1.0, 0.0));
    }
}
