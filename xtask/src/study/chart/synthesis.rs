//! Echoes of a moving body: paths against the paper's table, and the two forms of the sum.

use crate::study::chart::row::SettingRow;
use crate::study::chart::work::{Measured, Subject, measured};
use crate::study::looks;
use crate::study::scenes::{
    cube_of, frame_of, paths_at, paths_of, scene_of, synthesizer, tables_at, with_body,
};
use artifact::Accuracy;
use artifact::cube::CubeFrame;
use artifact::paths::{Curve, Facet, MAX_ORDER, Path};
use artifact::scene::SceneHeader;
use num_complex::Complex64;
use wayside::host::failure::Failure;

const ONE_CHANNEL: &str = "[radar.array]\npreset = \"1x1\"\n[radar.waveform]\nchirps = 64\n";
/// Asked of the paths that are traced anew through the frame.
const FINE_DB: f64 = -60.0;

/// The body in lane 2 at its range, approaching at 10 m/s.
fn scene(subject: &Subject, accuracy_db: f64) -> Result<SceneHeader, Failure> {
    let header = scene_of(ONE_CHANNEL)?;
    let ahead_m = (subject.range_m.powi(2) - 6.0_f64.powi(2) - 5.75_f64.powi(2)).sqrt();
    let mut header = with_body(header, &subject.body, [5.75, ahead_m, 0.0], [0.0, -10.0, 0.0]);
    header.fidelity.accuracy = Accuracy::from_db(accuracy_db);
    Ok(header)
}

fn wide(cube: &CubeFrame) -> Vec<Complex64> {
    cube.samples.iter().map(|z| Complex64::new(z.re.into(), z.im.into())).collect()
}

/// The cube of the same frame with the body traced anew every few chirps: nothing is frozen for longer.
fn retraced(subject: &Subject) -> Result<Vec<Complex64>, Failure> {
    let whole = scene(subject, FINE_DB)?;
    let mut part = whole.clone();
    part.radar.waveform.chirps = subject.retraced_chirps;
    let mut samples = Vec::new();
    for number in 0..whole.radar.waveform.chirps / subject.retraced_chirps {
        let mut frame = frame_of(&part);
        let begin_s = f64::from(number) * part.radar.frame_duration_s();
        frame.poses = frame.poses.iter().map(|pose| radar::motion::pose_after(pose, begin_s)).collect();
        samples.extend(wide(&cube_of(&part, &paths_at(&part, &frame)?)?));
    }
    Ok(samples)
}

fn reference(subject: &Subject) -> String {
    format!("paths traced anew every {} chirps, {FINE_DB} dB asked", subject.retraced_chirps)
}

fn row(
    subject: &Subject,
    method: &'static str,
    setting: String,
    from: &Measured<CubeFrame>,
    exact: &[Complex64],
) -> SettingRow {
    SettingRow {
        stage: "fmcw-echo",
        scene: format!("{}, 64 chirps, lane 2, 10 m/s", subject.name),
        method,
        setting,
        seconds: from.seconds,
        peak_mib: from.peak_mib,
        error: looks::relative_error(&wide(&from.value), exact),
        reference: reference(subject),
    }
}

/// Frozen for the whole frame, by the accuracy asked.
pub(super) fn paths(subject: &Subject) -> Result<Vec<SettingRow>, Failure> {
    let exact = retraced(subject)?;
    let row = |accuracy_db: f64| {
        let header = scene(subject, accuracy_db)?;
        let cube = measured(|| cube_of(&header, &paths_of(&header)?))?;
        Ok(row(subject, "paths", format!("{accuracy_db} dB asked"), &cube, &exact))
    };
    [-20.0, -30.0, -40.0].into_iter().map(row).collect()
}

/// The paper's σ_f.
pub(super) fn tables(subject: &Subject) -> Result<Vec<SettingRow>, Failure> {
    let exact = retraced(subject)?;
    let header = scene(subject, -20.0)?;
    let frame = frame_of(&header);
    let cube = measured(|| {
        let tables = tables_at(&header, &frame)?;
        synthesizer(&header, header.seed)?
            .frame_of_tables(&frame.poses, &tables, &|_| ())
            .map_err(Failure::refused)
    })?;
    Ok(vec![row(subject, "rcs-table", "far field, −20 dB asked".into(), &cube, &exact)])
}

/// The sum as the formulas have it, and with the phase advanced by recurrence; 8 chirps of one channel, one
/// thread.
pub(super) fn synthesis(subject: &Subject) -> Result<Vec<SettingRow>, Failure> {
    let mut header = scene_of(ONE_CHANNEL)?;
    header.radar.waveform.chirps = 8;
    let (radar, centre_hz) = (&header.radar, header.radar.waveform.centre_frequency_hz());
    let paths: Vec<Path> = (0..subject.echo_paths).map(point).collect();
    let slow = measured(|| Ok(fmcw_echo::reference::cube(radar, centre_hz, &paths)))?;
    let sum = fmcw_echo::direct_sum::DirectSum::new(radar, centre_hz, &paths);
    let fast = measured(|| Ok((0..8).flat_map(|chirp| sum.row(0, chirp)).collect::<Vec<_>>()))?;
    let row = |method,
               setting: &str,
               from: &Measured<Vec<Complex64>>,
               other: &Measured<Vec<Complex64>>,
               reference: &str| {
        SettingRow {
            stage: "fmcw-echo",
            scene: format!("{} paths, 8 chirps of 256 samples", paths.len()),
            method,
            setting: setting.into(),
            seconds: from.seconds,
            peak_mib: from.peak_mib,
            error: looks::relative_error(&from.value, &other.value),
            reference: reference.into(),
        }
    };
    Ok(vec![
        row("echo, formulas", "every sample alone", &slow, &fast, "echo, recurrence"),
        row("echo, recurrence", "quadratic phase", &fast, &slow, "echo, formulas"),
    ])
}

/// Points over the road, each with its own speed.
fn point(number: usize) -> Path {
    let share = (number as f64 * 0.618_034).fract(); // golden ratio: evenly spread for any count
    let position_m = [-4.0 + 14.0 * share, 25.0 + 30.0 * (share * 7.0).fract(), 1.8 * (share * 13.0).fract()];
    let velocity_mps = [0.0, -10.0 * (share * 5.0).fract(), 0.0];
    let one = [[Complex64::ONE, Complex64::ZERO], [Complex64::ZERO, Complex64::ONE]];
    Path {
        target: 0,
        order: 0,
        apparent_tx_m: position_m,
        apparent_tx_mps: velocity_mps,
        apparent_rx_m: position_m,
        apparent_rx_mps: velocity_mps,
        amplitude_m: one,
        slope_m_per_hz: [[Complex64::ZERO; 2]; 2],
        facets: [Facet::default(); MAX_ORDER],
        curve: Curve::default(),
    }
}
