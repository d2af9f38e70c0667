//! Range–azimuth–Doppler tensors: the angle spectrum over the virtual row in every cell of a map.
//!
//! Values of a channel are those of the map, with its window and calibration, without the phases of time and
//! code division.

use crate::azimuth_row::{AZIMUTHS, AzimuthRow};
use artifact::cube::CubeHeader;
use artifact::rdm::RdmFrame;
use dsp::angle::VirtualArray;
use num_complex::{Complex32, Complex64};
use pipeline::host::failure::Failure;
use rayon::prelude::*;

/// Largest number of values in a tensor: 1 GiB.
const TENSOR_LIMIT: u64 = 1 << 27;

/// The angle spectrum of one radar.
pub(crate) struct AngleSpectrum {
    array: VirtualArray,
    velocities_mps: Vec<f64>,
    ranges: usize,
    row: AzimuthRow,
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
    /// The spectrum of maps with this header.
    ///
    /// # Errors
    /// A radar without a valid receiver, places that do not match its elements, or tensors that are too
    /// large.
    pub(crate) fn of(header: &CubeHeader) -> Result<Self, Failure> {
        dsp::Receiver::new(header).map_err(Failure::refused)?;
        let (radar, waveform) = (&header.radar, &header.radar.waveform);
        let row = AzimuthRow::of(radar)?;
        let values = waveform.range_cells() as u64 * u64::from(waveform.chirps) * AZIMUTHS as u64;
        if values > TENSOR_LIMIT {
            let rule = format!("tensors of {values} values; {TENSOR_LIMIT} are the most that are made");
            return Err(Failure::refused(rule));
        }
        Ok(Self {
            array: VirtualArray::new(header),
            velocities_mps: dsp::velocity_axis_mps(header),
            ranges: waveform.range_cells(),
            row,
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
        self.row.spectrum(&self.array.snapshot(map, cell, self.velocities_mps[cell[0]]))
    }
}
