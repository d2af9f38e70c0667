//! Origins of artifacts that are used together, by the files that their provenance names.

use crate::host::failure::Failure;
use crate::host::progress;
use artifact::Provenance;
use artifact::radar::Radar;
use artifact::scene::SceneHeader;
use std::collections::BTreeSet;
use std::path::Path;

/// Refuses two lists of files, names with hashes, of which one name stands for two contents.
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

/// Whether what is read beside a scene, the frames or tracks that `named` names, was made of the very scene file that it was
/// made of; where that is not so, it is noted that bodies may be others.
///
/// # Errors
/// The scene was made of another file of the same name.
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

/// Refuses what was seen by a radar in another place, or that looks elsewhere, than the scene's; of what
/// other programs made no radar may be known.
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

/// Ids of a scene's targets and of every vehicle that is in view in some frame.
pub fn body_ids(scene: &SceneHeader) -> impl Iterator<Item = &String> {
    let vehicles = scene.traffic.iter().flat_map(|traffic| &traffic.vehicles).map(|vehicle| &vehicle.id);
    scene.targets.iter().map(|target| &target.id).chain(vehicles)
}

/// Refuses a scene that lacks a body which the frames beside it name.
pub fn has_bodies(file: &Path, scene: &SceneHeader, named: &[String]) -> Result<(), Failure> {
    let own: BTreeSet<&String> = body_ids(scene).collect();
    named.iter().find(|id| !own.contains(id)).map_or(Ok(()), |id| {
        let rule = format!("has no body `{id}`, which the frames beside it are of: it is another scene");
        Err(Failure::Refused(format!("{}: {rule}", file.display())))
    })
}

/// Refuses paths that were traced of other bodies than a scene's, or of the same in another order.
pub fn are_of_bodies(file: &Path, scene: &SceneHeader, named: &[String]) -> Result<(), Failure> {
    let own: Vec<&String> = body_ids(scene).collect();
    let other = (0..own.len().max(named.len())).find(|i| own.get(*i).copied() != named.get(*i));
    other.map_or(Ok(()), |i| {
        let told = |id: Option<&String>| id.map_or("none".to_owned(), |id| format!("`{id}`"));
        let (theirs, own) = (told(named.get(i)), told(own.get(i).copied()));
        let rule = format!("its body {i} is {theirs}, the scene's is {own}: it is of another scene");
        Err(Failure::Refused(format!("{}: {rule}", file.display())))
    })
}
