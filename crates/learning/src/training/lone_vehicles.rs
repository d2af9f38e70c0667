//! Classes with a single vehicle for training.

use classifier::Sightings;
use pipeline::host::progress;

/// Notes the classes with a single vehicle for training: when it is held out, its class has no training data,
/// and the model's confidence in it is calibrated to the resulting answers.
pub(crate) fn note_lone_vehicles(sightings: &Sightings) {
    let lone: Vec<String> = sightings
        .lone_vehicles()
        .iter()
        .map(|(class, model)| format!("{} ({model})", class.name()))
        .collect();
    if !lone.is_empty() {
        progress::note(format!(
            "note: one vehicle alone trains as {}: held out, its class is told by chance, and the model is \
             as unsure of it; give each class two or more",
            lone.join(", ")
        ));
    }
}
