//! Scenes of the study: those of `scenes/`, some frames of traffic, and vehicles as drawn by the recipe
//! `scenes/vehicles.dataset.toml`.

use crate::study::extent::Extent;
use crate::study::pages::whole_runs::scene_files::{text_of, with_key};
use wayside::host::failure::Failure;

/// A scene whose accuracy is yet to be specified.
pub(super) struct Case {
    /// Name of the scene's runs.
    pub(super) name: String,
    /// Name under which its figures are joined with others'.
    pub(super) group: &'static str,
    /// Accuracy of the reference for coarser ones, dB: the finest that memory and minutes allow.
    pub(super) reference_db: f64,
    text: String,
}

/// A vehicle on the approach: class, model, lane, distance along y in metres, speed in m/s.
type DrawnVehicle = (&'static str, &'static str, u8, f64, f64);

/// Two vehicles of each class, drawn once from the ranges of the recipe.
const DRAWN: [DrawnVehicle; 8] = [
    ("car", "car-suv", 3, 33.94, 3.91),
    ("bus", "bus-city", 3, 57.99, 7.53),
    ("truck", "truck-box", 3, 26.02, 4.92),
    ("motorcycle", "motorcycle-street", 1, 47.71, 9.06),
    ("car", "car-sedan", 1, 38.01, 8.75),
    ("bus", "bus-coach", 2, 44.03, 5.95),
    ("truck", "truck-tanker", 1, 50.59, 4.38),
    ("motorcycle", "motorcycle-scooter", 1, 57.07, 7.77),
];

/// Number of frames of a tracked scene; the paths' errors are measured in the first.
const FRAMES: u32 = 10;

/// All scenes; for a quick study a car and a motorcycle.
pub(super) fn cases(extent: Extent) -> Result<Vec<Case>, Failure> {
    let drawn = DRAWN.iter().enumerate().map(|(number, drawn)| alone(number, drawn));
    if extent == Extent::Quick {
        return Ok(drawn.filter(|case| ["draw00", "draw03"].contains(&case.name.as_str())).collect());
    }
    let mut all: Vec<Case> = drawn.collect();
    all.push(of_file("intersection", -20.0, |text| text)?);
    all.push(of_file("traffic", -20.0, |text| text.replace("end_s = 29.9", "end_s = 28.9"))?);
    all.push(of_file("tracking", -30.0, |text| {
        let fewer = with_key(&text, "", "frames", FRAMES);
        with_key(&fewer, "fidelity", "measured_every", FRAMES)
    })?);
    all.push(of_file("four-directions", -20.0, |text| text)?);
    all.push(of_file("street", -20.0, |text| text)?);
    Ok(all)
}

/// A single vehicle before the radar of the crossing.
fn alone(number: usize, (class, model, lane, y_m, speed_mps): &DrawnVehicle) -> Case {
    let text = format!(
        "name = \"draw{number:02}\"\nseed = {number}\n[noise]\nnoise_figure_db = 12.0\n[[target]]\nkind = \"mesh\"\n\
         id = \"v\"\nclass = \"{class}\"\nmodel = \"{model}\"\nlane = {lane}\ny_m = {y_m}\n\
         velocity_mps = [0.0, -{speed_mps}, 0.0]\n"
    );
    // A bus or a truck at −40 dB takes minutes and 6 GiB.
    let reference_db = if ["bus", "truck"].contains(class) { -30.0 } else { -40.0 };
    Case { name: format!("draw{number:02}"), group: "draws of the dataset", reference_db, text }
}

/// A scene file with changes.
fn of_file(
    name: &'static str,
    reference_db: f64,
    change: impl Fn(String) -> String,
) -> Result<Case, Failure> {
    Ok(Case { name: name.to_owned(), group: name, reference_db, text: change(text_of(name)?) })
}

impl Case {
    /// The scene file with a requested accuracy.
    pub(super) fn scene_at(&self, accuracy_db: f64) -> String {
        with_key(&self.text, "fidelity", "accuracy_db", format!("{accuracy_db:.1}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::scenes::scene_of;

    #[test]
    fn every_scene_is_read_with_the_accuracy_asked_for_and_no_other() {
        for case in cases(Extent::Full).unwrap() {
            let text = case.scene_at(-37.0);
            assert_eq!(text.matches("accuracy_db").count(), 1, "{text}");
            if case.name.starts_with("draw") || case.name == "tracking" {
                let named = text.replace("name = ", "# ");
                let header = scene_of(&named).unwrap();
                assert!((header.fidelity.accuracy.db() + 37.0).abs() < 1e-9, "{}", case.name);
            }
        }
    }
}
