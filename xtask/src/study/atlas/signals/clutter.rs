//! Steps of the clutter's level, frames without a target, and frames of noise alone.

use crate::study::atlas::methods;
use crate::study::atlas::verdict::documented;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::extent::Extent;
use crate::study::scenes::{cube_header, detect, paths_of, scene_of, synthesizer};
use artifact::settings::{Detector, Window};
use dsp::cfar::Cfar;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use wayside::host::failure::Failure;

const ASKED: f64 = 1e-3;
/// The first range cell of the clutter.
const STEP: usize = 128;
/// Cells on either side whose training cells extend over the step.
const NEAR: usize = 10;

/// Exponential noise whose power rises by 30 dB at a range: ratio of actual to requested false alarms in the
/// cells next to the step, on its upper side.
pub(in crate::study::atlas) fn steps(extent: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::CFAR.trial("false alarms on a step of the clutter by 30 dB", "detector");
    let statement = documented(
        "docs/scenes.md",
        "All detectors take the noise of a cell and of its training cells to be alike",
    )?;
    let row = |(name, detector): (&str, Detector)| {
        let mut header = scene_of("[radar.array]\npreset = \"1x1\"\n[noise]\nnoise_figure_db = 12.0\n")?;
        (header.dsp.range_window, header.dsp.doppler_window) = (Window::Rect, Window::Rect);
        (header.dsp.false_alarm_rate, header.dsp.detector) = (ASKED, detector);
        let cfar = Cfar::new(&cube_header(&header)).map_err(Failure::refused)?;
        let rate = on_the_step(&cfar, extent.case_count(150));
        // An excess counts as it is; a shortfall as the missing share.
        Ok(trial.answered(name, (rate / ASKED - 1.0).abs(), statement))
    };
    [
        ("ca-cfar", Detector::CaCfar),
        ("go-cfar", Detector::GoCfar),
        ("so-cfar", Detector::SoCfar),
        ("os-cfar", Detector::OsCfar),
    ]
    .into_iter()
    .map(row)
    .collect()
}

fn on_the_step(cfar: &Cfar, frames: u64) -> f64 {
    let (chirps, samples) = (128, 256);
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let (mut hits, mut cells) = (0_u64, 0_u64);
    for _ in 0..frames {
        let level = |column: usize| if column < STEP { 1.0 } else { 1e3 };
        let power: Vec<f64> = (0..chirps * samples)
            .map(|i| -level(i % samples) * (1.0 - random.random::<f64>()).ln())
            .collect();
        for (i, mask) in cfar.mask(&power, 0.0).iter().enumerate() {
            if (STEP..STEP + NEAR).contains(&(i % samples)) {
                cells += 1;
                hits += u64::from(*mask > 1);
            }
        }
    }
    hits as f64 / cells as f64
}

/// Nothing in view: neither points nor objects, only noise.
pub(in crate::study::atlas) fn without_target(_: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::CA_CFAR.trial("a frame without a target: objects", "noise");
    let row = |(name, words): (&str, &str)| {
        let header = scene_of(&format!("{words}[dsp]\nfalse_alarm_rate = 1e-9\n"))?;
        let objects = detect(&header)?.points.objects.len();
        Ok(trial.answered(name, objects as f64, ErrorStatement::Missing))
    };
    [
        ("none", ""),
        ("thermal", "[noise]\nnoise_figure_db = 12.0\n"),
        ("of an snr of no target", "[noise]\nsnr_db = 20.0\n"),
    ]
    .into_iter()
    .map(|(name, words)| {
        let header = scene_of(words)?;
        match detect(&header) {
            Ok(_) => row((name, words)),
            Err(refusal) => Ok(trial.must_refuse::<(), _>(name, Err(refusal))),
        }
    })
    .collect()
}

/// Noise alone for a hundred frames: confirmed tracks.
pub(in crate::study::atlas) fn noise_alone(extent: Extent) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::TRACKS.trial("noise alone: tracks that are believed", "false alarms asked, frames");
    let frames = extent.case_count(100) as u32;
    let row = |rate: f64| {
        let mut header = scene_of("[noise]\nnoise_figure_db = 12.0\n[radar.array]\npreset = \"1x4\"\n")?;
        header.dsp.false_alarm_rate = rate;
        let receiver = dsp::Receiver::new(&cube_header(&header)).map_err(Failure::refused)?;
        let synthesizer = synthesizer(&header, 3)?;
        let mut tracker =
            dsp::Tracker::new(&cube_header(&header), dsp::ROAD_TRAFFIC).map_err(Failure::refused)?;
        let mut paths = paths_of(&header)?;
        let mut believed = std::collections::BTreeSet::new();
        for index in 0..frames {
            (paths.index, paths.time_s) = (index, 0.1 * f64::from(index));
            let cube = synthesizer.frame(&paths, &|_| ()).map_err(Failure::refused)?;
            let (_, points) = receiver.process(&cube).map_err(Failure::refused)?;
            let tracks = tracker.step(&points).map_err(Failure::refused)?.tracks;
            let is_believed =
                |t: &&artifact::tracks::Track| t.state != artifact::tracks::TrackState::Tentative;
            believed.extend(tracks.iter().filter(is_believed).map(|t| t.id));
        }
        Ok(trial.answered(format!("{rate:e}, {frames}"), believed.len() as f64, ErrorStatement::Missing))
    };
    [1e-5, 1e-4].into_iter().map(row).collect()
}
