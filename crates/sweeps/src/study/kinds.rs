//! Kinds of designs: those of one kind have the same bodies, waveform and fidelity, so that the errors of
//! their paths are like and are measured once.

use crate::study::axis::{Axis, Pick};
use crate::study::document::Study;
use std::collections::BTreeMap;

/// Beginnings of keys that leave bodies, waveform and fidelity as they are.
const LIKE: [&str; 6] =
    ["radar.position_m", "radar.boresight_", "radar.array.preset", "dsp.", "noise.", "intersection."];

/// First design of each design's kind, in which errors are measured.
pub(crate) fn first_of_kinds(study: &Study, designs: &[Vec<Pick>]) -> Vec<usize> {
    let kind = |design: &Vec<Pick>| {
        let chosen = study.vary.iter().zip(design).filter(|(axis, _)| !is_like(axis));
        chosen.map(|(_, pick)| pick.clone()).collect::<Vec<_>>()
    };
    let mut firsts = BTreeMap::new();
    let first = |(number, design): (usize, &Vec<Pick>)| *firsts.entry(kind(design)).or_insert(number);
    designs.iter().enumerate().map(first).collect()
}

fn is_like(axis: &Axis) -> bool {
    axis.keys.iter().all(|key| LIKE.iter().any(|like| key.starts_with(like)))
}
