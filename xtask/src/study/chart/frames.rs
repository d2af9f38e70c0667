//! Vehicles on the road at several ranges, each frame echoed both ways: path by path, and by the paper's
//! table.

use crate::study::chart::row::SettingRow;
use crate::study::chart::work::{Measured, measured};
use crate::study::looks;
use crate::study::scenes::{
    cube_header, cube_of, frame_of, paths_at, paths_of, scene_of, synthesizer, tables_at, with_body,
};
use artifact::Accuracy;
use artifact::cube::CubeFrame;
use artifact::paths::Path;
use artifact::rcs::RcsFrame;
use artifact::scene::SceneHeader;
use num_complex::Complex64;
use wayside::host::failure::Failure;

/// Accuracies asked of both ways, and of the reference.
const ASKED_DB: f64 = -20.0;
const FINE_DB: f64 = -30.0;
/// Parts of the frame that the reference is traced for, each for itself.
const PARTS: u32 = 2;
/// Place of lane 2 along x (the paper's Table 1), and the radar's height.
const LANE_M: f64 = 5.75;
const RADAR_M: f64 = 6.0;

/// A vehicle in lane 2, approaching; the radar is that of experiment 1: 3 × 4 elements, 128 chirps of 256
/// samples.
struct VehicleCase {
    name: &'static str,
    vehicle: &'static str,
    ahead_m: f64,
    speed_mps: f64,
}

/// Ahead of the radar's foot so that the way from the radar to the middle of the vehicle on the road is
/// `range_m`.
fn ahead_m(range_m: f64) -> f64 {
    (range_m.powi(2) - RADAR_M.powi(2) - LANE_M.powi(2)).sqrt()
}

fn cases() -> [VehicleCase; 6] {
    let case = |name, vehicle, ahead_m, speed_mps| VehicleCase { name, vehicle, ahead_m, speed_mps };
    [
        case("car-suv, 25 m, a frame of 12 channels", "car-suv", ahead_m(25.0), 10.0),
        case("car-suv, 40 m, a frame of 12 channels", "car-suv", ahead_m(40.0), 10.0),
        case("car-suv, 60 m, a frame of 12 channels", "car-suv", ahead_m(60.0), 10.0),
        case("car-suv, 100 m, a frame of 12 channels", "car-suv", ahead_m(100.0), 10.0),
        case("bus-city, 40 m, a frame of 12 channels", "bus-city", ahead_m(40.0), 8.0),
        case("experiment-1, a frame of 12 channels", "car-suv", 40.0, 10.0),
    ]
}

/// Both ways of every case.
pub(super) fn rows() -> Result<Vec<SettingRow>, Failure> {
    Ok(cases().iter().map(of_case).collect::<Result<Vec<_>, _>>()?.concat())
}

fn of_case(case: &VehicleCase) -> Result<Vec<SettingRow>, Failure> {
    let exact = reference(case)?;
    Ok([by_paths(case, &exact)?, by_tables(case, &exact)?].concat())
}

fn scene(case: &VehicleCase, accuracy_db: f64) -> Result<SceneHeader, Failure> {
    let missing = || Failure::refused(format!("`{}` is missing", case.vehicle));
    let body = scene::vehicles::mesh(case.vehicle, 0).ok_or_else(missing)?;
    let velocity_mps = [0.0, -case.speed_mps, 0.0];
    let mut header = with_body(scene_of("")?, &body, [LANE_M, case.ahead_m, 0.0], velocity_mps);
    header.fidelity.accuracy = Accuracy::from_db(accuracy_db);
    Ok(header)
}

/// The cube with the vehicle traced anew in the middle of each part of the frame.
fn reference(case: &VehicleCase) -> Result<CubeFrame, Failure> {
    let whole = scene(case, FINE_DB)?;
    let mut part = whole.clone();
    part.radar.waveform.chirps = whole.radar.waveform.chirps / PARTS;
    let mut parts = Vec::new();
    for number in 0..PARTS {
        let mut frame = frame_of(&part);
        let begin_s = f64::from(number) * part.radar.frame_duration_s();
        frame.poses = frame.poses.iter().map(|pose| radar::motion::pose_after(pose, begin_s)).collect();
        parts.push(cube_of(&part, &paths_at(&part, &frame)?)?);
    }
    let of_channel = part.radar.waveform.chirps as usize * part.radar.waveform.samples as usize;
    let channels = 0..whole.radar.cube_channels();
    let rows = channels
        .flat_map(|channel| parts.iter().map(move |p| &p.samples[channel * of_channel..][..of_channel]));
    let samples = rows.flatten().copied().collect();
    Ok(CubeFrame { samples, ..parts[0].clone() })
}

fn by_paths(case: &VehicleCase, exact: &CubeFrame) -> Result<Vec<SettingRow>, Failure> {
    let header = scene(case, ASKED_DB)?;
    let paths = measured(|| paths_of(&header))?;
    let cube = measured(|| cube_of(&header, &paths.value))?;
    let count = paths.value.paths.len();
    let size = format!("{count} paths, {} kB", count * size_of::<Path>() / 1000);
    let methods = ["frame by paths, cube", "frame by paths, levels"];
    compared(case, methods, &size, &paths, &cube, exact)
}

fn by_tables(case: &VehicleCase, exact: &CubeFrame) -> Result<Vec<SettingRow>, Failure> {
    let header = scene(case, ASKED_DB)?;
    let frame = frame_of(&header);
    let tables = measured(|| tables_at(&header, &frame))?;
    let cube = measured(|| {
        synthesizer(&header, header.seed)?
            .frame_of_tables(&frame.poses, &tables.value, &|_| ())
            .map_err(Failure::refused)
    })?;
    let methods = ["frame by table, cube", "frame by table, levels"];
    compared(case, methods, &size_of_tables(&tables.value), &tables, &cube, exact)
}

fn size_of_tables(frame: &RcsFrame) -> String {
    let axes =
        |t: &artifact::rcs::RcsTable| [t.frequency_hz.len(), t.elevation_rad.len(), t.azimuth_rad.len()];
    let [f, el, az] = frame.tables.first().map_or([0; 3], axes);
    let values: usize = frame.tables.iter().map(|table| table.amplitude_m.len()).sum();
    format!("{f} × {el} × {az} values, {} kB", values * size_of::<Complex64>() / 1000)
}

/// Two rows: of the whole cube, and of the levels of its map, phases apart.
fn compared<T>(
    case: &VehicleCase,
    methods: [&'static str; 2],
    size: &str,
    scattering: &Measured<T>,
    cube: &Measured<CubeFrame>,
    exact: &CubeFrame,
) -> Result<Vec<SettingRow>, Failure> {
    let seconds = [scattering.seconds, cube.seconds];
    let setting = format!("{ASKED_DB} dB asked, {size}, {:.2} s + {:.3} s", seconds[0], seconds[1]);
    let row = |method, error| SettingRow {
        stage: "bart-rcs + fmcw-echo",
        scene: case.name.into(),
        method,
        setting: setting.clone(),
        seconds: seconds.iter().sum(),
        peak_mib: scattering.peak_mib.zip(cube.peak_mib).map(|(a, b)| a.max(b)),
        error,
        reference: format!("paths traced anew {PARTS} times in the frame, {FINE_DB} dB asked"),
    };
    let whole = looks::relative_error(&wide(&cube.value), &wide(exact));
    let levels = looks::relative_error(&levels(case, &cube.value)?, &levels(case, exact)?);
    Ok(vec![row(methods[0], whole), row(methods[1], levels)])
}

fn wide(cube: &CubeFrame) -> Vec<Complex64> {
    cube.samples.iter().map(|z| Complex64::new(z.re.into(), z.im.into())).collect()
}

/// |X| of every cell of the range-Doppler map of every channel.
fn levels(case: &VehicleCase, cube: &CubeFrame) -> Result<Vec<Complex64>, Failure> {
    let receiver = dsp::Receiver::new(&cube_header(&scene(case, ASKED_DB)?)).map_err(Failure::refused)?;
    let map = receiver.range_doppler(cube).map_err(Failure::refused)?;
    Ok(map.values.iter().map(|z| Complex64::from(f64::from(z.norm()))).collect())
}
