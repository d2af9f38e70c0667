//! Frames that are traced, and what their paths are compared with.

use artifact::material::MaterialMap;
use artifact::paths::{Amplitude, Path, PathsFrame};
use artifact::radar::Polarization;
use artifact::scene::{Intersection, Mesh, Pose, Role, SceneFrame, SceneHeader, Target, TargetKind};
use artifact::settings::{
    BetweenBodies, Detail, EchoMode, Edges, Fidelity, NodeRule, Noise, Sides, SmallParts, Surface, Wheels,
};
use artifact::{Accuracy, Radar, Waveform};
use bart_rcs::{FrameContext, PathView, RcsRequest, Standpoint, Tracer, rcs, scattering_of_paths};
use glam::DVec3;
use num_complex::Complex64;
use radar::aperture::Preset;
use radar::motion::pose_after;
use radar::paper;

pub(crate) const RADAR_M: [f64; 3] = [0.0, 0.0, 6.0];

pub(crate) fn waveform() -> Waveform {
    paper::waveform(256, 128)
}

pub(crate) fn pose(position_m: [f64; 3], velocity_mps: [f64; 3], yaw_rad: f64) -> Pose {
    Pose { position_m, yaw_rad, yaw_radps: 0.0, velocity_mps, acceleration_mps2: [0.0; 3] }
}

/// A scene of bodies, each with its own mesh, and of points.
pub(crate) fn scene(
    bodies: &[(Mesh, Pose)],
    points: &[(f64, Pose)],
    accuracy_db: f64,
    bounces: u8,
) -> (SceneHeader, SceneFrame) {
    let mesh_target = |(mesh, (_, start)): (u32, &(Mesh, Pose))| Target {
        id: format!("body-{mesh}"),
        role: Role::Target,
        kind: TargetKind::Mesh { class: None, model: "test".into(), mesh },
        start: *start,
    };
    let point_target = |(rcs_m2, start): &(f64, Pose)| Target {
        id: "point".into(),
        role: Role::Target,
        kind: TargetKind::Point { rcs_m2: *rcs_m2, wheel: None },
        start: *start,
    };
    let targets: Vec<Target> =
        (0..).zip(bodies).map(mesh_target).chain(points.iter().map(point_target)).collect();
    let poses = targets.iter().map(|target| target.start).collect();
    let header = SceneHeader {
        name: "test".into(),
        seed: 1,
        frames: 1,
        frame_interval_s: 0.1,
        radar: radar(),
        noise: Noise::Absent,
        dsp: paper::processing(),
        fidelity: Fidelity {
            accuracy: Accuracy::from_db(accuracy_db),
            goal: None,
            bounces,
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
        },
        intersection: Intersection { width_m: 22.5 },
        materials: MaterialMap::default(),
        road: None,
        backscatter: None,
        meshes: bodies.iter().map(|(mesh, _)| mesh.clone()).collect::<Vec<_>>().into(),
        targets,
        traffic: None,
    };
    (header, SceneFrame { index: 0, time_s: 0.0, poses })
}

pub(crate) fn radar() -> Radar {
    paper::radar(RADAR_M, waveform(), Preset::OneByOne.elements())
}

pub(crate) fn trace(scene: &(SceneHeader, SceneFrame)) -> PathsFrame {
    Tracer::new(&scene.0).unwrap().paths(&scene.0, &scene.1, &FrameContext::ALONE).unwrap()
}

/// S of the paths about the first target's origin at a moment.
pub(crate) fn of_paths(
    scene: &(SceneHeader, SceneFrame),
    frame: &PathsFrame,
    seconds: f64,
    frequency_hz: f64,
) -> Amplitude {
    let origin_m = DVec3::from_array(pose_after(&scene.1.poses[0], seconds).position_m);
    let (transmitter_m, receiver_m) = (DVec3::from_array(RADAR_M), DVec3::from_array(RADAR_M));
    let view = PathView {
        transmitter_m,
        receiver_m,
        origin_m,
        seconds,
        centre_frequency_hz: scene.0.radar.waveform.centre_frequency_hz(),
    };
    scattering_of_paths(&frame.paths, &view, frequency_hz)
}

/// Accuracy of the integrals of [`exact`]: what errs by less is not told apart from it.
pub(crate) const EXACT_DB: f64 = -45.0;

/// S of the first body alone, traced and integrated where it is at that moment.
pub(crate) fn anew(
    scene: &(SceneHeader, SceneFrame),
    seconds: f64,
    frequency_hz: &[f64],
    polarization: Polarization,
) -> Vec<Complex64> {
    exact(scene, seconds, [RADAR_M; 2], frequency_hz, polarization)
}

/// S of the first body alone at a moment between two points, from trees of their own.
pub(crate) fn exact(
    scene: &(SceneHeader, SceneFrame),
    seconds: f64,
    [tx_m, rx_m]: [[f64; 3]; 2],
    frequency_hz: &[f64],
    polarization: Polarization,
) -> Vec<Complex64> {
    let now = pose_after(&scene.1.poses[0], seconds);
    let origin_m = DVec3::from_array(now.position_m);
    let place = |x_m: [f64; 3]| {
        let way = glam::DMat3::from_rotation_z(-now.yaw_rad) * (DVec3::from_array(x_m) - origin_m);
        Standpoint {
            azimuth_rad: way.y.atan2(way.x),
            elevation_rad: (way.z / way.length()).asin(),
            range_m: way.length(),
        }
    };
    let transmitter = place(tx_m);
    let request = RcsRequest {
        range_m: transmitter.range_m,
        receiver: (tx_m != rx_m).then(|| place(rx_m)),
        polarization,
        bounces: scene.0.fidelity.bounces,
        nodes: scene.0.fidelity.nodes,
        sides: scene.0.fidelity.sides,
        edges: scene.0.fidelity.edges,
        accuracy: Accuracy::from_db(EXACT_DB),
        ..RcsRequest::over(
            frequency_hz.to_vec(),
            vec![transmitter.elevation_rad],
            vec![transmitter.azimuth_rad],
        )
    };
    rcs(&scene.0.meshes[0], &request, &|_, _| ()).unwrap().amplitude_m
}

pub(crate) fn relative(a: Complex64, b: Complex64) -> f64 {
    (a - b).norm() / b.norm()
}

/// Double bounces of a scene that moves on, against those of the scene traced as it stands at three moments
/// of the frame.
pub(crate) fn check_double_bounces(scene: &(SceneHeader, SceneFrame)) {
    let double_of =
        |scene: &_| -> Vec<Path> { trace(scene).paths.into_iter().filter(|path| path.order == 2).collect() };
    let double = double_of(scene);
    assert!(!double.is_empty(), "the walls see each other");
    let centre_hz = scene.0.radar.waveform.centre_frequency_hz();
    let view = |seconds: f64| PathView {
        transmitter_m: DVec3::from_array(RADAR_M),
        receiver_m: DVec3::from_array(RADAR_M),
        origin_m: DVec3::from_array(scene.1.poses[0].position_m),
        seconds,
        centre_frequency_hz: centre_hz,
    };
    for share in [0.0, 0.5, 1.0] {
        let seconds = share * scene.0.radar.frame_duration_s();
        let still = double_of(&standing(scene, seconds));
        let exact = scattering_of_paths(&still, &view(0.0), centre_hz)[0][0];
        let moving = scattering_of_paths(&double, &view(seconds), centre_hz)[0][0];
        println!("after {:.2} ms: {:.1} dB", 1e3 * seconds, 20.0 * relative(moving, exact).log10());
        assert!(relative(moving, exact) < 0.1, "{moving} {exact}");
    }
}

/// The scene as it stands at a moment.
fn standing(scene: &(SceneHeader, SceneFrame), seconds: f64) -> (SceneHeader, SceneFrame) {
    let still = |start: &Pose| {
        let now = pose_after(start, seconds);
        pose(now.position_m, [0.0; 3], now.yaw_rad)
    };
    let (mut header, mut frame) = scene.clone();
    header.radar.waveform.chirps = 1;
    frame.poses = frame.poses.iter().map(still).collect();
    (header, frame)
}
