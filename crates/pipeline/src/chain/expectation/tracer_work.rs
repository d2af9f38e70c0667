//! The tracer's work in every frame, extrapolated from a look at a few of them.

use crate::chain::cache::Cache;
use crate::chain::expectation::work::{WorkCounts, WorkKind};
use crate::chain::expected_work::ScaledWork;
use crate::chain::link::Chain;
use crate::chain::plan::FramePlan;
use crate::chain::stages::Stage;
use crate::host::failure::Failure;
use artifact::scene::{Mesh, SceneHeader};
use artifact::settings::{EchoMode, Edges, Surface};
use glam::DVec3;

/// Adds the tracer's work; returns the approximate number of paths of each frame.
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
        let scaled = chain.scaled_work(plan.index)?;
        paths.push(scaled.cells * scaled.work.largest_cells);
        // Frames whose bodies have the poses of an earlier one find its paths in the cache.
        let is_known =
            cache.is_some() && plans[..number].iter().any(|p| p.keys.bart_rcs == plan.keys.bart_rcs);
        if plan.runs(Stage::BartRcs) && !is_known {
            add_frame(chain.header, plan.index, &scaled, work);
        }
    }
    Ok(paths)
}

fn add_frame(header: &SceneHeader, index: u32, scaled: &ScaledWork, work: &mut WorkCounts) {
    if header.fidelity.echo == EchoMode::RcsTable {
        add_beams(header, scaled, 3.0, work);
        work.add(WorkKind::TableTiles, scaled.facets * (scaled.work.tiles[0] + scaled.work.tiles[1]));
        if header.fidelity.edges != Edges::Ignored {
            let beams = scaled.facets * (scaled.work.beams[0] + scaled.work.beams[1]);
            work.add(WorkKind::EdgeBeams, TABLE_SUMS * beams);
        }
    } else if header.measured_in(index) == index {
        add_measured(header, scaled, work);
        add_places(header, index, scaled, work);
    } else {
        add_like(header, scaled, work);
    }
}

/// Sums over all edges that a table takes beside those of its traced moments: nine aspects of a moving body,
/// and three for its error estimate.
const TABLE_SUMS: f64 = 12.0;

/// Adds the tracing of a frame whose errors are measured: two moments, and integrals compared with finer
/// ones.
fn add_measured(header: &SceneHeader, scaled: &ScaledWork, work: &mut WorkCounts) {
    add_beams(header, scaled, 2.0, work);
    add_tiles(header, scaled, work);
    let fine = scaled.work.fine_tiles.map(|tiles| scaled.facets * tiles);
    let long = (scaled.facets * scaled.work.long_tiles).min(fine[0] + fine[1]);
    let short_share = 1.0 - long / (fine[0] + fine[1]).max(f64::MIN_POSITIVE);
    work.add(WorkKind::FineTiles, short_share * fine[0]);
    work.add(WorkKind::LaterFineTiles, short_share * fine[1]);
    add_skins(header, fine[0] + fine[1], work);
    work.add(WorkKind::LongTiles, long);
    work.add(WorkKind::MeasuredCells, scaled.cells * scaled.work.smaller_cells);
    work.add(WorkKind::Cells, scaled.cells * scaled.work.largest_cells);
    work.add(
        WorkKind::WideCells,
        scaled.cells * scaled.work.smaller_cells * bart_rcs::element_offset_m(header),
    );
    add_sliding(scaled, work);
}

/// Adds the places at which a frame before a wide array is traced beside its middle and one check: beams of a
/// transmitter and a receiver at each place; at the row's nodes only the paths that change are traced.
fn add_places(header: &SceneHeader, index: u32, scaled: &ScaledWork, work: &mut WorkCounts) {
    let away_m = bart_rcs::element_offset_m(header);
    if away_m < WIDE_M {
        return;
    }
    add_beams(header, scaled, CHECK_ENDS, work);
    if header.fidelity.accuracy.db() > MET_WITHOUT_DB || !outlines_slide(header, index, away_m) {
        return;
    }
    let ways = LOOKED_AT + CHANGING * NODES;
    add_beams(header, scaled, 2.0 * ways, work);
    // Smaller cells do not follow outlines that slide from element to element, so trying them is in vain.
    work.add(WorkKind::Cells, scaled.cells * scaled.work.largest_cells * ways);
}

/// Whether the outlines of some body slide by a wavelength or more between the array's middle and an element
/// `away_m` from it: they slide by less than the element's offset, in the ratio of the body's size to its
/// distance.
fn outlines_slide(header: &SceneHeader, index: u32, away_m: f64) -> bool {
    let (view, frame) = (scene::frame_view(header, index), scene::snapshot(header, index));
    let position_m = DVec3::from_array(header.radar.position_m);
    let wavelength_m = header.radar.waveform.wavelength_m();
    view.targets.iter().zip(&frame.poses).any(|(target, pose)| {
        let reach_m = view.mesh_of(&target.kind).map_or(0.0, Mesh::reach_m);
        let distance_m = position_m.distance(DVec3::from_array(pose.position_m));
        away_m * reach_m > wavelength_m * distance_m
    })
}

/// Largest distance, m, of elements from the radar's position within which arrays are nearly always traced
/// from that position alone.
const WIDE_M: f64 = 0.1;
/// Accuracy up to which the array's middle nearly always suffices, dB.
const MET_WITHOUT_DB: f64 = -12.0;
/// Ends of both checks of a wide array, without the one place from which every frame is checked.
const CHECK_ENDS: f64 = 3.0;
/// Places of the row at which all paths are traced, and the places of five nodes that are neither the middle
/// nor such a look: five nodes are usually enough.
const LOOKED_AT: f64 = 2.0;
const NODES: f64 = 3.0;
/// Share of the paths that change along the row.
const CHANGING: f64 = 0.5;

/// Adds the tracing of a frame that takes errors over: one moment and its paths.
fn add_like(header: &SceneHeader, scaled: &ScaledWork, work: &mut WorkCounts) {
    add_beams(header, scaled, 1.0, work);
    add_tiles(header, scaled, work);
    work.add(WorkKind::Cells, scaled.cells * scaled.work.largest_cells);
    add_sliding(scaled, work);
}

/// Adds the moments at which paths between bodies in relative motion are traced: as many in a frame that
/// takes errors over.
fn add_sliding(scaled: &ScaledWork, work: &mut WorkCounts) {
    work.add(WorkKind::SlidingBeams, scaled.facets * scaled.work.sliding_beams);
    work.add(WorkKind::SlidingTiles, scaled.facets * scaled.work.sliding_tiles);
    work.add(WorkKind::MovingBeams, scaled.facets * scaled.work.moving_beams);
    work.add(WorkKind::MovingTiles, scaled.facets * scaled.work.moving_tiles);
    work.add(WorkKind::MovingCells, scaled.cells * scaled.work.moving_cells);
}

fn add_tiles(header: &SceneHeader, scaled: &ScaledWork, work: &mut WorkCounts) {
    let tiles = scaled.work.tiles.map(|tiles| scaled.facets * tiles);
    work.add(WorkKind::Tiles, tiles[0]);
    work.add(WorkKind::LaterTiles, tiles[1]);
    add_skins(header, tiles[0] + tiles[1], work);
}

/// Adds the additional cost of tiles on bodies that are not conductors, and on curved skins.
fn add_skins(header: &SceneHeader, tiles: f64, work: &mut WorkCounts) {
    if header.meshes.iter().any(|mesh| !mesh.makeup.is_perfect_conductor()) {
        work.add(WorkKind::LossyTiles, tiles);
    }
    if header.fidelity.surface == Surface::Smooth {
        work.add(WorkKind::BentTiles, tiles);
    }
}

fn add_beams(
    header: &SceneHeader,
    ScaledWork { work: of, facets, .. }: &ScaledWork,
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

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::Accuracy;
    use artifact::scene::{Pose, Role, Target, TargetKind};
    use bart_rcs::ExpectedWork;
    use radar::aperture::Preset;
    use radar::paper;

    /// A wall of 1 m so far before the widest array, −20 dB asked.
    fn wall_before_192_channels(y_m: f64) -> SceneHeader {
        let options = scene::ReadOptions::names_only();
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/intersection.toml");
        let mut header = scene::read(&file, &options).unwrap();
        let start = Pose { position_m: [0.0, y_m, 0.0], ..header.targets[0].start };
        let kind = TargetKind::Mesh { class: None, model: "wall".into(), mesh: 0 };
        header.targets = vec![Target { id: "wall".into(), role: Role::Target, kind, start }];
        let wall = Mesh {
            vertices_m: vec![[-0.5, 0.0, 0.0], [0.5, 0.0, 0.0], [0.0, 0.0, 1.0]],
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        };
        header.meshes = vec![wall].into();
        let elements = Preset::TwelveBySixteen.elements();
        header.radar = paper::radar(header.radar.position_m, header.radar.waveform, elements);
        header.fidelity.accuracy = Accuracy::from_db(-20.0);
        header
    }

    /// A frame of one facet and polygon, of one large cell or of nine smaller ones.
    fn scaled() -> ScaledWork {
        let work = ExpectedWork {
            facets: 1.0,
            beams: [1.0, 0.0],
            largest_cells: 1.0,
            smaller_cells: 9.0,
            ..ExpectedWork::default()
        };
        ScaledWork { work, facets: 1.0, cells: 1.0 }
    }

    fn counted(header: &SceneHeader, kind: WorkKind) -> f64 {
        let mut work = WorkCounts::NONE;
        add_frame(header, 0, &scaled(), &mut work);
        work.0[kind as usize]
    }

    #[test]
    fn a_wide_array_is_traced_from_places_of_largest_cells_where_outlines_slide_from_one_to_another() {
        let [near, far] = [15.0, 400.0].map(wall_before_192_channels);
        assert_eq!(counted(&far, WorkKind::Facets), 2.0 + 3.0, "the middle and two checks of two ends");
        assert_eq!(counted(&far, WorkKind::Cells), 1.0);
        // 3.5 places' beams of both ends beside them.
        assert_eq!(counted(&near, WorkKind::Facets), 2.0 + 3.0 + 7.0);
        assert_eq!(counted(&near, WorkKind::Cells), 1.0 + 3.5);
    }

    #[test]
    fn a_tile_of_a_long_polygon_is_counted_once() {
        let header = wall_before_192_channels(15.0);
        let work = ExpectedWork { fine_tiles: [30.0, 10.0], long_tiles: 20.0, ..scaled().work };
        let mut counts = WorkCounts::NONE;
        add_measured(&header, &ScaledWork { work, facets: 1.0, cells: 1.0 }, &mut counts);
        let of = |kind: WorkKind| counts.0[kind as usize];
        assert_eq!(of(WorkKind::LongTiles), 20.0);
        assert_eq!([of(WorkKind::FineTiles), of(WorkKind::LaterFineTiles)], [15.0, 5.0]);
        assert_eq!(counted(&header, WorkKind::LongTiles), 0.0, "no tiles at all");
        assert_eq!(counted(&header, WorkKind::FineTiles), 0.0);
    }

    #[test]
    fn edges_of_a_table_are_added_up_for_each_aspect() {
        let mut header = wall_before_192_channels(15.0);
        header.fidelity.edges = Edges::FirstOrder;
        header.fidelity.echo = EchoMode::RcsTable;
        assert_eq!(counted(&header, WorkKind::Beams), 3.0, "moments");
        assert_eq!(counted(&header, WorkKind::EdgeBeams), 3.0 + 9.0 + 3.0);
    }
}
