//! Scene snapshot: bodies, each with its own mesh, pose and velocity, and the radar that observes them.

use crate::descriptions::material::{MaterialMap, MeshMaterials, Road};
use crate::descriptions::radar::Radar;
use crate::descriptions::settings::{Class, DspSettings, Fidelity, Noise};
use crate::files::envelope::Schema;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::ops::{Deref, DerefMut};
use std::sync::Arc;

/// The `.scene` artifact.
pub struct Scene;

impl Schema for Scene {
    const NAME: &'static str = "scene";
    const VERSION: u32 = 18;
    type Header = SceneHeader;
    type Frame = SceneFrame;
}

/// Header of the artifact, the same for all frames.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneHeader {
    /// Name in the scene file.
    pub name: String,
    /// Seed of noise and all other randomness.
    pub seed: u64,
    /// Number of frame records: radar frames, or their sub-frames.
    pub frames: u32,
    /// Time from the first sample of one radar frame to that of the next.
    pub frame_interval_s: f64,
    /// The radar.
    pub radar: Radar,
    /// Receiver noise.
    pub noise: Noise,
    /// Signal processing.
    pub dsp: DspSettings,
    /// Requested accuracy and physics.
    pub fidelity: Fidelity,
    /// The road's lanes.
    pub intersection: Intersection,
    /// Materials for the meshes' material names; each mesh holds its own in [`Mesh::makeup`].
    pub materials: MaterialMap,
    /// The road as a mirror; `None` omits its reflections.
    pub road: Option<Road>,
    /// Backscatter of the road itself; `None` omits it.
    pub backscatter: Option<Backscatter>,
    /// Meshes shared by targets.
    pub meshes: Meshes,
    /// Targets present in every frame; they come first in [`SceneFrame::poses`].
    pub targets: Vec<Target>,
    /// Recorded traffic, if any; it follows the targets in [`SceneFrame::poses`].
    pub traffic: Option<Traffic>,
}

/// Recorded traffic, as far as it is in the radar's view.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Traffic {
    /// Vehicles in view in some frame, in order of appearance.
    pub vehicles: Vec<Vehicle>,
    /// Vehicles in view in each frame of the scene, in the order of the recording.
    pub frames: Vec<Vec<VehiclePose>>,
}

/// A vehicle of recorded traffic.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Vehicle {
    /// Id from the recording, unique in the scene.
    pub id: String,
    /// Scattering mesh or point.
    pub kind: TargetKind,
}

/// A vehicle in one frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct VehiclePose {
    /// Index into [`Traffic::vehicles`].
    pub vehicle: u32,
    /// Pose at the frame's first sample.
    pub pose: Pose,
}

/// Meshes of a scene, shared by copies of a header.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Meshes(Arc<Vec<Mesh>>);

impl From<Vec<Mesh>> for Meshes {
    fn from(meshes: Vec<Mesh>) -> Self {
        Self(Arc::new(meshes))
    }
}

impl Deref for Meshes {
    type Target = Vec<Mesh>;

    fn deref(&self) -> &Vec<Mesh> {
        &self.0
    }
}

impl DerefMut for Meshes {
    fn deref_mut(&mut self) -> &mut Vec<Mesh> {
        Arc::make_mut(&mut self.0)
    }
}

impl Serialize for Meshes {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'d> Deserialize<'d> for Meshes {
    fn deserialize<D: Deserializer<'d>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::deserialize(deserializer).map(Self::from)
    }
}

impl SceneHeader {
    /// Time of the first sample of frame record `index`, from that of record 0.
    pub fn frame_time_s(&self, index: u32) -> f64 {
        let cycle = index / self.radar.schedule.sub_frames();
        f64::from(cycle) * self.frame_interval_s + self.radar.sub_frame_start_s(index)
    }

    /// Frame record whose measured error record `index` takes over; `index` itself if its own is measured.
    pub fn measured_in(&self, index: u32) -> u32 {
        let sub_frames = self.radar.schedule.sub_frames();
        index - index / sub_frames % self.fidelity.measured_every.max(1) * sub_frames
    }

    /// Scene of frame record `index`, with the radar of its sub-frame ([`Radar::in_frame`]).
    pub fn in_frame(&self, index: u32) -> Cow<'_, Self> {
        if self.radar.schedule.sub_frames() == 1 {
            return Cow::Borrowed(self);
        }
        Cow::Owned(Self { radar: self.radar.in_frame(index), ..self.clone() })
    }

    /// All bodies in the order in which artifacts number them: targets, then the vehicles of traffic that are
    /// in view in some frame.
    pub fn bodies(&self) -> impl Iterator<Item = (&String, &TargetKind)> {
        let vehicles = self.traffic.iter().flat_map(|traffic| &traffic.vehicles);
        let vehicles = vehicles.map(|vehicle| (&vehicle.id, &vehicle.kind));
        self.targets.iter().map(|target| (&target.id, &target.kind)).chain(vehicles)
    }

    /// Pose in which each of the [`bodies`](Self::bodies) is first in view; `None` if it never is.
    pub fn first_poses(&self) -> Vec<Option<Pose>> {
        let mut poses: Vec<_> = self.targets.iter().map(|target| Some(target.start)).collect();
        let Some(traffic) = &self.traffic else { return poses };
        poses.resize(self.targets.len() + traffic.vehicles.len(), None);
        for placed in traffic.frames.iter().flatten() {
            if let Some(pose) = poses.get_mut(self.targets.len() + placed.vehicle as usize) {
                pose.get_or_insert(placed.pose);
            }
        }
        poses
    }

    /// Mesh of a body; `None` for a point.
    pub fn mesh_of(&self, kind: &TargetKind) -> Option<&Mesh> {
        self.meshes.get(kind.mesh()? as usize)
    }
}

/// The crossing road of Table 1; its lanes are in [`DspSettings::road`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Intersection {
    /// Width of the crossing road along y; 0 if there is none.
    pub width_m: f64,
}

/// The road's own backscatter: the plane z = 0 with σ⁰ = γ·sin ψ, ψ the grazing angle, for both vv and hh.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Backscatter {
    /// Power coefficient γ.
    pub gamma: f64,
}

/// A target of the scene, or a piece of clutter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Target {
    /// Name of the target, unique in the scene.
    pub id: String,
    /// Whether the radar is expected to find it.
    pub role: Role,
    /// Scattering mesh or point.
    pub kind: TargetKind,
    /// Pose at the first frame's first sample; acceleration and yaw rate stay constant from then on.
    pub start: Pose,
}

/// Role of a body in the evaluation; scattering does not depend on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Role {
    /// A true target, with which results are compared.
    Target,
    /// Clutter such as a pole, a rail or a kerb, which is not evaluated.
    Clutter,
}

/// Geometry of a target: mesh or point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum TargetKind {
    /// A body with a mesh.
    Mesh {
        /// Class given by the scene, the truth for the classifier.
        class: Option<Class>,
        /// Name of the built-in vehicle, or file name.
        model: String,
        /// Index into [`SceneHeader::meshes`].
        mesh: u32,
    },
    /// A point with scattering amplitude +√σ in vv and hh.
    Point {
        /// Cross section σ.
        rcs_m2: f64,
        /// Wheel on which the point rotates, in which case its pose is that of the hub; `None` for a point
        /// that does not rotate.
        wheel: Option<Wheel>,
    },
}

impl TargetKind {
    /// Class given by the scene; `None` for a point.
    pub fn class(&self) -> Option<Class> {
        match self {
            Self::Mesh { class, .. } => *class,
            Self::Point { .. } => None,
        }
    }

    /// Name of the model; `None` for a point.
    pub fn model(&self) -> Option<&String> {
        match self {
            Self::Mesh { model, .. } => Some(model),
            Self::Point { .. } => None,
        }
    }

    /// Index into [`SceneHeader::meshes`]; `None` for a point.
    pub fn mesh(&self) -> Option<u32> {
        match self {
            Self::Mesh { mesh, .. } => Some(*mesh),
            Self::Point { .. } => None,
        }
    }
}

/// A wheel that rolls along its yaw without slipping, and the scattering point on its rim.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Wheel {
    /// Radius of the rim.
    pub radius_m: f64,
    /// Angle at the first frame's first sample, from forward towards up.
    pub angle_rad: f64,
}

/// Pose of every target, and of every vehicle in view, at the frame's first sample.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneFrame {
    /// Index of the frame record, from 0.
    pub index: u32,
    /// Time of the frame's first sample.
    pub time_s: f64,
    /// Poses in the order of [`SceneHeader::targets`], then of the frame's [`Traffic::frames`].
    pub poses: Vec<Pose>,
}

/// Position and motion of a body; `world = position + Rz(yaw)·body`.
///
/// Velocity and acceleration turn with the body, as they do for a vehicle that drives forwards through a
/// bend.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Body origin, world metres.
    pub position_m: [f64; 3],
    /// Angle of the body x axis (forward) from world +x towards +y.
    pub yaw_rad: f64,
    /// Rate of `yaw_rad`, constant.
    pub yaw_radps: f64,
    /// Velocity at the moment of the pose.
    pub velocity_mps: [f64; 3],
    /// Acceleration at the moment of the pose, constant in body axes; excludes the contribution of turning.
    pub acceleration_mps2: [f64; 3],
}

/// Triangles in body axes: x forward, y left, z up, origin at the centre of the bounding box on the ground.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// Name of the built-in vehicle or of the file.
    pub name: String,
    /// Vertices in body axes, metres.
    pub vertices_m: Vec<[f64; 3]>,
    /// Unit normals per vertex, as many as vertices; empty if the file stores none.
    pub normals: Vec<[f32; 3]>,
    /// Indices into `vertices_m`.
    pub triangles: Vec<[u32; 3]>,
    /// Index into `materials` for each triangle.
    pub material_of_triangle: Vec<u16>,
    /// Names of materials; an empty name is a perfect conductor.
    pub materials: Vec<String>,
    /// Materials of these names.
    pub makeup: MeshMaterials,
    /// Road wheels that the model names; empty if there are none.
    pub wheels: Vec<RoadWheel>,
    /// Findings of the mesh reader.
    pub statistics: MeshStatistics,
}

impl Mesh {
    /// Minimum and maximum corner of the bounding box, body metres; zero for a mesh without vertices.
    pub fn bounds_m(&self) -> [[f64; 3]; 2] {
        [f64::min, f64::max].map(|pick: fn(f64, f64) -> f64| {
            [0, 1, 2].map(|axis| self.vertices_m.iter().map(|v| v[axis]).reduce(pick).unwrap_or(0.0))
        })
    }

    /// Length, width and height of the bounding box, body metres.
    pub fn size_m(&self) -> [f64; 3] {
        let [low_m, high_m] = self.bounds_m();
        [0, 1, 2].map(|axis| high_m[axis] - low_m[axis])
    }

    /// Distance of the farthest vertex from the body's origin.
    pub fn reach_m(&self) -> f64 {
        let square = |[x, y, z]: &[f64; 3]| x * x + y * y + z * z;
        self.vertices_m.iter().map(square).fold(0.0, f64::max).sqrt()
    }
}

/// A road wheel of a mesh, its axle along the body's y axis.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RoadWheel {
    /// Centre of the wheel on its axle, body metres.
    pub hub_m: [f64; 3],
    /// Rolling radius.
    pub radius_m: f64,
    /// Triangles of the wheel, ascending, without those of bodies of revolution about the axle, which look
    /// the same at any rotation.
    pub triangles: Vec<u32>,
}

/// Findings of the mesh reader.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MeshStatistics {
    /// Triangles in the file.
    pub triangles_read: u64,
    /// Triangles dropped because they have no area.
    pub degenerate: u64,
    /// Edges with a single triangle (by position).
    pub open_edges: u64,
}
