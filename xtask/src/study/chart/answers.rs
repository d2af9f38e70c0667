//! The whole chain by the accuracy that is asked: what a run takes, what it finds, how far its answers are
//! from the truth, and how probable it takes the true class to be.

use crate::project::shared;
use crate::study::chart::work::{Measured, measured};
use crate::study::extent::Extent;
use std::fmt::Write as _;
use std::path::Path;
use wayside::host::failure::Failure;
use wayside::host::files;
use wayside::host::progress::Work;
use wayside::outcome::summary::TargetSummary;
use wayside::{SceneSource, Settings, Summary};

/// Answers of one scene at one accuracy.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::study) struct Answers {
    pub(super) scene: &'static str,
    pub(super) asked_db: f64,
    /// Processor seconds of the frame with its pictures.
    pub(super) processor_s: f64,
    pub(super) peak_mib: Option<f64>,
    /// Bodies found, and those that the radar can see.
    pub(super) found: usize,
    pub(super) to_be_found: usize,
    /// Root mean squares over what was found: range, radial velocity, place across the road.
    pub(super) errors: Option<[f64; 3]>,
    /// Mean probability of the true class over the vehicles found.
    pub(super) probability: Option<f64>,
}

/// A scene: its name, and each body's class, model, lane, place along the road and speed.
struct Scene {
    name: &'static str,
    bodies: &'static [(&'static str, &'static str, u8, f64, f64)],
}

const fn scene(name: &'static str, bodies: &'static [(&'static str, &'static str, u8, f64, f64)]) -> Scene {
    Scene { name, bodies }
}

/// From one plate to a queue; models with a dot in their names are files.
const SCENES: [Scene; 12] = [
    scene("a car, 30 m", &[("car", "car-hatchback", 2, 30.0, 8.0)]),
    scene("a corner of 0.5 m", &[("", "corner.obj", 2, 35.0, 5.0)]),
    scene("a car beside a truck", &[("car", "car-suv", 2, 36.0, 9.0), ("truck", "truck-box", 3, 33.0, 1.0)]),
    scene("a plate of 1 m²", &[("", "plate.obj", 2, 30.0, 5.0)]),
    scene("a car, 90 m", &[("car", "car-sedan", 2, 90.0, 9.0)]),
    scene("a bus, 45 m", &[("bus", "bus-city", 1, 45.0, 7.0)]),
    scene("a truck, 35 m", &[("truck", "truck-semi", 3, 35.0, 6.0)]),
    scene("a motorcycle, 25 m", &[("motorcycle", "motorcycle-touring", 1, 25.0, 6.0)]),
    scene(
        "a queue of four",
        &[
            ("car", "car-sedan", 2, 18.0, 0.6),
            ("car", "car-estate", 2, 25.0, 0.9),
            ("bus", "bus-midi", 2, 34.0, 1.2),
            ("motorcycle", "motorcycle-street", 2, 41.0, 1.5),
        ],
    ),
    scene(
        "three lanes",
        &[
            ("motorcycle", "motorcycle-scooter", 1, 26.0, 7.0),
            ("car", "car-suv", 2, 38.0, 9.0),
            ("truck", "truck-tanker", 3, 48.0, 5.0),
        ],
    ),
    scene("a real car, 35 m", &[("car", "gazebo_prius.glb", 2, 35.0, 8.0)]),
    scene("a real bus, 40 m", &[("bus", "chrono_citybus.glb", 1, 40.0, 7.0)]),
];
/// Accuracies of a quick chart.
const QUICK_DB: [f64; 2] = [-10.0, -20.0];
const ASKED_DB: [f64; 5] = [-5.0, -10.0, -15.0, -20.0, -25.0];

/// Faces a radar 6 m up from 30 m away.
const PLATE: &str = "v 0 -0.5 0.5\nv 0 0.5 0.5\nv -0.2 0.5 1.48\nv -0.2 -0.5 1.48\nf 1 2 3 4\n";
const CORNER: &str = "v 0 0 0.5\nv 0.35 0.35 0.5\nv 0.35 -0.35 0.5\nv 0 0 1\nf 1 2 4\nf 1 4 3\nf 1 3 2\n";

/// Answers of every scene at every accuracy, scene by scene.
pub(super) fn rows(extent: Extent) -> Result<Vec<Answers>, Failure> {
    let folder = tempfile::tempdir().map_err(|e| Failure::System(format!("no temporary folder: {e}")))?;
    for (name, mesh) in [("plate.obj", PLATE), ("corner.obj", CORNER)] {
        files::write_file(&folder.path().join(name), mesh.as_bytes())?;
    }
    let asked = match extent {
        Extent::Quick => &QUICK_DB[..],
        Extent::Full => &ASKED_DB[..],
    };
    let work = Work::begin("whole chain");
    let mut rows = vec![];
    for (number, scene) in SCENES.iter().enumerate() {
        work.at(number, SCENES.len());
        let Some(text) = scene.text(folder.path()) else { continue };
        for asked_db in asked {
            rows.push(answers(scene.name, &text, *asked_db, folder.path())?);
        }
    }
    Ok(rows)
}

impl Scene {
    /// Text of its file; `None` where a file of third parties is not there.
    fn text(&self, folder: &Path) -> Option<String> {
        let mut text = String::from("name = \"chart\"\n[noise]\nnoise_figure_db = 12.0\n");
        for (number, (class, model, lane, y_m, speed_mps)) in self.bodies.iter().enumerate() {
            let model = place_of(model, folder)?;
            let class = if class.is_empty() { String::new() } else { format!("class = \"{class}\"\n") };
            let _ = write!(
                text,
                "[[target]]\nkind = \"mesh\"\nid = \"body-{number}\"\n{class}model = {model:?}\nlane = {lane}\n\
                 y_m = {y_m}\nvelocity_mps = [0.0, -{speed_mps}, 0.0]\n"
            );
        }
        Some(text)
    }
}

/// Model as a scene names it.
fn place_of(model: &str, folder: &Path) -> Option<String> {
    let file = match Path::new(model).extension().and_then(|kind| kind.to_str()) {
        None => return Some(model.to_owned()),
        Some("glb") => shared().join("vehicles").join(model),
        Some(_) => folder.join(model),
    };
    file.exists().then(|| file.display().to_string())
}

fn answers(scene: &'static str, text: &str, asked_db: f64, folder: &Path) -> Result<Answers, Failure> {
    let (file, out) = (folder.join("scene.toml"), folder.join("out"));
    let text = format!("{text}[fidelity]\naccuracy_db = {asked_db}\n");
    std::fs::write(&file, text).map_err(|e| Failure::system(&file, "write", e))?;
    let source = SceneSource { file: file.clone(), ..SceneSource::default() };
    let settings = Settings { scene: source, cache: None, ..Settings::of(&file, &out) };
    let Measured { peak_mib, .. } = measured(|| wayside::run(&settings).map(drop))?;
    let summary = Summary::read(&out.join("summary.json"))?;
    let targets = || summary.frames.iter().flat_map(|frame| &frame.targets).filter(|t| t.found.is_some());
    let probabilities: Vec<f64> = targets()
        .filter(|target| target.estimate.is_some())
        .filter_map(|target| target.probabilities.of_class(target.class?))
        .collect();
    Ok(Answers {
        scene,
        asked_db,
        processor_s: summary.frames_processor_seconds.unwrap_or(summary.frames_seconds),
        peak_mib,
        found: targets().filter(|target| target.found == Some(true)).count(),
        to_be_found: targets().count(),
        errors: root_mean_squares(&targets().filter_map(error).collect::<Vec<_>>()),
        probability: mean(&probabilities),
    })
}

/// Estimate less truth: range, radial velocity, place across the road.
fn error(target: &TargetSummary) -> Option<[f64; 3]> {
    let (estimate, truth) = (target.estimate?, &target.truth);
    Some([
        estimate.range_m - truth.compared_range_m(),
        estimate.radial_velocity_mps - truth.compared_radial_velocity_mps(),
        estimate.x_m - truth.x_m,
    ])
}

fn root_mean_squares(errors: &[[f64; 3]]) -> Option<[f64; 3]> {
    let of = |i: usize| mean(&errors.iter().map(|error| error[i].powi(2)).collect::<Vec<_>>());
    Some([of(0)?.sqrt(), of(1)?.sqrt(), of(2)?.sqrt()])
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_of_own_bodies_is_read() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("plate.obj"), PLATE).unwrap();
        std::fs::write(folder.path().join("corner.obj"), CORNER).unwrap();
        let options = ::scene::ReadOptions { model: None, radar: None, meshes: ::scene::Meshes::NamesOnly };
        for one in &SCENES {
            let Some(text) = one.text(folder.path()) else { continue };
            let file = folder.path().join("scene.toml");
            std::fs::write(&file, text).unwrap();
            let read = ::scene::read(&file, &options).unwrap();
            assert_eq!(read.targets.len(), one.bodies.len(), "{}", one.name);
        }
    }

    #[test]
    fn errors_are_root_mean_squares_over_what_was_found() {
        assert_eq!(root_mean_squares(&[[3.0, 0.0, 1.0], [-3.0, 0.0, -1.0]]), Some([3.0, 0.0, 1.0]));
        assert_eq!(root_mean_squares(&[]), None);
    }
}
