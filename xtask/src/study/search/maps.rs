//! Maps and detections against their definitions, and points against the truth.

use crate::study::scenes::{cube_header, detect, scene_of, with_point};
use crate::study::search::differential_testing::{Outcome, Random, outcome_of};
use crate::study::search::echoes::radar;
use crate::study::search::random_bodies::within;
use artifact::ErrorBudget;
use artifact::cube::CubeFrame;
use artifact::radar::Multiplexing;
use artifact::settings::{Detector, Window};
use num_complex::{Complex32, Complex64};
use rand::RngExt;
use std::f64::consts::TAU;
use wayside::host::failure::Failure;

/// Windows with closed formulas, periodic, of unit coherent gain.
const WINDOWS: [(Window, [f64; 3]); 4] = [
    (Window::Rect, [1.0, 0.0, 0.0]),
    (Window::Hann, [0.5, 0.5, 0.0]),
    (Window::Hamming, [0.54, 0.46, 0.0]),
    (Window::Blackman, [0.42, 0.5, 0.08]),
];

fn weight([a, b, c]: [f64; 3], n: usize, length: usize) -> f64 {
    let turn = TAU * n as f64 / length as f64;
    (a - b * turn.cos() + c * (2.0 * turn).cos()) / a
}

/// Compares cells of the map of a random cube with their sums.
pub(super) fn against_sums(random: &mut Random) -> Result<Outcome, Failure> {
    let mut header = radar(random)?;
    header.radar.array.multiplexing = Multiplexing::Simultaneous;
    header.radar.waveform.slope_hz_per_s = header.radar.waveform.slope_hz_per_s.abs();
    let windows = [0; 2].map(|_| WINDOWS[random.random_range(0..4)]);
    (header.dsp.range_window, header.dsp.doppler_window) = (windows[0].0, windows[1].0);
    let header = cube_header(&header);
    let [channels, chirps, length] = header.shape();
    let mut value = || Complex32::new(random.random::<f32>() - 0.5, random.random::<f32>() - 0.5);
    let samples: Vec<Complex32> = (0..channels * chirps * length).map(|_| value()).collect();
    let cube = CubeFrame { index: 0, time_s: 0.0, samples, error: ErrorBudget::default() };
    let receiver = match dsp::Receiver::new(&header) {
        Ok(receiver) => receiver,
        Err(_) => return Ok(Outcome::Uninformative),
    };
    let map = receiver.range_doppler(&cube).map_err(Failure::refused)?;
    let mut worst = 0.0_f64;
    for _ in 0..4 {
        let at = [channels, chirps, length].map(|count| random.random_range(0..count));
        let found = map.values[(at[0] * chirps + at[1]) * length + at[2]];
        let found = Complex64::new(found.re.into(), found.im.into());
        let exact = summed(&cube, [chirps, length], at, [windows[0].1, windows[1].1]);
        worst = worst.max((found - exact).norm() / ((chirps * length) as f64).sqrt());
    }
    Ok(outcome_of(worst, 1e-4, || {
        format!("{channels} channels, {chirps} chirps, {length} samples, {windows:?}")
    }))
}

fn summed(cube: &CubeFrame, [chirps, length]: [usize; 2], at: [usize; 3], of: [[f64; 3]; 2]) -> Complex64 {
    let mut sum = Complex64::ZERO;
    let row = (at[1] + chirps - chirps / 2) % chirps;
    for (m, n) in (0..chirps).flat_map(|m| (0..length).map(move |n| (m, n))) {
        let value = cube.samples[(at[0] * chirps + m) * length + n];
        let cycles = (n * at[2]) as f64 / length as f64 + (m * row) as f64 / chirps as f64;
        let taper = weight(of[0], n, length) * weight(of[1], m, chirps);
        sum +=
            taper * Complex64::new(value.re.into(), value.im.into()) * Complex64::cis(-TAU * cycles.fract());
    }
    sum
}

/// Compares a mask with threshold times noise estimate, cell by cell.
pub(super) fn detector(random: &mut Random) -> Result<Outcome, Failure> {
    let mut header = radar(random)?;
    header.dsp.detector =
        [Detector::CaCfar, Detector::GoCfar, Detector::SoCfar, Detector::OsCfar][random.random_range(0..4)];
    header.dsp.guard_cells = [0; 2].map(|_| random.random_range(0..4));
    header.dsp.training_cells = [0; 2].map(|_| random.random_range(1..8));
    header.dsp.false_alarm_rate = 10_f64.powf(within(random, -6.0, -0.5));
    let header = cube_header(&header);
    let (Ok(cfar), [_, chirps, length]) = (dsp::cfar::Cfar::new(&header), artifact::rdm::shape(&header))
    else {
        return Ok(Outcome::Uninformative);
    };
    let power: Vec<f64> = (0..chirps * length).map(|_| -(1.0 - random.random::<f64>()).ln()).collect();
    let (mask, estimates) = (cfar.mask(&power, 0.0), cfar.estimates(&power));
    let differs = |i: &usize| {
        let threshold = cfar.factor([i / length, i % length]) * estimates[*i];
        // Sums in another order round differently.
        let is_close = (power[*i] / threshold - 1.0).abs() < 1e-9;
        mask[*i] != 0 && !is_close && (mask[*i] > 1) != (power[*i] > threshold)
    };
    let wrong = (0..power.len()).filter(differs).count();
    Ok(outcome_of(wrong as f64, 0.0, || format!("{:?}, {chirps} × {length}", header.dsp)))
}

/// A single point 35 dB over the noise must be found at its place, with its velocity up to unresolved folds.
pub(super) fn isolated_points(random: &mut Random) -> Result<Outcome, Failure> {
    let multiplexing = ["simultaneous", "tdm", "ddm", "bpm"][random.random_range(0..4)];
    let header = scene_of(&format!(
        "[noise]\nsnr_db = 35.0\n[dsp]\nassumed_height_m = 6.0\n[radar.waveform]\nsamples = {}\n\
         [radar.array]\n\
         multiplexing = \"{multiplexing}\"\n",
        [256, 384, 512][random.random_range(0..3)]
    ))?;
    let (range_m, azimuth_rad) = (within(random, 3.0, 58.0), within(random, -0.8, 0.8));
    let speed_mps = within(random, -30.0, 30.0);
    let towards = [azimuth_rad.sin(), azimuth_rad.cos(), 0.0];
    let middle_s = header.radar.frame_middle_s();
    let place_m = [0, 1, 2].map(|i| (range_m - speed_mps * middle_s) * towards[i] + [0.0, 0.0, 6.0][i]);
    let header = with_point(header, 1.0, place_m, towards.map(|t| t * speed_mps));
    let objects = detect(&header)?.points.objects;
    let case =
        || format!("{multiplexing}, {range_m:.2} m, {:.2}°, {speed_mps:.2} m/s", azimuth_rad.to_degrees());
    let Some(object) = objects.iter().max_by(|a, b| a.snr_db.total_cmp(&b.snr_db)) else {
        return Ok(Outcome::Discrepancy(format!("not found: {}", case())));
    };
    // Folds of one chirp interval are ambiguous if none is resolved.
    let fold_mps =
        2.0 * header.radar.waveform.wavelength_m() / (4.0 * header.radar.waveform.chirp_interval_s);
    let off_mps = object.radial_velocity_mps - speed_mps;
    let folds = if object.velocity_resolved { 0.0 } else { (off_mps / fold_mps).round() };
    let velocity = (off_mps - folds * fold_mps).abs() / header.radar.velocity_resolution_mps().abs();
    // An unresolved fold shifts the range by the coupling.
    let coupled_m = radar::beat::coupling_m(&header.radar.waveform, folds * fold_mps);
    let range = (object.range_m - range_m + coupled_m).abs() / header.radar.waveform.range_resolution_m();
    // 12 virtual elements a half wavelength apart: a beam is 2/12 of u.
    let beam = (object.azimuth_rad.sin() - azimuth_rad.sin()).abs() * 6.0;
    let told = || {
        format!(
            "{}; range {range:.2} cells, velocity {velocity:.2} cells, direction {beam:.2} beams, {folds} \
             folds, \
             resolved {}",
            case(),
            object.velocity_resolved
        )
    };
    // An echo that crosses range cells within a frame is smeared along both axes.
    let crossed = 2.0 * middle_s * speed_mps.abs() / header.radar.waveform.range_resolution_m();
    Ok(outcome_of(range.max(velocity).max(beam), 0.3 + 0.5 * crossed, told))
}
