//! `vehicles`: the project's own vehicles as `.glb`, with their manifest.

use crate::host::failure::Failure;
use crate::host::files;
use crate::host::progress::Work;
use crate::program::cli::VehiclesArguments;
use crate::program::terminal;
use artifact::scene::Mesh;
use serde_json::{Value, json};

pub(crate) fn run(arguments: &VehiclesArguments) -> Result<(), Failure> {
    let names = scene::vehicles::names();
    let total = names.len() * arguments.count as usize;
    let work = Work::begin("vehicles");
    let mut manifest = Vec::new();
    for number in 0..arguments.count {
        for name in &names {
            work.at(manifest.len(), total);
            let file =
                if arguments.count == 1 { format!("{name}.glb") } else { format!("{name}-{number}.glb") };
            let seed = arguments.seed + number;
            let Some(mesh) = scene::vehicles::mesh(name, seed) else { continue };
            files::write_file(&arguments.out.join(&file), &scene::vehicles::glb(&mesh))?;
            manifest.push(entry(name, &file, seed, &mesh));
        }
    }
    let text = serde_json::to_string_pretty(&manifest).map_err(Failure::refused)?;
    files::write_file(&arguments.out.join("manifest.json"), text.as_bytes())?;
    terminal::line(format!("{total} vehicles in {}", arguments.out.display()));
    Ok(())
}

fn entry(name: &str, file: &str, seed: u64, mesh: &Mesh) -> Value {
    let [length_m, width_m, height_m] = extent_m(mesh);
    json!({
        "name": name, "class": scene::vehicles::class_of(name).map(|c| c.name()), "file": file, "seed": seed,
        "length_m": length_m, "width_m": width_m, "height_m": height_m,
        "triangles": mesh.triangles.len(), "materials": mesh.materials,
    })
}

fn extent_m(mesh: &Mesh) -> [f64; 3] {
    std::array::from_fn(|axis| {
        let along = mesh.vertices_m.iter().map(|v| v[axis]);
        along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
    })
}
