//! Samples as devices record them: the orders of a capture card and of SigMF.
//!
//! A device records receivers while transmitters take turns, slot by slot: slot m·N_tx + i is chirp m of
//! transmitter i (tdm), or slot m·M + s is chirp s of all transmitters' codes in block m (bpm). Samples of a
//! cube are `[turn·N_rx + rx][chirp][sample]`.

mod lanes; // bytes of a capture card
mod described_waveform; // waveforms in descriptions
mod described_unit; // units in descriptions
pub mod dca1000;
mod npy;
mod raddet;
pub mod arrays;
pub mod sigmf;
pub mod uwcr;
#[cfg(test)]
pub(crate) mod test_cube;

use artifact::cube::{CubeHeader, SampleUnit};
use artifact::radar::{Multiplexing, Sampling};
use num_complex::Complex32;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Largest file of samples, which are read whole; devices write files of a gibibyte.
pub const LIMIT_BYTES: u64 = 4 << 30;

/// The shape of one frame of a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct RecordingShape {
    /// Number of chirps from one of a channel to its next.
    turns: usize,
    pub(crate) receivers: usize,
    chirps: usize,
    pub(crate) samples: usize,
}

impl RecordingShape {
    /// Shape of a cube's frames; refused if no device can record it: transmitters that send at once but are
    /// separated.
    pub(crate) fn of(file: &Path, header: &CubeHeader) -> Result<Self, Failure> {
        let array = &header.radar.array;
        match array.multiplexing {
            Multiplexing::Tdm | Multiplexing::Ddm | Multiplexing::Bpm => {}
            Multiplexing::Simultaneous if array.tx_m.len() == 1 => {}
            Multiplexing::Simultaneous => {
                let text = "transmitters are ideally orthogonal: no device records them apart; take multiplexing tdm, ddm or bpm";
                return Err(Failure::Refused(format!("{}: {text}", file.display())));
            }
        }
        let [_, chirps, samples] = header.shape();
        Ok(Self { turns: header.radar.slots(), receivers: array.rx_m.len(), chirps, samples })
    }

    /// Shape of a cube's frames; refused if samples are real.
    pub(crate) fn of_complex(file: &Path, header: &CubeHeader) -> Result<Self, Failure> {
        if header.radar.waveform.sampling == Sampling::Real {
            let text = "samples are real: of recordings a DCA1000EVM's alone are read, and none is written";
            return Err(Failure::Refused(format!("{}: {text}", file.display())));
        }
        Self::of(file, header)
    }

    /// Shape of a single chirp of one transmitter.
    #[cfg(test)]
    pub(crate) fn of_sizes(receivers: usize, samples: usize) -> Self {
        Self { turns: 1, receivers, chirps: 1, samples }
    }

    /// Number of chirps of all transmitters.
    pub(crate) fn slots(&self) -> usize {
        self.chirps * self.turns
    }

    /// Complex values of a frame.
    pub(crate) fn values(&self) -> usize {
        self.slots() * self.receivers * self.samples
    }

    /// Range in a cube's frame of the samples of a slot and a receiver.
    fn row(&self, slot: usize, receiver: usize) -> std::ops::Range<usize> {
        let (chirp, turn) = (slot / self.turns, slot % self.turns);
        let start = ((turn * self.receivers + receiver) * self.chirps + chirp) * self.samples;
        start..start + self.samples
    }

    /// Reorders a cube's frame to `[slot][receiver][sample]`.
    pub(crate) fn by_slot(&self, cube: &[Complex32]) -> Vec<Complex32> {
        let rows =
            (0..self.slots()).flat_map(|slot| (0..self.receivers).map(move |receiver| (slot, receiver)));
        rows.flat_map(|(slot, receiver)| cube[self.row(slot, receiver)].iter().copied()).collect()
    }

    /// Reorders `[slot][receiver][sample]` to a cube's frame.
    pub(crate) fn cube_of_slots(&self, values: &[Complex32]) -> Vec<Complex32> {
        let mut cube = vec![Complex32::ZERO; self.values()];
        for (row, values) in values.chunks_exact(self.samples).enumerate() {
            cube[self.row(row / self.receivers, row % self.receivers)].copy_from_slice(values);
        }
        cube
    }

    /// Reorders `[slot][receiver][sample]` to `[slot][sample][receiver]`.
    pub(crate) fn interleaved(&self, values: &[Complex32]) -> Vec<Complex32> {
        transposed(values, self.receivers, self.samples)
    }

    /// Reorders `[slot][sample][receiver]` to `[slot][receiver][sample]`.
    pub(crate) fn deinterleaved(&self, values: &[Complex32]) -> Vec<Complex32> {
        transposed(values, self.samples, self.receivers)
    }

    /// Refuses a number of values that is not a whole number of frames; notes if nothing beside the file
    /// specifies the shape of a frame, because samples of another radar can make whole frames too.
    pub(crate) fn check_frames(&self, file: &Path, values: usize, shape: ShapeSource) -> Result<(), Failure> {
        let (name, frames) = (file.display(), values / self.values());
        let radars = format!(
            "{} chirps × {} receivers × {} samples, as the scene's radar has them",
            self.slots(),
            self.receivers,
            self.samples
        );
        if values == 0 || !values.is_multiple_of(self.values()) {
            let text = format!("{name}: {values} samples are no whole number of frames of {radars}");
            return Err(Failure::Refused(text));
        }
        if shape == ShapeSource::Assumed {
            let assumed = if frames == 1 { "1 frame is".to_owned() } else { format!("{frames} frames are") };
            progress::note(format!(
                "note: {name}: nothing beside it tells the shape of a frame: {assumed} assumed of {radars}"
            ));
        }
        Ok(())
    }
}

/// Source of the shape of a recording's frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShapeSource {
    /// A description beside it, compared with the scene's radar, or the configuration of the device.
    Described,
    /// No description: the scene's radar is assumed to be the recording one.
    Assumed,
}

impl ShapeSource {
    /// Described, if all of these values are in the description.
    pub(crate) fn of(told: &[&Value]) -> Self {
        if told.iter().all(|value| value.is_number()) { Self::Described } else { Self::Assumed }
    }
}

/// Transposes each run of `rows` × `columns` values.
fn transposed(values: &[Complex32], rows: usize, columns: usize) -> Vec<Complex32> {
    let run = |run: &[Complex32]| {
        (0..rows * columns).map(|i| run[i % rows * columns + i / rows]).collect::<Vec<_>>()
    };
    values.chunks_exact(rows * columns).flat_map(run).collect()
}

/// Frames from a reader of raw data, with the meaning of their steps.
pub struct ImportedFrames {
    /// Samples of each frame, in the order of a cube.
    pub frames: Vec<Vec<Complex32>>,
    /// Step of integer samples, with its source.
    pub step: IntegerStep,
    /// Descriptions beside the recording that were found to be of these samples.
    pub descriptions: Vec<PathBuf>,
}

/// Value of one step of integer samples, with its source.
#[derive(Debug, Clone, PartialEq)]
pub enum IntegerStep {
    /// Samples are floats, of which no file gives the unit.
    Floats,
    /// Samples are floats in the unit that this file gives.
    DescribedFloats(SampleUnit, PathBuf),
    /// √W, given by the command.
    Given(f32),
    /// √W, given by that file.
    Described(f32, PathBuf),
    /// Steps of the converter of the samples, given by that file, which need not be the file's own steps.
    ConverterSteps {
        /// The converter's steps per step of the file.
        step: f32,
        /// Full scale of the converter, in its steps.
        full_scale: Option<f64>,
        /// File with these values.
        place: PathBuf,
    },
    /// Values of a transform with an unknown factor: neither steps nor powers.
    Unscaled,
    /// Unknown.
    Unknown,
}

impl IntegerStep {
    /// Chooses the command's value before the file's.
    fn of(asked: Option<f32>, told: impl FnOnce() -> Option<Self>) -> Self {
        asked.map_or_else(|| told().unwrap_or(Self::Unknown), Self::Given)
    }

    /// Whether a description beside the recording gives it.
    pub fn is_described(&self) -> bool {
        match self {
            Self::Described(..) | Self::ConverterSteps { .. } | Self::DescribedFloats(..) => true,
            Self::Floats | Self::Given(_) | Self::Unscaled | Self::Unknown => false,
        }
    }

    /// Factor of integer samples: √W per step, or steps of the converter; 1 if unknown.
    pub(crate) fn factor(&self) -> f32 {
        match self {
            Self::Given(step) | Self::Described(step, _) | Self::ConverterSteps { step, .. } => *step,
            Self::Floats | Self::DescribedFloats(..) | Self::Unscaled | Self::Unknown => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slots_of_two_transmitters_and_back_are_the_cube() {
        let recording = RecordingShape { turns: 2, receivers: 3, chirps: 2, samples: 4 };
        let cube: Vec<Complex32> = (0..48).map(|i| Complex32::new(i as f32, -(i as f32))).collect();
        let slots = recording.by_slot(&cube);
        // Slot 1 is the first chirp of the second transmitter: channel 3.
        assert_eq!(slots[12], cube[3 * 2 * 4]);
        assert_eq!(recording.cube_of_slots(&slots), cube);
        let interleaved = recording.interleaved(&slots);
        assert_eq!(interleaved[1], slots[4]);
        assert_eq!(recording.deinterleaved(&interleaved), slots);
    }
}
