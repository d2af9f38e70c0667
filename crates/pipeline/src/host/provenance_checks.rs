//! Checks that artifacts used together have the same origin, by the files that their provenance names.

use crate::host::failure::Failure;
use crate::host::progress;
use artifact::Provenance;
use artifact::envelope::fingerprint;
use artifact::radar::Radar;
use artifact::scene::{Mesh, Pose, SceneHeader, TargetKind};
use artifact::settings::Fidelity;
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;
use std::path::Path;

/// Refuses two lists of files, names with hashes, in which one name has two contents.
pub fn same_files(files: &[(String, String)], of_other: &[(String, String)]) -> Result<(), Failure> {
    let changed = files.iter().find(|(name, _)| {
        let hashes = |files: &[(String, String)]| -> Vec<String> {
            files.iter().filter(|(other, _)| other == name).map(|(_, hash)| hash.clone()).collect()
        };
        let (own, theirs) = (hashes(files), hashes(of_other));
        !theirs.is_empty() && !own.iter().any(|hash| theirs.contains(hash))
    });
    changed.map_or(Ok(()), |(name, _)| {
        Err(Failure::refused(format!("was made of another `{name}`, or before that was changed")))
    })
}

/// Whether a scene and an artifact read beside it (frames or tracks, as `named` says) were made from the same
/// scene file; if not, notes that bodies may differ.
///
/// # Errors
/// The scene was made from another file of the same name.
pub fn same_scene(
    file: &Path,
    scene: &Provenance,
    (named, beside): (&str, &Provenance),
) -> Result<bool, Failure> {
    same_files(&scene.inputs, &beside.inputs).map_err(|failure| failure.about(file))?;
    let Some(own) = scene.inputs.first() else { return Ok(false) };
    let is_same = beside.inputs.contains(own);
    if let (false, Some((theirs, _))) = (is_same, beside.inputs.first()) {
        let (file, own) = (file.display(), &own.0);
        progress::note(format!(
            "note: {file}: was made of {own}, the {named} of {theirs}; that bodies are the same is not known"
        ));
    }
    Ok(is_same)
}

/// Refuses an artifact of a radar with another position or orientation than the scene's; artifacts of other
/// programs may name no radar.
pub fn same_radar(file: &Path, scene: &Radar, seen_by: Option<&Radar>) -> Result<(), Failure> {
    let stand = |radar: &Radar| {
        (radar.position_m, [radar.boresight_az_rad, radar.boresight_el_rad].map(f64::to_degrees))
    };
    let Some((theirs, own)) = seen_by.map(|radar| (stand(radar), stand(scene))).filter(|(a, b)| a != b)
    else {
        return Ok(());
    };
    let told = |(place_m, [az_deg, el_deg]): ([f64; 3], [f64; 2])| {
        format!("at {place_m:?} m, boresight {az_deg:.3}°, {el_deg:.3}°")
    };
    let rule = format!("its radar is {}, the scene's {}", told(theirs), told(own));
    Err(Failure::Refused(format!("{}: {rule}: it is of another radar or scene", file.display())))
}

/// Refuses a scene that lacks a body named by the frames beside it.
pub fn has_bodies(file: &Path, scene: &SceneHeader, named: &[String]) -> Result<(), Failure> {
    let own: BTreeSet<&String> = scene.bodies().map(|(id, _)| id).collect();
    named.iter().find(|id| !own.contains(id)).map_or(Ok(()), |id| {
        let rule = format!("has no body `{id}`, which the frames beside it are of: it is another scene");
        Err(Failure::Refused(format!("{}: {rule}", file.display())))
    })
}

/// Refuses paths that were traced for other bodies than a scene's, or in another order.
pub fn are_of_bodies(file: &Path, scene: &SceneHeader, named: &[String]) -> Result<(), Failure> {
    let own: Vec<&String> = scene.bodies().map(|(id, _)| id).collect();
    let other = (0..own.len().max(named.len())).find(|i| own.get(*i).copied() != named.get(*i));
    other.map_or(Ok(()), |i| {
        let told = |id: Option<&String>| id.map_or("none".to_owned(), |id| format!("`{id}`"));
        let (theirs, own) = (told(named.get(i)), told(own.get(i).copied()));
        let rule = format!("its body {i} is {theirs}, the scene's is {own}: it is of another scene");
        Err(Failure::Refused(format!("{}: {rule}", file.display())))
    })
}

/// Largest description of bodies in provenance, of the 1 MiB allowed for all of it, bytes; a longer one is
/// replaced by its hash.
const MOST_TOLD_BYTES: usize = 512 << 10;

/// Bodies and road of a scene as far as paths depend on them, in the keys of a scene file: for the provenance
/// of paths.
pub fn describe_bodies(scene: &SceneHeader) -> Value {
    let meshes: Vec<String> = scene.meshes.iter().map(mesh_hash).collect();
    let bodies = scene.bodies().zip(scene.first_poses()).map(|((id, kind), pose)| {
        let told =
            [json!({ "id": id }), describe_kind(kind, &meshes), pose.map_or(Value::Null, describe_pose)];
        let entries = told.into_iter().filter_map(|part| part.as_object().cloned()).flatten();
        Value::Object(entries.collect::<Map<_, _>>())
    });
    let bodies = Value::Array(bodies.collect());
    let text = bodies.to_string();
    let bodies = if text.len() > MOST_TOLD_BYTES { fingerprint(&text).into() } else { bodies };
    json!({ "bodies": bodies, "road": scene.road })
}

/// Hash of a mesh with its materials, without their names; transmission is left out, because it is no
/// property of the body and may be planned.
fn mesh_hash(mesh: &Mesh) -> String {
    let surface = (&mesh.vertices_m, &mesh.normals, &mesh.triangles, &mesh.material_of_triangle);
    fingerprint(&(surface, &mesh.makeup.materials, &mesh.wheels)).chars().take(16).collect()
}

fn describe_kind(kind: &TargetKind, meshes: &[String]) -> Value {
    match kind {
        TargetKind::Mesh { model, mesh, .. } => {
            json!({ "model": model, "mesh_and_materials_hash": meshes.get(*mesh as usize) })
        }
        TargetKind::Point { rcs_m2, wheel } => json!({ "rcs_m2": rcs_m2, "wheel": wheel }),
    }
}

fn describe_pose(pose: Pose) -> Value {
    json!({
        "position_m": pose.position_m,
        "velocity_mps": pose.velocity_mps,
        "acceleration_mps2": pose.acceleration_mps2,
        "yaw_deg": pose.yaw_rad.to_degrees(),
        "yaw_rate_dps": pose.yaw_radps.to_degrees(),
    })
}

/// Refuses paths traced for bodies that differ from the scene's, by body, key and both values; paths of
/// earlier versions do not describe bodies.
pub fn are_of_same_bodies(scene: &SceneHeader, of_paths: &Provenance) -> Result<(), Failure> {
    let settings: Value = serde_json::from_str(&of_paths.settings).unwrap_or_default();
    let (theirs, own) = (&settings[2], describe_bodies(scene));
    let other = if theirs.is_null() { None } else { difference(theirs, &own) };
    other.map_or(Ok(()), |other| Err(Failure::refused(format!("traced of another scene: {other}"))))
}

/// Refuses paths whose physics contradicts the scene's file, by key and both values; returns sentences about
/// differences from the scene's defaults or plan, because paths may be those of a plan. Paths of earlier
/// versions may lack the information.
///
/// # Errors
/// A `[fidelity]` key in the file differs from that of the paths.
pub fn of_same_physics(
    scene: &SceneHeader,
    said: &BTreeSet<String>,
    of_paths: &Provenance,
) -> Result<Vec<String>, Failure> {
    let settings: Value = serde_json::from_str(&of_paths.settings).unwrap_or_default();
    let Ok(theirs) = serde_json::from_value::<Fidelity>(settings[0].clone()) else { return Ok(vec![]) };
    let [theirs, own] = [&theirs, &scene.fidelity].map(scene::physics_settings);
    let others = || theirs.iter().zip(&own).filter(|(theirs, own)| theirs != own);
    if let Some(((key, theirs), (_, own))) = others().find(|((key, _), _)| said.contains(*key)) {
        let rule = format!("traced with {key} = {theirs}, [fidelity] of the scene has {own}");
        return Err(Failure::refused(rule));
    }
    let told = |((key, theirs), (_, own)): (&(&str, String), &(&str, String))| {
        format!(
            "note: the paths were traced with {key} = {theirs}, where the scene takes {own}: the cube is theirs"
        )
    };
    Ok(others().map(told).collect())
}

/// The first difference between two scenes' bodies and roads, in words. A road that only one of them has may
/// have been planned.
fn difference(theirs: &Value, own: &Value) -> Option<String> {
    let list = |told: &Value| told["bodies"].as_array().cloned().unwrap_or_default();
    let (road, own_road) = (&theirs["road"], &own["road"]);
    if theirs["bodies"] == own["bodies"] {
        let is_other = !road.is_null() && !own_road.is_null() && road != own_road;
        return is_other.then(|| values("[road]", road, own_road));
    }
    let Some((theirs, own)) = list(theirs).into_iter().zip(list(own)).find(|(theirs, own)| theirs != own)
    else {
        return Some("other bodies, or the same elsewhere".into());
    };
    let entries = [&theirs, &own].into_iter().filter_map(Value::as_object);
    let differs = entries.flat_map(Map::keys).find(|key| theirs[key.as_str()] != own[key.as_str()])?;
    let id = own["id"].as_str().unwrap_or_default();
    Some(format!("`{id}`: {}", values(differs, &theirs[differs], &own[differs])))
}

fn values(key: &str, theirs: &Value, own: &Value) -> String {
    format!("{key} was {theirs}, the scene's is {own}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::material::{Material, Road};
    use artifact::scene::{Role, Target};

    /// A scene of so many points, and the provenance of its paths.
    fn of_points(count: usize) -> (SceneHeader, Provenance) {
        let options = scene::ReadOptions::names_only();
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/intersection.toml");
        let read = scene::read(&file, &options).unwrap();
        let start = read.targets[0].start;
        let kind = || TargetKind::Point { rcs_m2: 1.0, wheel: None };
        let point = |i: usize| Target { id: format!("p{i}"), role: Role::Target, kind: kind(), start };
        let header = SceneHeader { targets: (0..count).map(point).collect(), ..read };
        let settings = json!([null, null, describe_bodies(&header)]).to_string();
        let (stage, inputs) = ("bart_rcs".into(), vec![]);
        (header, Provenance { stage, program_version: "0".into(), inputs, settings, seed: 0 })
    }

    #[test]
    fn bodies_are_compared_however_many_there_are_and_provenance_holds_what_is_told() {
        for (count, said) in [(20, "`p7`: yaw_deg was "), (20_000, "other bodies")] {
            let (mut header, from) = of_points(count);
            assert!(from.settings.len() < 1 << 20, "{} bytes", from.settings.len());
            are_of_same_bodies(&header, &from).unwrap();
            header.targets[7].start.yaw_rad += 0.1;
            let refused = are_of_same_bodies(&header, &from).unwrap_err().to_string();
            assert!(refused.contains(said), "{refused}");
        }
    }

    #[test]
    fn another_road_is_another_scene_and_one_that_was_planned_is_not() {
        let (header, from) = of_points(1);
        let road = |rms_height_m| Road { material: Material::Conductor, rms_height_m };
        let over = |road| SceneHeader { road: Some(road), ..header.clone() };
        are_of_same_bodies(&over(road(1e-3)), &from).unwrap();
        let settings = json!([null, null, describe_bodies(&over(road(1e-3)))]).to_string();
        let from = Provenance { settings, ..from };
        are_of_same_bodies(&header, &from).unwrap();
        are_of_same_bodies(&over(road(1e-3)), &from).unwrap();
        let refused = are_of_same_bodies(&over(road(2e-3)), &from).unwrap_err().to_string();
        assert!(refused.contains("[road] was {"), "{refused}");
    }
}
