//! The detector at the edges of a map, between neighbours, and without noise.

use crate::study::atlas::methods;
use crate::study::atlas::{CaseRow, ErrorStatement};
use crate::study::extent::Extent;
use crate::study::scenes::{cube_header, detect, paths_of, scene_of, synthesizer, with_point};
use artifact::scene::SceneHeader;
use artifact::settings::Window;
use wayside::host::failure::Failure;

pub(in crate::study::atlas) fn all(extent: Extent) -> Result<Vec<CaseRow>, Failure> {
    let mut rows = false_alarms(extent, "rect", Window::Rect)?;
    rows.extend(false_alarms(extent, "hann", Window::Hann)?);
    rows.extend(neighbours()?);
    rows.extend(without_noise()?);
    Ok(rows)
}

const ASKED: f64 = 1e-2;
/// Number of cells at either end of the range axis with truncated training cells.
const RIM: usize = 10;

/// Noise alone, by zone. Counting statistics are 2 % in the interior and 5 % at an edge of 2·10⁵ cells.
fn false_alarms(extent: Extent, name: &str, window: Window) -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::CA_CFAR.trial("false alarms by zone, asked 1e-2", "window, zone");
    let statement = match window {
        Window::Rect => ErrorStatement::Missing,
        _ => ErrorStatement::Remark(
            "docs/physics.md §8: tapered cells are correlated, 0.8 to 1.3 of the rate asked",
        ),
    };
    let mut header = scene_of("[radar.array]\npreset = \"1x1\"\n[noise]\nnoise_figure_db = 12.0\n")?;
    (header.dsp.range_window, header.dsp.doppler_window) = (window, window);
    header.dsp.false_alarm_rate = ASKED;
    let frames = match extent {
        Extent::Quick => 30,
        Extent::Full => 120,
    };
    let [edge, interior] = counted(&header, frames)?;
    let row = |zone: &str, rate: f64| {
        trial.answered(format!("{name}, {zone}"), (rate / ASKED - 1.0).abs(), statement)
    };
    Ok(vec![row("edge", edge), row("interior", interior)])
}

/// Ratio of detections to tested cells, at the edges of the range axis and inside.
fn counted(header: &SceneHeader, frames: u64) -> Result<[f64; 2], Failure> {
    let (mut hits, mut cells) = ([0_u64; 2], [0_u64; 2]);
    let samples = header.radar.waveform.range_cells();
    let receiver = dsp::Receiver::new(&cube_header(header)).map_err(Failure::refused)?;
    for seed in 0..frames {
        for (i, mask) in noise_map(header, &receiver, seed)?.iter().enumerate() {
            let column = i % samples;
            let zone = usize::from((RIM..samples - RIM).contains(&column));
            cells[zone] += u64::from(*mask > 0);
            hits[zone] += u64::from(*mask > 1);
        }
    }
    Ok([0, 1].map(|zone| hits[zone] as f64 / cells[zone].max(1) as f64))
}

fn noise_map(header: &SceneHeader, receiver: &dsp::Receiver, seed: u64) -> Result<Vec<u8>, Failure> {
    let nothing = paths_of(header)?;
    let cube = synthesizer(header, seed)?.frame(&nothing, &|_| ()).map_err(Failure::refused)?;
    Ok(receiver.range_doppler(&cube).map_err(Failure::refused)?.mask)
}

/// Two equal points three range cells apart: both must be points of the cloud. The error is the farther one's
/// distance to the nearest point, relative to the three cells. The stronger one raises the noise estimate of
/// the weaker.
fn neighbours() -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::CA_CFAR.trial("two points three cells apart", "second below first, dB");
    let statement = ErrorStatement::Remark("docs/physics.md §10: ca-cfar masks a weaker neighbour");
    let row = |below_db: f64| {
        let header = scene_of("[radar.array]\npreset = \"1x4\"\n[noise]\nsnr_db = 50.0\n")?;
        let gap_m = 3.0 * header.radar.waveform.range_resolution_m();
        let header = with_point(header, 1.0, [0.0, 40.0, 6.0], [0.0; 3]);
        let header = with_point(header, 10_f64.powf(-0.1 * below_db), [0.0, 40.0 + gap_m, 6.0], [0.0; 3]);
        let points = detect(&header)?.points.points;
        let away =
            |range_m: f64| points.iter().map(|p| (p.range_m - range_m).abs()).fold(f64::INFINITY, f64::min);
        Ok(trial.answered(below_db, away(40.0).max(away(40.0 + gap_m)) / gap_m, statement))
    };
    [0.0, 15.0].into_iter().map(row).collect()
}

/// A map without noise, whose floor is 60 dB below the peak: weaker echoes are not detected, and the map
/// reports its floor.
fn without_noise() -> Result<Vec<CaseRow>, Failure> {
    let trial = methods::CA_CFAR.trial("noise-free map, a second point at 30 m", "second below first, dB");
    let row = |below_db: f64| {
        let header = scene_of("[radar.array]\npreset = \"1x4\"\n[dsp]\nrange_window = \"blackman\"\n")?;
        let header = with_point(header, 1.0, [0.0, 40.0, 6.0], [0.0; 3]);
        let header = with_point(header, 10_f64.powf(-0.1 * below_db), [0.0, 30.0, 6.0], [0.0; 3]);
        let found = detect(&header)?;
        let is_there = found.points.points.iter().any(|p| (p.range_m - 30.0).abs() < 0.25);
        let statement = found.map.assumed_floor.map_or(ErrorStatement::Missing, |_| {
            ErrorStatement::Remark("assumed_floor is set: 60 dB below the peak")
        });
        Ok(trial.answered(below_db, if is_there { 0.0 } else { 1.0 }, statement))
    };
    [30.0, 50.0, 80.0].into_iter().map(row).collect()
}
