//! Propagation paths described by the bodies that they meet, in the order of travel.

use std::collections::BTreeSet;

/// A set of paths as sequences of bodies, each together with its reverse.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct BodySequences(BTreeSet<Vec<u32>>);

impl BodySequences {
    /// Adds a sequence and its reverse.
    pub(crate) fn add(&mut self, bodies: &[u32]) {
        self.0.insert(bodies.to_vec());
        self.0.insert(bodies.iter().rev().copied().collect());
    }

    pub(crate) fn contains(&self, bodies: &[u32]) -> bool {
        self.0.contains(bodies)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether some sequence begins with these bodies and continues.
    pub(crate) fn continue_from(&self, bodies: &[u32]) -> bool {
        self.0.iter().any(|way| way.len() > bodies.len() && way.starts_with(bodies))
    }

    /// Whether some sequence meets this number of bodies.
    pub(crate) fn has_order(&self, order: u8) -> bool {
        self.0.iter().any(|way| way.len() == usize::from(order))
    }

    /// Sequences in their order, including the reverse ones.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[u32]> {
        self.0.iter().map(Vec::as_slice)
    }
}
