//! Scenes of the chart, from one plate to a queue.

use crate::project::shared;
use std::fmt::Write as _;
use std::path::Path;
use wayside::host::failure::Failure;
use wayside::host::files;

/// A body of a scene: class, model, lane, place along the road and speed.
type Body = (&'static str, &'static str, u8, f64, f64);

/// A scene of approaching bodies.
pub(super) struct Scene {
    pub(super) name: &'static str,
    pub(super) bodies: &'static [Body],
}

const fn scene(name: &'static str, bodies: &'static [Body]) -> Scene {
    Scene { name, bodies }
}

/// Scenes from one plate to a queue; models with a point in their names are files.
pub(super) const SCENES: [Scene; 12] = [
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

/// A plate that faces a radar 6 m up, 30 m away.
const PLATE: &str = "v 0 -0.5 0.5\nv 0 0.5 0.5\nv -0.2 0.5 1.48\nv -0.2 -0.5 1.48\nf 1 2 3 4\n";
const CORNER: &str = "v 0 0 0.5\nv 0.35 0.35 0.5\nv 0.35 -0.35 0.5\nv 0 0 1\nf 1 2 4\nf 1 4 3\nf 1 3 2\n";

/// A folder with the chart's own bodies.
pub(super) fn folder_of_bodies() -> Result<tempfile::TempDir, Failure> {
    let folder = tempfile::tempdir().map_err(|e| Failure::System(format!("no temporary folder: {e}")))?;
    for (name, mesh) in [("plate.obj", PLATE), ("corner.obj", CORNER)] {
        files::write_file(&folder.path().join(name), mesh.as_bytes())?;
    }
    Ok(folder)
}

impl Scene {
    /// Targets of its file; `None` if a third-party file is missing.
    pub(super) fn targets(&self, folder: &Path) -> Option<String> {
        let mut text = String::new();
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

/// Model as named in a scene.
fn place_of(model: &str, folder: &Path) -> Option<String> {
    let file = match Path::new(model).extension().and_then(|kind| kind.to_str()) {
        None => return Some(model.to_owned()),
        Some("glb") => shared().join("vehicles").join(model),
        Some(_) => folder.join(model),
    };
    file.exists().then(|| file.display().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::scenes::scene_of;

    #[test]
    fn every_scene_of_own_bodies_is_read() {
        let folder = folder_of_bodies().unwrap();
        for one in &SCENES {
            let Some(text) = one.targets(folder.path()) else { continue };
            assert_eq!(scene_of(&text).unwrap().targets.len(), one.bodies.len(), "{}", one.name);
        }
    }
}
