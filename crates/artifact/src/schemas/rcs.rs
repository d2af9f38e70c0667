//! The paper's σ_f: far-field scattering amplitude over frequency, elevation and azimuth.

use crate::descriptions::radar::{Polarization, Radar};
use crate::files::envelope::Schema;
use crate::quantities::accuracy::{ErrorBudget, ModelError};
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

/// The `.rcs` artifact.
pub struct Rcs;

impl Schema for Rcs {
    const NAME: &'static str = "rcs";
    const VERSION: u32 = 8;
    type Header = RcsHeader;
    type Frame = RcsFrame;
}

/// Header of the artifact, the same for all frames.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RcsHeader {
    /// Radar for which the tables were made; `None` for a table of a mesh alone.
    pub radar: Option<Radar>,
    /// Ids of the scene's targets, indexed by [`RcsTable::target`].
    pub targets: Vec<String>,
}

/// Tables of one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RcsFrame {
    /// Index of the frame record, from 0.
    pub index: u32,
    /// Time of the frame's first sample.
    pub time_s: f64,
    /// Tables, one for each target in view.
    pub tables: Vec<RcsTable>,
    /// Numerical error of the tables.
    pub error: ErrorBudget,
    /// Errors of the physical model.
    pub model_error: ModelError,
}

/// Scattering amplitude S in metres over frequency × elevation × azimuth, phase referred to the body's
/// origin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RcsTable {
    /// Index of the target.
    pub target: u32,
    /// Axis 0: frequency.
    pub frequency_hz: Vec<f64>,
    /// Axis 1: elevation above the horizon, body axes.
    pub elevation_rad: Vec<f64>,
    /// Axis 2: azimuth from body x towards body y.
    pub azimuth_rad: Vec<f64>,
    /// Distance from the antenna to the origin; infinite for the far field.
    pub range_m: f64,
    /// Polarization of `amplitude_m`.
    pub polarization: Polarization,
    /// Scattering amplitude S, row-major `[frequency, elevation, azimuth]`.
    pub amplitude_m: Vec<Complex64>,
}
