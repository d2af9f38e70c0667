//! Designs of a study: every combination of its varied values, or a drawn sample of them.

use crate::study::axis::{Axis, AxisChoice};
use crate::study::document::Study;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use scene::Change;

/// All designs, each a choice for every axis of `vary`. A drawn one is a function of the seed and its number:
/// a larger sample begins with the smaller one.
pub(crate) fn designs(study: &Study) -> Vec<Vec<AxisChoice>> {
    match study.sample {
        Some(count) => (0..u64::from(count)).map(|number| sample(study, number)).collect(),
        None => product(&study.vary),
    }
}

/// Every combination of the listed values, with the last axis varying fastest; drawn axes are left out.
pub(crate) fn product(axes: &[Axis]) -> Vec<Vec<AxisChoice>> {
    axes.iter().filter_map(Axis::listed).fold(vec![vec![]], |before, picks| {
        let with =
            |all: &Vec<AxisChoice>, pick: &AxisChoice| all.iter().chain([pick]).cloned().collect::<Vec<_>>();
        before.iter().flat_map(|all| picks.iter().map(move |pick| with(all, pick))).collect()
    })
}

/// Number of all designs, without making them.
pub(crate) fn count(study: &Study) -> u64 {
    study.sample.map_or_else(|| combinations(&study.vary), u64::from)
}

/// Number of combinations of the listed values; drawn axes are left out.
pub(crate) fn combinations(axes: &[Axis]) -> u64 {
    let counts = axes.iter().filter_map(Axis::listed).map(|picks| picks.len() as u64);
    counts.fold(1, u64::saturating_mul)
}

fn sample(study: &Study, number: u64) -> Vec<AxisChoice> {
    let share = |axis: u64| share(study.seed, "sweep/design", &[number, axis]);
    study.vary.iter().zip(0..).map(|(axis, place)| axis.at(share(place))).collect()
}

/// A random number from 0 to below 1, a function of the seed, its use and its index.
pub(crate) fn share(seed: u64, of: &str, index: &[u64]) -> f64 {
    ChaCha8Rng::from_seed(artifact::seed::key(seed, of, index)).random()
}

/// Changes to a scene from choices.
pub(crate) fn changes<'a>(chosen: impl Iterator<Item = (&'a Axis, &'a AxisChoice)>) -> Vec<Change> {
    let of_axis = |(axis, pick): (&'a Axis, &'a AxisChoice)| {
        let change = |(key, value): (&String, &String)| Change { key: key.clone(), value: value.clone() };
        axis.keys.iter().zip(&pick.values).map(change).collect::<Vec<_>>()
    };
    chosen.flat_map(of_axis).collect()
}
