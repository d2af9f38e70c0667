//! Many points, fast and rotating points, and a scene after a long time: samples against the formulas.

use crate::study::atlas::methods;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use crate::study::scenes::{cube_of, frame_of, paths_at, paths_of, scene_of, with_point};
use artifact::Accuracy;
use artifact::cube::CubeFrame;
use artifact::paths::PathsFrame;
use artifact::scene::{SceneHeader, TargetKind, Wheel};
use num_complex::Complex64;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;
use wayside::host::failure::Failure;

/// Number of cells of a cube that are compared with the formulas.
const COMPARED: usize = 600;

/// Error of a cube at some of its samples, with the program's estimate.
pub(in crate::study::atlas) fn against_formulas(
    header: &SceneHeader,
    paths: &PathsFrame,
    cube: &CubeFrame,
) -> (f64, ErrorStatement) {
    let radar = &header.radar;
    let length = radar.waveform.samples as usize;
    let chirps = radar.waveform.chirps as usize;
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let (mut found, mut exact) = (vec![], vec![]);
    for _ in 0..COMPARED.min(cube.samples.len()) {
        let cell = random.random_range(0..cube.samples.len());
        let at = [cell / length / chirps, cell / length % chirps, cell % length];
        let centre_hz = radar.waveform.centre_frequency_hz();
        let sample = cube.samples[cell];
        found.push(Complex64::new(sample.re.into(), sample.im.into()));
        exact.push(fmcw_echo::reference::cube_sample(radar, centre_hz, &paths.paths, at, None));
    }
    let statement = cube.error.synthesis.map_or(ErrorStatement::Missing, ErrorStatement::UpperBound);
    (rcs_solvers::relative_error(&found, &exact), statement)
}

/// Points on the rims of two wheels: 0 to 20 m/s at one place.
pub(in crate::study::atlas) fn wheels(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::FAST_SUM
        .trial("points on rolling wheels against the formulas", "speed_mps, accuracy_db asked");
    let row = |(speed_mps, accuracy_db): (f64, f64)| {
        let mut header = scene_of("[radar.array]\npreset = \"1x1\"\n")?;
        header.fidelity.accuracy = Accuracy::from_db(accuracy_db);
        for i in 0..40 {
            let at_m = [5.75, 25.0 + 2.5 * f64::from(i % 2), 0.33];
            header = with_point(header, 0.1, at_m, [0.0, -speed_mps, 0.0]);
            let Some(last) = header.targets.last_mut() else { continue };
            last.start.yaw_rad = -0.25 * TAU;
            let wheel = Some(Wheel { radius_m: 0.33, angle_rad: 0.05 * TAU * f64::from(i / 2) });
            last.kind = TargetKind::Point { rcs_m2: 0.1, wheel };
        }
        let paths = paths_of(&header)?;
        let (error, statement) = against_formulas(&header, &paths, &cube_of(&header, &paths)?);
        Ok(trial.answered(format!("{speed_mps}, {accuracy_db}"), error, statement))
    };
    [(10.0, -20.0), (10.0, -80.0), (40.0, -20.0)].into_iter().map(row).collect()
}

/// Points all over the field of view, at all velocities.
pub(in crate::study::atlas) fn targets(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::FAST_SUM.trial("very many targets against the formulas", "targets");
    let row = |count: u32| {
        let mut header = scene_of("[radar.array]\npreset = \"1x4\"\n")?;
        let mut random = ChaCha8Rng::seed_from_u64(u64::from(count));
        for _ in 0..count {
            let mut within = |low: f64, high: f64| random.random_range(low..high);
            let at_m = [within(-20.0, 20.0), within(5.0, 55.0), within(0.0, 3.0)];
            let velocity_mps = [within(-5.0, 5.0), within(-30.0, 30.0), 0.0];
            header = with_point(header, within(0.01, 10.0), at_m, velocity_mps);
        }
        let paths = paths_of(&header)?;
        let (error, statement) = against_formulas(&header, &paths, &cube_of(&header, &paths)?);
        Ok(trial.answered(count, error, statement))
    };
    [100, 10_000].into_iter().map(row).collect()
}

/// The limits of the keys: 340 m/s, 100 m/s², a point a wavelength away, one behind the radar.
pub(in crate::study::atlas) fn motion(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::FAST_SUM.trial("points at the limits of their keys against the formulas", "point");
    let row = |(name, place_m, velocity_mps, acceleration_mps2): (&str, [f64; 3], [f64; 3], [f64; 3])| {
        let mut header = scene_of("[radar.array]\npreset = \"3x4\"\nmultiplexing = \"tdm\"\n")?;
        header = with_point(header, 1.0, place_m, velocity_mps);
        header.targets[0].start.acceleration_mps2 = acceleration_mps2;
        let paths = paths_of(&header)?;
        let (error, statement) = against_formulas(&header, &paths, &cube_of(&header, &paths)?);
        Ok(trial.answered(name, error, statement))
    };
    [
        ("340 m/s across, 5 m away", [0.0, 5.0, 6.0], [340.0, 0.0, 0.0], [0.0; 3]),
        ("340 m/s towards the radar", [0.0, 40.0, 6.0], [0.0, -340.0, 0.0], [0.0; 3]),
        ("braking at 100 m/s²", [5.75, 25.0, 0.5], [0.0, -20.0, 0.0], [0.0, 100.0, 0.0]),
        ("2 cm before the elements", [0.0, 0.02, 6.0], [0.0; 3], [0.0; 3]),
        ("100 km away", [0.0, 1e5, 6.0], [0.0, -10.0, 0.0], [0.0; 3]),
        ("behind the radar", [1.0, -30.0, 6.0], [0.0, 3.0, 0.0], [0.0; 3]),
    ]
    .into_iter()
    .map(row)
    .collect()
}

/// A point that has moved for hours is at the same place as one that starts there.
pub(in crate::study::atlas) fn long_runs(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::MOTION.trial("a point that has driven for long, against one that begins there", "s");
    let row = |(frame, interval_s): (u32, f64)| {
        let words =
            format!("frames = 1000000\nframe_interval_s = {interval_s:?}\n[radar.array]\npreset = \"1x1\"\n");
        let driven_s = f64::from(frame) * interval_s;
        let begun = with_point(scene_of(&words)?, 1.0, [5.75, 40.0, 0.5], [0.0, -10.0, 0.0]);
        let mut driven = begun.clone();
        driven.targets[0].start.position_m[1] += 10.0 * driven_s;
        let late = paths_at(&driven, &scene::snapshot(&driven, frame))?;
        let mut early = paths_at(&begun, &frame_of(&begun))?;
        (early.index, early.time_s) = (late.index, late.time_s);
        let values = |paths: &PathsFrame| -> Result<Vec<Complex64>, Failure> {
            let of = |z: &num_complex::Complex32| Complex64::new(z.re.into(), z.im.into());
            Ok(cube_of(&driven, paths)?.samples.iter().map(of).collect())
        };
        let error = rcs_solvers::relative_error(&values(&late)?, &values(&early)?);
        Ok(trial.answered(driven_s, error, ErrorStatement::Missing))
    };
    [(10, 0.1), (36_000, 0.1), (99_000, 0.1), (999_999, 1e4)].into_iter().map(row).collect()
}
