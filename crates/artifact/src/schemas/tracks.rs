//! Vehicles tracked over frames.

use crate::files::envelope::Schema;
use crate::schemas::cube::CubeHeader;
use serde::{Deserialize, Serialize};

/// The `.tracks` artifact.
pub struct Tracks;

impl Schema for Tracks {
    const NAME: &'static str = "tracks";
    const VERSION: u32 = 3;
    type Header = TracksHeader;
    type Frame = TracksFrame;
}

/// Header of the artifact, the same for all frames.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TracksHeader {
    /// The radar and settings whose objects were tracked; `None` for tracks from elsewhere.
    pub cube: Option<CubeHeader>,
}

/// Tracks of one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TracksFrame {
    /// Index of the frame record, from 0.
    pub index: u32,
    /// Time of the frame's first sample.
    pub time_s: f64,
    /// Live tracks in order of creation.
    pub tracks: Vec<Track>,
}

/// A tracked vehicle at the frame's middle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Track {
    /// Number of the track, counted from 0 over the scene; never reused.
    pub id: u32,
    /// State in the track's life cycle.
    pub state: TrackState,
    /// Frames since its creation, this one included.
    pub age_frames: u32,
    /// Consecutive frames without an object of its own; 0 where it has one.
    pub missed_frames: u32,
    /// Mean position of the reflecting parts: x, y in world metres.
    pub position_m: [f64; 2],
    /// Velocity in world axes.
    pub velocity_mps: [f64; 2],
    /// Covariance of (x, y, v_x, v_y), row-major.
    pub covariance: [[f64; 4]; 4],
    /// Whether a single multiple of the velocity span remains possible; otherwise `velocity_mps` is the
    /// likeliest.
    pub velocity_resolved: bool,
    /// Lane that contains the footprint's centre.
    pub lane: Option<u8>,
    /// Rectangle on the road occupied by the body.
    pub footprint: Footprint,
    /// Indices of the frame's objects associated with the track.
    pub objects: Vec<u32>,
}

/// States of a track.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum TrackState {
    /// Too few frames to confirm the track.
    Tentative,
    /// Confirmed, and seen in this frame.
    Confirmed,
    /// Confirmed, predicted without an object in this frame.
    Coasting,
}

impl TrackState {
    /// Name in files and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tentative => "tentative",
            Self::Confirmed => "confirmed",
            Self::Coasting => "coasting",
        }
    }
}

/// A rectangle on the road, with its length along the heading.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Footprint {
    /// Centre, world metres.
    pub centre_m: [f64; 2],
    /// Extent along the heading: as observed, but at least that of a car of 4 m.
    pub length_m: f64,
    /// Extent across the heading; assumed, since no beam here is as narrow as a vehicle.
    pub width_m: f64,
    /// Heading from world +x towards +y, like a body's yaw.
    pub heading_rad: f64,
}
