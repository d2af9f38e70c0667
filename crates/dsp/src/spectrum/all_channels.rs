//! The maps of a cube's channels, one for every transmit–receive pair, its samples checked first.

use crate::error::DspError;
use crate::numerics::finite::first_not_finite;
use crate::spectrum::code_division;
use crate::spectrum::doppler_bands::source_of;
use crate::spectrum::map_transform::{RangeDoppler, Workspace};
use artifact::cube::CubeHeader;
use artifact::radar::{Multiplexing, Sampling};
use num_complex::Complex32;
use rayon::prelude::*;

pub(crate) fn check_samples(header: &CubeHeader, samples: &[Complex32]) -> Result<(), DspError> {
    let [channels, chirps, length] = header.shape();
    let expected = channels * chirps * length;
    if samples.len() != expected {
        return Err(DspError::SampleCount { expected, found: samples.len() });
    }
    if header.radar.waveform.sampling == Sampling::Real
        && let Some(at) = samples.iter().position(|sample| sample.im != 0.0)
    {
        return Err(DspError::NotReal {
            channel: at / (chirps * length),
            chirp: at / length % chirps,
            sample: at % length,
        });
    }
    match first_not_finite(samples) {
        None => Ok(()),
        Some(at) => Err(DspError::SampleNotFinite {
            channel: at / (chirps * length),
            chirp: at / length % chirps,
            sample: at % length,
        }),
    }
}

/// Maps `[channel, doppler, range]` of a cube's samples, before any detection; 16 bytes of memory traffic a
/// value at least.
pub fn all_channels(
    header: &CubeHeader,
    transform: &RangeDoppler,
    samples: &[Complex32],
) -> Result<Vec<Complex32>, DspError> {
    check_samples(header, samples)?;
    let cells = transform.cells();
    let mut values = blank(header.radar.map_channels() * cells);
    let fill = |work: &mut Workspace<f32>, (channel, map): (usize, &mut [Complex32])| {
        let (source, turn_cycles) = source_of(header, channel);
        let transmitter = channel / header.radar.array.rx_m.len();
        let own = &samples[source * transform.samples()..][..transform.samples()];
        transform.fill(transmitter, (own, turn_cycles), work, map);
    };
    values.par_chunks_mut(cells).enumerate().for_each_init(Workspace::default, fill);
    if header.radar.array.multiplexing == Multiplexing::Bpm {
        values = code_division::codes_of_slots(header, &values);
    }
    match first_not_finite(&values) {
        None => Ok(values),
        Some(at) => Err(DspError::ValueNotFinite { channel: at / cells, cell: at % cells }),
    }
}

/// Zeros, written by all threads: to be given new memory takes longer than to write to it, and a large cube's
/// maps are always new.
fn blank(values: usize) -> Vec<Complex32> {
    (0..values).into_par_iter().with_min_len(1 << 16).map(|_| Complex32::ZERO).collect()
}
