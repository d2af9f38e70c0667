//! Radar cubes: complex IF samples.

use crate::descriptions::radar::{Radar, Sampling};
use crate::descriptions::settings::{DspSettings, Noise};
use crate::files::envelope::Schema;
use crate::quantities::accuracy::ErrorBudget;
use crate::quantities::units::db_from_power;
use num_complex::Complex32;
use serde::{Deserialize, Serialize};

/// The `.cube` artifact.
pub struct Cube;

impl Schema for Cube {
    const NAME: &'static str = "cube";
    const VERSION: u32 = 10;
    type Header = CubeHeader;
    type Frame = CubeFrame;

    fn contradiction(header: &CubeHeader, frame: &CubeFrame) -> Option<String> {
        wrong_count("samples", header.shape(), frame.samples.len())
    }

    fn least_frame_bytes(header: &CubeHeader) -> u64 {
        least_bytes(header.shape(), 8)
    }
}

/// Minimum number of bytes of an array of this shape; saturates at the largest number.
pub(crate) fn least_bytes(shape: [usize; 3], value_bytes: u64) -> u64 {
    shape.iter().fold(value_bytes, |product, n| product.saturating_mul(*n as u64))
}

/// Message about a number of values that does not match a shape.
pub(crate) fn wrong_count(what: &str, shape: [usize; 3], found: usize) -> Option<String> {
    let expected = shape.iter().try_fold(1_usize, |product, n| product.checked_mul(*n));
    let [channels, rows, columns] = shape;
    (expected != Some(found))
        .then(|| format!("{found} {what} where the header's radar has {channels} × {rows} × {columns}"))
}

/// Header with the information available to a detector: the radar and its settings, no truth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CubeHeader {
    /// The radar.
    pub radar: Radar,
    /// Receiver noise, to be estimated if there is any.
    pub noise: Noise,
    /// Settings for the processing of the cube.
    pub dsp: DspSettings,
    /// Unit of the samples and of quantities derived from them.
    pub unit: SampleUnit,
}

/// Unit of samples.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub enum SampleUnit {
    /// √W at the receiver.
    #[default]
    RootWatts,
    /// Steps of a converter with this full-scale value; levels are relative to it.
    FullScale(f64),
    /// Steps of a converter of unknown full scale.
    Steps,
}

impl SampleUnit {
    /// Level of a power in this unit squared, in [`Self::level_unit`]; 0 dBFS is a sample with the magnitude
    /// of full scale.
    pub fn level_db(self, power: f64) -> f64 {
        match self {
            Self::RootWatts | Self::Steps => db_from_power(power),
            Self::FullScale(steps) => db_from_power(power / (steps * steps)),
        }
    }

    /// Unit of levels.
    pub fn level_unit(self) -> &'static str {
        match self {
            Self::RootWatts => "dBW",
            Self::FullScale(_) => "dBFS",
            Self::Steps => "dB of ADC steps",
        }
    }

    /// Unit of samples in words.
    pub fn words(self) -> String {
        match self {
            Self::RootWatts => "√W".to_owned(),
            Self::FullScale(steps) => format!("ADC steps, {steps} to full scale"),
            Self::Steps => "ADC steps".to_owned(),
        }
    }

    /// Unit of samples in tables for other programs.
    pub fn name(self) -> &'static str {
        match self {
            Self::RootWatts => "sqrt(W)",
            Self::FullScale(_) | Self::Steps => "ADC steps",
        }
    }

    /// Full scale in steps, where known.
    pub fn full_scale(self) -> Option<f64> {
        match self {
            Self::FullScale(steps) => Some(steps),
            Self::RootWatts | Self::Steps => None,
        }
    }
}

/// Maximum number of values of a frame's cube: one GiB at 8 bytes each, of which the stages hold a few.
pub const CUBE_LIMIT: u64 = 1 << 27;

/// Samples of one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CubeFrame {
    /// Index of the frame record, from 0.
    pub index: u32,
    /// Time of the frame's first sample.
    pub time_s: f64,
    /// Samples in the header's unit, row-major `[channel, chirp, sample]`, channel = tx·N_rx + rx (rx with
    /// ddm; slot·N_rx + rx with bpm).
    pub samples: Vec<Complex32>,
    /// Numerical error accumulated over the stages so far.
    pub error: ErrorBudget,
}

impl CubeHeader {
    /// Header of frame record `index`, with the radar of its sub-frame ([`Radar::in_frame`]).
    pub fn in_frame(&self, index: u32) -> Self {
        Self { radar: self.radar.in_frame(index), ..self.clone() }
    }

    /// Level of a map cell whose power is summed over `channels`, in the unit's own decibels. Maps are not
    /// scaled, but relative to a full scale their mean over channels is, so that a full-scale tone has 0
    /// dBFS; a real one has half of its amplitude in either of its two lines.
    pub fn map_level_db(&self, power: f64, channels: usize) -> f64 {
        let waveform = &self.radar.waveform;
        let of_line = if waveform.sampling == Sampling::Real { 0.5 } else { 1.0 };
        let gain = of_line * f64::from(waveform.chirps) * f64::from(waveform.samples);
        match self.unit {
            SampleUnit::RootWatts | SampleUnit::Steps => self.unit.level_db(power),
            SampleUnit::FullScale(_) => self.unit.level_db(power / (gain * gain * channels.max(1) as f64)),
        }
    }

    /// Shape `[channel, chirp, sample]` of every frame.
    pub fn shape(&self) -> [usize; 3] {
        [
            self.radar.cube_channels(),
            self.radar.waveform.chirps as usize,
            self.radar.waveform.samples as usize,
        ]
    }
}
