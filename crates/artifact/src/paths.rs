//! Scattering paths: exact for any bounce order, antenna element, chirp and moving body (`docs/decisions/path-record.md`).

use crate::radar::Radar;
use crate::settings::Detail;
use crate::{ErrorBudget, ModelError, Schema};
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

/// The `.paths` artifact.
pub struct Paths;

impl Schema for Paths {
    const NAME: &'static str = "paths";
    const VERSION: u32 = 8;
    type Header = PathsHeader;
    type Frame = PathsFrame;
}

/// What does not change from frame to frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PathsHeader {
    /// The radar the paths were traced for.
    pub radar: Radar,
    /// f_c of the amplitudes and their slopes: the centre of the sampled sweep.
    pub centre_frequency_hz: f64,
    /// Ids of the scene's targets; [`Path::target`] points here.
    pub targets: Vec<String>,
}

/// Paths of one frame, referred to its first sample.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PathsFrame {
    /// From 0.
    pub index: u32,
    /// The frame's first sample.
    pub time_s: f64,
    /// In the tracer's order: body, facet sequence, cell; where detail was taken from them, target by target.
    pub paths: Vec<Path>,
    /// Nearest lit surface of each body from the radar's position at the frame's middle, m, in the order of the scene
    /// frame's poses; `None` if all is hidden.
    pub nearest_range_m: Vec<Option<f64>>,
    /// Numerical error of this frame's paths.
    pub error: ErrorBudget,
    /// What the model leaves out in this frame.
    pub model_error: ModelError,
    /// What the tracer did.
    pub trace: TraceStatistics,
}

/// Highest bounce order that a path record holds.
pub const MAX_ORDER: usize = 5;

/// 2 × 2 scattering amplitude in metres, `[receive][transmit]`, v = 0, h = 1.
pub type Amplitude = [[Complex64; 2]; 2];

/// A facet of the scene.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Facet {
    /// Index of the target.
    pub body: u32,
    /// Index of the triangle in its mesh.
    pub triangle: u32,
}

/// One way from transmitter to receiver.
///
/// Its node appears from the transmitter at x_a and from the receiver at x_b, unfolded through the reflections; with
/// L₁ = |x_a − p_t|, L₂ = |x_b − p_r| the scattering amplitude of interface.md is
/// S = Σ a·R_tR_r/(L₁L₂)·e^{−jk(L₁+L₂−R_t−R_r)}: `a` holds neither its own delay's phase nor 1/length.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// Index of the target (of the first facet).
    pub target: u32,
    /// Bounces; 0 for a point target.
    pub order: u8,
    /// x_a at the frame's first sample, world metres.
    pub apparent_tx_m: [f64; 3],
    /// Velocity of x_a.
    pub apparent_tx_mps: [f64; 3],
    /// x_b at the frame's first sample, world metres.
    pub apparent_rx_m: [f64; 3],
    /// Velocity of x_b.
    pub apparent_rx_mps: [f64; 3],
    /// a at f_c.
    pub amplitude_m: Amplitude,
    /// a′ = da/df, m/Hz: a(f) = a + (f − f_c)·a′.
    pub slope_m_per_hz: Amplitude,
    /// The facets in the order of travel; the first `order` are meant.
    pub facets: [Facet; MAX_ORDER],
    /// What of its movement is not at constant velocity.
    pub curve: Curve,
}

/// What of a path's movement is not at constant velocity; nothing by default.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// Constant acceleration of x_a.
    pub apparent_tx_mps2: [f64; 3],
    /// Constant acceleration of x_b.
    pub apparent_rx_mps2: [f64; 3],
    /// The node goes round with a wheel; x_a and x_b are then where its hub appears.
    pub rim: Option<Rim>,
}

/// A point on the rim of a wheel that rolls upright without slipping: hub + r·(cos φ·forward + sin φ·up), φ = φ₀ − (way of the hub
/// along forward)/r.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Rim {
    /// r.
    pub radius_m: f64,
    /// Unit vector in the plane of the wheel, horizontal.
    pub forward: [f64; 3],
    /// φ₀, at the frame's first sample: from forward towards up.
    pub angle_rad: f64,
}

impl Path {
    /// The facets in the order of travel.
    pub fn sequence(&self) -> &[Facet] {
        &self.facets[..usize::from(self.order).min(MAX_ORDER)]
    }
}

/// What the tracer did.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TraceStatistics {
    /// Triangles of all bodies.
    pub triangles: u64,
    /// Beams by bounce order, from order 1.
    pub beams: Vec<u64>,
    /// Paths by bounce order, from order 1.
    pub paths: Vec<u64>,
    /// Upper bound of the power of all beams given up over the power kept.
    pub dropped_power_ratio: f64,
    /// Bytes that the tracer's own structures held at most, estimated.
    pub bytes: u64,
    /// How finely bodies were cut and integrated; `None` where there was no body.
    pub fineness: Option<Fineness>,
    /// Where `error` and `model_error` come from.
    pub origin: ErrorOrigin,
    /// What became of each target's paths; empty where nothing was asked of them.
    pub detail: Vec<TargetDetail>,
}

/// What the accuracy asked for turned out to need.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Fineness {
    /// Largest side of the parts of a facet that are one path.
    pub cell_m: f64,
    /// Of the integrals on each body.
    pub integrals: Vec<IntegralFineness>,
}

/// How finely integrals on one body were taken.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IntegralFineness {
    /// The body's id: in another frame it may stand elsewhere among the targets.
    pub body: String,
    /// Of each, relative to the largest that it could be.
    pub accuracy: f64,
}

/// Whether a frame's errors were measured in it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ErrorOrigin {
    /// In this frame.
    #[default]
    Measured,
    /// In another frame, whose fineness this one has.
    TakenOver,
}

/// A target's level of detail.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TargetDetail {
    /// Never `Auto`.
    pub level: Detail,
    /// Paths that were traced.
    pub traced: u64,
    /// Paths of the frame.
    pub kept: u64,
    /// Of the target's echo against that of all its paths, relative amplitude; `None` where these were kept.
    pub error: Option<f64>,
}
