//! The tree of one end of an aspect: grown as far as it is asked for, or grown once for an antenna that
//! stands still.

use crate::beams::beam::{BeamTree, GrowingTree, TraceSettings};
use crate::bodies::world::World;
use crate::geometry::antenna::Antenna;
use crate::oversight::error::BartError;
use crate::oversight::progress::Progress;

/// A tree and how many of its orders an aspect has asked for.
pub(crate) enum EndTree<'a> {
    /// The aspect's own.
    Growing(Box<GrowingTree<'a>>),
    /// One that all aspects share. An order of a tree depends on those before it alone, so what an aspect
    /// looks at is what it would have grown itself, bit by bit; orders beyond `asked` are there but not
    /// looked at.
    Shared { tree: &'a BeamTree, asked: u8 },
}

impl<'a> EndTree<'a> {
    /// Growing tree of which nothing is asked for yet.
    pub(crate) fn growing(
        world: &'a World,
        antenna: Antenna,
        settings: &'a TraceSettings,
        progress: &'a dyn Progress,
    ) -> Result<Self, BartError> {
        Ok(Self::Growing(Box::new(GrowingTree::new(world, antenna, settings, progress)?)))
    }

    /// Shared tree that is grown as far as any aspect may ask, of which nothing is asked for yet.
    pub(crate) fn shared(tree: &'a BeamTree) -> Self {
        Self::Shared { tree, asked: 0 }
    }

    pub(crate) fn grow_to(&mut self, order: u8) -> Result<(), BartError> {
        match self {
            Self::Growing(tree) => tree.grow_to(order),
            Self::Shared { tree, asked } => {
                *asked = order.min(tree.audit.orders.len() as u8).max(*asked);
                Ok(())
            }
        }
    }

    pub(crate) fn tree(&self) -> &BeamTree {
        match self {
            Self::Growing(tree) => tree.tree(),
            Self::Shared { tree, .. } => tree,
        }
    }

    /// Beams of each order asked for.
    pub(crate) fn beams(&self) -> impl Iterator<Item = u64> {
        let asked = match self {
            Self::Growing(tree) => tree.tree().audit.orders.len(),
            Self::Shared { asked, .. } => usize::from(*asked),
        };
        self.tree().audit.orders.iter().take(asked).map(|order| order.beams)
    }
}
