//! Detected points and the objects they form.

use crate::descriptions::settings::Class;
use crate::files::envelope::Schema;
use crate::schemas::cube::{CUBE_LIMIT, CubeHeader, least_bytes};
use serde::{Deserialize, Serialize};

/// The `.points` artifact.
pub struct Points;

impl Schema for Points {
    const NAME: &'static str = "points";
    const VERSION: u32 = 12;
    type Header = PointsHeader;
    type Frame = PointsFrame;

    /// A radar of more values than any cube has: the noise of a point is that of windows over its samples and
    /// chirps.
    fn contradiction(header: &PointsHeader, _frame: &PointsFrame) -> Option<String> {
        let values = least_bytes(header.cube.as_ref()?.shape(), 1);
        (values > CUBE_LIMIT).then(|| format!("its radar has {values} values a frame, {CUBE_LIMIT} at most"))
    }
}

/// Header of the artifact, the same for all frames.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PointsHeader {
    /// The radar and settings that made the points; `None` for points from elsewhere.
    pub cube: Option<CubeHeader>,
    /// Ids that [`Point::target`] and [`Label::target`] point to; empty until a report joins the truth.
    pub targets: Vec<String>,
    /// Classes of the targets, where the scene tells them.
    pub classes: Vec<Option<Class>>,
}

/// Points of one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PointsFrame {
    /// Index of the frame record, from 0.
    pub index: u32,
    /// Time of the frame's first sample.
    pub time_s: f64,
    /// Detections.
    pub points: Vec<Point>,
    /// Clusters of points.
    pub objects: Vec<Object>,
}

/// A detection, located.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Range from the array's centre.
    pub range_m: f64,
    /// Radial velocity, positive when the range grows.
    pub radial_velocity_mps: f64,
    /// Azimuth from world +y towards +x; of a [`Height::None`] the boresight's and the angle of the cone.
    pub azimuth_rad: f64,
    /// Elevation above the horizon: measured with elevation rows, else what the assumed height gives.
    pub elevation_rad: f64,
    /// What elevation and height stand on.
    pub height: Height,
    /// World metres.
    pub position_m: [f64; 3],
    /// Map power over the local noise estimate.
    pub snr_db: f64,
    /// Azimuths of the two bodies between which its wave ran, one way round and the other: a ghost, at
    /// neither place. `None` where echoes of one body each explain its peak, or the array cannot tell.
    pub two_ways_rad: Option<[f64; 2]>,
    /// Whether the echo under whose peak the point lies is at rest, as far as its velocity is known; `None`
    /// where the settings do not ask.
    pub stationary: Option<bool>,
    /// Index into [`PointsFrame::objects`]; `None` for a lone detection that forms none.
    pub object: Option<u32>,
    /// True target of its object, joined afterwards by a report; never set by a detector.
    pub target: Option<u32>,
    /// True origin of what echoes in the point's own cell, joined afterwards by a report; never set by a
    /// detector.
    pub label: Option<Label>,
}

/// What the height of a point or an object stands on.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Height {
    /// Measured: the array has elevation rows.
    Measured,
    /// Assumed, as the settings say: range and the cone around the row then leave one place before the array.
    #[default]
    Assumed,
    /// Neither: the range is less than the assumed height is away along that cone, so that no place on the
    /// ground has both. What is measured is the cone alone; the position is that of the radar's own height.
    None,
}

impl Height {
    /// Name of what the height stands on, as tables have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Assumed => "assumed",
            Self::None => "none",
        }
    }
}

impl PointsFrame {
    /// Number of points that no place on the ground has the range of ([`Height::None`]).
    pub fn points_without_height(&self) -> usize {
        self.points.iter().filter(|point| point.height == Height::None).count()
    }
}

/// True origin of a point: whose echo, after how many bounces, fills its cell most.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Label {
    /// Index into [`PointsHeader::targets`]; of the first facet of ways over several bodies.
    pub target: u32,
    /// Bounces; 0 of a point target.
    pub order: u8,
    /// Number of different targets on the way; more than one: a ghost.
    pub bodies: u8,
    /// Share in the power that all targets and orders have in the cell, each for itself.
    pub share: f64,
}

/// A cluster of points: one vehicle, as far as the radar can tell.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Object {
    /// Power-weighted mean of its points.
    pub range_m: f64,
    /// Power-weighted mean of its points, positive when the range grows.
    pub radial_velocity_mps: f64,
    /// Whether velocity ambiguity was resolved (not merely assumed absent).
    pub velocity_resolved: bool,
    /// Azimuth of the summed channels.
    pub azimuth_rad: f64,
    /// What the height of its position stands on.
    pub height: Height,
    /// World metres.
    pub position_m: [f64; 3],
    /// Lane that holds it.
    pub lane: Option<u8>,
    /// Signal-to-noise ratio of the strongest cell.
    pub snr_db: f64,
    /// Number of points.
    pub points: u32,
    /// Nearest and farthest point.
    pub range_extent_m: [f64; 2],
    /// Slowest and fastest point.
    pub velocity_extent_mps: [f64; 2],
    /// Share of the power of the object's peaks that ran between two bodies ([`Point::two_ways_rad`]): an
    /// object of 1 is a ghost. `None` where the array cannot tell.
    pub ghost_share: Option<f64>,
    /// Whether all of the object's peaks are at rest; `None` where the settings do not ask.
    pub stationary: Option<bool>,
}
