//! Paths that represent a body through a whole frame, and the precision of samples.

use crate::study::atlas::methods;
use crate::study::atlas::verdict::printed;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::bodies;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use crate::study::scenes::{cube_of, frame_of, paths_at, paths_of, scene_of, with_body, with_point};
use artifact::Accuracy;
use artifact::paths::Path;
use artifact::scene::{SceneFrame, SceneHeader};
use bart_rcs::{PathView, scattering_of_paths};
use glam::DVec3;
use num_complex::Complex64;
use wayside::host::failure::Failure;

/// Lane 3 at 25 m, 10 m/s, long frames: against the body traced anew at three moments of the frame.
pub(in crate::study::atlas) fn near_lane(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::PATHS.trial("frozen for a frame, lane 3 at 25 m", "accuracy_db asked");
    let body = bodies::joined(
        bodies::tube(0.2, 0.25, 120, 0.0),
        &bodies::shifted(bodies::cube(0.2, &bodies::Face::ALL), [-1.5, 0.0, 0.2]),
    );
    let row = |accuracy_db: f64| {
        let mut header = with_body(scene_of(PLAIN)?, &body, [9.5, 22.3, 0.0], [0.0, -10.0, 0.0]);
        header.fidelity.accuracy = Accuracy::from_db(accuracy_db);
        let frozen = paths_of(&header)?;
        let statement = printed(&frozen.error);
        Ok(trial.answered(accuracy_db, error_through_the_frame(&header, &frozen.paths)?, statement))
    };
    [-20.0, -30.0].into_iter().map(row).collect()
}

const PLAIN: &str = "[radar.array]\npreset = \"1x1\"\n";

fn error_through_the_frame(header: &SceneHeader, frozen: &[Path]) -> Result<f64, Failure> {
    let (mut found, mut expected) = (Vec::new(), Vec::new());
    for share in [0.05, 0.5, 0.95] {
        let seconds = share * header.radar.frame_duration_s();
        let (instant, frame) = instant(header, seconds);
        let anew = paths_at(&instant, &frame)?;
        found.extend(over_the_band(header, frozen, seconds, &frame));
        expected.extend(over_the_band(header, &anew.paths, instant.radar.frame_middle_s(), &frame));
    }
    Ok(rcs_solvers::relative_error(&found, &expected))
}

/// The scene as one chirp with its middle at this time, at −45 dB.
fn instant(header: &SceneHeader, seconds: f64) -> (SceneHeader, SceneFrame) {
    let mut instant = header.clone();
    instant.fidelity.accuracy = Accuracy::from_db(-45.0);
    instant.radar.waveform.chirps = 1;
    let begin_s = seconds - instant.radar.frame_middle_s();
    let mut frame = frame_of(header);
    frame.poses = frame.poses.iter().map(|pose| radar::motion::pose_after(pose, begin_s)).collect();
    (instant, frame)
}

/// S at the ends and the middle of the sweep, relative to the place of the first body at that time.
fn over_the_band(header: &SceneHeader, paths: &[Path], seconds: f64, frame: &SceneFrame) -> Vec<Complex64> {
    let waveform = &header.radar.waveform;
    let antenna_m = DVec3::from(header.radar.position_m);
    let view = PathView {
        transmitter_m: antenna_m,
        receiver_m: antenna_m,
        origin_m: DVec3::from(frame.poses[0].position_m),
        seconds,
        centre_frequency_hz: waveform.centre_frequency_hz(),
    };
    let at = |share: f64| waveform.start_frequency_hz + share * waveform.bandwidth_hz();
    [0.1, 0.5, 0.9].map(|share| scattering_of_paths(paths, &view, at(share))[0][0]).to_vec()
}

/// Lengths and phases are f64, samples are stored as f32.
pub(in crate::study::atlas) fn single_precision(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::RECURRENCE.trial("samples of a point against the formulas", "range_m");
    let row = |range_m: f64| {
        let header = scene_of("[radar.waveform]\nchirps = 16\n[radar.array]\npreset = \"1x1\"\n")?;
        let header = with_point(header, 1.0, [0.0, range_m, 6.0], [0.0, -10.0, 0.0]);
        let paths = paths_of(&header)?;
        let cube = cube_of(&header, &paths)?;
        let exact = fmcw_echo::reference::cube(
            &header.radar,
            header.radar.waveform.centre_frequency_hz(),
            &paths.paths,
        );
        let found: Vec<Complex64> =
            cube.samples.iter().map(|z| Complex64::new(z.re.into(), z.im.into())).collect();
        let statement = cube.error.synthesis.map_or(ErrorStatement::Missing, ErrorStatement::UpperBound);
        Ok(trial.answered(range_m, rcs_solvers::relative_error(&found, &exact), statement))
    };
    [1.0, 40.0, 1000.0].into_iter().map(row).collect()
}
