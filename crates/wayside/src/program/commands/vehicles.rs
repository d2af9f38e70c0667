//! `vehicles`: the project's own vehicles as `.glb`, with their manifest.

use crate::program::cli::VehiclesArguments;
use crate::program::terminal;
use crate::run::leftovers;
use artifact::scene::Mesh;
use pipeline::host::failure::Failure;
use pipeline::host::files::{self, FolderLock};
use pipeline::host::progress::Work;
use serde_json::{Value, json};
use std::path::Path;

/// Largest manifest: some hundred thousand vehicles.
const LIMIT_BYTES: u64 = 256 << 20;

/// Largest file of a vehicle: more than any of this program has.
const MODEL_LIMIT_BYTES: u64 = 64 << 20;

/// Keys of an entry by which a manifest of this program is recognized.
const KEYS: [&str; 4] = ["name", "file", "seed", "triangles"];

/// A vehicle to be written.
struct PlannedVehicle {
    name: &'static str,
    seed: u64,
    file: String,
}

pub(crate) fn run(arguments: &VehiclesArguments) -> Result<(), Failure> {
    let planned = planned(arguments);
    let manifest_place = arguments.out.join("manifest.json");
    let models: Vec<_> = planned.iter().map(|vehicle| arguments.out.join(&vehicle.file)).collect();
    let _writing = FolderLock::acquire(&arguments.out)?;
    files::claim(&[&models[..], std::slice::from_ref(&manifest_place)].concat())?;
    files::refuse_foreign(&manifest_place, LIMIT_BYTES, is_manifest)?;
    models.iter().try_for_each(|place| files::refuse_foreign(place, MODEL_LIMIT_BYTES, is_own_model))?;
    let listed = listed(&manifest_place);
    files::remove_outdated([manifest_place.clone()].into_iter().chain(models))?;
    let work = Work::begin("vehicles");
    let mut manifest = Vec::new();
    for vehicle in &planned {
        work.at(manifest.len(), planned.len());
        let Some(drawn) = scene::vehicles::vehicle(vehicle.name, vehicle.seed) else { continue };
        files::write_file(&arguments.out.join(&vehicle.file), &scene::vehicles::glb(&drawn))?;
        manifest.push(entry(vehicle, &drawn.mesh));
    }
    let text = serde_json::to_string_pretty(&manifest).map_err(Failure::refused)?;
    files::write_file(&manifest_place, text.as_bytes())?;
    terminal::line(format!("{} vehicles in {}", planned.len(), arguments.out.display()));
    let is_left = |file: &String| {
        planned.iter().all(|vehicle| vehicle.file != *file) && arguments.out.join(file).is_file()
    };
    leftovers::note(&arguments.out, listed.into_iter().filter(is_left).collect());
    Ok(())
}

/// Files of the models that a manifest lists; none without a manifest.
fn listed(manifest: &Path) -> Vec<String> {
    let text = files::read_own(manifest, LIMIT_BYTES).unwrap_or_default();
    let entries: Vec<Value> = serde_json::from_slice(&text).unwrap_or_default();
    entries.iter().filter_map(|entry| entry["file"].as_str().map(str::to_owned)).collect()
}

/// Every requested model, in the order of the catalogue, with every seed; with a single seed, files are named
/// by the model alone.
fn planned(arguments: &VehiclesArguments) -> Vec<PlannedVehicle> {
    let is_requested = |name: &&str| arguments.names.is_empty() || arguments.names.contains(name);
    let names: Vec<_> = scene::vehicles::names().into_iter().filter(is_requested).collect();
    let vehicle = |number: u64, name: &'static str| {
        let file = if arguments.count == 1 { format!("{name}.glb") } else { format!("{name}-{number}.glb") };
        PlannedVehicle { name, seed: seed_of(arguments.seed, number), file }
    };
    (0..arguments.count).flat_map(|number| names.iter().map(move |name| vehicle(number, name))).collect()
}

/// Seed of one of several vehicles of a model: the first has the requested seed, and the seeds of the others
/// differ from those of neighbouring requests.
fn seed_of(asked: u64, number: u64) -> u64 {
    match number {
        0 => asked,
        _ => artifact::seed::derived(asked, "vehicles/count", &[number]),
    }
}

/// Whether a text is a manifest of vehicles.
fn is_manifest(text: &[u8]) -> bool {
    let entries: Vec<Value> = serde_json::from_slice(text).unwrap_or_default();
    !entries.is_empty() && entries.iter().all(|entry| KEYS.iter().all(|key| entry.get(key).is_some()))
}

/// Whether a `.glb` was made by this program, according to the generator in its first chunk.
fn is_own_model(bytes: &[u8]) -> bool {
    let length = bytes.get(12..16).and_then(|length| length.try_into().ok()).map(u32::from_le_bytes);
    let chunk = length.and_then(|length| bytes.get(20..)?.get(..length as usize)).unwrap_or_default();
    serde_json::from_slice(chunk).is_ok_and(|document: Value| document["asset"]["generator"] == "wayside")
}

fn entry(vehicle: &PlannedVehicle, mesh: &Mesh) -> Value {
    let PlannedVehicle { name, seed, file } = vehicle;
    let [length_m, width_m, height_m] = mesh.size_m();
    json!({
        "name": name, "class": scene::vehicles::class_of(name).map(|c| c.name()), "file": file, "seed": seed,
        "length_m": length_m, "width_m": width_m, "height_m": height_m,
        "triangles": mesh.triangles.len(), "materials": mesh.materials,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn neighbouring_seeds_have_no_vehicles_in_common() {
        let all = (0..100).flat_map(|asked| (0..100).map(move |number| seed_of(asked, number)));
        assert_eq!(all.collect::<BTreeSet<u64>>().len(), 10_000);
        assert_eq!(seed_of(7, 0), 7, "the first has the seed that was asked for");
    }
}
