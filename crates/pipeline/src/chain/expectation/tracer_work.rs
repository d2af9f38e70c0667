//! The tracer's work in every frame, from a look at a few of them.

use crate::chain::cache::Cache;
use crate::chain::expectation::work::{WorkCounts, WorkKind};
use crate::chain::expected_work::Look;
use crate::chain::link::Chain;
use crate::chain::plan::FramePlan;
use crate::chain::stages::Stage;
use crate::host::failure::Failure;
use artifact::scene::SceneHeader;
use artifact::settings::{EchoMode, Edges, Surface};

/// Adds what the tracer does; gives about how many paths each frame has.
pub(super) fn add(
    chain: &Chain,
    cache: Option<&Cache>,
    plans: &[FramePlan],
    work: &mut WorkCounts,
) -> Result<Vec<f64>, Failure> {
    let mut paths = Vec::new();
    for (number, plan) in plans.iter().enumerate() {
        if !plan.runs(Stage::FmcwEcho) && !plan.runs(Stage::BartRcs) {
            paths.push(0.0);
            continue;
        }
        let look = chain.look(plan.index)?;
        paths.push(look.cells * look.work.largest_cells);
        // Frames whose bodies stand as in an earlier one find its paths in the cache.
        let is_known =
            cache.is_some() && plans[..number].iter().any(|p| p.keys.bart_rcs == plan.keys.bart_rcs);
        if plan.runs(Stage::BartRcs) && !is_known {
            add_frame(chain.header, plan.index, &look, work);
        }
    }
    Ok(paths)
}

fn add_frame(header: &SceneHeader, index: u32, look: &Look, work: &mut WorkCounts) {
    if header.fidelity.echo == EchoMode::RcsTable {
        add_beams(header, look, 3.0, work);
        work.add(WorkKind::TableTiles, look.facets * (look.work.tiles[0] + look.work.tiles[1]));
    } else if header.measured_in(index) == index {
        add_measured(header, look, work);
    } else {
        add_like(header, look, work);
    }
}

/// Adds the tracing of a frame whose errors are measured: two moments, and integrals that are compared with
/// finer ones.
fn add_measured(header: &SceneHeader, look: &Look, work: &mut WorkCounts) {
    add_beams(header, look, 2.0, work);
    add_tiles(header, look, work);
    let fine = look.work.fine_tiles.map(|tiles| look.facets * tiles);
    work.add(WorkKind::FineTiles, fine[0]);
    work.add(WorkKind::LaterFineTiles, fine[1]);
    add_skins(header, fine[0] + fine[1], work);
    work.add(WorkKind::LongTiles, look.facets * look.work.long_tiles);
    work.add(WorkKind::MeasuredCells, look.cells * look.work.smaller_cells);
    work.add(WorkKind::Cells, look.cells * look.work.largest_cells);
    work.add(WorkKind::WideCells, look.cells * look.work.smaller_cells * bart_rcs::element_offset_m(header));
    add_sliding(look, work);
    add_places(header, look, work);
}

/// Adds the second check of a frame before a wide array, and the places of its row from which ways are
/// traced, a transmitter's and a receiver's beams each.
fn add_places(header: &SceneHeader, look: &Look, work: &mut WorkCounts) {
    if bart_rcs::element_offset_m(header) < WIDE_M || header.fidelity.accuracy.db() > MET_WITHOUT_DB {
        return;
    }
    add_beams(header, look, PLACES, work);
    work.add(WorkKind::Cells, look.cells * look.work.smaller_cells);
}

/// Arrays whose elements are all nearer to the radar's position are traced from there alone, nearly always.
const WIDE_M: f64 = 0.1;
/// Accuracy up to which the array's middle is enough, nearly always, dB.
const MET_WITHOUT_DB: f64 = -12.0;
/// Moments' beams that nine places and a second check are worth: the ways that change are a part of all.
const PLACES: f64 = 12.0;

/// Adds the tracing of a frame that takes errors over: one moment and its paths.
fn add_like(header: &SceneHeader, look: &Look, work: &mut WorkCounts) {
    add_beams(header, look, 1.0, work);
    add_tiles(header, look, work);
    work.add(WorkKind::Cells, look.cells * look.work.largest_cells);
    add_sliding(look, work);
}

/// Adds the moments at which ways between bodies that move against each other are traced: as many in a frame
/// that takes them over.
fn add_sliding(look: &Look, work: &mut WorkCounts) {
    work.add(WorkKind::SlidingBeams, look.facets * look.work.sliding_beams);
    work.add(WorkKind::SlidingTiles, look.facets * look.work.sliding_tiles);
    work.add(WorkKind::MovingBeams, look.facets * look.work.moving_beams);
    work.add(WorkKind::MovingTiles, look.facets * look.work.moving_tiles);
    work.add(WorkKind::MovingCells, look.cells * look.work.moving_cells);
}

fn add_tiles(header: &SceneHeader, look: &Look, work: &mut WorkCounts) {
    let tiles = look.work.tiles.map(|tiles| look.facets * tiles);
    work.add(WorkKind::Tiles, tiles[0]);
    work.add(WorkKind::LaterTiles, tiles[1]);
    add_skins(header, tiles[0] + tiles[1], work);
}

/// Adds what tiles take more where bodies are no conductors, and where their skins are bent.
fn add_skins(header: &SceneHeader, tiles: f64, work: &mut WorkCounts) {
    if header.meshes.iter().any(|mesh| !mesh.makeup.conducts_all_over()) {
        work.add(WorkKind::LossyTiles, tiles);
    }
    if header.fidelity.surface == Surface::Smooth {
        work.add(WorkKind::BentTiles, tiles);
    }
}

fn add_beams(
    header: &SceneHeader,
    Look { work: of, facets, .. }: &Look,
    moments: f64,
    work: &mut WorkCounts,
) {
    let times = moments * facets;
    let beams = times * (of.beams[0] + of.beams[1]);
    work.add(WorkKind::Facets, times * of.facets);
    work.add(WorkKind::InSight, times * of.in_sight);
    work.add(WorkKind::Beams, beams);
    work.add(WorkKind::Mirrors, times * of.mirrors);
    if header.road.is_some() {
        work.add(WorkKind::RoadBeams, beams);
    }
    if header.fidelity.edges != Edges::Ignored {
        work.add(WorkKind::EdgeBeams, beams);
    }
}
