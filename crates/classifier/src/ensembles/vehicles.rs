//! Samples as sightings of vehicles: features, class, vehicle and track; with their weights and folds.

use crate::ensembles::boosting::TrainingTable;
use crate::error::ClassifierError;
use crate::signatures::cells::inputs;
use crate::signatures::features::features;
use artifact::ArtifactError;
use artifact::dataset::{Sample, Split};
use artifact::envelope::fingerprint;
use artifact::seed;
use artifact::settings::Class;
use bodies::vehicles::families_of;
use rand::{SeedableRng, seq::SliceRandom};
use rand_chacha::ChaCha8Rng;
use std::collections::{BTreeMap, BTreeSet};

/// Dataset, scene and vehicle in the scene: its frames are one track.
pub type TrackKey = (usize, u64, u32);

/// One sighting.
#[derive(Debug, Clone, PartialEq)]
pub struct Sighting {
    /// Features in the order of [`crate::feature_names`].
    pub features: Vec<f32>,
    /// Inputs of networks over range cells.
    pub cells: Vec<f32>,
    /// Index in [`Class::ALL`].
    pub class: usize,
    /// Vehicle model.
    pub model: String,
    /// Key of the track that the frame belongs to.
    pub track: TrackKey,
    /// Split of its scene.
    pub split: Split,
    /// Whether the array has rows, which measure heights.
    pub has_rows: bool,
}

/// Sightings of one or more datasets.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sightings {
    /// Sightings in reading order.
    pub all: Vec<Sighting>,
    /// Number of ignored samples without a class.
    pub unlabelled: u64,
    ids: BTreeSet<(usize, String)>,
    /// Fingerprint of every sample's signature and truth, with its dataset.
    prints: BTreeMap<String, usize>,
}

impl Sightings {
    /// Adds the samples of dataset number `dataset`; refuses duplicates, also across datasets, whatever else
    /// their shards contain.
    pub fn add(
        &mut self,
        dataset: usize,
        samples: impl Iterator<Item = Result<Sample, ArtifactError>>,
    ) -> Result<(), ClassifierError> {
        for sample in samples {
            let sample = sample?;
            if !self.ids.insert((dataset, sample.id.clone())) {
                return Err(ClassifierError::SampleTwice(sample.id));
            }
            if *self.prints.entry(fingerprint_of(&sample)).or_insert(dataset) != dataset {
                return Err(ClassifierError::SampleInTwoDatasets(sample.id));
            }
            let Some(class) = sample.class.and_then(|class| Class::ALL.iter().position(|c| *c == class))
            else {
                self.unlabelled += 1;
                continue;
            };
            self.all.push(Sighting {
                features: features(&sample.signature).into_iter().map(|(_, value)| value as f32).collect(),
                cells: inputs(&sample.signature),
                class,
                model: sample.model,
                track: (dataset, sample.scene, sample.target),
                split: sample.split,
                has_rows: sample.signature.beams[1].is_some(),
            });
        }
        Ok(())
    }

    /// Refuses sightings that share a sample with these.
    pub fn check_disjoint(&self, others: &Self) -> Result<(), ClassifierError> {
        let shared = others.prints.keys().find(|print| self.prints.contains_key(*print));
        shared.map_or(Ok(()), |print| {
            let name = print.split_once(' ').map_or("", |(_, id)| id);
            Err(ClassifierError::SampleInTwoDatasets(name.to_owned()))
        })
    }

    /// Indices of the sightings of some splits.
    pub fn of(&self, splits: &[Split]) -> Vec<usize> {
        (0..self.all.len()).filter(|i| splits.contains(&self.all[*i].split)).collect()
    }

    /// Sightings with these indices.
    pub fn select(&self, numbers: &[usize]) -> Vec<&Sighting> {
        numbers.iter().map(|i| &self.all[*i]).collect()
    }

    /// Sightings with these indices as a table. Every class has the same weight, within a class every
    /// vehicle, within a vehicle every sighting; the mean is 1.
    pub fn table(&self, numbers: &[usize]) -> TrainingTable {
        let mut of_model: BTreeMap<(usize, &str), f64> = BTreeMap::new();
        for seen in numbers.iter().map(|i| &self.all[*i]) {
            *of_model.entry((seen.class, &seen.model)).or_default() += 1.0;
        }
        let models = |class: usize| of_model.keys().filter(|(c, _)| *c == class).count() as f64;
        let models: [f64; 4] = std::array::from_fn(models);
        let classes = models.iter().filter(|count| **count > 0.0).count() as f64;
        let weight = |seen: &Sighting| {
            let of_vehicle = of_model[&(seen.class, seen.model.as_str())];
            numbers.len() as f64 / (classes * models[seen.class] * of_vehicle)
        };
        let width = numbers.first().map_or(0, |i| self.all[*i].features.len());
        TrainingTable {
            columns: (0..width).map(|f| numbers.iter().map(|i| self.all[*i].features[f]).collect()).collect(),
            classes: numbers.iter().map(|i| self.all[*i].class).collect(),
            weights: numbers.iter().map(|i| weight(&self.all[*i])).collect(),
        }
    }

    /// Folds of every sighting's vehicle: those of a class are distributed evenly, in an order drawn from the
    /// seed. A cross has the folds of both of its families, any other vehicle its own twice.
    pub fn folds(&self, numbers: &[usize], folds: usize, seed: u64) -> Vec<[usize; 2]> {
        let parents =
            |i: &usize| parent_families(&self.all[*i].model).map(|model| (self.all[*i].class, model));
        let models: BTreeSet<(usize, &str)> = numbers.iter().flat_map(parents).collect();
        let mut fold_of = BTreeMap::new();
        for class in 0..Class::ALL.len() {
            let mut own: Vec<_> = models.iter().filter(|(c, _)| *c == class).collect();
            own.shuffle(&mut ChaCha8Rng::from_seed(seed::key(seed, "classifier/folds", &[class as u64])));
            fold_of.extend(own.into_iter().enumerate().map(|(at, model)| (model, at % folds)));
        }
        numbers.iter().map(|i| parents(i).map(|model| fold_of[&model])).collect()
    }

    /// Classes with a single vehicle for training, with its name: none remains when it is held out.
    pub fn lone_vehicles(&self) -> Vec<(Class, &str)> {
        let of_class = |class: usize| {
            let learned = self.all.iter().filter(|seen| seen.class == class && seen.split != Split::Test);
            let models: BTreeSet<&str> = learned.map(|seen| seen.model.as_str()).collect();
            models.first().filter(|_| models.len() == 1).map(|model| (Class::ALL[class], *model))
        };
        (0..Class::ALL.len()).filter_map(of_class).collect()
    }
}

impl Sighting {
    /// Whether the vehicle is a cross between two families, which other vehicles show unmodified.
    pub fn is_cross(&self) -> bool {
        families_of(&self.model).is_some()
    }
}

/// Fingerprint of a sample's signature and truth, followed by a blank and its name: the image comes from the
/// same map, and the split follows from the scene.
fn fingerprint_of(sample: &Sample) -> String {
    let truth = (sample.class, &sample.model, sample.variant, sample.range_m, sample.radial_velocity_mps);
    let place = (sample.seed, sample.scene, sample.target, sample.frame);
    format!("{} {}", fingerprint(&(&sample.signature, truth, place)), sample.id)
}

/// The two families of a cross; for any other vehicle its own twice.
fn parent_families(model: &str) -> [&str; 2] {
    families_of(model).unwrap_or([model, model])
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::signature::Signature;

    fn seen(model: &str) -> Sighting {
        let model = model.to_owned();
        Sighting {
            features: vec![],
            cells: vec![],
            class: 0,
            model,
            track: (0, 0, 0),
            split: Split::Train,
            has_rows: false,
        }
    }

    #[test]
    fn a_sample_of_another_dataset_is_refused_whatever_its_split_and_one_of_another_scene_is_not() {
        let sample = |scene: u64| Sample {
            id: format!("scene-{scene}"),
            signature: Signature::default(),
            crop: None,
            class: Some(Class::Car),
            model: "car-kei".into(),
            variant: 0,
            scene,
            target: 0,
            frame: 0,
            split: if scene == 1 { Split::Test } else { Split::Train },
            range_m: 40.0,
            radial_velocity_mps: 0.0,
            lane: None,
            seed: 1,
        };
        let mut first = Sightings::default();
        first.add(0, [sample(0), sample(1)].map(Ok).into_iter()).unwrap();
        let again = Sample { split: Split::Validation, lane: Some(1), ..sample(1) };
        let refused = first.clone().add(1, [Ok(again.clone())].into_iter()).unwrap_err();
        assert_eq!(
            refused.to_string(),
            "sample `scene-1` is in another of the folders too; each is taken once"
        );
        let (mut same, mut other) = (Sightings::default(), Sightings::default());
        same.add(0, [Ok(again)].into_iter()).unwrap();
        other.add(0, [Ok(sample(2))].into_iter()).unwrap();
        assert!(first.check_disjoint(&same).is_err() && first.check_disjoint(&other).is_ok());
        assert!(first.add(1, [Ok(sample(2))].into_iter()).is_ok());
    }

    #[test]
    fn a_cross_is_in_the_folds_of_both_families_and_a_vehicle_in_its_own() {
        let models = ["car-kei", "car-van", "car-taxi", "car-mpv", "car-kei+van", "car-van+taxi", "other"];
        let all = models.map(seen).to_vec();
        let sightings = Sightings { all, ..Sightings::default() };
        let folds = sightings.folds(&[0, 1, 2, 3, 4, 5, 6], 5, 1);
        assert_eq!(folds[4], [folds[0][0], folds[1][0]]);
        assert_eq!(folds[5], [folds[1][0], folds[2][0]]);
        assert!([0, 1, 2, 3, 6].iter().all(|i| folds[*i][0] == folds[*i][1]), "{folds:?}");
        assert_eq!(folds.iter().map(|f| f[0]).collect::<BTreeSet<_>>().len(), 5);
        assert!(sightings.all[4].is_cross() && !sightings.all[6].is_cross());
    }

    #[test]
    fn a_vehicle_that_is_alone_in_its_class_is_told() {
        let mut all = ["car-kei", "car-van", "car-kei", "bus-city"].map(seen).to_vec();
        all[3].class = 1;
        let mut sightings = Sightings { all, ..Sightings::default() };
        assert_eq!(sightings.lone_vehicles(), [(Class::Bus, "bus-city")]);
        sightings.all[1].split = Split::Test;
        assert_eq!(sightings.lone_vehicles(), [(Class::Car, "car-kei"), (Class::Bus, "bus-city")]);
    }
}
