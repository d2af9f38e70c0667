//! Other radars in the air.

use crate::study::atlas::methods;
use crate::study::atlas::verdict::documented;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::extent::Extent;
use crate::study::scenes::{cube_of, detect, paths_of, scene_of, with_point};
use artifact::scene::SceneHeader;
use artifact::units::SPEED_OF_LIGHT_MPS;
use wayside::host::failure::Failure;

/// A radar with one transmitter in noise, with these interferers.
fn beside(interferers: &str) -> Result<SceneHeader, Failure> {
    scene_of(&format!("[radar.array]\npreset = \"1x1\"\n[noise]\nnoise_figure_db = 12.0\n{interferers}"))
}

/// Slope, MHz/µs, offset, µs, and distance, m, of radars whose chirps cross our own.
const CROSSING: [(f64, f64, f64); 3] = [(13.7, 3.0, 20.0), (11.1, -3.0, 25.0), (10.0, -2.0, 30.0)];

fn crossing(count: usize, eirp_dbm: f64) -> String {
    CROSSING[..count].iter().map(|(slope, offset, y)| interferer(*slope, *offset, eirp_dbm, *y)).collect()
}

fn interferer(slope_mhz_per_us: f64, offset_us: f64, eirp_dbm: f64, y_m: f64) -> String {
    format!(
        "[[radar.interferer]]\nposition_m = [0.0, {y_m:?}, 6.0]\neirp_dbm = {eirp_dbm:?}\nslope_mhz_per_us = \
         {slope_mhz_per_us:?}\noffset_us = {offset_us:?}\n"
    )
}

/// Another radar with the same slope is a ghost at ½c(R/c + lateness), where there is no body.
pub(in crate::study::atlas) fn same_slope(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial =
        methods::INTERFERER.trial("interferer of the same slope, its ghost against its formula", "late_ns");
    let filter =
        documented("docs/scenes.md", "The IF filter is a brick wall around the beats of the map's ranges")?;
    let row = |late_ns: f64| {
        let ghost_m = 0.5 * (20.0 + SPEED_OF_LIGHT_MPS * 1e-9 * late_ns);
        let points = detect(&beside(&interferer(12.5, 1e-3 * late_ns, 10.0, 20.0))?)?.points.points;
        let nearest = points.iter().map(|p| (p.range_m - ghost_m).abs()).fold(f64::INFINITY, f64::min);
        // Beats beyond the sample rate, 61.4 m, are filtered out.
        let statement = if ghost_m > 61.4 { filter } else { ErrorStatement::Missing };
        Ok(trial.answered(late_ns, (nearest / ghost_m).min(1.0), statement))
    };
    [0.0, 60.0, 450.0].into_iter().map(row).collect()
}

/// An interferer with the same slope is an object without a body: a flaw of all such radars.
pub(in crate::study::atlas) fn ghosts_of_no_body(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::CA_CFAR.trial("objects of an empty road beside an interferer", "its slope, MHz/µs");
    let statement = documented(
        "docs/scenes.md",
        "with equal slopes it is a ghost target at ½c·(R/c + the other chirp's lateness)",
    )?;
    let row = |slope: f64| {
        let objects = detect(&beside(&interferer(slope, 0.06, 10.0, 20.0))?)?.points.objects.len();
        Ok(trial.answered(slope, objects as f64, statement))
    };
    [12.5, 11.0, -12.5].into_iter().map(row).collect()
}

/// Several crossing radars raise the noise: their power relative to the noise's, against the closed form for
/// crossings of duration f_s/|Δμ|.
pub(in crate::study::atlas) fn crossings(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::INTERFERER.trial("power of several crossing radars against closed forms", "radars");
    let row = |count: usize| {
        let all = crossing(count, 10.0);
        let header = scene_of(&format!("[radar.array]\npreset = \"1x1\"\n{all}"))?;
        let cube = cube_of(&header, &paths_of(&header)?)?;
        let power: f64 = cube.samples.iter().map(|z| f64::from(z.norm_sqr())).sum();
        let waveform = &header.radar.waveform;
        let exact: f64 =
            CROSSING[..count].iter().map(|(slope, _, y)| crossing_power(waveform, *slope, *y)).sum();
        let exact = exact * f64::from(waveform.chirps);
        // Beats of crossings with each other are not part of the sum of their powers.
        Ok(trial.answered(count, ((power / exact).sqrt() - 1.0).abs(), ErrorStatement::Missing))
    };
    [1, 2, 3].into_iter().map(row).collect()
}

/// Σ over the samples of one chirp: EIRP·G·(λ/4πR)² for f_s²/|Δμ| samples.
fn crossing_power(waveform: &artifact::radar::Waveform, slope_mhz_per_us: f64, range_m: f64) -> f64 {
    let lambda_over_way = waveform.wavelength_m() / (4.0 * std::f64::consts::PI * range_m);
    let (eirp_w, gain) = (0.01, 10.0);
    let apart = (waveform.slope_hz_per_s - 1e12 * slope_mhz_per_us).abs();
    eirp_w * gain * lambda_over_way * lambda_over_way * waveform.sample_rate_hz.powi(2) / apart
}

/// A weak point among crossing radars: error 1 if it is lost.
pub(in crate::study::atlas) fn weak_among_radars(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::CA_CFAR.trial("a weak point beside crossing radars", "eirp_dbm of three");
    let statement =
        documented("docs/scenes.md", "Where its frequency crosses that of a chirp the receiver hears it")?;
    let row = |eirp_dbm: f64| {
        let all = crossing(CROSSING.len(), eirp_dbm);
        let words = format!("[radar.array]\npreset = \"1x4\"\n[noise]\nnoise_figure_db = 12.0\n{all}");
        let header = with_point(scene_of(&words)?, 0.1, [0.0, 40.0, 6.0], [0.0, -5.0, 0.0]);
        let points = detect(&header)?.points.points;
        let is_there = points.iter().any(|p| (p.range_m - 40.0).abs() < 0.3);
        Ok(trial.answered(eirp_dbm, if is_there { 0.0 } else { 1.0 }, statement))
    };
    [-60.0, -20.0, 20.0].into_iter().map(row).collect()
}
