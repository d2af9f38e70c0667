//! Two echoes: in one cell, far apart in level, in two Doppler bands, side by side.

use crate::study::atlas::methods;
use crate::study::atlas::verdict::documented;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::extent::Extent;
use crate::study::scenes::{detect, scene_of, with_point};
use artifact::scene::SceneHeader;
use artifact::settings::Angle;
use wayside::host::failure::Failure;

/// A radar at the height of its points, so that places on the ground are directions.
fn level(words: &str) -> Result<SceneHeader, Failure> {
    scene_of(&format!("{words}[dsp]\nassumed_height_m = 6.0\n"))
}

/// Two equal points at one range and speed, half a beam apart: the farther one's distance from the nearest
/// point, relative to theirs.
pub(in crate::study::atlas) fn one_cell(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::ANGLE.trial("two targets in one cell, 0.7 of a beam apart", "angle");
    let statement = documented("docs/scenes.md", "one direction a cell, the strongest beam")?;
    let row = |(name, angle): (&str, Angle)| {
        let mut header = level("[noise]\nsnr_db = 40.0\n")?;
        header.dsp.angle = angle;
        let half_m: f64 = 0.35 * 40.0 / 6.0;
        let places = [-half_m, half_m];
        for (i, x) in places.into_iter().enumerate() {
            // A quarter of a wavelength more two-way range: neither in phase nor in opposition.
            let y = (1600.0 - x * x).sqrt() + 0.0005 * i as f64;
            header = with_point(header, 1.0, [x, y, 6.0], [0.0; 3]);
        }
        let points = detect(&header)?.points.points;
        let away = |x: f64| points.iter().map(|p| (p.position_m[0] - x).abs()).fold(f64::INFINITY, f64::min);
        let error = places.map(away).into_iter().fold(0.0, f64::max) / (2.0 * half_m);
        Ok(trial.answered(name, error, if angle == Angle::Fft { statement } else { ErrorStatement::Missing }))
    };
    [("fft", Angle::Fft), ("max-likelihood", Angle::MaximumLikelihood)].into_iter().map(row).collect()
}

/// A second point far below the first and five metres away, noise 30 dB below it: error 1 if it is lost.
pub(in crate::study::atlas) fn dynamic_range(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::MAP.trial("a point far below another, 5 m away", "dB below, range window");
    let statement = documented("docs/scenes.md", "taper over the samples of a chirp")?;
    let row = |(below_db, window): (f64, &str)| {
        let words = format!(
            "[radar.array]\npreset = \"1x1\"\n[noise]\nsnr_db = {:?}\n[dsp]\nrange_window = \"{window}\"\n\
             doppler_window = \"{window}\"\n",
            below_db + 30.0
        );
        let header = with_point(scene_of(&words)?, 1.0, [0.0, 40.1, 6.0], [0.0; 3]);
        let rcs_m2 = 10_f64.powf(-0.1 * below_db) * (45.1_f64 / 40.1).powi(4);
        let header = with_point(header, rcs_m2, [0.0, 45.1, 6.0], [0.0, -4.0, 0.0]);
        let points = detect(&header)?.points.points;
        let is_there = points
            .iter()
            .any(|p| (p.range_m - 45.1).abs() < 0.3 && (p.radial_velocity_mps + 4.0).abs() < 0.3);
        Ok(trial.answered(format!("{below_db}, {window}"), if is_there { 0.0 } else { 1.0 }, statement))
    };
    [
        (60.0, "hann"),
        (100.0, "chebyshev-120"),
        (100.0, "blackman"),
        (100.0, "hann"),
        (100.0, "rect"),
        (140.0, "chebyshev-160"),
    ]
    .into_iter()
    .map(row)
    .collect()
}

/// Doppler division: two points at one range whose bands meet. Error: share of lanes without an object.
pub(in crate::study::atlas) fn doppler_bands(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial =
        methods::DDM.trial("two points of one range whose Doppler bands meet", "apart in bands of 8.1 m/s");
    let row = |bands: f64| {
        let words = "[noise]\nsnr_db = 40.0\n[radar.array]\nmultiplexing = \"ddm\"\n";
        let header = level(words)?;
        let band_mps = 2.0 * header.radar.velocity_max_mps() / 4.0;
        let speeds = [-3.0, -3.0 + bands * band_mps];
        let header = with_point(header, 1.0, [-3.0, 39.89, 6.0], [0.0, speeds[0], 0.0]);
        let header = with_point(header, 1.0, [3.0, 39.89, 6.0], [0.0, speeds[1], 0.0]);
        let objects = detect(&header)?.points.objects;
        let is_found = |x: f64, v: f64| {
            objects
                .iter()
                .any(|o| (o.position_m[0] - x).abs() < 0.5 && (o.radial_velocity_mps - v).abs() < 0.3)
        };
        let cosine = 39.89 / 40.0;
        let lost = [(-3.0, speeds[0] * cosine), (3.0, speeds[1] * cosine)]
            .into_iter()
            .filter(|(x, v)| !is_found(*x, *v))
            .count();
        let unresolved = objects.iter().any(|o| !o.velocity_resolved);
        let statement = if unresolved {
            ErrorStatement::Remark("velocity_resolved is false")
        } else {
            ErrorStatement::Missing
        };
        Ok(trial.answered(bands, lost as f64, statement))
    };
    [0.3, 1.0, 2.0].into_iter().map(row).collect()
}

/// Two vehicles side by side, nearer than the clustering distances: one object.
pub(in crate::study::atlas) fn side_by_side(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::OBJECTS.trial("two points behind one another as objects", "apart_m");
    let statement =
        documented("docs/scenes.md", "m in range: detections closer than this can join one object")?;
    let row = |apart_m: f64| {
        let header = level("[noise]\nsnr_db = 40.0\n")?;
        let header = with_point(header, 1.0, [0.0, 35.0, 6.0], [0.0, -5.0, 0.0]);
        let header = with_point(header, 1.0, [0.0, 35.0 + apart_m, 6.0], [0.0, -5.0, 0.0]);
        let objects = detect(&header)?.points.objects.len();
        Ok(trial.answered(apart_m, (objects as f64 - 2.0).abs(), statement))
    };
    [1.5, 2.4, 3.0, 6.0].into_iter().map(row).collect()
}
