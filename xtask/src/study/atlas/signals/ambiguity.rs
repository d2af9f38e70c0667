//! Targets too fast or too far for the waveform. Errors are those of the estimate, relative to the truth.

use crate::study::atlas::methods;
use crate::study::atlas::signals::strongest::{strongest, unless_resolved};
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::extent::Extent;
use crate::study::scenes::{scene_of, with_point};
use artifact::points::Object;
use artifact::scene::SceneHeader;
use wayside::host::failure::Failure;

const NOISE: &str = "[noise]\nsnr_db = 40.0\n";
const PLACE_M: [f64; 3] = [5.75, 40.0, 1.0];

fn detected(header: &SceneHeader) -> Result<Object, Failure> {
    strongest(header)?.ok_or_else(|| Failure::Refused("atlas: a lone strong point was not detected".into()))
}

/// Range and its rate at the middle of the frame.
fn truth(header: &SceneHeader) -> (f64, f64) {
    let pose = radar::motion::pose_after(&header.targets[0].start, header.radar.frame_middle_s());
    let away = glam::DVec3::from(pose.position_m) - glam::DVec3::from(header.radar.position_m);
    (away.length(), glam::DVec3::from(pose.velocity_mps).dot(away) / away.length())
}

/// Relative error of the speed of an approaching point, with its object's statement.
fn speed_off(words: &str, place_m: [f64; 3], speed_mps: f64) -> Result<(f64, ErrorStatement), Failure> {
    let header = scene_of(&format!("{NOISE}{words}"))?;
    let header = with_point(header, 1.0, place_m, [0.0, -speed_mps, 0.0]);
    let (_, true_mps) = truth(&header);
    let object = detected(&header)?;
    let error = ((object.radial_velocity_mps - true_mps) / true_mps).abs();
    Ok((error, unless_resolved(&object)))
}

/// Experiment 3: ±8.78 m/s.
pub(in crate::study::atlas) fn velocity(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::MAP.trial("speed against v_max 8.78 m/s (experiment 3)", "speed_mps");
    let row = |speed_mps: f64| {
        let (error, statement) = speed_off(
            "[radar.waveform]\nsamples = 512\n[radar.array]\npreset = \"1x4\"\n",
            PLACE_M,
            speed_mps,
        )?;
        Ok(trial.answered(speed_mps, error, statement))
    };
    [5.0, 8.0, 10.0, 20.0].into_iter().map(row).collect()
}

/// 256 samples at 5.12 MHz: a beat of f_s is 61.4 m away.
pub(in crate::study::atlas) fn range(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::MAP.trial("range against R_max 61.4 m", "range_m");
    let statement = ErrorStatement::Remark("summary: range_max_m below the truth's range, estimate null");
    let row = |range_m: f64| {
        let header = scene_of(&format!("{NOISE}[radar.array]\npreset = \"1x4\"\n"))?;
        let header = with_point(header, 1.0, [0.0, range_m, 6.0], [0.0, -5.0, 0.0]);
        let (true_m, _) = truth(&header);
        let object = detected(&header)?;
        let error = ((object.range_m - true_m) / true_m).abs();
        let beyond = true_m > header.radar.waveform.range_max_m();
        Ok(trial.answered(range_m, error, if beyond { statement } else { ErrorStatement::Missing }))
    };
    [50.0, 60.0, 70.0].into_iter().map(row).collect()
}

/// Three transmitters share the velocity span with `tdm`, and keep it with `ddm`; a wrong fold gives a wrong
/// angle.
pub(in crate::study::atlas) fn transmitters_in_turn(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::ANGLE.trial("place of a point at −10 m/s, 3 transmitters", "multiplexing");
    let row = |multiplexing: &str| {
        let words = format!("{NOISE}[radar.array]\npreset = \"3x4\"\nmultiplexing = \"{multiplexing}\"\n");
        let header = with_point(scene_of(&words)?, 1.0, PLACE_M, [0.0, -10.0, 0.0]);
        let (true_m, _) = truth(&header);
        let object = detected(&header)?;
        let across_m = object.position_m[0] - PLACE_M[0];
        // Half a lane at this range is −27 dB; the verdict depends on the lane, not on −20 dB.
        let error = across_m.abs() / true_m * if object.lane == Some(2) { 1.0 } else { 10.0 };
        Ok(trial.answered(multiplexing, error, unless_resolved(&object)))
    };
    ["simultaneous", "tdm", "ddm"].into_iter().map(row).collect()
}

/// Doppler division keeps the span of one transmitter, ±16.2 m/s; beyond it the empty band does not determine
/// the fold, and the velocity is reported as not resolved. Found by the random search (seed 2, lone points,
/// case 0).
pub(in crate::study::atlas) fn beyond_the_bands(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::DDM.trial("speed beyond the span of Doppler division, ±16.2 m/s", "speed_mps");
    let row = |speed_mps: f64| {
        let (error, statement) = speed_off("[radar.array]\nmultiplexing = \"ddm\"\n", PLACE_M, speed_mps)?;
        Ok(trial.answered(speed_mps, error, statement))
    };
    [10.0, 15.0, 20.0, 29.0].into_iter().map(row).collect()
}

/// A frame with codes takes four times as long: a fast point crosses several range cells during it. Found by
/// the random search (seed 2, lone points, case 9: 0.4 of a Doppler cell off).
pub(in crate::study::atlas) fn crossing_cells(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::BPM.trial("speed of a point that crosses range cells within a frame", "speed_mps");
    let row = |speed_mps: f64| {
        let (error, statement) = speed_off(
            "[radar.waveform]\nsamples = 512\n[radar.array]\nmultiplexing = \"bpm\"\n",
            [9.5, 40.0, 1.0],
            speed_mps,
        )?;
        Ok(trial.answered(speed_mps, error, statement))
    };
    [3.0, 12.0, 30.0].into_iter().map(row).collect()
}
