//! Artifacts under names that nobody typed: those of their own kind are replaced, all else is refused.

use artifact::{ArtifactError, Fault, Reader, Schema};
use pipeline::host::failure::Failure;
use pipeline::host::files;
use std::path::Path;

/// Refuses, before the work, to replace a file that is no artifact, or one of another kind. A damaged
/// artifact of this kind and an empty file are replaced.
pub(crate) fn refuse_other_artifact<S: Schema>(place: &Path) -> Result<(), Failure> {
    files::refuse_no_artifact(place)?;
    let rule = format!("is no `{}` artifact, and would be replaced", S::NAME);
    files::refuse_unless(place, &rule, || is_of_kind::<S>(place))
}

/// Whether an artifact is of this kind, as far as it can be read.
fn is_of_kind<S: Schema>(place: &Path) -> bool {
    let opened = Reader::<S>::open_own(place).map(drop);
    !matches!(opened, Err(ArtifactError { fault: Fault::Schema { .. }, .. }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::classes::{Classes, ClassesHeader};
    use artifact::model::Model;
    use artifact::{Provenance, Writer};

    #[test]
    fn artifacts_of_another_kind_and_other_files_stay_and_damaged_ones_of_this_kind_do_not() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("weights.model");
        let header = ClassesHeader { classes: vec![] };
        Writer::<Classes>::create(&place, &Provenance::default(), &header).unwrap().finish().unwrap();
        assert!(refuse_other_artifact::<Classes>(&place).is_ok());
        let refused = refuse_other_artifact::<Model>(&place).unwrap_err();
        assert!(refused.to_string().contains("weights.model: is no `model` artifact"), "{refused}");
        assert!(matches!(refused, Failure::System(_)), "exit code 2");
        let whole = std::fs::read(&place).unwrap();
        std::fs::write(&place, &whole[..20]).unwrap();
        assert!(refuse_other_artifact::<Model>(&place).is_ok(), "nothing tells its kind");
        std::fs::write(&place, "mine").unwrap();
        let refused = refuse_other_artifact::<Model>(&place).unwrap_err().to_string();
        assert!(refused.contains("was not written by this program"), "{refused}");
        std::fs::write(&place, "").unwrap();
        assert!(refuse_other_artifact::<Model>(&place).is_ok());
    }
}

#[cfg(test)]
mod temporary {
    use artifact::dataset::Dataset;
    use artifact::{Reader, Schema, inputs, read_preamble};
    use pipeline::host::dataset_folders::DatasetFolder;
    use pipeline::host::failure::Failure;
    use std::path::{Path, PathBuf};
    /// Replaces each folder by the datasets in it.
    ///
    /// # Errors
    /// Those of [`DatasetFolder::open_all`]; a dataset that is named twice, alone or beside its folder.
    fn expanded(places: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
        let (folders, files): (Vec<PathBuf>, Vec<PathBuf>) =
            places.iter().cloned().partition(|place| place.is_dir());
        let opened = DatasetFolder::open_all(&folders)?;
        check_named_once(opened.iter().flat_map(|folder| &folder.shards).collect(), &files)?;
        let mut shards = opened.into_iter().map(|folder| folder.shards);
        let files_of = |place: &PathBuf| match folders.contains(place) {
            true => shards.next().unwrap_or_default(),
            false => vec![place.clone()],
        };
        Ok(places.iter().flat_map(files_of).collect())
    }

    /// Refuses a file of a dataset with the bytes of one that is `known`, or of another file.
    fn check_named_once<'a>(mut known: Vec<&'a PathBuf>, files: &'a [PathBuf]) -> Result<(), Failure> {
        for file in files.iter().filter(|file| has_samples(file)) {
            for other in &known {
                if has_same_bytes(file, other)? {
                    let (one, other) = (file.display(), other.display());
                    return Err(Failure::System(format!(
                        "{one}: has the samples of {other}; each is taken once"
                    )));
                }
            }
            known.push(file);
        }
        Ok(())
    }

    /// Whether a file is a dataset with samples; what cannot be opened is refused in its turn.
    fn has_samples(file: &Path) -> bool {
        let is_dataset = read_preamble(file).is_ok_and(|preamble| preamble.schema == Dataset::NAME);
        is_dataset && Reader::<Dataset>::open(file).is_ok_and(|reader| reader.frames() > 0)
    }

    /// Whether two files have the same bytes; only files of one length are read.
    fn has_same_bytes(one: &Path, other: &Path) -> Result<bool, Failure> {
        let unread = |file: &Path, error: std::io::Error| Failure::system(file, "read", error);
        let length =
            |file: &Path| std::fs::metadata(file).map(|about| about.len()).map_err(|e| unread(file, e));
        let hash = |file: &Path| inputs::named_hash(file).map(|(_, hash)| hash).map_err(|e| unread(file, e));
        Ok(length(one)? == length(other)? && hash(one)? == hash(other)?)
    }

    #[test]
    fn temporary() {
        let place = |name: &str| PathBuf::from("/tmp/me/w/learning").join(name);
        let run = |names: &[&str]| expanded(&names.iter().map(|n| place(n)).collect::<Vec<_>>());
        println!("TEMP {:?}", run(&["d", "d2"]));
        println!("TEMP {:?}", run(&["d2/shard-0000.dataset", "d"]));
        println!("TEMP {:?}", run(&["d", "d"]));
        println!("TEMP {:?}", run(&["d/shard-0000.dataset", "d"]));
        println!("TEMP {:?}", run(&["d/shard-0000.dataset", "d/shard-0000.dataset"]));
        println!("TEMP {:?}", run(&["base.toml", "base.toml"]));
    }
}

#[cfg(test)]
mod temporary_removal {
    use artifact::atomic_file::{self, Durability};
    use artifact::{ArtifactError, Fault};
    use pipeline::host::failure::Failure as TrainingError;
    use std::path::Path;
    /// Removes a file of an earlier training; a symbolic link stays, and its target is emptied.
    fn remove_outdated(place: &Path) -> Result<(), TrainingError> {
        // The writer reports a place that cannot be replaced.
        if !place.is_file() {
            return Ok(());
        }
        atomic_file::check(place)?;
        if place.is_symlink() {
            return Ok(atomic_file::write(place, b"", Durability::OnDisk)?);
        }
        let fault = |cause| Fault::System { doing: "remove", cause };
        Ok(std::fs::remove_file(place)
            .map_err(|cause| ArtifactError { file: place.to_owned(), fault: fault(cause) })?)
    }

    #[test]
    fn temporary_removal() {
        let folder = tempfile::tempdir().unwrap();
        let [file, link, target] = ["a", "b", "c"].map(|name| folder.path().join(name));
        std::fs::write(&file, "x").unwrap();
        std::fs::write(&target, "x").unwrap();
        std::os::unix::fs::symlink(&target, &link).unwrap();
        [&file, &link, &folder.path().join("none")].iter().for_each(|place| remove_outdated(place).unwrap());
        assert!(!file.exists() && link.is_symlink() && std::fs::read(&target).unwrap().is_empty());
    }
}
