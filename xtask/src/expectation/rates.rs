//! Processor seconds of each kind of work on the machine that they were measured on, and bytes.

use super::work::{ITEMS, Item, Work};

/// What the program holds beside frames: code, thread stacks, the learning library's buffers (measured 40 MiB).
pub(crate) const PROGRAM_MIB: f64 = 48.0;

/// Bytes of a facet at rest, of a beam with what is joined on it, and of a cell with its path: of the two runs they were taken from
/// twice what was held.
pub(crate) const BYTES_PER_FACET: f64 = 1500.0;
pub(crate) const BYTES_PER_BEAM: f64 = 1500.0;
pub(crate) const BYTES_PER_CELL: f64 = 2500.0;
/// More where a body moves: a path for each of up to 33 moments.
pub(crate) const BYTES_PER_CHANGING_CELL: f64 = 33.0 * 480.0;
/// Of a tile between bodies that slide past each other, for each wavelength; of a cell of such ways.
pub(crate) const BYTES_PER_SLIDING_TILE: f64 = 2500.0;
pub(crate) const BYTES_PER_MOVING_CELL: f64 = 0.0;

/// Nine of ten runs are meant to take between the expected time over this and times this (docs/validation/predictions.md).
pub(crate) const SPREAD: f64 = 2.0;

/// From the figures of docs/speed.md and a few runs; `cargo xtask bench --predictions` prints those that tell its scenes best.
const SECONDS: [(Item, f64); ITEMS] = [
    (Item::Run, 0.15),
    (Item::Triangles, 8e-6),
    (Item::Facets, 1e-6),
    (Item::InSight, 6e-6),
    (Item::Beams, 3e-5),
    (Item::Mirrors, 1.2e-5),
    (Item::Tiles, 5e-6),
    (Item::LaterTiles, 5e-6),
    (Item::FineTiles, 1.2e-5),
    (Item::LaterFineTiles, 1.2e-5),
    (Item::LongTiles, 1e-4),
    (Item::MeasuredCells, 1.5e-5),
    (Item::Cells, 5e-6),
    (Item::SlidingBeams, 2.5e-5),
    (Item::SlidingTiles, 8e-6),
    (Item::MovingBeams, 1e-5),
    (Item::MovingTiles, 1e-6),
    (Item::MovingCells, 1e-5),
    (Item::RoadBeams, 5e-5),
    (Item::EdgeBeams, 2e-5),
    (Item::LossyTiles, 1e-5),
    (Item::TableTiles, 1e-4),
    (Item::Echoes, 1.5e-7),
    (Item::GroundEchoes, 1.5e-7),
    (Item::Samples, 1e-7),
    (Item::MapCells, 1e-7),
    (Item::Bodies, 1e-2),
    (Item::SeparatedBodies, 1e-2),
    (Item::Frames, 0.2),
];

/// In the order of the items.
pub(super) fn by_item() -> [f64; ITEMS] {
    let mut rates = [0.0; ITEMS];
    SECONDS.iter().for_each(|(item, rate)| rates[*item as usize] = *rate);
    rates
}

/// Processor seconds on that machine.
pub(super) fn reference_seconds(work: &Work) -> f64 {
    SECONDS.iter().map(|(item, rate)| rate * work.0[*item as usize]).sum()
}

/// By the clock, on free processors: what one thread does alone, and the rest shared.
pub(super) fn wall_seconds(seconds: f64, threads: usize) -> f64 {
    const ALONE: f64 = 0.15;
    seconds * (ALONE + (1.0 - ALONE) / threads as f64)
}
