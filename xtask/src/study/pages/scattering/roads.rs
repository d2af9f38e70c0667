//! Random frames of one vehicle over a road: printed and true error of leaving the road out.

use super::bodies::Named;
use super::frames::at;
use crate::study::pages::measures::references::methods::decibels;
use artifact::Radar;
use artifact::material::{Material, Road};
use artifact::scene::{Pose, SceneHeader};
use bart_rcs::{FrameContext, Tracer};
use glam::DVec3;
use num_complex::Complex64;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha12Rng;
use std::f64::consts::TAU;
use wayside::host::failure::Failure;

/// One case; decibels are amplitudes relative to the echo without a road.
#[derive(Debug)]
pub(crate) struct FoundRoad {
    name: String,
    pose: Pose,
    height_m: f64,
    bounces: u8,
    road: &'static str,
    pub(crate) printed_db: f64,
    pub(crate) true_db: f64,
}

/// Possible materials of a road: asphalt by recipe and moisture, and concrete (docs/materials.md).
const ROADS: [(&str, [f64; 2]); 4] = [
    ("asphalt", [9.5, 0.3]),
    ("dry asphalt", [8.6, 0.3]),
    ("moist asphalt", [10.4, 0.3]),
    ("concrete", [5.24, 0.32]),
];

/// Case number `case`: paths with a road minus those without, at the time of the frame's check and over the
/// whole band.
pub(crate) fn try_road(case: u64, meshes: &[Named], empty: &SceneHeader) -> Result<FoundRoad, Failure> {
    let mut rng = ChaCha12Rng::from_seed(artifact::seed::key(13, "validation/random-roads", &[case]));
    let (name, mesh) = &meshes[rng.random_range(0..meshes.len())];
    let (range_m, bearing_rad): (f64, f64) = (rng.random_range(15.0..60.0), rng.random_range(-0.4..0.4));
    let pose = Pose {
        position_m: [range_m * bearing_rad.sin(), range_m * bearing_rad.cos(), 0.0],
        yaw_rad: rng.random_range(0.0..TAU),
        yaw_radps: 0.0,
        velocity_mps: [0.0; 3],
        acceleration_mps2: [0.0; 3],
    };
    let mut header = empty.clone();
    lift(&mut header.radar, rng.random_range(0.5..7.0));
    header.fidelity.bounces = rng.random_range(1..=3);
    header.meshes = vec![mesh.clone()].into();
    header.targets[0].start = pose;
    let (road, [real, loss]) = ROADS[rng.random_range(0..ROADS.len())];
    let frame = scene::snapshot(&header, 0);
    let tracer = Tracer::new(&header).map_err(Failure::refused)?;
    let surroundings = &FrameContext::ALONE;
    let without = tracer.all_paths(&header, &frame, surroundings).map_err(Failure::refused)?;
    let material = Material::HalfSpace { permittivity: Complex64::new(real, -loss) };
    header.road = Some(Road { material, rms_height_m: rng.random_range(2e-4..1e-3) });
    let with = tracer.all_paths(&header, &frame, surroundings).map_err(Failure::refused)?;
    let frequencies_hz = (0..24).map(|i| {
        let waveform = &header.radar.waveform;
        waveform.start_frequency_hz + (f64::from(i) + 0.5) / 24.0 * waveform.bandwidth_hz()
    });
    let radar_m = DVec3::from_array(header.radar.position_m);
    let powers = frequencies_hz.map(|f| {
        let [with, without] = [&with.paths, &without.paths]
            .map(|paths| at(&header, paths, &pose, [radar_m; 2], header.radar.frame_middle_s(), f));
        [(with - without).norm_sqr(), without.norm_sqr()]
    });
    let [added, whole] = powers.fold([0.0; 2], |sum, p| [sum[0] + p[0], sum[1] + p[1]]);
    Ok(FoundRoad {
        name: name.clone(),
        pose,
        height_m: header.radar.position_m[2],
        bounces: header.fidelity.bounces,
        road,
        printed_db: decibels(without.model_error.road.unwrap_or(0.0)),
        true_db: decibels((added / whole).sqrt()),
    })
}

/// The radar and its elements at another height.
pub(super) fn lift(radar: &mut Radar, height_m: f64) {
    let up_m = height_m - radar.position_m[2];
    let elements = radar.array.tx_m.iter_mut().chain(&mut radar.array.rx_m);
    elements.chain([&mut radar.position_m]).for_each(|place| place[2] += up_m);
}

impl std::fmt::Display for FoundRoad {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let range_m = DVec3::from_array(self.pose.position_m).length();
        write!(f, "| {} | {range_m:.1} | {:.0} |", self.name, self.pose.yaw_rad.to_degrees())?;
        write!(f, " {:.1} | {} | {} |", self.height_m, self.bounces, self.road)?;
        write!(f, " {:.1} | {:.1} | {:.1} |", self.printed_db, self.true_db, self.printed_db - self.true_db)
    }
}
