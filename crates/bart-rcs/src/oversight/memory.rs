//! Memory of a trace: expected before it begins, watched while it grows, refused with figures.

use crate::oversight::error::BartError;

/// The most that the bodies and beams of a trace may hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryLimit {
    bytes: u64,
}

impl MemoryLimit {
    /// No limit: only what 32 bits can count ends a tree.
    pub const NONE: Self = Self { bytes: u64::MAX };

    /// Limit of so many bytes.
    pub fn of_bytes(bytes: u64) -> Self {
        Self { bytes }
    }

    /// An equal share for each of `count` frames that are traced side by side.
    pub fn share_of(self, count: usize) -> Self {
        self.shared(0, count)
    }

    /// Equal shares of what is left beside `held_bytes`, for `count` trees at a time.
    pub(crate) fn shared(self, held_bytes: u64, count: usize) -> Self {
        if self == Self::NONE {
            self
        } else {
            Self { bytes: self.bytes.saturating_sub(held_bytes) / count.max(1) as u64 }
        }
    }

    /// Refuses what a frame's cells of paths have grown to.
    pub(crate) fn check_cells(self, bytes: u64) -> Result<(), BartError> {
        let limit_bytes = self.bytes;
        if bytes <= limit_bytes {
            Ok(())
        } else {
            Err(BartError::CellsTakeTooMuchMemory { bytes, limit_bytes })
        }
    }

    /// Refuses what is expected to need more.
    pub(crate) fn check_estimate(self, triangles: usize, bytes: u64) -> Result<(), BartError> {
        let limit_bytes = self.bytes;
        if bytes <= limit_bytes {
            Ok(())
        } else {
            Err(BartError::NeedsTooMuchMemory { triangles, bytes, limit_bytes })
        }
    }

    /// Refuses a tree that has grown to `tree_bytes`: what is joined from it later takes [`JOINED_PER_TREE`]
    /// times as much.
    pub(crate) fn check_tree(self, order: u8, beams: usize, tree_bytes: usize) -> Result<(), BartError> {
        let bytes = with_joints(tree_bytes);
        let limit_bytes = self.bytes;
        if bytes <= limit_bytes {
            Ok(())
        } else {
            Err(BartError::BeamsTakeTooMuchMemory { order, beams, bytes, limit_bytes })
        }
    }
}

/// Bytes of a sheet that the way of a beam passes, as a tree counts them: with what is joined
/// ([`with_joints`]) 72, for 4 of the beam and 48 of its leg in lists of their own.
pub(crate) const BYTES_PER_SHEET: usize = 24;

/// Joints and their polygons, legs and sums beside a tree's own bytes. Assumed, not measured apart: the
/// vehicles and scenes of `docs/speed.md` stay below their estimates with it.
pub(crate) const JOINED_PER_TREE: u64 = 2;

/// Bytes of trees with what is joined from them.
pub(crate) fn with_joints(trees_bytes: usize) -> u64 {
    (1 + JOINED_PER_TREE) * trees_bytes as u64
}

/// Bodies at rest: mesh, facets, hierarchy and topology of a triangle (measured 0.9 to 1.1 KiB).
const BYTES_PER_TRIANGLE: u64 = 1280;
/// Shadows, grid and unfinished polygons of the first order (measured 0.3 to 0.5 KiB).
const BYTES_PER_TRIANGLE_SEEN: u64 = 640;
/// Beams and joints of one order of a vehicle alone, per triangle (measured 0.1 to 0.35 KiB).
const BYTES_PER_TRIANGLE_AND_ORDER: u64 = 448;

/// Most bytes that `rcs` is expected to hold, for so many triangles, orders of beams, and aspects
/// traced at a time.
///
/// Measured on six vehicles; a body all of cavities may need more: then the trace stops at its limit.
pub fn memory_estimate_bytes(triangles: usize, orders: u8, aspects_at_a_time: usize) -> u64 {
    let per_tree = BYTES_PER_TRIANGLE_SEEN + BYTES_PER_TRIANGLE_AND_ORDER * u64::from(orders);
    triangles as u64 * (BYTES_PER_TRIANGLE + aspects_at_a_time as u64 * per_tree)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_that_cannot_fit_is_refused_before_it_is_traced() {
        let bytes = memory_estimate_bytes(1_000_000, 3, 2);
        println!("a million triangles, two aspects at a time: {} MiB", bytes >> 20);
        let limit = MemoryLimit::of_bytes(1 << 30);
        assert!(matches!(limit.check_estimate(1_000_000, bytes), Err(BartError::NeedsTooMuchMemory { .. })));
        assert_eq!(limit.check_estimate(1000, memory_estimate_bytes(1000, 5, 16)), Ok(()));
        assert_eq!(MemoryLimit::NONE.shared(1 << 40, 7).check_estimate(1, u64::MAX), Ok(()));
    }
}
