//! The paper's protocol and two beside it: how four images come of each map, and which of them train, are
//! watched, and are kept for the end.
//!
//! The paper makes 1,120 images by augmentation, shuffles them and takes 600, 320 and 200 (section IV-C).
//! Copies of one map then stand on both sides. Dealing maps first, or whole vehicles first, keeps them apart.

use crate::augmentation::{Augmentation, VariationKey, augmented};
use crate::error::TrainingError;
use artifact::dataset::{CropFormat, Split};
use artifact::seed;
use artifact::settings::Class;
use classifier::{Example, Examples};
use rand::{SeedableRng, seq::SliceRandom};
use rand_chacha::ChaCha8Rng;
use std::collections::{BTreeMap, BTreeSet};

/// Things that are parted before the network learns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SplitProtocol {
    /// Images, after maps were augmented: the paper's protocol.
    Images,
    /// Maps, each of which is then augmented on its side.
    Maps,
    /// Vehicles of each class, with all of their maps.
    Vehicles,
}

/// Images that come of a map, itself among them: the paper's 1,120 of 280.
pub const COPIES: u64 = 4;

/// The paper's images.
const ALL: usize = 1120;
/// Images that train, and with them those that are watched meanwhile (the paper's "test set", which
/// chooses the epoch here); the others are its "validation set", which is looked at once.
const TRAINED: usize = 600;
const TRAINED_OR_WATCHED: usize = 920;

/// Way in which copies are made.
pub(crate) struct ImageAugmenter<'a> {
    pub(crate) format: &'a CropFormat,
    pub(crate) augmentation: &'a Augmentation,
    pub(crate) seed: u64,
}

/// The examples of a dataset, augmented and parted anew; which splits they had is not asked.
pub(crate) fn split_examples(
    examples: &Examples,
    augmenter: &ImageAugmenter<'_>,
    deal: SplitProtocol,
) -> Result<Examples, TrainingError> {
    let maps: Vec<(u64, &Example)> = (0..).zip(examples.all()).collect();
    let mut random = ChaCha8Rng::from_seed(seed::key(augmenter.seed, "classifier/deal", &[]));
    let parts = match deal {
        SplitProtocol::Images => shuffled_parts(augmenter.images(&maps), &mut random),
        SplitProtocol::Maps => shuffled_parts(maps, &mut random).map(|part| augmenter.images(&part)),
        SplitProtocol::Vehicles => by_vehicle(&maps, &mut random)?.map(|part| augmenter.images(&part)),
    };
    let splits = [Split::Train, Split::Validation, Split::Test];
    Ok(Examples::from_splits(splits.into_iter().zip(parts).collect()))
}

impl ImageAugmenter<'_> {
    fn images(&self, maps: &[(u64, &Example)]) -> Vec<Example> {
        maps.iter()
            .flat_map(|(map, example)| (0..COPIES).map(|copy| self.image(example, *map, copy)))
            .collect()
    }

    /// The first copy is the map itself.
    fn image(&self, example: &Example, map: u64, copy: u64) -> Example {
        let key = VariationKey { seed: self.seed, example: COPIES * map + copy };
        let pooled = match copy {
            0 => example.pooled.clone(),
            _ => augmented(&example.pooled, self.format, self.augmentation, key),
        };
        Example { pooled, ..example.clone() }
    }
}

/// Parts that were shuffled and cut in the paper's proportions.
fn shuffled_parts<T>(mut all: Vec<T>, random: &mut ChaCha8Rng) -> [Vec<T>; 3] {
    all.shuffle(random);
    let count = all.len();
    let kept = all.split_off(count * TRAINED_OR_WATCHED / ALL);
    let watched = all.split_off(count * TRAINED / ALL);
    [all, watched, kept]
}

/// Parts the maps so that all of a vehicle are on one side, and of every class at least one vehicle on
/// each.
fn by_vehicle<'a>(
    maps: &[(u64, &'a Example)],
    random: &mut ChaCha8Rng,
) -> Result<[Vec<(u64, &'a Example)>; 3], TrainingError> {
    let mut vehicles: BTreeMap<usize, BTreeSet<&str>> = BTreeMap::new();
    for (_, example) in maps {
        vehicles.entry(example.class).or_default().insert(&example.model);
    }
    let mut side: BTreeMap<(usize, &str), usize> = BTreeMap::new();
    for (class, models) in &vehicles {
        let parts = shuffled_parts(models.iter().copied().collect(), random);
        if parts.iter().any(Vec::is_empty) {
            return Err(TrainingError::TooFewVehicles { class: Class::ALL[*class], vehicles: models.len() });
        }
        side.extend(
            (0..).zip(parts).flat_map(|(number, part)| part.into_iter().map(move |m| ((*class, m), number))),
        );
    }
    Ok([0, 1, 2].map(|number| {
        let is_there = |example: &Example| side[&(example.class, example.model.as_str())] == number;
        maps.iter().copied().filter(|(_, example)| is_there(example)).collect()
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FORMAT: CropFormat =
        CropFormat { side: 8, range_span_m: 24.0, velocity_span_mps: 8.0, floor_db: -5.0, ceiling_db: 46.0 };
    const VARIED: Augmentation =
        Augmentation { range_shift_m: 6.0, velocity_shift_mps: 2.0, gain_db: 3.0, noise_db: 1.0 };

    const AUGMENTER: ImageAugmenter<'_> = ImageAugmenter { format: &FORMAT, augmentation: &VARIED, seed: 3 };

    /// 280 maps of five vehicles a class; the first pixel tells the map.
    fn maps() -> Examples {
        let map = |n: usize| {
            let mut pooled: Vec<u8> = (0..64).map(|p| (p * 3 + n % 7) as u8).collect();
            pooled[0] = (n % 256) as u8;
            Example { pooled, class: n % 4, model: format!("{}-{}", n % 4, n / 4 % 5) }
        };
        Examples::from_splits([(Split::Train, (0..280).map(map).collect())].into())
    }

    fn dealt_by(deal: SplitProtocol) -> [Vec<Example>; 3] {
        let all = split_examples(&maps(), &AUGMENTER, deal).unwrap();
        [Split::Train, Split::Validation, Split::Test].map(|split| all.of(split).to_vec())
    }

    #[test]
    fn images_are_as_many_as_the_papers() {
        assert_eq!(dealt_by(SplitProtocol::Images).map(|part| part.len()), [600, 320, 200]);
        assert_eq!(dealt_by(SplitProtocol::Maps).map(|part| part.len()), [600, 320, 200]);
    }

    #[test]
    fn the_papers_protocol_has_copies_of_a_map_on_both_sides_and_dealing_maps_has_none() {
        let unvaried: BTreeSet<Vec<u8>> = maps().all().map(|example| example.pooled.clone()).collect();
        // Maps that are whole in one part: with all of their copies there, among them the map itself.
        let whole =
            |part: &[Example]| part.iter().filter(|example| unvaried.contains(&example.pooled)).count();
        assert_eq!(dealt_by(SplitProtocol::Maps).map(|part| whole(&part)), [150, 80, 50]);
        let of_images = dealt_by(SplitProtocol::Images).map(|part| whole(&part));
        assert_eq!(of_images.iter().sum::<usize>(), 280);
        assert_ne!(of_images, [150, 80, 50]);
    }

    #[test]
    fn vehicles_stay_whole_and_every_part_has_all_classes() {
        let vehicles = dealt_by(SplitProtocol::Vehicles).map(|part| {
            let models: BTreeSet<String> = part.iter().map(|example| example.model.clone()).collect();
            let classes: BTreeSet<usize> = part.iter().map(|example| example.class).collect();
            (models, classes.len())
        });
        assert_eq!(vehicles.iter().map(|(models, _)| models.len()).sum::<usize>(), 20);
        assert!(vehicles.iter().all(|(_, classes)| *classes == 4), "{vehicles:?}");
    }

    #[test]
    fn a_class_of_two_vehicles_is_refused() {
        let examples = maps();
        let few: Vec<Example> =
            examples.all().filter(|e| e.class > 0 || e.model.as_str() < "0-2").cloned().collect();
        let few = Examples::from_splits([(Split::Train, few)].into());
        let refused = split_examples(&few, &AUGMENTER, SplitProtocol::Vehicles).unwrap_err();
        assert!(
            matches!(refused, TrainingError::TooFewVehicles { class: Class::Car, vehicles: 2 }),
            "{refused}"
        );
    }
}
