//! Places of the files of a dataset: shards of the first thousand are in the folder itself, each further
//! thousand in its own folder, so that none holds more than some thousand files for any number of scenes.

use crate::dataset::draws;
use crate::dataset::recipe::Recipe;
use pipeline::host::dataset_folders::lines_file;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Number of shards in one folder, two files each.
const SHARDS_OF_FOLDER: u64 = 1000;

/// Shards of a recipe in their folders.
pub(super) struct Layout {
    folder: PathBuf,
    /// Number of scenes of the recipe.
    pub(super) scenes: u64,
    /// Number of scenes of each shard except the last, which has the rest.
    pub(super) scenes_per_shard: u64,
}

/// A shard: its scenes and its files.
pub(super) struct PlannedShard {
    pub(super) scenes: Range<u64>,
    /// File of signatures and crops.
    pub(super) samples: PathBuf,
    /// File with a line per scene; written after the samples: its presence marks a complete shard.
    pub(super) lines: PathBuf,
    /// Name of the samples' file relative to the dataset's folder.
    pub(super) name: String,
}

impl Layout {
    pub(super) fn of(recipe: &Recipe, folder: &Path) -> Self {
        let scenes_per_shard = u64::from(recipe.document.scenes_per_shard);
        Self { folder: folder.to_owned(), scenes: draws::count(recipe), scenes_per_shard }
    }

    pub(super) fn count(&self) -> u64 {
        self.scenes.div_ceil(self.scenes_per_shard)
    }

    /// Number of folders with shards, including that of the dataset.
    pub(super) fn folders(&self) -> u64 {
        self.count().div_ceil(SHARDS_OF_FOLDER)
    }

    /// Number of entries in the dataset's folder, the fullest: its shards, the other folders and the summary.
    pub(super) fn most_in_folder(&self) -> u64 {
        2 * self.count().min(SHARDS_OF_FOLDER) + self.folders() - 1 + 3
    }

    pub(super) fn all(&self) -> impl Iterator<Item = PlannedShard> {
        (0..self.count()).map(|number| self.shard(number))
    }

    /// Shards of part `number` of `of`, counted from 1: every `of`-th one.
    pub(super) fn part(&self, number: u32, of: u32) -> impl Iterator<Item = PlannedShard> {
        let numbers = (u64::from(number) - 1..self.count()).step_by(of as usize);
        numbers.map(|number| self.shard(number))
    }

    fn shard(&self, number: u64) -> PlannedShard {
        let first = number * self.scenes_per_shard;
        let (samples, name) = self.place(number);
        PlannedShard {
            scenes: first..self.scenes.min(first + self.scenes_per_shard),
            lines: lines_file(&samples),
            samples,
            name,
        }
    }

    /// File of a shard's samples and its name. A folder of earlier versions has all shards side by side;
    /// existing ones stay there.
    fn place(&self, number: u64) -> (PathBuf, String) {
        let flat = format!("shard-{number:04}.dataset");
        let thousand = number - number % SHARDS_OF_FOLDER;
        if thousand == 0 || self.folder.join(&flat).exists() {
            return (self.folder.join(&flat), flat);
        }
        let name = format!("shards-{thousand}/{flat}");
        (self.folder.join(&name), name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_scenes_fill_folders_of_two_thousand_files_each() {
        let folder = tempfile::tempdir().unwrap();
        let shards = Layout { folder: folder.path().to_owned(), scenes: 1_000_000, scenes_per_shard: 64 };
        assert_eq!((shards.count(), shards.folders(), shards.most_in_folder()), (15_625, 16, 2018));
        let mut files = std::collections::BTreeMap::new();
        for shard in shards.all() {
            *files.entry(shard.samples.parent().unwrap().to_owned()).or_insert(0) += 2;
        }
        assert_eq!((files.len(), files.values().max()), (16, Some(&2000)));
        let names: Vec<String> = shards.all().map(|shard| shard.name).collect();
        let some = [0, 999, 1000, 15_624].map(|number: usize| names[number].as_str());
        let expected = [
            "shard-0000.dataset",
            "shard-0999.dataset",
            "shards-1000/shard-1000.dataset",
            "shards-15000/shard-15624.dataset",
        ];
        assert_eq!(some, expected);
    }

    #[test]
    fn parts_have_every_shard_once_and_the_last_one_the_rest_of_the_scenes() {
        let shards = Layout { folder: PathBuf::new(), scenes: 30, scenes_per_shard: 4 };
        let mut scenes: Vec<Range<u64>> =
            (1..=3).flat_map(|part| shards.part(part, 3).map(|shard| shard.scenes)).collect();
        scenes.sort_by_key(|scenes| scenes.start);
        assert_eq!(scenes.len(), 8);
        assert_eq!(scenes.last(), Some(&(28..30)));
        assert!(scenes.into_iter().flatten().eq(0..30));
    }

    #[test]
    fn a_shard_of_a_folder_without_folders_stays_where_it_is() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("shard-1000.dataset"), "").unwrap();
        let shards = Layout { folder: folder.path().to_owned(), scenes: 1002, scenes_per_shard: 1 };
        let names: Vec<String> = shards.all().skip(1000).map(|shard| shard.name).collect();
        assert_eq!(names, ["shard-1000.dataset", "shards-1000/shard-1001.dataset"]);
    }
}
