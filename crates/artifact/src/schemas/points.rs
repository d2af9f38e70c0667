//! Detected points and the objects that they form.

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

    /// Refuses a radar with more values than any cube may have, since a point's noise depends on windows over
    /// its samples and chirps.
    fn contradiction(header: &PointsHeader, _frame: &PointsFrame) -> Option<String> {
        let values = least_bytes(header.cube.as_ref()?.shape(), 1);
        (values > CUBE_LIMIT).then(|| format!("its radar has {values} values a frame, {CUBE_LIMIT} at most"))
    }
}

/// Header of the artifact, the same for all frames.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PointsHeader {
    /// Radar and settings that produced the points; `None` for points from elsewhere.
    pub cube: Option<CubeHeader>,
    /// Ids referred to by [`Point::target`] and [`Label::target`]; empty until a report joins the truth.
    pub targets: Vec<String>,
    /// Classes of the targets, where the scene specifies them.
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

/// A detection with its position.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Range from the array's centre.
    pub range_m: f64,
    /// Radial velocity, positive when the range grows.
    pub radial_velocity_mps: f64,
    /// Azimuth from world +y towards +x; for [`Height::None`], that of the boresight plus the cone angle.
    pub azimuth_rad: f64,
    /// Elevation above the horizon: measured by an array with elevation rows, else derived from the assumed
    /// height.
    pub elevation_rad: f64,
    /// Basis of elevation and height.
    pub height: Height,
    /// Position, world metres.
    pub position_m: [f64; 3],
    /// Signal-to-noise ratio, dB: map power over the local noise estimate, less 1.
    pub snr_db: f64,
    /// Azimuths of the two bodies between which the wave travelled, in either direction: a ghost, located at
    /// neither. `None` if the peak is explained by echoes of one body each, or if the array cannot resolve
    /// it.
    pub two_ways_rad: Option<[f64; 2]>,
    /// Whether the echo whose peak contains the point is at rest, as far as its velocity is known; `None` if
    /// the settings do not request it.
    pub stationary: Option<bool>,
    /// Index into [`PointsFrame::objects`]; `None` for an isolated detection that forms none.
    pub object: Option<u32>,
    /// True target of the point's object, joined afterwards by a report; never set by a detector.
    pub target: Option<u32>,
    /// True origin of the echo in the point's own cell, joined afterwards by a report; never set by a
    /// detector.
    pub label: Option<Label>,
}

/// Basis of the height of a point or an object.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Height {
    /// Measured: the array has elevation rows.
    Measured,
    /// Assumed from the settings: range and the cone around the row then leave one position in front of the
    /// array.
    #[default]
    Assumed,
    /// Neither: the range is shorter than the distance to the assumed height along that cone, so that no
    /// position on the ground matches both. Only the cone is measured; the position is at the radar's own
    /// height.
    None,
}

impl Height {
    /// Name of the basis in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Assumed => "assumed",
            Self::None => "none",
        }
    }
}

impl PointsFrame {
    /// Number of points whose range matches no position on the ground ([`Height::None`]).
    pub fn points_without_height(&self) -> usize {
        self.points.iter().filter(|point| point.height == Height::None).count()
    }
}

/// True origin of a point: the target and bounce order whose echo contributes most to its cell.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Label {
    /// Index into [`PointsHeader::targets`]; for paths over several bodies that of the first facet.
    pub target: u32,
    /// Number of bounces; 0 for a point target.
    pub order: u8,
    /// Number of different targets along the path; more than one is a ghost.
    pub bodies: u8,
    /// Share of the summed power that all targets and orders have in the cell, each taken by itself.
    pub share: f64,
}

/// A cluster of points: one vehicle, as far as the radar can resolve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Object {
    /// Power-weighted mean range of its points.
    pub range_m: f64,
    /// Power-weighted mean of its points' radial velocities, positive when the range grows.
    pub radial_velocity_mps: f64,
    /// Whether velocity ambiguity was resolved (not merely assumed absent).
    pub velocity_resolved: bool,
    /// Azimuth from the summed channels.
    pub azimuth_rad: f64,
    /// Basis of the height of its position.
    pub height: Height,
    /// Position, world metres.
    pub position_m: [f64; 3],
    /// Lane that contains the object.
    pub lane: Option<u8>,
    /// Signal-to-noise ratio of the strongest cell.
    pub snr_db: f64,
    /// Number of points.
    pub points: u32,
    /// Ranges of the nearest and the farthest point.
    pub range_extent_m: [f64; 2],
    /// Velocities of the slowest and the fastest point.
    pub velocity_extent_mps: [f64; 2],
    /// Share of the power of the object's peaks that travelled between two bodies ([`Point::two_ways_rad`]);
    /// an object with 1 is a ghost. `None` if the array cannot resolve it.
    pub ghost_share: Option<f64>,
    /// Whether all of the object's peaks are at rest; `None` if the settings do not request it.
    pub stationary: Option<bool>,
}
