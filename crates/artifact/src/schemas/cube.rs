//! Radar cubes: complex IF samples.

use crate::descriptions::radar::Radar;
use crate::descriptions::settings::{DspSettings, Noise};
use crate::files::envelope::Schema;
use crate::quantities::accuracy::ErrorBudget;
use num_complex::Complex32;
use serde::{Deserialize, Serialize};

/// The `.cube` artifact.
pub struct Cube;

impl Schema for Cube {
    const NAME: &'static str = "cube";
    const VERSION: u32 = 9;
    type Header = CubeHeader;
    type Frame = CubeFrame;

    fn contradiction(header: &CubeHeader, frame: &CubeFrame) -> Option<String> {
        wrong_count("samples", header.shape(), frame.samples.len())
    }
}

/// Sentence about values that are not as many as a shape has.
pub(crate) fn wrong_count(what: &str, shape: [usize; 3], found: usize) -> Option<String> {
    let expected = shape.iter().try_fold(1_usize, |product, n| product.checked_mul(*n));
    let [channels, rows, columns] = shape;
    (expected != Some(found))
        .then(|| format!("{found} {what} where the header's radar has {channels} × {rows} × {columns}"))
}

/// Header with what a detector may know: the radar and its settings, no truth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CubeHeader {
    /// The radar.
    pub radar: Radar,
    /// Whether there is noise to estimate.
    pub noise: Noise,
    /// Settings that the cube carries for its processing.
    pub dsp: DspSettings,
}

/// Samples of one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CubeFrame {
    /// Index of the frame record, from 0.
    pub index: u32,
    /// Time of the frame's first sample.
    pub time_s: f64,
    /// Samples in √W, row-major `[channel, chirp, sample]`, channel = tx·N_rx + rx (with ddm: rx; with bpm:
    /// slot·N_rx + rx).
    pub samples: Vec<Complex32>,
    /// Numerical error of the stages up to here.
    pub error: ErrorBudget,
}

impl CubeHeader {
    /// The header of frame record `index` alone: its sub-frame's radar ([`Radar::in_frame`]).
    pub fn in_frame(&self, index: u32) -> Self {
        Self { radar: self.radar.in_frame(index), ..self.clone() }
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
