//! Range–azimuth–Doppler tensors of RADDet as samples: the inverse transforms of the map and of the virtual
//! row.
//!
//! A tensor is complex64 `[range, azimuth, Doppler]`, the farthest range first, sines 2j/256 − 1 from left to
//! right, velocities from approaching to receding, without the phases of time division, as
//! `training_sets::raddet` writes it. Its samples contain the tensor's windows: with rectangular windows
//! their map is the tensor's.

use crate::azimuth_row::{AZIMUTHS, AzimuthRow};
use artifact::cube::CubeHeader;
use artifact::radar::Multiplexing;
use artifact::rdm::RdmFrame;
use dsp::InverseRangeDoppler;
use dsp::angle::VirtualArray;
use ndarray::{ArrayD, s};
use num_complex::{Complex32, Complex64};
use pipeline::host::failure::Failure;

/// Inverse of a radar's tensors, planned once for any number of frames.
pub(super) struct TensorInverse {
    /// Cells of a tensor, `[range, azimuth, Doppler]`.
    cells: [usize; 3],
    range_doppler: InverseRangeDoppler,
    row: AzimuthRow,
    /// Responses of the channels, by sub-frame and Doppler cell.
    responses: Vec<Vec<Vec<Complex64>>>,
}

impl TensorInverse {
    /// Inverse for the tensors of this radar.
    ///
    /// # Errors
    /// A radar whose samples do not follow from its tensors, and one without a map.
    pub(super) fn new(header: &CubeHeader) -> Result<Self, Failure> {
        let radar = &header.radar;
        if matches!(radar.array.multiplexing, Multiplexing::Ddm | Multiplexing::Bpm) {
            let rule =
                "a tensor tells channels apart: its radar has multiplexing tdm, or transmitters at once";
            return Err(Failure::refused(rule));
        }
        let range_doppler = InverseRangeDoppler::new(&header.in_frame(0)).map_err(Failure::refused)?;
        let row = AzimuthRow::invertible(radar)?;
        let sub_frames = 0..radar.schedule.sub_frames();
        Ok(Self {
            cells: [radar.waveform.range_cells(), AZIMUTHS, radar.waveform.chirps as usize],
            range_doppler,
            row,
            responses: sub_frames.map(|index| responses(&header.in_frame(index))).collect(),
        })
    }

    /// Samples `[channel, chirp, sample]` of the tensor of frame record `index`.
    ///
    /// # Errors
    /// A tensor of other sizes than the radar's.
    pub(super) fn samples(
        &self,
        tensor: &ArrayD<Complex32>,
        index: usize,
    ) -> Result<Vec<Complex32>, Failure> {
        if tensor.shape() != self.cells {
            let (found, expected) = (tensor.shape(), self.cells);
            let rule = format!("[range, azimuth, Doppler] is {found:?}, the scene's radar has {expected:?}");
            return Err(Failure::refused(rule));
        }
        let maps = self.maps(tensor, &self.responses[index % self.responses.len()]);
        let cells = self.cells[0] * self.cells[2];
        Ok(maps.chunks_exact(cells).flat_map(|map| self.range_doppler.channel(map)).collect())
    }

    /// Maps `[channel, Doppler, range]`, near to far.
    fn maps(&self, tensor: &ArrayD<Complex32>, responses: &[Vec<Complex64>]) -> Vec<Complex32> {
        let [ranges, _, doppler_cells] = self.cells;
        let channels_and_rows: usize = responses.iter().map(Vec::len).sum();
        let mut maps = vec![Complex32::ZERO; channels_and_rows * ranges];
        for (doppler, responses) in responses.iter().enumerate() {
            for range in 0..ranges {
                let spectrum = tensor.slice(s![ranges - 1 - range, .., doppler]);
                let spectrum: Vec<Complex64> = (spectrum.iter())
                    .map(|value| Complex64::new(f64::from(value.re), f64::from(value.im)))
                    .collect();
                for (channel, value) in self.row.channels(&spectrum).into_iter().enumerate() {
                    let value = value / responses[channel];
                    maps[(channel * doppler_cells + doppler) * ranges + range] =
                        Complex32::new(value.re as f32, value.im as f32);
                }
            }
        }
        maps
    }
}

/// Responses of calibration and time division to a value of 1 in each channel, by Doppler cell, in the
/// sub-frame of this header.
fn responses(header: &CubeHeader) -> Vec<Vec<Complex64>> {
    let array = VirtualArray::new(header);
    let [channels, rows, columns] = artifact::rdm::shape(header);
    let ones = RdmFrame {
        index: 0,
        time_s: 0.0,
        values: vec![Complex32::ONE; channels * rows * columns],
        mask: vec![],
        detections: 0,
        cells: 0,
        assumed_floor: None,
    };
    let of_row = |(row, velocity_mps): (usize, &f64)| array.snapshot(&ones, [row, 0], *velocity_mps);
    dsp::velocity_axis_mps(header).iter().enumerate().map(of_row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::settings::Noise;
    use ndarray::IxDyn;
    use radar::paper;

    /// Two transmitters in turn beside two receivers, in cycles of two sub-frames.
    fn in_turn() -> CubeHeader {
        let elements = [vec![[0.0, 0.0], [2.0, 0.0]], vec![[0.0, 0.0], [1.0, 0.0]]];
        let mut radar = paper::radar([0.0; 3], paper::waveform(16, 8), elements);
        radar.array.multiplexing = Multiplexing::Tdm;
        radar.schedule.sub_frame_intervals_s = vec![60e-6, 45e-6];
        CubeHeader { radar, noise: Noise::Absent, dsp: paper::processing(), unit: Default::default() }
    }

    #[test]
    fn frames_of_one_inverse_are_those_of_inverses_of_their_sub_frames() {
        let header = in_turn();
        let inverse = TensorInverse::new(&header).unwrap();
        for index in 0..5 {
            let cells = IxDyn(&inverse.cells);
            let tensor = ArrayD::from_shape_fn(cells, |cell| {
                let at = (cell[0] * AZIMUTHS + cell[1]) * 8 + cell[2];
                Complex32::from_polar(1.0 + index as f32, (at * at % 1009) as f32)
            });
            let own = TensorInverse::new(&header.in_frame(index)).unwrap();
            let found = inverse.samples(&tensor, index as usize).unwrap();
            assert_eq!(found.len(), 4 * 8 * 16, "frame {index}");
            assert_eq!(found, own.samples(&tensor, 0).unwrap(), "frame {index}");
        }
    }

    #[test]
    fn an_inverse_refuses_one_tensor_of_other_sizes_and_takes_the_next() {
        let inverse = TensorInverse::new(&in_turn()).unwrap();
        let small = ArrayD::zeros(IxDyn(&[8, AZIMUTHS, 8]));
        let refused = inverse.samples(&small, 0).unwrap_err().to_string();
        assert!(refused.contains("is [8, 256, 8], the scene's radar has [16, 256, 8]"), "{refused}");
        assert!(inverse.samples(&ArrayD::zeros(IxDyn(&inverse.cells)), 1).is_ok());
    }
}
