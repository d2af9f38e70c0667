//! Sums over beam trees.

use bart_rcs::BeamTree;
use std::collections::BTreeMap;

/// Section of all beams of an order: solid angle, sr, or area across the direction, m².
pub(crate) fn lit_section(tree: &BeamTree, order: u8) -> f64 {
    tree.beams.iter().filter(|beam| beam.order == order).map(|beam| beam.section).sum()
}

/// Section of each sequence of facets, its facets renamed.
pub(crate) fn section_of_sequences(tree: &BeamTree, name: impl Fn(u32) -> u32) -> BTreeMap<Vec<u32>, f64> {
    let mut sections = BTreeMap::new();
    for beam in &tree.beams {
        let sequence: Vec<u32> = tree.sequence(beam).into_iter().map(&name).collect();
        *sections.entry(sequence).or_insert(0.0) += beam.section;
    }
    sections
}

/// Greatest difference of two maps of sections, relative to the greatest section.
pub(crate) fn difference(a: &BTreeMap<Vec<u32>, f64>, b: &BTreeMap<Vec<u32>, f64>) -> f64 {
    let greatest = a.values().chain(b.values()).fold(0.0, |m: f64, &v| m.max(v));
    let off = |(key, value): (&Vec<u32>, &f64), other: &BTreeMap<Vec<u32>, f64>| {
        (value - other.get(key).copied().unwrap_or(0.0)).abs()
    };
    let forth = a.iter().map(|entry| off(entry, b));
    forth.chain(b.iter().map(|entry| off(entry, a))).fold(0.0, f64::max) / greatest
}
