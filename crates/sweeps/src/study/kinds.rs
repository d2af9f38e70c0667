//! Kinds of designs: those of one kind have the same bodies, waveform and fidelity, so that their path errors
//! are similar and are measured once.

use crate::study::axis::{Axis, AxisChoice};
use crate::study::document::Study;
use std::collections::BTreeMap;

/// Beginnings of keys that do not affect bodies, waveform and fidelity. The positions of lanes are not among
/// them: targets placed by lane move with it.
const NEUTRAL_KEYS: [&str; 7] = [
    "radar.position_m",
    "radar.boresight_",
    "radar.array.preset",
    "dsp.",
    "noise.",
    "intersection.lane_width_m",
    "intersection.crossing_width_m",
];

/// First design of each design's kind, in which errors are measured.
pub(crate) fn first_of_kinds(study: &Study, designs: &[Vec<AxisChoice>]) -> Vec<usize> {
    let kind = |design: &Vec<AxisChoice>| {
        let chosen = study.vary.iter().zip(design).filter(|(axis, _)| !is_neutral(axis));
        chosen.map(|(_, pick)| pick.clone()).collect::<Vec<_>>()
    };
    let mut firsts = BTreeMap::new();
    let first = |(number, design): (usize, &Vec<AxisChoice>)| *firsts.entry(kind(design)).or_insert(number);
    designs.iter().enumerate().map(first).collect()
}

fn is_neutral(axis: &Axis) -> bool {
    axis.keys.iter().all(|key| NEUTRAL_KEYS.iter().any(|like| key.starts_with(like)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::axis::Source;

    #[test]
    fn what_moves_bodies_makes_another_kind() {
        let is_neutral = |key: &str| {
            let (keys, source) = (vec![key.to_owned()], Source::Whole([0, 1]));
            is_neutral(&Axis { places: vec![], name: key.to_owned(), keys, source })
        };
        assert!(
            ["radar.position_m.2", "noise.snr_db", "intersection.lane_width_m"].map(is_neutral) == [true; 3]
        );
        let moving = ["intersection.lane_centres_m.0", "intersection.lane_azimuth_deg", "target.0.lane"];
        assert!(moving.map(is_neutral) == [false; 3]);
    }
}
