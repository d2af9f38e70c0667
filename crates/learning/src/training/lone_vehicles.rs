//! Classes of which a single vehicle trains.

use classifier::Sightings;
use pipeline::host::progress;

/// Notes the classes of which a single vehicle trains: held out, nothing of its class is learned from, and
/// the model is made as unsure of it as what is told then.
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
