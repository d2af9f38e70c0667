//! Processor seconds of each kind of work on the reference machine, and bytes of memory.

use crate::chain::expectation::work::{ITEMS, WorkCounts, WorkKind};

/// Memory that the program holds beside frames, MiB: code, thread stacks, the classifier (32 to 40 MiB were
/// measured when the learning library was part of it).
pub(crate) const PROGRAM_MIB: f64 = 48.0;

/// Bytes of a facet, at rest and placed, and of a beam with its joints.
pub(crate) const BYTES_PER_FACET: f64 = 2000.0;
pub(crate) const BYTES_PER_BEAM: f64 = 1500.0;
/// Bytes of a cell with its path: at most 5.2 KB were measured (192 channels, where hardly any path could be
/// left out), and a quarter is added.
pub(crate) const BYTES_PER_CELL: f64 = 6500.0;
/// Further bytes of a cell where a body moves, whose paths may be held for up to 33 moments: at most 8.6 KB
/// in all were measured (under the mast); 14 KB in all are assumed.
pub(crate) const BYTES_PER_CHANGING_CELL: f64 = 7500.0;
/// Bytes of a tile between bodies that slide past each other, per wavelength; the constant after it holds the
/// bytes of a cell of such paths.
pub(crate) const BYTES_PER_SLIDING_TILE: f64 = 2500.0;
pub(crate) const BYTES_PER_MOVING_CELL: f64 = 0.0;

/// Number of kinds of expected memory contents.
pub const HELD_KINDS: usize = 8;
/// Expected memory of each of them, MiB: the program, a triangle as it is read, and in each concurrent frame
/// a MiB of signals, a facet, a lit polygon, a cell, a cell of paths between bodies that slide past each
/// other, and a lit polygon behind sheets. Fitted to the same scenes as the seconds below; the last to a car
/// and a bus of glass, one bounce and two.
pub const HELD_MIB: [(&str, f64); HELD_KINDS] = [
    ("program", 37.0),
    ("triangles", 3.3e-4),
    ("signals", 0.27),
    ("facets", 8.2e-4),
    ("lit polygons", 1.4e-3),
    ("cells", 6.7e-4),
    ("moving cells", 1.1e-3),
    ("lit polygons behind sheets", 4.0e-3),
];

/// Factor of the expected time: nine of ten runs are meant to take between 1/`SPREAD` and `SPREAD` times the
/// expected time (docs/validation/predictions.md).
pub const SPREAD: f64 = 2.0;

/// Processor seconds of each kind of work on the machine that they were measured on, in the order of the
/// counts. Fitted to 175 scenes of `cargo xtask bench --predictions` (seeds 8, 9 and 10) and three of
/// `scenes/`, held to the rates before, which work keeps that these scenes have little of
/// (docs/validation/predictions.md); that of cells before wide arrays to four scenes of seed 12. What a run,
/// a frame, samples, point targets and long polygons take is fitted to five scenes of points, 24 of boxes and
/// those of seed 14, the other rates being what they are: in scenes of vehicles it is hardly seen.
pub const SECONDS: [(WorkKind, f64); ITEMS] = [
    (WorkKind::Run, 0.073),
    (WorkKind::Triangles, 8.1e-6),
    (WorkKind::Facets, 7.5e-6),
    (WorkKind::InSight, 1.6e-5),
    (WorkKind::Beams, 1.4e-6),
    (WorkKind::Mirrors, 5.9e-5),
    (WorkKind::Tiles, 9.0e-7),
    (WorkKind::LaterTiles, 1.3e-6),
    (WorkKind::FineTiles, 2.2e-5),
    (WorkKind::LaterFineTiles, 8.7e-6),
    (WorkKind::LongTiles, 8.9e-6),
    (WorkKind::MeasuredCells, 5.3e-6),
    (WorkKind::Cells, 2.5e-5),
    (WorkKind::WideCells, 3.0e-5),
    (WorkKind::SlidingBeams, 2.7e-6),
    (WorkKind::SlidingTiles, 1.5e-6),
    (WorkKind::MovingBeams, 9.2e-6),
    (WorkKind::MovingTiles, 9.9e-7),
    (WorkKind::MovingCells, 2.8e-4),
    (WorkKind::RoadBeams, 4.2e-6),
    (WorkKind::EdgeBeams, 5.2e-5),
    (WorkKind::LossyTiles, 1.6e-5),
    (WorkKind::BentTiles, 7.6e-6),
    (WorkKind::TableTiles, 2.1e-5),
    (WorkKind::Echoes, 7.5e-8),
    (WorkKind::GroundEchoes, 1.7e-6),
    (WorkKind::Samples, 1.4e-7),
    (WorkKind::MapCells, 1.4e-7),
    (WorkKind::Bodies, 7.2e-3),
    (WorkKind::SeparatedBodies, 8.7e-3),
    (WorkKind::PointTargets, 2.2e-3),
    (WorkKind::Frames, 0.067),
];

const _: () = {
    let mut at = 0;
    while at < ITEMS {
        assert!(SECONDS[at].0 as usize == at, "rates stand in the order of the kinds");
        at += 1;
    }
};

/// Expected memory, MiB, of counts in the order of [`HELD_MIB`].
pub(super) fn expected_mib(held: &[f64; HELD_KINDS]) -> f64 {
    HELD_MIB.iter().zip(held).map(|((_, mib), count)| mib * count).sum()
}

/// Processor seconds of the work on the reference machine.
pub(super) fn reference_seconds(work: &WorkCounts) -> f64 {
    SECONDS.iter().map(|(item, rate)| rate * work.0[*item as usize]).sum()
}

/// Wall-clock seconds on free processors, from processor seconds: the serial part, and the parallel part
/// shared by the threads.
pub fn wall_seconds(seconds: f64, threads: usize) -> f64 {
    const ALONE: f64 = 0.15;
    seconds * (ALONE + (1.0 - ALONE) / threads as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Processor seconds on the machine of the rates of ten frames of three points and of thirty, of a box at
    /// rest 12 m away and of two that move; what their counts were.
    #[test]
    fn scenes_of_points_and_of_boxes_are_told_within_half_as_much_again() {
        use WorkKind::{
            Bodies, Cells, Frames, LaterTiles, LongTiles, MapCells, MeasuredCells, PointTargets, Run,
            Samples, SlidingTiles, Tiles,
        };
        let frames = |frames: f64| {
            let cube = 12.0 * 128.0 * 256.0 * frames;
            [(Run, 1.0), (Frames, frames), (Samples, cube), (MapCells, cube)]
        };
        let box_at_rest =
            [(Bodies, 1.0), (Tiles, 7.5e4), (LongTiles, 1.43e5), (MeasuredCells, 468.0), (Cells, 166.0)];
        let two_boxes = [
            (Bodies, 2.0),
            (Tiles, 5.9e4),
            (LaterTiles, 2.3e3),
            (LongTiles, 1.17e5),
            (MeasuredCells, 1016.0),
            (Cells, 370.0),
            (SlidingTiles, 3.5e4),
        ];
        for (signals, of_scene, taken_s) in [
            (frames(10.0), &[(PointTargets, 30.0)][..], 1.74),
            (frames(10.0), &[(PointTargets, 300.0)], 2.45),
            (frames(1.0), &box_at_rest, 1.16),
            (frames(1.0), &two_boxes, 1.30),
        ] {
            let mut work = WorkCounts::NONE;
            signals.iter().chain(of_scene).for_each(|(kind, count)| work.add(*kind, *count));
            let told_s = reference_seconds(&work);
            assert!((told_s / taken_s).ln().abs() < 1.5_f64.ln(), "{told_s} s told, {taken_s} s taken");
        }
    }
}
