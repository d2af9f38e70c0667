//! Limits of the map: ranges near zero and near the largest, velocities at the ambiguity, other kinds of
//! sampling, directions far off the boresight.

use crate::study::atlas::methods;
use crate::study::atlas::signals::strongest::{strongest, unless_resolved};
use crate::study::atlas::verdict::documented;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::extent::Extent;
use crate::study::scenes::{detect, scene_of, with_point};
use artifact::scene::SceneHeader;
use wayside::host::failure::Failure;

/// Error of a single point's range in cells: one is 0.24 m.
fn cells_off(header: &SceneHeader, range_m: f64) -> Result<f64, Failure> {
    let cell_m = header.radar.waveform.range_resolution_m();
    Ok(strongest(header)?.map_or(f64::INFINITY, |o| (o.range_m - range_m).abs() / cell_m))
}

/// Ranges from almost zero to the last cell before the fold, and one beyond it; an error of one is a range
/// cell.
pub(in crate::study::atlas) fn ranges(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::MAP.trial("range of a point at the ends of the range axis, in cells", "range_m");
    let folded = documented("docs/scenes.md", "What is beyond `range_max_m` shows as much behind 0")?;
    let row = |range_m: f64| {
        let header = scene_of("[noise]\nsnr_db = 40.0\n[radar.array]\npreset = \"1x1\"\n")?;
        let header = with_point(header, 1.0, [0.0, range_m, 6.0], [0.0; 3]);
        let is_beyond = range_m > header.radar.waveform.range_max_m();
        Ok(trial.answered(
            range_m,
            cells_off(&header, range_m)?,
            if is_beyond { folded } else { ErrorStatement::Missing },
        ))
    };
    [0.05, 0.24, 1.0, 60.9, 61.2, 61.36, 61.6].into_iter().map(row).collect()
}

/// Scenes with a single point that cannot be received.
pub(in crate::study::atlas) fn at_the_radar(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::READ.trial("a target at the radar", "target");
    let point = |place: &str| {
        scene_of(&format!("[[target]]\nkind = \"point\"\nid = \"p\"\nrcs_m2 = 1.0\nposition_m = {place}\n"))
    };
    let seen_of =
        |header: Result<SceneHeader, Failure>| header.and_then(|header| detect(&header).map(|_| ()));
    Ok(vec![
        trial.must_refuse("a point in the array's centre", seen_of(point("[0.0, 0.0, 6.0]"))),
        trial.must_refuse("a point a millimetre before it", seen_of(point("[0.0, 0.001, 6.0]"))),
        trial.must_refuse("a point that is nowhere", seen_of(point("[nan, 0.0, 6.0]"))),
    ])
}

/// Experiment 3, ±8.7774 m/s: at the ambiguity itself, and slightly to either side.
pub(in crate::study::atlas) fn speeds(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::MAP.trial("speed at the ambiguity, ±8.7774 m/s", "radial speed, m/s");
    let row = |speed_mps: f64| {
        let header = scene_of(
            "[noise]\nsnr_db = 40.0\n[radar.waveform]\nsamples = 512\n[radar.array]\npreset = \"1x4\"\n",
        )?;
        let header = with_point(header, 1.0, [0.0, 40.0, 6.0], [0.0, speed_mps, 0.0]);
        let Some(object) = strongest(&header)? else {
            return Ok(trial.answered(speed_mps, 1.0, ErrorStatement::Missing));
        };
        let error = (object.radial_velocity_mps / speed_mps - 1.0).abs();
        Ok(trial.answered(speed_mps, error, unless_resolved(&object)))
    };
    [8.7, 8.7774, -8.7774, 8.85].into_iter().map(row).collect()
}

/// Falling chirps, samples without Q, varying intervals: range and speed of a single point.
pub(in crate::study::atlas) fn waveforms(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::MAP.trial("waveforms of other kinds: range and speed of a point", "waveform");
    let row = |(name, words): (&str, &str)| {
        let header = scene_of(&format!("[noise]\nsnr_db = 40.0\n{words}"))?;
        let header = with_point(header, 1.0, [0.0, 20.0, 6.0], [0.0, -6.0, 0.0]);
        let middle_m = 20.0 - 6.0 * header.radar.frame_middle_s();
        let Some(object) = strongest(&header)? else {
            return Ok(trial.answered(name, 1.0, ErrorStatement::Missing));
        };
        let off = (object.range_m / middle_m - 1.0).hypot(object.radial_velocity_mps / -6.0 - 1.0);
        Ok(trial.answered(name, off, unless_resolved(&object)))
    };
    [
        ("falling chirps", "[radar.waveform]\nslope_mhz_per_us = -12.5\n"),
        ("real samples", "[radar.receiver]\nsampling = \"real\"\n"),
        (
            "real samples, falling",
            "[radar.receiver]\nsampling = \"real\"\n[radar.waveform]\nslope_mhz_per_us = -12.5\n",
        ),
        ("staggered", "[radar.waveform]\nstagger_us = [0.0, 3.0, 7.0]\n[radar.array]\npreset = \"1x4\"\n"),
        (
            "eight chirps of eight samples",
            "[radar.waveform]\nsamples = 8\nchirps = 8\nslope_mhz_per_us = 0.8\n",
        ),
        ("one chirp", "[radar.waveform]\nchirps = 1\n"),
    ]
    .into_iter()
    .map(row)
    .collect()
}

/// Error of the azimuth of a point 30 m away, rad; 1 if it is lost. `array` specifies the antennas.
fn azimuth_off(array: &str, azimuth_deg: f64) -> Result<f64, Failure> {
    let (sin, cos) = azimuth_deg.to_radians().sin_cos();
    let header = scene_of(&format!("[noise]\nsnr_db = 40.0\n[dsp]\nassumed_height_m = 6.0\n{array}"))?;
    let header = with_point(header, 1.0, [30.0 * sin, 30.0 * cos, 6.0], [0.0; 3]);
    Ok(strongest(&header)?.map_or(1.0, |o| (o.azimuth_rad - azimuth_deg.to_radians()).abs()))
}

/// Points far off the boresight: cross-range error relative to the range.
pub(in crate::study::atlas) fn directions(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::ANGLE.trial("points far off the boresight", "azimuth_deg");
    let statement = documented("docs/scenes.md", "the two along the row itself, +90° and −90°, look alike")?;
    let row = |azimuth_deg: f64| {
        let error = azimuth_off("", azimuth_deg)?;
        Ok(trial.answered(
            azimuth_deg,
            error,
            if azimuth_deg > 85.0 { statement } else { ErrorStatement::Missing },
        ))
    };
    [0.0, 30.0, 60.0, 80.0, 89.0].into_iter().map(row).collect()
}

/// Receivers two wavelengths apart: directions whose cosines differ by a half are ambiguous.
pub(in crate::study::atlas) fn grating_lobes(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::ANGLE.trial("grating lobes of a sparse array, two wavelengths apart", "azimuth_deg");
    let statement = documented("docs/scenes.md", "directions look alike whose direction cosines differ by")?;
    let row = |azimuth_deg: f64| {
        let sparse = "[radar.array]\ntx_half_wavelengths = [[0.0, 0.0]]\n\
                      rx_half_wavelengths = [[0.0, 0.0], [4.0, 0.0], [8.0, 0.0], [12.0, 0.0]]\n";
        let error = azimuth_off(sparse, azimuth_deg)?;
        Ok(trial.answered(azimuth_deg, error, statement))
    };
    [5.0, 14.0, 16.0, 25.0].into_iter().map(row).collect()
}
