//! Maps of all channels of a cube, one per transmit–receive pair, after checking its samples.

use crate::error::DspError;
use crate::spectrum::code_division;
use crate::spectrum::doppler_bands::source_of;
use crate::spectrum::map_transform::{RangeDoppler, Workspace};
use artifact::cube::CubeFrame;
use artifact::radar::Multiplexing;
use num_complex::Complex32;
use rayon::prelude::*;

impl RangeDoppler<f32> {
    /// Maps `[channel, doppler, range]` of a frame's samples, before any detection; at least 16 bytes of
    /// memory traffic per value.
    ///
    /// # Errors
    /// Samples whose number or sampling is not the radar's, and non-finite values.
    pub fn all_channels(&self, frame: &CubeFrame) -> Result<Vec<Complex32>, DspError> {
        let (shapes, division, samples) = (self.shapes(), self.division(), frame.samples.as_slice());
        shapes.check_samples(samples)?;
        let mut values = blank(division.map_channels * self.cells());
        let fill = |work: &mut Workspace<f32>, (channel, map): (usize, &mut [Complex32])| {
            let (source, turn_cycles) = source_of(division, channel);
            let own = &samples[source * self.samples()..][..self.samples()];
            self.fill(channel / division.receivers, (own, turn_cycles), work, map);
        };
        values.par_chunks_mut(self.cells()).enumerate().for_each_init(Workspace::default, fill);
        if division.multiplexing == Multiplexing::Bpm {
            values = code_division::codes_of_slots(division, [shapes.map[1], shapes.map[2]], &values);
        }
        shapes.check_values(frame.index, &values)?;
        Ok(values)
    }
}

/// Zeros, written by all threads: obtaining new memory takes longer than writing to it, and a large cube's
/// maps are always new.
fn blank(values: usize) -> Vec<Complex32> {
    (0..values).into_par_iter().with_min_len(1 << 16).map(|_| Complex32::ZERO).collect()
}
