//! Scenes of posed bodies; radar and processing are not asked.

use artifact::Accuracy;
use artifact::material::MaterialMap;
use artifact::radar::Radar;
use artifact::scene::{Intersection, Mesh, Pose, Role, SceneFrame, SceneHeader, Target, TargetKind};
use artifact::settings::{
    BetweenBodies, Detail, EchoMode, Edges, Fidelity, NodeRule, Noise, Sides, SmallParts, Surface, Wheels,
};
use radar::aperture::Preset;
use radar::paper;

const RADAR_M: [f64; 3] = [0.0, 0.0, 6.0];

/// A pose: position, yaw, velocity.
pub(crate) type Placed = ([f64; 3], f64, [f64; 3]);

/// A scene with the same mesh at every place.
pub(crate) fn scene(mesh: &Mesh, places: &[Placed]) -> (SceneHeader, SceneFrame) {
    let pose = |&(position_m, yaw_rad, velocity_mps): &Placed| Pose {
        position_m,
        yaw_rad,
        yaw_radps: 0.0,
        velocity_mps,
        acceleration_mps2: [0.0; 3],
    };
    let poses: Vec<Pose> = places.iter().map(pose).collect();
    let target = |(i, &start): (usize, &Pose)| {
        let kind = TargetKind::Mesh { class: None, model: mesh.name.clone(), mesh: 0 };
        Target { id: format!("car-{i}"), role: Role::Target, kind, start }
    };
    let header = SceneHeader {
        name: "test".into(),
        seed: 1,
        frames: 1,
        frame_interval_s: 0.1,
        radar: radar(),
        noise: Noise::Absent,
        dsp: paper::processing(),
        fidelity: fidelity(),
        intersection: Intersection { width_m: 22.5 },
        materials: MaterialMap::default(),
        road: None,
        backscatter: None,
        meshes: vec![mesh.clone()].into(),
        targets: poses.iter().enumerate().map(target).collect(),
        traffic: None,
    };
    (header, SceneFrame { index: 0, time_s: 0.0, poses })
}

fn radar() -> Radar {
    paper::radar(RADAR_M, paper::waveform(256, 128), Preset::OneByOne.elements())
}

fn fidelity() -> Fidelity {
    Fidelity {
        accuracy: Accuracy::from_db(-20.0),
        goal: None,
        bounces: 3,
        edges: Edges::Ignored,
        surface: Surface::Flat,
        sides: Sides::Two,
        nodes: NodeRule::Middle,
        echo: EchoMode::Paths,
        detail: Detail::Paths,
        small_parts: SmallParts::OfMesh,
        between_bodies: BetweenBodies::Traced,
        wheels: Wheels::Still,
        measured_every: 1,
    }
}
