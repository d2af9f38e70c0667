//! Situations in which every design of a study is tried, with the same conditions and seeds for all, so that
//! designs are compared in pairs.

use crate::study::axis::{Axis, AxisChoice};
use crate::study::designs::{changes, combinations, product, share};
use crate::study::document::Study;
use scene::Change;

/// A condition with a seed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Situation {
    /// Number of the combination of listed conditions.
    pub(crate) condition: usize,
    pub(crate) repeat: u32,
    /// Seed of the scene's noise and other random draws.
    pub(crate) seed: u64,
    /// A choice for every axis of `condition`.
    pub(crate) picks: Vec<AxisChoice>,
}

/// Situations by repeat: every combination of the listed conditions, with new random draws.
pub(crate) fn situations(study: &Study) -> Vec<Vec<Situation>> {
    let listed = product(&study.conditions);
    let of_repeat = |repeat: u32| {
        listed
            .iter()
            .enumerate()
            .map(|(condition, picks)| situation(study, repeat, condition, picks))
            .collect()
    };
    (0..study.repeats).map(of_repeat).collect()
}

/// Number of situations of all repeats, without making them.
pub(crate) fn count(study: &Study) -> u64 {
    combinations(&study.conditions).saturating_mul(u64::from(study.repeats))
}

/// Changes to the scene for a design in a situation.
pub(crate) fn changes_in(study: &Study, design: &[AxisChoice], situation: &Situation) -> Vec<Change> {
    changes(study.vary.iter().zip(design).chain(study.conditions.iter().zip(&situation.picks)))
}

fn situation(study: &Study, repeat: u32, condition: usize, listed: &[AxisChoice]) -> Situation {
    let index = [u64::from(repeat), condition as u64];
    let seed = artifact::seed::derived(study.seed, "sweep/scene", &index);
    let mut listed = listed.iter();
    let axes = study.conditions.iter().zip(0..);
    let pick = |(axis, place): (&Axis, u64)| match axis.listed() {
        Some(_) => listed.next().cloned(),
        None => Some(axis.at(share(study.seed, "sweep/condition", &[index[0], index[1], place]))),
    };
    Situation { condition, repeat, seed, picks: axes.filter_map(pick).collect() }
}
