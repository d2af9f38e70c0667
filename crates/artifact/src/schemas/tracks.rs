//! Vehicles followed over frames.

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
    /// The radar and settings whose objects were followed; `None` for tracks from elsewhere.
    pub cube: Option<CubeHeader>,
}

/// Tracks of one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TracksFrame {
    /// Index of the frame record, from 0.
    pub index: u32,
    /// Time of the frame's first sample.
    pub time_s: f64,
    /// Tracks that are alive, in the order of their birth.
    pub tracks: Vec<Track>,
}

/// A vehicle that is followed, at the frame's middle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Track {
    /// Number of the track, counted from 0 over the scene; never given twice.
    pub id: u32,
    /// Stage of the track's life.
    pub state: TrackState,
    /// Frames since its birth, this one included.
    pub age_frames: u32,
    /// Frames in a row without an object of its own; 0 where it has one.
    pub missed_frames: u32,
    /// Mean place of what reflects: x, y in world metres.
    pub position_m: [f64; 2],
    /// World m/s.
    pub velocity_mps: [f64; 2],
    /// Covariance of (x, y, v_x, v_y), row by row.
    pub covariance: [[f64; 4]; 4],
    /// Whether one multiple of the velocity span is left; else `velocity_mps` is the likeliest.
    pub velocity_resolved: bool,
    /// Lane that holds the box's middle.
    pub lane: Option<u8>,
    /// Rectangle on the road where the body stands.
    pub footprint: Footprint,
    /// Indices of the frame's objects that are its own.
    pub objects: Vec<u32>,
}

/// Stages of a track's life.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum TrackState {
    /// The track has too few frames to be believed.
    Tentative,
    /// Believed, and seen in this frame.
    Confirmed,
    /// Believed, predicted where nothing was seen.
    Coasting,
}

impl TrackState {
    /// Name as people write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tentative => "tentative",
            Self::Confirmed => "confirmed",
            Self::Coasting => "coasting",
        }
    }
}

/// A rectangle on the road, its length along the heading.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Footprint {
    /// Place of the middle, world metres.
    pub centre_m: [f64; 2],
    /// Extent along the heading: as far as it was seen, and no shorter than a car of 4 m.
    pub length_m: f64,
    /// Extent across the heading; assumed, for no beam here is as narrow as a vehicle.
    pub width_m: f64,
    /// Heading from world +x towards +y, as a body's yaw.
    pub heading_rad: f64,
}
