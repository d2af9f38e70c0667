//! Files that a scene was read from. What is made of it later is made of the same, or refused.

use std::path::{Path, PathBuf};
use wayside::stepwise::{OpenedScene, inputs, radars};
use wayside::{Failure, SceneSource};

/// Files of a scene as they were when it was read.
pub(crate) struct SourceFiles {
    /// Folder from which relative names were seen.
    folder: Option<PathBuf>,
    /// Names and hashes.
    files: Vec<(String, String)>,
    /// Text of the scene.
    pub(crate) text: String,
    /// Ids of several radars; none where the scene has one.
    pub(crate) radars: Vec<String>,
}

impl SourceFiles {
    /// Keeps what a scene was read from; `opened` is the scene, where it is seen through one radar.
    pub(crate) fn of(source: &SceneSource, opened: Option<&OpenedScene>) -> Result<Self, Failure> {
        let text = std::fs::read_to_string(&source.file);
        Ok(Self {
            folder: std::env::current_dir().ok(),
            files: opened.map_or_else(|| hashes(source), |opened| Ok(opened.files().to_vec()))?,
            text: text.map_err(|error| Failure::system(&source.file, "read", error))?,
            radars: radars(source)?,
        })
    }

    /// The source as it is to be read from the folder that the process is in now.
    pub(crate) fn seen_from_here(&self, source: &SceneSource) -> SceneSource {
        let here = std::env::current_dir().ok();
        let Some(folder) = self.folder.as_ref().filter(|folder| here.as_ref() != Some(folder)) else {
            return source.clone();
        };
        // An own vehicle has a name without an ending, and is no file.
        let of_model = |model: &PathBuf| match model.extension() {
            Some(_) => folder.join(model),
            None => model.clone(),
        };
        SceneSource {
            file: folder.join(&source.file),
            model: source.model.as_ref().map(of_model),
            ..source.clone()
        }
    }

    /// Refuses files that are no longer what they were.
    ///
    /// # Errors
    /// A file has changed, or cannot be read.
    pub(crate) fn check(&self, source: &SceneSource) -> Result<(), Failure> {
        let now = hashes(source)?;
        let is_other = |(was, is): &(&(String, String), &(String, String))| was != is;
        match self.files.iter().zip(&now).find(is_other) {
            Some(((name, _), _)) => Err(changed(Path::new(name))),
            None if self.files.len() != now.len() => Err(changed(&source.file)),
            None => Ok(()),
        }
    }
}

fn changed(file: &Path) -> Failure {
    let rule = "it has changed since the scene was read; read the scene again";
    Failure::Refused(format!("{}: {rule}", file.display()))
}

/// Names and hashes of the files of a scene, through each of several radars.
fn hashes(source: &SceneSource) -> Result<Vec<(String, String)>, Failure> {
    let ids = if source.radar.is_none() { radars(source)? } else { vec![] };
    if ids.is_empty() {
        return inputs(source);
    }
    let of_radar = |id: String| inputs(&SceneSource { radar: Some(id), ..source.clone() });
    Ok(ids.into_iter().map(of_radar).collect::<Result<Vec<_>, _>>()?.concat())
}
