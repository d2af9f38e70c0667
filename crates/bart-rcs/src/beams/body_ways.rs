//! Ways told by the bodies that they meet, in the order of travel.

use std::collections::BTreeSet;

/// A set of ways; with each also the way back.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct BodyWays(BTreeSet<Vec<u32>>);

impl BodyWays {
    /// Adds a way and its way back.
    pub(crate) fn add(&mut self, bodies: &[u32]) {
        self.0.insert(bodies.to_vec());
        self.0.insert(bodies.iter().rev().copied().collect());
    }

    pub(crate) fn contain(&self, bodies: &[u32]) -> bool {
        self.0.contains(bodies)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether some way begins with these bodies and goes on.
    pub(crate) fn go_on_from(&self, bodies: &[u32]) -> bool {
        self.0.iter().any(|way| way.len() > bodies.len() && way.starts_with(bodies))
    }

    /// Whether some way meets so many bodies.
    pub(crate) fn have_order(&self, order: u8) -> bool {
        self.0.iter().any(|way| way.len() == usize::from(order))
    }

    /// The ways in their order, ways back among them.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[u32]> {
        self.0.iter().map(Vec::as_slice)
    }
}
