//! Echoes of many paths: the formulas, the sum by recurrence, and sums by transforms.

use crate::study::chart::cost::{Cost, measured};
use crate::study::chart::row::SettingRow;
use crate::study::extent::Extent;
use crate::study::rcs_solvers;
use crate::study::scenes::scene_of;
use artifact::paths::Path;
use artifact::{Accuracy, Radar};
use fmcw_echo::direct_sum::DirectSum;
use fmcw_echo::fast_sum;
use num_complex::Complex64;
use rayon::prelude::*;
use wayside::host::failure::Failure;

/// Requested accuracies of transforms.
const ASKED_DB: [f64; 4] = [-20.0, -40.0, -60.0, -80.0];
/// Number of paths for the formulas, which evaluate every sample separately.
const FEW_PATHS: usize = 300;

/// Number of samples of a cube at which the direct sum is compared with the formulas.
const CHECKED: usize = 64;

/// Numbers of paths: those of one distant car, of a street, of bodies that reflect each other.
pub(super) fn counts(extent: Extent) -> &'static [usize] {
    match extent {
        Extent::Quick => &[FEW_PATHS],
        Extent::Full => &[FEW_PATHS, 1_000, 10_000, 67_000],
    }
}

/// Every method of summing `count` paths over a frame of 12 channels, 128 chirps of 256 samples.
pub(super) fn rows(count: usize) -> Result<Vec<SettingRow>, Failure> {
    let radar = scene_of("")?.radar;
    let paths: Vec<Path> = (0..count).map(point).collect();
    let sum = Sum { radar: &radar, paths: &paths };
    let direct = measured(|| Ok(sum.directly()))?;
    let mut rows = vec![];
    if count <= FEW_PATHS {
        rows.extend(sum.by_formulas()?);
    }
    for asked_db in ASKED_DB {
        let found = measured(|| Ok(sum.by_transforms(asked_db)))?;
        let error = rcs_solvers::relative_error(&found.value, &direct.value);
        let setting = format!("{asked_db} dB asked");
        rows.push(sum.row("echo, transforms", setting, found.cost, error, "echo, recurrence"));
    }
    let error = sum.error_of_direct(&direct.value);
    let reference = format!("echo, formulas, at {CHECKED} samples");
    rows.push(sum.row("echo, recurrence", "direct sum".into(), direct.cost, error, &reference));
    Ok(rows)
}

struct Sum<'a> {
    radar: &'a Radar,
    paths: &'a [Path],
}

impl Sum<'_> {
    fn directly(&self) -> Vec<Complex64> {
        let sum = DirectSum::new(self.radar, self.radar.waveform.centre_frequency_hz(), self.paths);
        let chirps = self.radar.waveform.chirps as usize;
        let rows = (0..self.radar.virtual_channels() * chirps).into_par_iter();
        rows.flat_map_iter(|row| sum.row(row / chirps, row % chirps)).collect()
    }

    /// The direct sum against the formulas, at samples spread over the cube.
    fn error_of_direct(&self, cube: &[Complex64]) -> f64 {
        let [chirps, samples] = [self.radar.waveform.chirps, self.radar.waveform.samples].map(|n| n as usize);
        let centre_hz = self.radar.waveform.centre_frequency_hz();
        let places: Vec<usize> = (0..CHECKED).map(|n| n * cube.len() / CHECKED + n).collect();
        let exact = places.par_iter().map(|place| {
            let at = [place / (chirps * samples), place / samples % chirps, place % samples];
            fmcw_echo::reference::cube_sample(self.radar, centre_hz, self.paths, at, None)
        });
        let found: Vec<Complex64> = places.iter().map(|place| cube[*place]).collect();
        rcs_solvers::relative_error(&found, &exact.collect::<Vec<_>>())
    }

    fn by_transforms(&self, asked_db: f64) -> Vec<Complex64> {
        let centre_hz = self.radar.waveform.centre_frequency_hz();
        fast_sum::cube(self.radar, centre_hz, self.paths, Accuracy::from_db(asked_db))
    }

    /// The sum by the formulas, and with the phase advanced by recurrence; 8 chirps of one channel, one
    /// thread.
    fn by_formulas(&self) -> Result<[SettingRow; 2], Failure> {
        let mut radar = scene_of("[radar.array]\npreset = \"1x1\"\n")?.radar;
        radar.waveform.chirps = 8;
        let centre_hz = radar.waveform.centre_frequency_hz();
        let slow = measured(|| Ok(fmcw_echo::reference::cube(&radar, centre_hz, self.paths)))?;
        let sum = DirectSum::new(&radar, centre_hz, self.paths);
        let fast = measured(|| Ok((0..8).flat_map(|chirp| sum.row(0, chirp)).collect::<Vec<_>>()))?;
        let error = rcs_solvers::relative_error(&fast.value, &slow.value);
        let row = |method, setting: &str, cost, reference| SettingRow {
            scene: format!("{} paths, 1 × 8 × 256, one thread", self.paths.len()),
            ..self.row(method, setting.into(), cost, error, reference)
        };
        Ok([
            row("echo, formulas", "every sample alone", slow.cost, "echo, recurrence"),
            row("echo, recurrence alone", "quadratic phase", fast.cost, "echo, formulas"),
        ])
    }

    fn row(&self, method: &str, setting: String, cost: Cost, error: f64, reference: &str) -> SettingRow {
        let [chirps, samples] = [self.radar.waveform.chirps, self.radar.waveform.samples];
        let channels = self.radar.virtual_channels();
        SettingRow {
            stage: "fmcw-echo".into(),
            scene: format!("{} paths, {channels} × {chirps} × {samples}", self.paths.len()),
            method: method.into(),
            setting,
            cost,
            error,
            reference: reference.into(),
            size: String::new(),
        }
    }
}

/// Points over the road, each with its own velocity.
fn point(number: usize) -> Path {
    let share = (number as f64 * 0.618_034).fract(); // golden ratio: evenly spread for any count
    let position_m = [-4.0 + 14.0 * share, 25.0 + 30.0 * (share * 7.0).fract(), 1.8 * (share * 13.0).fract()];
    let velocity_mps = [0.0, -10.0 * (share * 5.0).fract(), 0.0];
    let one = [[Complex64::ONE, Complex64::ZERO], [Complex64::ZERO, Complex64::ONE]];
    Path::of_point(position_m, velocity_mps, one)
}
