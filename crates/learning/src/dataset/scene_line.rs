//! Lines of a dataset as they are written and read: a scene with its frames and their vehicles.
//!
//! Readers of lines name the fields here, so that a wrong name is a compilation error. `None` represents
//! values that lines of earlier versions lack, and infinite numbers, which JSON does not have.

use artifact::dataset::Split;
use pipeline::outcome::verdict::AccuracyVerdict;
use serde::{Deserialize, Serialize};

/// A scene with all of its frames: a line beside its shard and in `scenes.jsonl`.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct SceneLine {
    /// File of the shard.
    pub(crate) file: String,
    /// Number among the scenes of the recipe.
    pub(crate) scene: Option<u64>,
    /// File of the base scene.
    pub(crate) base: Option<String>,
    pub(crate) seed: u64,
    pub(crate) split: Option<Split>,
    pub(crate) radar_x_m: Option<f64>,
    pub(crate) radar_y_m: Option<f64>,
    pub(crate) radar_height_m: Option<f64>,
    /// Elevation of the boresight.
    pub(crate) tilt_deg: Option<f64>,
    /// Direction along the lanes, from world +y towards +x.
    pub(crate) lanes_azimuth_deg: Option<f64>,
    pub(crate) extra_noise_db: Option<f64>,
    pub(crate) is_queue: bool,
    /// Source of small parts, "statistical"; `None` for the meshes alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) detail: Option<String>,
    /// Number of vehicles that found no room.
    pub(crate) left_out: usize,
    /// Number of the scene in which the errors of this kind were measured.
    pub(crate) measured_in: Option<u64>,
    pub(crate) frames: Vec<FrameLine>,
}

/// A frame with all of its vehicles.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct FrameLine {
    /// Index among the frames of its scene.
    pub(crate) frame: u32,
    /// Number of objects.
    pub(crate) objects: usize,
    /// Number of points.
    pub(crate) points: usize,
    /// Number of paths; `None` for a table.
    pub(crate) paths: Option<usize>,
    pub(crate) accuracy: AccuracyVerdict,
    pub(crate) vehicles: Vec<VehicleLine>,
}

/// A vehicle in one frame, detected or not: its truth with its estimate.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct VehicleLine {
    /// Identifier of the vehicle in one frame of one scene.
    pub(crate) id: String,
    /// Index among the targets of its scene.
    pub(crate) target: u32,
    /// Name of the vehicle's class.
    pub(crate) class: String,
    pub(crate) model: String,
    pub(crate) variant: u64,
    /// Lane of the vehicle's middle.
    pub(crate) lane: Option<u8>,
    /// Range of the vehicle's middle.
    pub(crate) range_m: Option<f64>,
    /// Radial velocity of the vehicle's middle.
    pub(crate) velocity_mps: Option<f64>,
    pub(crate) yaw_deg: Option<f64>,
    pub(crate) x_m: Option<f64>,
    pub(crate) y_m: Option<f64>,
    /// Place across the lanes.
    pub(crate) across_m: Option<f64>,
    /// Range of its echo; `None` without an echo.
    pub(crate) echo_range_m: Option<f64>,
    /// Radial velocity of its echo; `None` without an echo.
    pub(crate) echo_velocity_mps: Option<f64>,
    /// Estimate from its object; `None` if it was missed.
    pub(crate) estimate: Option<EstimateLine>,
}

/// Estimate of a vehicle, as the radar measured it.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct EstimateLine {
    pub(crate) range_m: Option<f64>,
    pub(crate) velocity_mps: Option<f64>,
    pub(crate) x_m: Option<f64>,
    /// Place across the lanes.
    pub(crate) across_m: Option<f64>,
    /// Lane of the object.
    pub(crate) lane: Option<u8>,
    /// Signal-to-noise ratio of the strongest cell.
    pub(crate) snr_db: Option<f64>,
    /// Number of points.
    pub(crate) points: u32,
}

impl SceneLine {
    /// Every vehicle of every frame, with the frame.
    pub(crate) fn vehicles(&self) -> impl Iterator<Item = (&FrameLine, &VehicleLine)> {
        self.frames.iter().flat_map(|frame| frame.vehicles.iter().map(move |vehicle| (frame, vehicle)))
    }

    /// Direction along the lanes, from world +y towards +x, rad; 0 for lines of earlier versions, which lack
    /// it.
    pub(crate) fn lanes_azimuth_rad(&self) -> f64 {
        self.lanes_azimuth_deg.unwrap_or(0.0).to_radians()
    }
}
