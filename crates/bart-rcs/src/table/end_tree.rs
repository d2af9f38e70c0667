//! Tree of one end of an aspect: grown as needed, or grown once for a stationary antenna.

use crate::beams::beam::{BeamTree, GrowingTree, TraceSettings};
use crate::bodies::world::World;
use crate::geometry::antenna::Antenna;
use crate::run_control::error::BartError;
use crate::run_control::progress::Progress;

/// A tree and the number of its orders requested by an aspect.
pub(crate) enum EndTree<'a> {
    /// A tree of the aspect's own.
    Growing(Box<GrowingTree<'a>>),
    /// A tree shared by all aspects. An order of a tree depends only on those before it, so an aspect sees
    /// what it would have grown itself, bit for bit; orders beyond `asked` exist but are not used.
    Shared { tree: &'a BeamTree, asked: u8 },
}

impl<'a> EndTree<'a> {
    /// Growing tree with no orders requested yet.
    pub(crate) fn growing(
        world: &'a World,
        antenna: Antenna,
        settings: &'a TraceSettings,
        progress: &'a dyn Progress,
    ) -> Result<Self, BartError> {
        Ok(Self::Growing(Box::new(GrowingTree::new(world, antenna, settings, progress)?)))
    }

    /// Shared tree grown as far as any aspect may need, with no orders requested yet.
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

    /// Number of beams in each requested order.
    pub(crate) fn beams(&self) -> impl Iterator<Item = u64> {
        let asked = match self {
            Self::Growing(tree) => tree.tree().audit.orders.len(),
            Self::Shared { asked, .. } => usize::from(*asked),
        };
        self.tree().audit.orders.iter().take(asked).map(|order| order.beams)
    }
}
