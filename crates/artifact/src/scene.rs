//! Scene snapshot: bodies, each with its own mesh, pose and velocity, and the radar that looks at them.

use crate::Schema;
use crate::material::{Makeup, MaterialMap, Road};
use crate::radar::Radar;
use crate::settings::{Class, DspSettings, Fidelity, Noise};
use serde::{Deserialize, Serialize};

/// The `.scene` artifact.
pub struct Scene;

impl Schema for Scene {
    const NAME: &'static str = "scene";
    const VERSION: u32 = 3;
    type Header = SceneHeader;
    type Frame = SceneFrame;
}

/// What does not change from frame to frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneHeader {
    /// As the scene file says.
    pub name: String,
    /// Noise and everything random.
    pub seed: u64,
    /// Number of radar frames.
    pub frames: u32,
    /// From one frame's first sample to the next's.
    pub frame_interval_s: f64,
    /// The radar.
    pub radar: Radar,
    /// Receiver noise.
    pub noise: Noise,
    /// Signal processing.
    pub dsp: DspSettings,
    /// Accuracy and physics asked for.
    pub fidelity: Fidelity,
    /// The road's lanes.
    pub intersection: Intersection,
    /// What the meshes' materials stand for; each mesh has its own share as [`Mesh::makeup`].
    pub materials: MaterialMap,
    /// The road as a mirror; `None` leaves its reflections out.
    pub road: Option<Road>,
    /// Meshes that targets share.
    pub meshes: Vec<Mesh>,
    /// What may be seen, in the order of [`SceneFrame::poses`].
    pub targets: Vec<Target>,
}

/// The road of Table 1 (lanes are in [`DspSettings::lanes`]).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Intersection {
    /// Width of the crossing road along y.
    pub width_m: f64,
}

/// A target of the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Target {
    /// Unique in the scene.
    pub id: String,
    /// What scatters.
    pub kind: TargetKind,
    /// Where it is at the first frame's first sample; velocity and yaw stay as they are from then on.
    pub start: Pose,
}

/// What a target is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum TargetKind {
    /// A body with a mesh.
    Mesh {
        /// Told by the scene, truth for the classifier.
        class: Option<Class>,
        /// Name of the own vehicle, or file name.
        model: String,
        /// Index into [`SceneHeader::meshes`].
        mesh: u32,
    },
    /// A point with scattering amplitude +√σ in vv and hh.
    Point {
        /// σ.
        rcs_m2: f64,
    },
}

/// Pose of every target at the frame's first sample.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneFrame {
    /// From 0.
    pub index: u32,
    /// The frame's first sample.
    pub time_s: f64,
    /// In the order of [`SceneHeader::targets`].
    pub poses: Vec<Pose>,
}

/// Where a body is and how it moves; `world = position + Rz(yaw)·body`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Body origin, world metres.
    pub position_m: [f64; 3],
    /// Body x axis (forward) from world +x towards +y.
    pub yaw_rad: f64,
    /// Constant over the frame.
    pub velocity_mps: [f64; 3],
}

/// Triangles in body axes: x forward, y left, z up, origin at the centre of the bounding box on the ground.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// Own vehicle or file.
    pub name: String,
    /// Body metres.
    pub vertices_m: Vec<[f64; 3]>,
    /// Unit normals per vertex, as many as vertices, or empty where the file stores none.
    pub normals: Vec<[f32; 3]>,
    /// Indices into `vertices_m`.
    pub triangles: Vec<[u32; 3]>,
    /// Index into `materials` for each triangle.
    pub material_of_triangle: Vec<u16>,
    /// Names of materials; an empty name is a perfect conductor.
    pub materials: Vec<String>,
    /// What these names stand for.
    pub makeup: Makeup,
    /// What was found when the file was read.
    pub statistics: MeshStatistics,
}

/// What was found when a mesh was read.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MeshStatistics {
    /// Triangles in the file.
    pub triangles_read: u64,
    /// Dropped for want of area.
    pub degenerate: u64,
    /// Edges with one triangle only (by position).
    pub open_edges: u64,
}
