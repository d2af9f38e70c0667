//! Turning wheels compared with wheels of the rigid body: their contribution to maps, and its cost.

use crate::project::{project_root, shared};
use crate::study::extent::Extent;
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{CHAIN, SourcePaths};
use artifact::paths::PathsFrame;
use artifact::rdm::RdmFrame;
use artifact::scene::{MeshStatistics, SceneHeader};
use ndarray::Array2;
use plotting::heat_map::HeatMap;
use plotting::marks::Legend;
use std::path::{Path, PathBuf};
use wayside::host::cancellation::Cancellation;
use wayside::host::failure::Failure;
use wayside::host::progress::note;
use wayside::host::{files, processor_time};
use wayside::stepwise::{OpenedScene, Processing, echoes_of_paths, paths};
use wayside::{Allowance, SceneSource};

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[CHAIN, &[file!()]];

/// Views of a vehicle: height of the radar above the road, place of the vehicle, and its velocity.
const VIEWS: [(&str, f64, [f64; 2], [f64; 2]); 4] = [
    ("side", 1.0, [0.0, 15.0], [10.0, 0.0]),
    ("27° off the side", 1.0, [0.0, 20.0], [10.0, 5.0]),
    ("27° off the side, from 6 m up", 6.0, [0.0, 20.0], [10.0, 5.0]),
    ("front", 1.0, [0.0, 20.0], [0.0, -10.0]),
];

/// Own vehicles, and real ones whose materials name their wheels.
const OWN: [&str; 4] = ["car-sedan", "motorcycle-street", "bus-city", "truck-box"];
const REAL: [&str; 2] = ["gazebo_prius", "generic_sedan"];

/// Difference from the rigid body's velocities above which a velocity counts as the wheels' own, m/s: two
/// cells.
const BESIDE_MPS: f64 = 0.5;

/// Table of vehicles and views, and a picture of one.
pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    part.head(&[
        "vehicle",
        "wheels",
        "triangles that turn",
        "view",
        "power beside the body's velocities, dB of all: still / turning",
        "widest −40 dB, m/s: still / turning",
        "error, dB: still / turning",
        "paths",
        "moments",
        "processor s",
    ]);
    let folder = tempfile::tempdir().map_err(|error| Failure::System(format!("no folder: {error}")))?;
    for (name, model) in models(extent) {
        for view in VIEWS.iter().take(extent.case_count(VIEWS.len() as u64) as usize) {
            let both =
                ["still", "turning"].map(|wheels| VehicleMap::simulate(folder.path(), &model, view, wheels));
            let [still, turning] = both;
            let (still, turning) = (still?, turning?);
            part.row(&row(&name, view.0, &still, &turning));
            if name == "car-sedan" && view.0 == VIEWS[1].0 && extent == Extent::Full {
                draw("wheels-still.svg", "Wheels still", &still)?;
                draw("wheels-turning.svg", "Wheels turning", &turning)?;
            }
        }
    }
    Ok(part)
}

/// Names of vehicles with their models in scenes.
fn models(extent: Extent) -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = OWN.iter().map(|name| ((*name).into(), (*name).into())).collect();
    if extent == Extent::Quick {
        all.truncate(1);
        return all;
    }
    for name in REAL {
        let file: PathBuf = shared().join("vehicles").join(format!("{name}.glb"));
        match file.is_file() {
            true => all.push((name.to_owned(), file.display().to_string())),
            false => note(format!("{} is not here: {name} is left out", file.display())),
        }
    }
    all
}

/// Results of a scene with one vehicle.
struct VehicleMap {
    header: SceneHeader,
    paths: PathsFrame,
    ranges_m: Vec<f64>,
    velocities_mps: Vec<f64>,
    /// Power of all channels, `[doppler, range]`.
    power: Array2<f64>,
    processor_s: f64,
}

impl VehicleMap {
    fn simulate(
        folder: &Path,
        model: &str,
        (_, height_m, [x_m, y_m], [vx, vy]): &(&str, f64, [f64; 2], [f64; 2]),
        wheels: &str,
    ) -> Result<Self, Failure> {
        let file = folder.join(format!("{}.toml", files_in(folder)));
        let text = format!(
            "name = \"wheels\"\n[radar]\nposition_m = [0.0, 0.0, {height_m:?}]\nboresight_el_deg = 0.0\n\
             [fidelity]\nbounces = 2\nwheels = \"{wheels}\"\n[[target]]\nkind = \"mesh\"\nid = \"vehicle\"\n\
             model = {model:?}\nposition_m = [{x_m:?}, {y_m:?}, 0.0]\nvelocity_mps = [{vx:?}, {vy:?}, 0.0]\n"
        );
        files::write_file(&file, text.as_bytes())?;
        let before_s = processor_time::of_process().unwrap_or(0.0);
        let scene = OpenedScene::of(&SceneSource { file, ..SceneSource::default() }, Allowance::of(None))?;
        let never = Cancellation::default();
        let paths = paths(&scene, &never)?;
        let cubes = echoes_of_paths(&scene, &paths, &never)?;
        let processor_s = processor_time::of_process().unwrap_or(0.0) - before_s;
        let processing = Processing::of(&cubes.header)?;
        let maps = processing.maps(&cubes.frames[..1], &never)?;
        let (ranges_m, velocities_mps) = processing.axes();
        let power = power(&maps[0], [velocities_mps.len(), ranges_m.len()]);
        let header = scene.header().clone();
        Ok(Self { header, paths: paths.frames[0].clone(), ranges_m, velocities_mps, power, processor_s })
    }

    /// Least and greatest radial velocity of the rigid body's corners, extended by two cells to either side.
    fn rigid_body_velocities_mps(&self) -> [f64; 2] {
        let (target, mesh) = (&self.header.targets[0], &self.header.meshes[0]);
        let pose = &target.start;
        let (sin, cos) = pose.yaw_rad.sin_cos();
        let radar = self.header.radar.position_m;
        let radial = |v: &[f64; 3]| {
            let way = [
                pose.position_m[0] + cos * v[0] - sin * v[1] - radar[0],
                pose.position_m[1] + sin * v[0] + cos * v[1] - radar[1],
                pose.position_m[2] + v[2] - radar[2],
            ];
            let range_m = way.iter().map(|x| x * x).sum::<f64>().sqrt();
            (0..3).map(|k| way[k] * pose.velocity_mps[k]).sum::<f64>() / range_m
        };
        let all = mesh.vertices_m.iter().map(radial);
        let [low, high] = all.fold([f64::MAX, f64::MIN], |[low, high], v| [low.min(v), high.max(v)]);
        [low - BESIDE_MPS, high + BESIDE_MPS]
    }

    /// Power of cells beyond the rigid body's velocities relative to all power, dB.
    fn off_body_power_db(&self) -> f64 {
        let [low, high] = self.rigid_body_velocities_mps();
        let row_power = |row: usize| self.power.row(row).sum();
        let rows = 0..self.velocities_mps.len();
        let beside: f64 = rows
            .clone()
            .filter(|row| !(low..=high).contains(&self.velocities_mps[*row]))
            .map(row_power)
            .sum();
        10.0 * (beside / rows.map(row_power).sum::<f64>()).log10()
    }

    /// Least and greatest velocity of cells within 40 dB of the brightest.
    fn velocity_extent_mps(&self) -> [f64; 2] {
        let brightest = self.power.iter().copied().fold(0.0, f64::max);
        let is_bright = |row: &usize| self.power.row(*row).iter().any(|power| *power > 1e-4 * brightest);
        let bright = (0..self.velocities_mps.len()).filter(is_bright).map(|row| self.velocities_mps[row]);
        bright.fold([f64::MAX, f64::MIN], |[low, high], v| [low.min(v), high.max(v)])
    }

    fn error_db(&self) -> f64 {
        20.0 * self.paths.error.total().unwrap_or(0.0).log10()
    }
}

/// Number of files in a folder, used as a new name.
fn files_in(folder: &Path) -> usize {
    std::fs::read_dir(folder).map_or(0, Iterator::count)
}

/// Power summed over channels.
fn power(map: &RdmFrame, [rows, columns]: [usize; 2]) -> Array2<f64> {
    let mut power = Array2::zeros([rows, columns]);
    for channel in map.values.chunks_exact(rows * columns) {
        power.iter_mut().zip(channel).for_each(|(sum, value)| *sum += f64::from(value.norm_sqr()));
    }
    power
}

fn row(name: &str, view: &str, still: &VehicleMap, turning: &VehicleMap) -> Vec<String> {
    let wheels = &turning.header.meshes[0].wheels;
    let MeshStatistics { triangles_read, .. } = turning.header.meshes[0].statistics;
    let turned: usize = wheels.iter().map(|wheel| wheel.triangles.len()).sum();
    let both =
        |of: &dyn Fn(&VehicleMap) -> String| format!("{} / {}", of(still), of(turning)).replace('-', "−");
    let moments =
        |seen: &VehicleMap| seen.paths.trace.fineness.as_ref().map_or(1, |fineness| fineness.moments);
    vec![
        name.to_owned(),
        wheels.len().to_string(),
        format!("{turned} of {triangles_read}"),
        view.to_owned(),
        both(&|seen| format!("{:.1}", seen.off_body_power_db())),
        both(&|seen| {
            let [low, high] = seen.velocity_extent_mps();
            format!("{low:.1} … {high:.1}")
        }),
        both(&|seen| format!("{:.1}", seen.error_db())),
        both(&|seen| seen.paths.paths.len().to_string()),
        both(&|seen| moments(seen).to_string()),
        both(&|seen| format!("{:.1}", seen.processor_s)),
    ]
}

/// Draws the part of a map around the vehicle.
fn draw(file: &str, title: &str, seen: &VehicleMap) -> Result<(), Failure> {
    const SPAN_M: [f64; 2] = [16.0, 24.0];
    const SPAN_DB: f64 = 50.0;
    let columns: Vec<usize> =
        (0..seen.ranges_m.len()).filter(|k| (SPAN_M[0]..=SPAN_M[1]).contains(&seen.ranges_m[*k])).collect();
    let rows = seen.velocities_mps.len();
    let levels_db = Array2::from_shape_fn([rows, columns.len()], |(row, column)| {
        10.0 * seen.power[[row, columns[column]]].max(f64::MIN_POSITIVE).log10()
    });
    let ends = |values: &[f64], [from, to]: [usize; 2]| [values[from], values[to]];
    let map = HeatMap {
        title: title.to_owned(),
        notes: vec![
            "A car that passes 20 m away, 27° off its side; velocity is positive where the range grows."
                .to_owned(),
        ],
        x: ("range, m".into(), ends(&seen.ranges_m, [columns[0], columns[columns.len() - 1]])),
        y: ("radial velocity, m/s".into(), ends(&seen.velocities_mps, [0, rows - 1])),
        levels_db,
        span_db: SPAN_DB,
        unit: "dBW".into(),
        overlay: None,
        legend: Legend::default(),
    };
    let sheet = map.draw_square().map_err(Failure::refused)?;
    files::write_file(&project_root().join("docs/pictures").join(file), sheet.standalone().as_bytes())
}
