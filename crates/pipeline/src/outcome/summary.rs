//! `summary.json` as types that write it and read it back: each key is a field, and a nullable key an
//! `Option`. `docs/interface.md` defines the keys.

mod words;
mod classes;
mod radar;
mod tracks;
mod echo_error;
mod targets;
mod frame;
mod one_radar;
mod several_radars;

pub use crate::chain::class_rule::Predicted;
pub use crate::chain::stages::Stage;
pub use crate::outcome::error_figures::{ErrorFigures, ModelErrorFigures};
pub use crate::outcome::false_objects::{Cause, FalseObject};
pub use crate::outcome::verdict::AccuracyVerdict;
pub use classes::Probabilities;
pub use echo_error::EchoError;
pub use evaluation::{Agreement, IdentityMetrics, Metrics};
pub use frame::{FrameSummary, MapState, TargetDetail};
pub use one_radar::{Summary, is_summary};
pub use radar::{ElementErrorSummary, ElementErrors, LaneSummary, RadarSummary};
pub use several_radars::{CommonFrame, CommonTarget, RadarEntry, RadarsSummary, common_times_s};
pub use targets::{ClutterSummary, Estimate, TargetSummary, TruthSummary};
pub use tracks::{TrackBox, TrackSummary};
