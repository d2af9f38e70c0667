//! Scenes of posed bodies; radar and processing are not asked.

use artifact::Accuracy;
use artifact::material::MaterialMap;
use artifact::radar::{
    Array, Hardware, Link, Multiplexing, Pattern, Polarization, Radar, Schedule, Waveform,
};
use artifact::scene::{Intersection, Mesh, Pose, Role, SceneFrame, SceneHeader, Target, TargetKind};
use artifact::settings::{
    Angle, BetweenBodies, Detail, Detector, DspSettings, EchoMode, Edges, Fidelity, Lanes, NodeRule, Noise,
    Refine, Sides, StaticEchoes, Surface, Window,
};

const RADAR_M: [f64; 3] = [0.0, 0.0, 6.0];

/// A pose: position, yaw, velocity.
pub(crate) type Placed = ([f64; 3], f64, [f64; 3]);

/// A scene with the same mesh at every place.
pub(crate) fn scene(mesh: &Mesh, places: &[Placed]) -> (SceneHeader, SceneFrame) {
    let pose = |&(position_m, yaw_rad, velocity_mps): &Placed| Pose {
        position_m,
        yaw_rad,
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
        dsp: dsp(),
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
    Radar {
        position_m: RADAR_M,
        boresight_az_rad: 0.0,
        boresight_el_rad: 0.0,
        schedule: Schedule::default(),
        hardware: Hardware::default(),
        waveform: Waveform {
            start_frequency_hz: 77e9,
            slope_hz_per_s: 12.5e12,
            sample_rate_hz: 5.12e6,
            sampling: artifact::radar::Sampling::Complex,
            samples: 256,
            chirp_interval_s: 60e-6,
            chirps: 128,
        },
        array: Array {
            tx_m: vec![RADAR_M],
            rx_m: vec![RADAR_M],
            tx_half_wavelengths: vec![[0.0; 2]],
            rx_half_wavelengths: vec![[0.0; 2]],
            multiplexing: Multiplexing::Simultaneous,
            polarization: Polarization::Vv,
            pattern: Pattern::Isotropic,
        },
        link: Link { transmit_power_w: 0.01, antenna_gain_db: 10.0 },
    }
}

fn dsp() -> DspSettings {
    DspSettings {
        range_window: Window::Hann,
        doppler_window: Window::Hann,
        detector: Detector::CaCfar,
        false_alarm_rate: 1e-6,
        guard_cells: [2, 2],
        training_cells: [8, 8],
        angle: Angle::Fft,
        refine: Refine::Off,
        calibration: vec![],
        static_echoes: StaticEchoes::Keep,
        assumed_height_m: 0.5,
        cluster_range_m: 1.0,
        cluster_velocity_mps: 1.0,
        cluster_cross_m: 2.0,
        road: Lanes::default(),
    }
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
        between_bodies: BetweenBodies::Traced,
        measured_every: 1,
    }
}
