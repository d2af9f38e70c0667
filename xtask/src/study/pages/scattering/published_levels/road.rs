//! Levels of cars with and without a road of asphalt under them, seen from 7 m up at 40 m.

use super::super::bodies::{experiment_1, own, real};
use super::super::frames::at;
use super::super::roads::lift;
use super::levels::mean;
use crate::study::extent::Extent;
use crate::study::pages::page_section::PageSection;
use artifact::Accuracy;
use artifact::material::{Material, Road};
use artifact::scene::{Mesh, Pose, SceneHeader};
use artifact::units::db_from_power;
use bart_rcs::{FrameContext, Tracer};
use glam::DVec3;
use num_complex::Complex64;
use wayside::host::failure::Failure;

/// Cars, own and real, with a road.
const CARS: [&str; 5] = ["car-suv", "car-sedan", "gazebo_prius", "modern_hatchback", "nissan_patrol_suv"];
/// Number of aspects all round.
const ASPECTS: u32 = 24;

/// Adds the table of the road's effect on a car's levels.
pub(super) fn added(part: &mut PageSection, extent: Extent) -> Result<(), Failure> {
    part.head(&["car", "mean of dBsm alone", "on a road of asphalt", "the road adds, dB"]);
    let (cars, aspects) = match extent {
        Extent::Quick => (1, 2),
        Extent::Full => (CARS.len(), ASPECTS),
    };
    for name in &CARS[..cars] {
        let Ok(mesh) = own(name).or_else(|_| real(name)) else { continue };
        let levels: Vec<[f64; 2]> =
            (0..aspects).map(|aspect| levels_dbsm(&mesh, aspect)).collect::<Result<_, _>>()?;
        let [alone, on_road] =
            [0, 1].map(|at: usize| mean(&levels.iter().map(|l| l[at]).collect::<Vec<_>>()));
        let told = [alone, on_road, on_road - alone].map(|db| format!("{db:.1}").replace('-', "−"));
        part.row(&[&[(*name).to_owned()], &told[..]].concat());
    }
    Ok(())
}

/// Levels of a car at an aspect without a road and with one, over the band, dBsm.
fn levels_dbsm(mesh: &Mesh, aspect: u32) -> Result<[f64; 2], Failure> {
    let mut header = experiment_1()?;
    lift(&mut header.radar, 7.0);
    header.fidelity.bounces = 3;
    header.fidelity.accuracy = Accuracy::from_db(-20.0);
    header.meshes = vec![mesh.clone()].into();
    let pose = Pose {
        position_m: [0.0, 40.0, 0.0],
        yaw_rad: (f64::from(aspect) * 360.0 / f64::from(ASPECTS)).to_radians(),
        yaw_radps: 0.0,
        velocity_mps: [0.0; 3],
        acceleration_mps2: [0.0; 3],
    };
    header.targets[0].start = pose;
    let alone = level_dbsm(&header, &pose)?;
    // Asphalt of docs/materials.md.
    let material = Material::HalfSpace { permittivity: Complex64::new(9.5, -0.3) };
    header.road = Some(Road { material, rms_height_m: 5e-4 });
    Ok([alone, level_dbsm(&header, &pose)?])
}

fn level_dbsm(header: &SceneHeader, pose: &Pose) -> Result<f64, Failure> {
    let tracer = Tracer::new(header).map_err(Failure::refused)?;
    let frame = scene::snapshot(header, 0);
    let paths = tracer.all_paths(header, &frame, &FrameContext::ALONE).map_err(Failure::refused)?;
    let waveform = &header.radar.waveform;
    let (radar_m, middle_s) = (DVec3::from(header.radar.position_m), header.radar.frame_middle_s());
    let power = |i: u32| {
        let f_hz = waveform.start_frequency_hz + (f64::from(i) + 0.5) / 24.0 * waveform.bandwidth_hz();
        at(header, &paths.paths, pose, [radar_m; 2], middle_s, f_hz).norm_sqr()
    };
    Ok(db_from_power((0..24).map(power).sum::<f64>() / 24.0))
}
