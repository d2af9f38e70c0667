//! Limits on the part of a run in its page, so that it opens at once and can be sent by mail.

use artifact::scene::SceneHeader;

/// Largest number of frames.
const FRAMES: usize = 24;
/// Largest number of cells of all maps together.
const CELLS: usize = 400_000;
/// Largest number of paths of all frames together.
pub(super) const PATHS: usize = 50_000;
/// Largest number of bodies of all frames together.
const BODIES: usize = 2_000;
/// Largest number of triangles of all meshes together.
pub(super) const TRIANGLES: usize = 100_000;

/// Part of a run in the view.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Budget {
    /// Interval between viewed frames.
    pub(super) every: u32,
    /// Number of paths per frame.
    pub(super) paths: usize,
    /// Number of cells of a frame's map.
    pub(super) cells: usize,
}

impl Budget {
    /// The budget of a scene for maps with `cells` cells.
    pub(super) fn of(header: &SceneHeader, cells: usize) -> Self {
        let placed = header.traffic.iter().flat_map(|traffic| &traffic.frames).map(Vec::len).max();
        Self::shared(header.frames, cells, header.targets.len() + placed.unwrap_or(0))
    }

    fn shared(frames: u32, cells: usize, bodies: usize) -> Self {
        let most = FRAMES.min(CELLS / cells.max(1)).min(BODIES / bodies.max(1)).max(1);
        let every = frames.max(1).div_ceil(most as u32);
        let viewed = frames.max(1).div_ceil(every) as usize;
        Self { every, paths: PATHS / viewed, cells: CELLS / viewed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_scene_is_viewed_every_few_frames_and_a_single_one_has_all_the_paths() {
        assert_eq!(Budget::shared(1, 32_768, 4), Budget { every: 1, paths: PATHS, cells: CELLS });
        let long = Budget::shared(100, 32_768, 4);
        // 12 maps of this size fit.
        assert_eq!((long.every, long.paths), (9, PATHS / 12));
        assert!(Budget::shared(100, 10 * CELLS, 4).every == 100 && Budget::shared(3, 1, 3_000).every == 3);
    }
}
