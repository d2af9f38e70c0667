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

/// Samples `[channel, chirp, sample]` of a tensor, for the header's radar in this frame.
///
/// # Errors
/// A tensor of other sizes than that radar's, a radar whose samples do not follow from its tensors, and one
/// without a map.
pub(super) fn samples(tensor: &ArrayD<Complex32>, header: &CubeHeader) -> Result<Vec<Complex32>, Failure> {
    let radar = &header.radar;
    let expected = [radar.waveform.range_cells(), AZIMUTHS, radar.waveform.chirps as usize];
    if tensor.shape() != expected {
        let found = tensor.shape();
        let rule = format!("[range, azimuth, Doppler] is {found:?}, the scene's radar has {expected:?}");
        return Err(Failure::refused(rule));
    }
    if matches!(radar.array.multiplexing, Multiplexing::Ddm | Multiplexing::Bpm) {
        let rule = "a tensor tells channels apart: its radar has multiplexing tdm, or transmitters at once";
        return Err(Failure::refused(rule));
    }
    let inverse = InverseRangeDoppler::new(header).map_err(Failure::refused)?;
    let maps = maps(tensor, header)?;
    let cells = expected[0] * expected[2];
    Ok(maps.chunks_exact(cells).flat_map(|map| inverse.channel(map)).collect())
}

/// Maps `[channel, Doppler, range]`, near to far.
fn maps(tensor: &ArrayD<Complex32>, header: &CubeHeader) -> Result<Vec<Complex32>, Failure> {
    let row = AzimuthRow::invertible(&header.radar)?;
    let (ranges, velocities_mps) = (tensor.shape()[0], dsp::velocity_axis_mps(header));
    let doppler_cells = velocities_mps.len();
    let channels = header.radar.virtual_channels();
    let mut maps = vec![Complex32::ZERO; channels * doppler_cells * ranges];
    for (doppler, factors) in factors(header, &velocities_mps).into_iter().enumerate() {
        for range in 0..ranges {
            let spectrum = tensor.slice(s![ranges - 1 - range, .., doppler]);
            let spectrum: Vec<Complex64> = (spectrum.iter())
                .map(|value| Complex64::new(f64::from(value.re), f64::from(value.im)))
                .collect();
            for (channel, value) in row.channels(&spectrum).into_iter().enumerate() {
                let value = value / factors[channel];
                maps[(channel * doppler_cells + doppler) * ranges + range] =
                    Complex32::new(value.re as f32, value.im as f32);
            }
        }
    }
    Ok(maps)
}

/// Response of calibration and time division to a value of 1 in each channel, by Doppler cell.
fn factors(header: &CubeHeader, velocities_mps: &[f64]) -> Vec<Vec<Complex64>> {
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
    velocities_mps.iter().enumerate().map(of_row).collect()
}
