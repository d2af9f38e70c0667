//! Faults of a scene, rule by rule, for callers that do not show them as lines.

use pipeline::chain::loading::SceneSource;
use scene::{MeshLoading, Place, ReadOptions, SceneError};
use std::collections::BTreeSet;

/// A broken rule of a scene and its place.
pub struct SceneFault {
    /// Line and column in the scene file, from 1; `None` if the file could not be read at all.
    pub position: Option<[u32; 2]>,
    /// Table, target or material concerned, as named in messages; `None` for the file itself.
    pub place: Option<String>,
    /// Broken rule, in a sentence.
    pub rule: String,
}

/// All faults of a scene file and of the files that it names; empty for a valid scene.
pub fn scene_faults(source: &SceneSource) -> Vec<SceneFault> {
    let (model, radar) = (source.model.clone(), source.radar.clone());
    let options = ReadOptions { model, radar, meshes: MeshLoading::Whole };
    scene::read(&source.file, &options).err().into_iter().flat_map(|errors| errors.0).map(fault).collect()
}

/// Names of the keys of a scene that name files, which are searched beside the scene.
pub fn file_keys() -> BTreeSet<&'static str> {
    scene::keys::TABLES.iter().flat_map(scene::keys::Table::files).collect()
}

fn fault(error: SceneError) -> SceneFault {
    SceneFault {
        position: error.position.map(|at| [at.line, at.column]),
        place: place(&error.place),
        rule: error.rule.to_string(),
    }
}

fn place(place: &Place) -> Option<String> {
    Some(match place {
        Place::Scene => return None,
        Place::Table(name) => format!("[{name}]"),
        Place::Target(id) => format!("target `{id}`"),
        Place::Clutter(id) => format!("clutter `{id}`"),
        Place::Radar(id) => format!("radar `{id}`"),
        Place::Material(name) => format!("material `{name}`"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_that_names_a_file_is_told() {
        let known =
            ["calibration", "fcd", "materials", "model", "net", "openmaterial", "osi", "pattern_file"];
        assert_eq!(file_keys(), BTreeSet::from(known));
    }
}
