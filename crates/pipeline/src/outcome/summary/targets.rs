//! Targets of a frame, truth beside estimate, and clutter.

use crate::chain::class_rule::Predicted;
use crate::chain::frame_result::FrameResult;
use crate::outcome::summary::classes::Probabilities;
use crate::outcome::summary::echo_error::EchoError;
use crate::outcome::summary::tracks::TrackSummary;
use artifact::points::Object;
use artifact::scene::SceneHeader;
use artifact::settings::Class;
use evaluation::{FrameTruth, Truth};
use radar::doppler_ambiguity::apparent_velocity_mps;
use serde::{Deserialize, Serialize};

/// Target of a frame, truth beside estimate.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TargetSummary {
    /// Id of the target in the scene.
    pub id: String,
    /// True class; `None` for a point target, or where the scene does not specify it.
    pub class: Option<Class>,
    /// Name of the target's mesh; `None` for a point target.
    pub model: Option<String>,
    /// True place and motion at the frame's middle.
    pub truth: TruthSummary,
    /// Estimate from the target's object; `None` without one.
    pub estimate: Option<Estimate>,
    /// Error of the target's own echo, and its effect on the estimate; `None` if it was not measured: for
    /// point targets, which are exact, for tables, and where wheels turn.
    #[serde(default)]
    pub error: Option<EchoError>,
    /// Whether the target has an object; `None` if it cannot be found: hidden, without an echo of its own, or
    /// out of range.
    pub found: Option<bool>,
    /// Whether the target's echoes were removed as echoes at rest.
    pub removed: bool,
    /// Index of the target's object among those of the frame; `None` without one.
    pub object: Option<usize>,
    /// Whether the map shows another velocity than the true one.
    pub velocity_aliased: bool,
    /// Predicted class from this frame's object; `None` without one, and for a point target.
    pub predicted_class: Option<Predicted>,
    /// Probabilities of the classes from this frame's object.
    pub probabilities: Probabilities,
    /// Class of the track that follows the target; `None` without one.
    pub track_class: Option<Predicted>,
    /// Probabilities of the track that follows the target; `None` without one.
    pub track_probabilities: Option<Probabilities>,
}

/// True place and motion of a target at the frame's middle, seen from the radar's position.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct TruthSummary {
    /// Range of the body's origin, m.
    pub range_m: f64,
    /// Radial velocity of the body's origin, positive when the range grows, m/s.
    pub radial_velocity_mps: f64,
    /// Place of the body's origin along world x, m.
    pub x_m: f64,
    /// Place of the body's origin along world y, m.
    pub y_m: f64,
    /// Height of the body's origin, world z, m.
    pub z_m: f64,
    /// Number of the lane that holds the body; `None` outside of all.
    pub lane: Option<u8>,
    /// Range of the body's nearest lit surface, m; `None` if none is lit, or the echo was made from tables.
    pub nearest_range_m: Option<f64>,
    /// Range of the echo, the power-weighted mean over the body's paths, m; `None` if the body has no echo of
    /// its own.
    pub echo_range_m: Option<f64>,
    /// Radial velocity of the echo, the power-weighted mean over the body's paths, positive when the range
    /// grows, m/s; `None` if the body has no echo of its own.
    pub echo_radial_velocity_mps: Option<f64>,
}

/// The radar's estimate of a target: place, motion and level of its object.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// Range, the power-weighted mean of the object's points, m.
    pub range_m: f64,
    /// Radial velocity, positive when the range grows, m/s.
    pub radial_velocity_mps: f64,
    /// Place along world x, m.
    pub x_m: f64,
    /// Place along world y, m.
    pub y_m: f64,
    /// Height along world z, m; without elevation rows the assumed height.
    pub z_m: f64,
    /// Number of the lane that holds the object; `None` outside of all.
    pub lane: Option<u8>,
    /// Signal-to-noise ratio of the object's strongest cell, dB.
    pub snr_db: f64,
    /// Number of points that form the object.
    pub points: u32,
    /// Share of the power of the object's peaks that travelled between two bodies; `None` where the array
    /// cannot measure it.
    pub ghost_share: Option<f64>,
    /// Whether the object is at rest; `None` if the settings keep static echoes unmarked.
    pub stationary: Option<bool>,
}

/// A body of clutter: its place and the range of its echo.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClutterSummary {
    /// Id of the body in the scene.
    pub id: String,
    /// Name of the body's mesh.
    pub model: String,
    /// Place of the body's origin along world x, m.
    pub x_m: f64,
    /// Place of the body's origin along world y, m.
    pub y_m: f64,
    /// Range of the body's nearest lit surface, m; `None` if none is lit.
    pub nearest_range_m: Option<f64>,
    /// Range of the echo, the power-weighted mean over the body's paths, m; `None` if the body has no echo of
    /// its own.
    pub echo_range_m: Option<f64>,
}

impl TargetSummary {
    pub(super) fn of(
        header: &SceneHeader,
        result: &FrameResult,
        frame: &FrameTruth,
        tracks: &[TrackSummary],
        index: usize,
    ) -> Self {
        let (described, truth) = (&header.targets[index], &frame.truths[index]);
        let (class, model) = (described.kind.class(), described.kind.model().cloned());
        let chosen = frame.pairing.object_of[index];
        let object = chosen.map(|o| &result.points.objects[o]);
        let probabilities = chosen.filter(|_| model.is_some()).and_then(|o| result.classes.get(o));
        let track = tracks.iter().find(|track| track.target.as_ref() == Some(&described.id));
        Self {
            id: described.id.clone(),
            class,
            model,
            truth: TruthSummary::of(truth),
            estimate: object.map(Estimate::of),
            error: EchoError::of(header, result, (index, chosen)),
            found: frame.pairing.expected.contains(&index).then_some(object.is_some()),
            removed: frame.pairing.removed.contains(&index),
            object: chosen,
            velocity_aliased: is_aliased(header, truth, object),
            predicted_class: probabilities.map(|p| result.rule.predict(p)),
            probabilities: Probabilities::of(probabilities),
            track_class: track.and_then(|track| track.predicted_class),
            track_probabilities: track.map(|track| track.probabilities),
        }
    }
}

/// Whether the map's velocity minus the true one, rounded to multiples of the unambiguous span, is not zero.
/// Without an estimate the true velocity decides: one beyond the span must be aliased.
fn is_aliased(header: &SceneHeader, truth: &Truth, object: Option<&Object>) -> bool {
    let span = 2.0 * header.radar.velocity_max_mps();
    let shown = object.map(|o| apparent_velocity_mps(&header.radar, o.radial_velocity_mps));
    let difference = shown.unwrap_or_else(|| apparent_velocity_mps(&header.radar, truth.radial_velocity_mps))
        - truth.radial_velocity_mps;
    (difference / span).round() != 0.0
}

impl TruthSummary {
    fn of(truth: &Truth) -> Self {
        Self {
            range_m: truth.range_m,
            radial_velocity_mps: truth.radial_velocity_mps,
            x_m: truth.position_m.x,
            y_m: truth.position_m.y,
            z_m: truth.position_m.z,
            lane: truth.lane,
            nearest_range_m: truth.nearest_range_m,
            echo_range_m: truth.echo.map(|e| e.range_m),
            echo_radial_velocity_mps: truth.echo.map(|e| e.radial_velocity_mps),
        }
    }

    /// True range to compare an estimate with, m: that of the echo, or without one that of the body.
    pub fn compared_range_m(&self) -> f64 {
        self.echo_range_m.unwrap_or(self.range_m)
    }

    /// True radial velocity to compare an estimate with, m/s: that of the echo, or without one that of the
    /// body.
    pub fn compared_radial_velocity_mps(&self) -> f64 {
        self.echo_radial_velocity_mps.unwrap_or(self.radial_velocity_mps)
    }
}

impl Estimate {
    fn of(object: &Object) -> Self {
        let [x_m, y_m, z_m] = object.position_m;
        Self {
            range_m: object.range_m,
            radial_velocity_mps: object.radial_velocity_mps,
            x_m,
            y_m,
            z_m,
            lane: object.lane,
            snr_db: object.snr_db,
            points: object.points,
            ghost_share: object.ghost_share,
            stationary: object.stationary,
        }
    }
}

impl ClutterSummary {
    /// Summarizes a clutter body; `None` for a point, which is no clutter.
    pub(super) fn of(header: &SceneHeader, index: usize, truth: &Truth) -> Option<Self> {
        let described = &header.targets[index];
        Some(Self {
            id: described.id.clone(),
            model: described.kind.model()?.clone(),
            x_m: truth.position_m.x,
            y_m: truth.position_m.y,
            nearest_range_m: truth.nearest_range_m,
            echo_range_m: truth.echo.map(|e| e.range_m),
        })
    }
}
