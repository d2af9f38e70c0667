//! The fast sum over paths against the formulas, sample by sample.

use crate::study::rcs_solvers;
use crate::study::scenes::{cube_of, paths_of, scene_of, with_point};
use crate::study::search::differential_testing::{Outcome, Random, outcome_of};
use crate::study::search::random_bodies::within;
use artifact::Accuracy;
use artifact::scene::{SceneHeader, TargetKind, Wheel};
use num_complex::Complex64;
use rand::RngExt;
use wayside::host::failure::Failure;

/// A radar with a random waveform, array and multiplexing.
pub(super) fn radar(random: &mut Random) -> Result<SceneHeader, Failure> {
    let multiplexing = ["simultaneous", "tdm", "ddm", "bpm"][random.random_range(0..4)];
    let preset = ["1x1", "1x4", "3x4"][random.random_range(0..3)];
    let slope = within(random, 3.0, 30.0) * if random.random() { 1.0 } else { -1.0 };
    let (samples, chirps) = (random.random_range(16..400), random.random_range(4..96));
    let idle_us = within(random, 1.0, 60.0);
    scene_of(&format!(
        "[radar.waveform]\nslope_mhz_per_us = {slope:?}\nsamples = {samples}\nchirps = {chirps}\nidle_us = \
         {idle_us:?}\n[radar.array]\npreset = \"{preset}\"\nmultiplexing = \"{multiplexing}\"\n"
    ))
}

/// Adds points all round, some accelerating, some on wheels.
fn with_points(mut header: SceneHeader, random: &mut Random) -> SceneHeader {
    for _ in 0..random.random_range(1..60) {
        let at_m = [within(random, -30.0, 30.0), within(random, 1.0, 70.0), within(random, 0.0, 8.0)];
        let velocity_mps = [0; 3].map(|_| within(random, -40.0, 40.0));
        let rcs_m2 = 10_f64.powf(within(random, -3.0, 2.0));
        header = with_point(header, rcs_m2, at_m, velocity_mps);
        let Some(last) = header.targets.last_mut() else { continue };
        if random.random_range(0..4) == 0 {
            last.start.acceleration_mps2 = [0; 3].map(|_| within(random, -50.0, 50.0));
        }
        if random.random_range(0..4) == 0 {
            last.start.velocity_mps[2] = 0.0;
            let (radius_m, angle_rad) = (within(random, 0.2, 0.6), within(random, -3.0, 3.0));
            last.kind = TargetKind::Point { rcs_m2, wheel: Some(Wheel { radius_m, angle_rad }) };
        }
    }
    header
}

/// Compares random samples of a cube of points.
pub(super) fn against_formulas(random: &mut Random) -> Result<Outcome, Failure> {
    let mut header = with_points(radar(random)?, random);
    header.fidelity.accuracy = Accuracy::from_db(within(random, -90.0, -10.0));
    let paths = paths_of(&header)?;
    let cube = cube_of(&header, &paths)?;
    let radar = &header.radar;
    let (length, chirps) = (radar.waveform.samples as usize, radar.waveform.chirps as usize);
    let (mut found, mut exact) = (vec![], vec![]);
    for _ in 0..300 {
        let cell = random.random_range(0..cube.samples.len());
        let at = [cell / length / chirps, cell / length % chirps, cell % length];
        found.push(Complex64::new(cube.samples[cell].re.into(), cube.samples[cell].im.into()));
        let centre_hz = radar.waveform.centre_frequency_hz();
        exact.push(fmcw_echo::reference::cube_sample(radar, centre_hz, &paths.paths, at, None));
    }
    let asked = fmcw_echo::sum_accuracy(header.fidelity.accuracy).amplitude();
    let printed = cube.error.synthesis.unwrap_or(0.0);
    // The printed error is measured at some samples of the cube, this one at others.
    let allowed = asked.max(2.0 * printed);
    let case = || format!("{:?}, {} points", radar.waveform, header.targets.len());
    Ok(outcome_of(rcs_solvers::relative_error(&found, &exact), allowed, case))
}
