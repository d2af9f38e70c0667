//! A plate of 1.5 m at the ranges of a road, 2D²/λ = 1.2 km: a far-field table against paths of spherical
//! waves.

use crate::study::atlas::methods;
use crate::study::atlas::verdict::printed;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::bodies;
use crate::study::closed_forms;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use crate::study::scenes::{frame_of, paths_of, scene_of, tables_at, with_body};
use artifact::scene::SceneHeader;
use wayside::host::failure::Failure;

const SIDE_M: f64 = 1.5;
const RANGES_M: [f64; 4] = [10.0, 25.0, 40.0, 100.0];

/// A plate at the radar's height, perpendicular to the line of sight; the sweep is centred on the frequency
/// of the closed forms.
fn scene_at(range_m: f64) -> Result<SceneHeader, Failure> {
    let header = scene_of(
        "[radar.waveform]\nstart_frequency_ghz = 76.6875\nchirps = 32\n[radar.array]\npreset = \"1x1\"\n",
    )?;
    Ok(with_body(header, &bodies::plate(SIDE_M), [0.0, range_m, 6.0], [0.0; 3]))
}

/// The paper's σ_f, whose phase and level hold at infinity.
pub(in crate::study::atlas) fn table_over_range(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::RCS_TABLE.trial("far-field table of a 1.5 m plate", "range_m");
    let far = closed_forms::plate_far(SIDE_M, 0.0);
    let row = |range_m: f64| {
        let header = scene_at(range_m)?;
        let table = tables_at(&header, &frame_of(&header))?;
        let statement = table.model_error.far_field.map_or(ErrorStatement::Missing, ErrorStatement::Estimate);
        let near = closed_forms::plate_near(SIDE_M, range_m, 0.0);
        // The table's own S at its middle aspect is the far-field closed form; its comparison is over the
        // band.
        Ok(trial.answered(range_m, rcs_solvers::relative_error(&[far], &[near]), statement))
    };
    RANGES_M.into_iter().map(row).collect()
}

/// Paths of spherical waves instead of the table.
pub(in crate::study::atlas) fn paths_over_range(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::PATHS.trial("paths of the same plate", "range_m");
    let row = |range_m: f64| {
        let header = scene_at(range_m)?;
        let frame = paths_of(&header)?;
        let statement = printed(&frame.error);
        let near = closed_forms::plate_near(SIDE_M, range_m, 0.0);
        Ok(trial.answered(
            range_m,
            rcs_solvers::relative_error(
                &[rcs_solvers::first_body_scattering(&header, &frame.paths, rcs_solvers::FREQUENCY_HZ)[0][0]],
                &[near],
            ),
            statement,
        ))
    };
    RANGES_M.into_iter().map(row).collect()
}
