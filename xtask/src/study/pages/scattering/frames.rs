//! Random frames of one moving vehicle: the printed and the true error of the map.

use super::bodies::Named;
use crate::study::pages::measures::references::methods::{decibels, error, request};
use artifact::scene::{Pose, SceneHeader};
use bart_rcs::{FrameContext, PathView, Standpoint, Tracer, rcs, scattering_of_paths};
use glam::{DMat3, DVec3};
use num_complex::Complex64;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha12Rng;
use std::f64::consts::TAU;
use wayside::host::failure::Failure;

/// A frame of one moving vehicle.
#[derive(Debug)]
pub(crate) struct FoundFrame {
    name: String,
    pose: Pose,
    bounces: u8,
    asked_db: f64,
    paths: usize,
    pub(crate) printed_db: f64,
    pub(crate) true_db: f64,
}

/// Frame number `case`: its paths against the body traced and integrated anew, 15 dB finer, at its pose at
/// three random times of the frame.
///
/// A map is a unitary transform of the frame's samples (Parseval), so its relative error is that of the
/// samples; each is S at its time and frequency.
pub(crate) fn try_frame(case: u64, meshes: &[Named], empty: &SceneHeader) -> Result<FoundFrame, Failure> {
    let mut rng = ChaCha12Rng::from_seed(artifact::seed::key(11, "validation/random-frames", &[case]));
    let (name, mesh) = &meshes[rng.random_range(0..meshes.len())];
    let speed_mps = rng.random_range(0.5..15.0);
    let yaw_rad = rng.random_range(0.0..TAU);
    let pose = Pose {
        position_m: [rng.random_range(0.0..11.0), rng.random_range(25.0..60.0), 0.0],
        yaw_rad,
        yaw_radps: 0.0,
        velocity_mps: [speed_mps * f64::cos(yaw_rad), speed_mps * f64::sin(yaw_rad), 0.0],
        acceleration_mps2: [0.0; 3],
    };
    let mut header = empty.clone();
    header.fidelity.bounces = rng.random_range(1..=3);
    let asked_db = rng.random_range(-25.0..-10.0);
    header.fidelity.accuracy = artifact::Accuracy::from_db(asked_db);
    header.meshes = vec![mesh.clone()].into();
    header.targets[0].start = pose;
    let frame = scene::snapshot(&header, 0);
    let tracer = Tracer::new(&header).map_err(Failure::refused)?;
    let paths = tracer.all_paths(&header, &frame, &FrameContext::ALONE).map_err(Failure::refused)?;
    let (mut of_paths, mut anew) = (Vec::new(), Vec::new());
    for _ in 0..3 {
        let seconds = rng.random_range(0.0..header.radar.frame_duration_s());
        let frequencies_hz: Vec<f64> = (0..12).map(|_| random_frequency_hz(&header, &mut rng)).collect();
        let array = &header.radar.array;
        let pair =
            [&array.tx_m, &array.rx_m].map(|from| DVec3::from_array(from[rng.random_range(0..from.len())]));
        of_paths.extend(frequencies_hz.iter().map(|f| at(&header, &paths.paths, &pose, pair, seconds, *f)));
        anew.extend(traced_anew(&header, &pose, pair, seconds, &frequencies_hz)?);
    }
    Ok(FoundFrame {
        name: name.clone(),
        pose,
        bounces: header.fidelity.bounces,
        asked_db,
        paths: paths.paths.len(),
        printed_db: decibels(paths.error.total().unwrap_or(0.0)),
        true_db: decibels(error(&of_paths, &anew)),
    })
}

fn random_frequency_hz(header: &SceneHeader, rng: &mut ChaCha12Rng) -> f64 {
    let waveform = &header.radar.waveform;
    waveform.start_frequency_hz + rng.random_range(0.0..1.0) * waveform.bandwidth_hz()
}

fn origin_m(pose: &Pose, seconds: f64) -> DVec3 {
    DVec3::from_array(pose.position_m) + seconds * DVec3::from_array(pose.velocity_mps)
}

/// S of the paths between two elements, as the radar receives it.
pub(crate) fn at(
    header: &SceneHeader,
    paths: &[artifact::paths::Path],
    pose: &Pose,
    [transmitter_m, receiver_m]: [DVec3; 2],
    seconds: f64,
    f_hz: f64,
) -> Complex64 {
    let view = PathView {
        transmitter_m,
        receiver_m,
        origin_m: origin_m(pose, seconds),
        seconds,
        centre_frequency_hz: header.radar.waveform.centre_frequency_hz(),
    };
    let (p, q) = header.radar.array.polarization.indices();
    scattering_of_paths(paths, &view, f_hz)[p][q]
}

/// S between two elements, traced separately.
fn traced_anew(
    header: &SceneHeader,
    pose: &Pose,
    pair_m: [DVec3; 2],
    seconds: f64,
    frequencies_hz: &[f64],
) -> Result<Vec<Complex64>, Failure> {
    let [transmitter, receiver] = pair_m.map(|antenna_m| {
        let to_antenna = DMat3::from_rotation_z(-pose.yaw_rad) * (antenna_m - origin_m(pose, seconds));
        Standpoint {
            azimuth_rad: to_antenna.y.atan2(to_antenna.x),
            elevation_rad: (to_antenna.z / to_antenna.length()).asin(),
            range_m: to_antenna.length(),
        }
    });
    let fidelity = &header.fidelity;
    let finer_db = fidelity.accuracy.db() - 15.0;
    let request = request(transmitter, frequencies_hz, fidelity.bounces, fidelity.nodes, finer_db);
    let request = bart_rcs::RcsRequest { receiver: Some(receiver), ..request };
    Ok(rcs(&header.meshes[0], &request, &|_, _| {}).map_err(Failure::refused)?.amplitude_m)
}

impl std::fmt::Display for FoundFrame {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, _] = self.pose.position_m;
        let speed_mps = DVec3::from_array(self.pose.velocity_mps).length();
        write!(
            f,
            "| {} | {x:.1}, {y:.1} | {:.0} | {speed_mps:.1} |",
            self.name,
            self.pose.yaw_rad.to_degrees()
        )?;
        write!(f, " {} | {:.1} | {} |", self.bounces, self.asked_db, self.paths)?;
        write!(f, " {:.1} | {:.1} | {:.1} |", self.printed_db, self.true_db, self.printed_db - self.true_db)
    }
}
