//! Confirmed and coasting tracks.

use crate::chain::class_rule::{ClassRule, Predicted};
use crate::outcome::summary::classes::Probabilities;
use crate::outcome::summary::words::TrackWord;
use artifact::tracks::{Track, TrackState};
use serde::{Deserialize, Serialize};

/// A tracked vehicle at the frame's middle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrackSummary {
    /// Number of the track, counted from 0 over the scene; never reused.
    pub id: u32,
    /// State of the track, confirmed or coasting.
    #[serde(with = "TrackWord")]
    pub state: TrackState,
    /// Frames since its birth, this one included.
    pub age_frames: u32,
    /// Mean place of the reflecting parts along world x, m.
    pub x_m: f64,
    /// Mean place of the reflecting parts along world y, m.
    pub y_m: f64,
    /// Velocity along world x, m/s.
    pub vx_mps: f64,
    /// Velocity along world y, m/s.
    pub vy_mps: f64,
    /// Whether the Doppler ambiguity is resolved; otherwise the velocity is the likeliest.
    pub velocity_resolved: bool,
    /// Number of the lane that holds the box's middle; `None` outside of all.
    pub lane: Option<u8>,
    /// Box of the body on the road.
    #[serde(rename = "box")]
    pub footprint: TrackBox,
    /// Id of the target that the track truly follows; `None` if it follows none.
    pub target: Option<String>,
    /// Predicted class from all frames of the track so far; `None` if no object of it was classified.
    pub predicted_class: Option<Predicted>,
    /// Probabilities of the classes from all frames of the track so far.
    pub probabilities: Probabilities,
}

/// Box of a track: a rectangle on the road.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TrackBox {
    /// Place of the box's middle along world x, m.
    pub x_m: f64,
    /// Place of the box's middle along world y, m.
    pub y_m: f64,
    /// Length along the heading, m.
    pub length_m: f64,
    /// Width across the heading, m.
    pub width_m: f64,
    /// Heading from world +x towards +y, degrees.
    pub yaw_deg: f64,
}

impl TrackSummary {
    pub(crate) fn of(
        track: &Track,
        target: Option<&str>,
        probabilities: Option<&[f32; 4]>,
        rule: &ClassRule,
    ) -> Self {
        let ([x_m, y_m], [vx_mps, vy_mps], footprint) =
            (track.position_m, track.velocity_mps, &track.footprint);
        Self {
            id: track.id,
            state: track.state,
            age_frames: track.age_frames,
            x_m,
            y_m,
            vx_mps,
            vy_mps,
            velocity_resolved: track.velocity_resolved,
            lane: track.lane,
            footprint: TrackBox {
                x_m: footprint.centre_m[0],
                y_m: footprint.centre_m[1],
                length_m: footprint.length_m,
                width_m: footprint.width_m,
                yaw_deg: footprint.heading_rad.to_degrees(),
            },
            target: target.map(str::to_owned),
            predicted_class: probabilities.map(|p| rule.predict(p)),
            probabilities: Probabilities::of(probabilities),
        }
    }
}
