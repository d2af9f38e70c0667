//! Memory of a trace: predicted before it starts, monitored while it grows, refused with figures.

use crate::run_control::error::BartError;

/// Maximum memory of a trace's bodies and beams.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryLimit {
    bytes: u64,
}

impl MemoryLimit {
    /// No limit: only 32-bit counts end a tree.
    pub const NONE: Self = Self { bytes: u64::MAX };

    /// Limit in bytes.
    pub fn of_bytes(bytes: u64) -> Self {
        Self { bytes }
    }

    /// An equal share for each of `count` frames traced in parallel.
    pub fn share_of(self, count: usize) -> Self {
        self.shared(0, count)
    }

    /// Equal shares of the memory left besides `held_bytes`, for `count` trees at a time.
    pub(crate) fn shared(self, held_bytes: u64, count: usize) -> Self {
        if self == Self::NONE {
            self
        } else {
            Self { bytes: self.bytes.saturating_sub(held_bytes) / count.max(1) as u64 }
        }
    }

    /// Refuses the cells of a frame's paths if they exceed the limit.
    pub(crate) fn check_cells(self, bytes: u64) -> Result<(), BartError> {
        let limit_bytes = self.bytes;
        if bytes <= limit_bytes {
            Ok(())
        } else {
            Err(BartError::CellsTakeTooMuchMemory { bytes, limit_bytes })
        }
    }

    /// Refuses a trace whose predicted memory exceeds the limit.
    pub(crate) fn check_estimate(self, triangles: usize, bytes: u64) -> Result<(), BartError> {
        let limit_bytes = self.bytes;
        if bytes <= limit_bytes {
            Ok(())
        } else {
            Err(BartError::NeedsTooMuchMemory { triangles, bytes, limit_bytes })
        }
    }

    /// Refuses a tree of `tree_bytes`, if with the joints made from it later, [`JOINED_PER_TREE`] times as
    /// much, it exceeds the limit.
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

/// Memory of a sheet passed on the path of a beam, as counted by a tree, bytes: including joints
/// ([`with_joints`]) 72, for 4 of the beam and 48 of its leg in separate lists.
pub(crate) const BYTES_PER_SHEET: usize = 24;

/// Memory of joints with their polygons, legs and sums, relative to a tree's own. Assumed, not measured
/// separately: the vehicles and scenes of `docs/speed.md` stay below their estimates with it.
pub(crate) const JOINED_PER_TREE: u64 = 2;

/// Memory of trees including their joints, bytes.
pub(crate) fn with_joints(trees_bytes: usize) -> u64 {
    (1 + JOINED_PER_TREE) * trees_bytes as u64
}

/// Memory of static bodies: mesh, facets, hierarchy and topology per triangle (measured 0.9 to 1.1 KiB).
const BYTES_PER_TRIANGLE: u64 = 1280;
/// Memory of shadows, grid and unfinished polygons of the first order, per triangle (measured 0.3 to 0.5
/// KiB).
const BYTES_PER_TRIANGLE_SEEN: u64 = 640;
/// Memory of beams and joints of one order of a single vehicle, per triangle (measured 0.1 to 0.35 KiB).
const BYTES_PER_TRIANGLE_AND_ORDER: u64 = 448;

/// Expected peak memory of `rcs`, bytes, for numbers of triangles, orders of beams, and aspects traced at a
/// time.
///
/// Measured on six vehicles; a body consisting of cavities may need more, in which case the trace stops at
/// its limit.
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
