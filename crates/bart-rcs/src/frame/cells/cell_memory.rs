//! Cells of a frame's paths are counted while they grow, so that a frame ends with figures before memory
//! does.

use crate::run_control::error::BartError;
use crate::run_control::memory::MemoryLimit;
use std::sync::atomic::{AtomicU64, Ordering};

/// Room for cells, which several threads take at a time.
#[derive(Debug)]
pub(crate) struct CellMemory {
    limit: MemoryLimit,
    /// Bytes of cells and paths that are there before the first one is taken.
    held_bytes: u64,
    bytes_per_cell: u64,
    taken: AtomicU64,
}

impl CellMemory {
    /// Room that a limit leaves beside beams, with what is joined from them, of so many bytes.
    pub(crate) fn besides_beams(beams_bytes: u64, limit: MemoryLimit, bytes_per_cell: usize) -> Self {
        let limit = limit.shared(beams_bytes, 1);
        Self { limit, held_bytes: 0, bytes_per_cell: bytes_per_cell as u64, taken: AtomicU64::new(0) }
    }

    /// The same room, in which cells and paths of so many bytes are already.
    pub(crate) fn holding(self, held_bytes: u64) -> Self {
        Self { held_bytes, ..self }
    }

    /// Room for so many more; false where there is none, and then [`CellMemory::check`] says so.
    pub(crate) fn take(&self, cells: u32) -> bool {
        let cells = u64::from(cells);
        let before = self.taken.fetch_add(cells, Ordering::Relaxed);
        self.limit.check_cells(self.bytes_of(before + cells)).is_ok()
    }

    /// Refuses what was found where there was not room for all of it.
    pub(crate) fn check(&self) -> Result<(), BartError> {
        self.limit.check_cells(self.bytes_of(self.taken.load(Ordering::Relaxed)))
    }

    fn bytes_of(&self, cells: u64) -> u64 {
        self.held_bytes.saturating_add(cells.saturating_mul(self.bytes_per_cell))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_is_room_up_to_the_limit_and_what_had_none_is_told() {
        let room = CellMemory::besides_beams(1000, MemoryLimit::of_bytes(1000 + 3 * 700), 700);
        assert_eq!([1, 2].map(|cells| room.take(cells)), [true; 2]);
        room.check().unwrap();
        assert!(!room.take(1));
        assert_eq!(room.check(), Err(BartError::CellsTakeTooMuchMemory { bytes: 2800, limit_bytes: 2100 }));
        let room = CellMemory::besides_beams(1000, MemoryLimit::of_bytes(1000 + 3 * 700), 700).holding(1500);
        assert!(!room.take(1));
        assert_eq!(room.check(), Err(BartError::CellsTakeTooMuchMemory { bytes: 2200, limit_bytes: 2100 }));
    }
}
