//! The paper's way: far-field tables over aspect and frequency.

use crate::setting::*;
use artifact::radar::{Multiplexing, Polarization, Radar};
use artifact::rcs::{RcsFrame, RcsTable};
use artifact::scene::Pose;
use artifact::settings::Noise;
use artifact::units::SPEED_OF_LIGHT_MPS;
use artifact::{ErrorBudget, ModelError};
use fmcw_echo::{EchoError, Synthesizer};
use glam::{DQuat, DVec3};
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, TAU};

fn rcs_frame(tables: Vec<RcsTable>) -> RcsFrame {
    RcsFrame {
        index: 0,
        time_s: 0.0,
        tables,
        error: ErrorBudget::default(),
        model_error: ModelError::default(),
    }
}

fn constant_table(amplitude_m: Complex64) -> RcsTable {
    RcsTable {
        target: 0,
        frequency_hz: vec![77e9],
        elevation_rad: vec![0.0],
        azimuth_rad: vec![0.0],
        range_m: f64::INFINITY,
        polarization: Polarization::Vv,
        amplitude_m: vec![amplitude_m],
    }
}

/// Far-field table of unit scatterers at these places of the body: S = Σ e^{+2jk r̂·x} (interface.md, rcs).
fn table_of_points(points_m: &[DVec3], frequency_hz: Vec<f64>, aspects_rad: [Vec<f64>; 2]) -> RcsTable {
    let [elevation_rad, azimuth_rad] = aspects_rad;
    let mut amplitude_m = Vec::new();
    for f in &frequency_hz {
        for el in &elevation_rad {
            for az in &azimuth_rad {
                let towards_radar = DVec3::new(el.cos() * az.cos(), el.cos() * az.sin(), el.sin());
                let phase = |x: &DVec3| 2.0 * TAU * f / SPEED_OF_LIGHT_MPS * towards_radar.dot(*x);
                amplitude_m.push(points_m.iter().map(|x| Complex64::cis(phase(x))).sum());
            }
        }
    }
    RcsTable { frequency_hz, elevation_rad, azimuth_rad, amplitude_m, ..constant_table(Complex64::ONE) }
}

fn steps(first: f64, last: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| first + (last - first) * i as f64 / (count - 1) as f64).collect()
}

fn samples_of_tables(radar: &Radar, pose: Pose, frame: &RcsFrame) -> (Vec<Complex64>, Option<f64>) {
    let cube = Synthesizer::new(&header(radar.clone(), Noise::Absent), 1, asked(), vec![])
        .and_then(|stage| stage.frame_of_tables(&[pose], frame, &|_| ()))
        .unwrap();
    (widened(&cube.samples), cube.error.synthesis)
}

fn samples_of_paths(radar: &Radar, paths: Vec<artifact::paths::Path>) -> Vec<Complex64> {
    widened(&synthesized(&header(radar.clone(), Noise::Absent), 1, &frame(paths)).unwrap().samples)
}

#[test]
fn a_table_of_one_value_is_a_point_target() {
    for multiplexing in [Multiplexing::Simultaneous, Multiplexing::Tdm, Multiplexing::Ddm, Multiplexing::Bpm]
    {
        let radar = radar(artifact::Waveform { chirps: 4, ..experiment(1) }, &presets()[2], multiplexing);
        let pose = Pose {
            position_m: [5.75, 40.0, 0.5],
            yaw_rad: -FRAC_PI_2,
            yaw_radps: 0.0,
            velocity_mps: [0.0, -10.0, 0.0],
            acceleration_mps2: [0.0; 3],
        };
        let table = constant_table(Complex64::from(2.0));
        let (got, _) = samples_of_tables(&radar, pose, &rcs_frame(vec![table]));
        let exact = samples_of_paths(&radar, vec![point(pose.position_m, pose.velocity_mps, 4.0)]);
        // Both are stored in f32: −144.5 dB at worst each.
        assert!(error_db(&got, &exact) < -138.0);
    }
}

/// A car's worth of scatterers far away, where a far-field table is true.
struct FarCase {
    radar: Radar,
    pose: Pose,
    points_m: [DVec3; 3],
}

impl FarCase {
    fn new() -> Self {
        let radar = radar(
            artifact::Waveform { chirps: 4, ..experiment(1) },
            &presets()[1],
            Multiplexing::Simultaneous,
        );
        let pose = Pose {
            position_m: [0.0, 2000.0, 6.0],
            yaw_rad: -1.4,
            yaw_radps: 0.0,
            velocity_mps: [0.0, -10.0, 0.0],
            acceleration_mps2: [0.0; 3],
        };
        let points_m =
            [DVec3::new(0.3, 0.02, 0.0), DVec3::new(-0.2, 0.01, 0.03), DVec3::new(0.1, -0.02, -0.02)];
        Self { radar, pose, points_m }
    }

    fn table_error_db(&self, frequencies: usize) -> (f64, f64) {
        // Seen from the body the radar stands at azimuth −π/2 + 1.4, on the horizon. The wave that comes back
        // started μτ = 167 MHz lower.
        let azimuth = 1.4 - FRAC_PI_2;
        let aspects = [steps(-1e-3, 1e-3, 5), steps(azimuth - 1e-3, azimuth + 1e-3, 5)];
        let table = table_of_points(&self.points_m, steps(76.8e9, 77.7e9, frequencies), aspects);
        let (got, estimated) = samples_of_tables(&self.radar, self.pose, &rcs_frame(vec![table]));
        let world_from_body = DQuat::from_rotation_z(self.pose.yaw_rad);
        let place = |x: &DVec3| (DVec3::from_array(self.pose.position_m) + world_from_body * *x).to_array();
        let paths = self.points_m.iter().map(|x| point(place(x), self.pose.velocity_mps, 1.0)).collect();
        (error_db(&got, &samples_of_paths(&self.radar, paths)), 20.0 * estimated.unwrap().log10())
    }
}

#[test]
fn a_far_body_sounds_the_same_by_its_table_as_by_its_points() {
    // Left out far away: 1/r of points 0.3 m apart over 2 km (1.5e-4 each way), the wavefront's curvature
    // over up to 0.07 m across (k·x²/R = 4e-3 rad: −48 dB at most), interpolation over 1 MHz and 0.5 mrad
    // (1e-5).
    let (error_db, _) = FarCase::new().table_error_db(901);
    println!("table against points at 2 km: {error_db:.1} dB");
    assert!(error_db < -48.0);
}

#[test]
fn a_coarse_table_says_how_coarse_it_is() {
    // Steps of 45 MHz turn 0.3 m by 0.57 rad: linear interpolation errs by 0.57²/8 at most.
    let (error_db, estimated_db) = FarCase::new().table_error_db(21);
    println!("true {error_db:.1} dB, estimated {estimated_db:.1} dB");
    assert!(error_db > -45.0 && (error_db - estimated_db).abs() < 6.0, "{error_db} against {estimated_db}");
}

type IsExpected = fn(&EchoError) -> bool;

#[test]
fn tables_that_cannot_answer_are_refused() {
    let radar = single_channel(artifact::Waveform { chirps: 2, ..experiment(1) });
    let pose = Pose {
        position_m: [0.0, 40.0, 6.0],
        yaw_rad: 0.0,
        yaw_radps: 0.0,
        velocity_mps: [0.0; 3],
        acceleration_mps2: [0.0; 3],
    };
    let whole = table_of_points(&[DVec3::ZERO], steps(76.9e9, 77.7e9, 9), [vec![0.0], steps(-3.15, 3.15, 9)]);
    let refuse = |table: RcsTable| {
        Synthesizer::new(&header(radar.clone(), Noise::Absent), 1, asked(), vec![])
            .and_then(|stage| stage.frame_of_tables(&[pose], &rcs_frame(vec![table]), &|_| ()))
    };
    assert!(refuse(whole.clone()).is_ok());
    let cases: [(RcsTable, IsExpected); 6] = [
        (RcsTable { target: 3, ..whole.clone() }, |e| {
            matches!(e, EchoError::TargetMissing { target: 3, .. })
        }),
        (RcsTable { polarization: Polarization::Hh, ..whole.clone() }, |e| {
            matches!(e, EchoError::TablePolarization { found: Polarization::Hh, .. })
        }),
        (RcsTable { amplitude_m: vec![], ..whole.clone() }, |e| {
            matches!(e, EchoError::TableShape { axis: "amplitude", .. })
        }),
        (RcsTable { azimuth_rad: vec![1.0, 0.5], ..whole.clone() }, |e| {
            matches!(e, EchoError::TableShape { axis: "azimuth_rad", .. })
        }),
        (table_of_points(&[DVec3::ZERO], steps(78e9, 79e9, 9), [vec![0.0], vec![0.0]]), |e| {
            matches!(e, EchoError::OutsideTable { axis: "frequency_hz", .. })
        }),
        (table_of_points(&[DVec3::ZERO], vec![77e9], [steps(0.5, 0.6, 3), vec![0.0]]), |e| {
            matches!(e, EchoError::OutsideTable { axis: "elevation_rad", .. })
        }),
    ];
    for (table, expected) in cases {
        let refused = refuse(table).unwrap_err();
        assert!(expected(&refused), "{refused}");
    }
}
