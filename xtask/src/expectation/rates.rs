//! Processor seconds of each kind of work on the machine that they were measured on, and bytes.

use super::work::{ITEMS, Item, Work};

/// What the program holds beside frames: code, thread stacks, the classifier (measured 32 to 40 MiB with the learning library that was there then).
pub(crate) const PROGRAM_MIB: f64 = 48.0;

/// Bytes of a facet, at rest and placed, and of a beam with what is joined on it.
pub(crate) const BYTES_PER_FACET: f64 = 2000.0;
pub(crate) const BYTES_PER_BEAM: f64 = 1500.0;
/// Of a cell with its path: most were 5.2 KB (192 channels, which hardly anything could be left out for); a quarter more.
pub(crate) const BYTES_PER_CELL: f64 = 6500.0;
/// More where a body moves, whose paths may be held for up to 33 moments: most were 8.6 KB in all (under the mast); 14 KB in all.
pub(crate) const BYTES_PER_CHANGING_CELL: f64 = 7500.0;
/// Of a tile between bodies that slide past each other, for each wavelength; of a cell of such ways.
pub(crate) const BYTES_PER_SLIDING_TILE: f64 = 2500.0;
pub(crate) const BYTES_PER_MOVING_CELL: f64 = 0.0;

/// Nine of ten runs are meant to take between the expected time over this and times this (docs/validation/predictions.md).
pub(crate) const SPREAD: f64 = 2.0;

/// Fitted to the first 36 scenes of `cargo xtask bench --predictions --seed 1`, held to first rates from the figures of docs/speed.md,
/// which work keeps that these scenes have little of (edges, tables, frames split in time).
const SECONDS: [(Item, f64); ITEMS] = [
    (Item::Run, 0.13),
    (Item::Triangles, 5.6e-6),
    (Item::Facets, 9e-7),
    (Item::InSight, 2.3e-5),
    (Item::Beams, 1.2e-5),
    (Item::Mirrors, 1.3e-5),
    (Item::Tiles, 4.2e-6),
    (Item::LaterTiles, 4.5e-6),
    (Item::FineTiles, 7.4e-6),
    (Item::LaterFineTiles, 3.1e-5),
    (Item::LongTiles, 2.2e-5),
    (Item::MeasuredCells, 1.8e-5),
    (Item::Cells, 5.1e-6),
    (Item::WideCells, 1e-4),
    (Item::SlidingBeams, 6e-5),
    (Item::SlidingTiles, 5.6e-6),
    (Item::MovingBeams, 1e-5),
    (Item::MovingTiles, 1e-6),
    (Item::MovingCells, 1e-5),
    (Item::RoadBeams, 4.8e-5),
    (Item::EdgeBeams, 1.9e-5),
    (Item::LossyTiles, 2.6e-4),
    (Item::TableTiles, 1.7e-5),
    (Item::Echoes, 1.7e-7),
    (Item::GroundEchoes, 6.9e-6),
    (Item::Samples, 1.7e-7),
    (Item::MapCells, 1.7e-7),
    (Item::Bodies, 9.8e-3),
    (Item::SeparatedBodies, 9e-3),
    (Item::Frames, 0.15),
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
