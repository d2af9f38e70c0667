//! A dataset at the network's resolution: 16 KiB per sample at side 128, so that 10⁵ samples fit in 1.6 GB.

use crate::crops::classify::pooled_crop;
use crate::crops::layout::Layout;
use crate::error::ClassifierError;
use artifact::dataset::{Crop, CropFormat, Dataset, Sample, Split};
use artifact::settings::Class;
use artifact::{ArtifactError, Reader};
use std::collections::{BTreeMap, BTreeSet};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

/// The common format of the crops of some shards; `None` without a shard.
///
/// # Errors
/// A shard is unreadable, or differs from the first.
pub fn format_of(shards: &[PathBuf]) -> Result<Option<CropFormat>, ClassifierError> {
    let Some((first, others)) = shards.split_first() else { return Ok(None) };
    let format = *Reader::<Dataset>::open(first)?.header();
    for shard in others {
        if *Reader::<Dataset>::open(shard)?.header() != format {
            return Err(ClassifierError::ShardFormat { shard: shard.clone(), first: first.clone() });
        }
    }
    Ok(Some(format))
}

/// Samples of a shard, one by one; if it cannot be opened, its error replaces them.
pub fn samples_of(shard: &Path) -> Box<dyn Iterator<Item = Result<Sample, ArtifactError>>> {
    match Reader::<Dataset>::open(shard) {
        Ok(reader) => Box::new(reader),
        Err(error) => Box::new(std::iter::once(Err(error))),
    }
}

/// A labelled crop.
#[derive(Debug, Clone, PartialEq)]
pub struct Example {
    /// Grey levels `[input_side, input_side]`.
    pub pooled: Vec<u8>,
    /// Index in [`Class::ALL`].
    pub class: usize,
    /// Vehicle in the crop.
    pub model: String,
}

impl AsRef<[u8]> for Example {
    fn as_ref(&self) -> &[u8] {
        &self.pooled
    }
}

/// Labelled crops by split, in reading order.
#[derive(Debug, Default)]
pub struct Examples {
    splits: BTreeMap<Split, Vec<Example>>,
    /// Number of samples without a class, usable neither for training nor for testing.
    pub unlabelled: u64,
}

impl Examples {
    /// Reads samples one by one; refuses a scene or an image in two splits and a duplicate sample.
    pub fn read(
        samples: impl Iterator<Item = Result<Sample, ArtifactError>>,
        layout: &Layout,
    ) -> Result<Self, ClassifierError> {
        let mut examples = Self::default();
        let mut partition = Partition::default();
        for (index, sample) in samples.enumerate() {
            let sample = sample?;
            let crop = sample.crop.as_ref().ok_or(ClassifierError::NoCrop { index })?;
            partition.add(&sample, crop)?;
            let pooled = pooled_crop(crop, layout, index)?;
            match sample.class.and_then(index_of) {
                None => examples.unlabelled += 1,
                Some(class) => {
                    let example = Example { pooled, class, model: sample.model };
                    examples.splits.entry(sample.split).or_default().push(example);
                }
            }
        }
        Ok(examples)
    }

    /// Examples with splits other than a dataset's.
    pub fn from_splits(splits: BTreeMap<Split, Vec<Example>>) -> Self {
        Self { splits, unlabelled: 0 }
    }

    /// Examples of all splits, one after the other.
    pub fn all(&self) -> impl Iterator<Item = &Example> {
        self.splits.values().flatten()
    }

    /// The examples of a split; possibly none.
    pub fn of(&self, split: Split) -> &[Example] {
        self.splits.get(&split).map_or(&[], Vec::as_slice)
    }
}

/// Partition of a dataset: the split of each scene and image, and the samples so far.
#[derive(Debug, Default)]
struct Partition {
    split_of_scene: BTreeMap<u64, Split>,
    /// First sample of each image, by the hash of the pixels: two of 10⁵ different images share one with a
    /// probability of 3e-10.
    first_of_image: BTreeMap<u64, (Split, String)>,
    ids: BTreeSet<String>,
}

impl Partition {
    fn add(&mut self, sample: &Sample, crop: &Crop) -> Result<(), ClassifierError> {
        let first = *self.split_of_scene.entry(sample.scene).or_insert(sample.split);
        if first != sample.split {
            return Err(ClassifierError::SceneInTwoSplits {
                scene: sample.scene,
                first,
                second: sample.split,
            });
        }
        if !self.ids.insert(sample.id.clone()) {
            return Err(ClassifierError::SampleTwice(sample.id.clone()));
        }
        let image = (sample.split, sample.id.clone());
        match self.first_of_image.entry(hash_of(&crop.pixels)).or_insert(image) {
            (split, _) if *split == sample.split => Ok(()),
            (_, first) => {
                Err(ClassifierError::CropInTwoSplits { first: first.clone(), second: sample.id.clone() })
            }
        }
    }
}

fn hash_of(pixels: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    pixels.hash(&mut hasher);
    hasher.finish()
}

fn index_of(class: Class) -> Option<usize> {
    Class::ALL.iter().position(|c| *c == class)
}
