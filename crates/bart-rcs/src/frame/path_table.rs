//! Path table with the largest cells that the requested accuracy permits.

use crate::beams::body_sequences::BodySequences;
use crate::bodies::world::World;
use crate::frame::cells::cell_memory::CellMemory;
use crate::frame::cells::corner_slide::{OutlineSlides, SlidesOfOrder};
use crate::frame::cells::edge_cells::{edge_cells, truncation_cells};
use crate::frame::cells::path_cells::{BYTES_PER_CELL, Cell, CellSettings, cells, gathered};
use crate::frame::frame_error::{FrameError, FrameReference, OmittedPowers, dropped_sections};
use crate::frame::path_plan::{MOMENTS_MAX, MOMENTS_USUAL, PATHS_MAX, Plan, WHEEL_STEPS};
use crate::frame::path_pruning::{PrunedPaths, pruned};
use crate::frame::snapshot::sliding_outlines::{has_sliding_corners, outline_slides};
use crate::frame::snapshot::{BlendNode, TracedScene};
use crate::geometry::antenna::Antenna;
use crate::joins::scatterer::{Scatterer, bracket_of};
use crate::run_control::error::BartError;
use crate::run_control::memory::with_joints;
use crate::table::order_joints::OrderJoints;
use artifact::paths::{Curve, Fineness, IntegralFineness, Outlines, Path};
use artifact::scene::{SceneHeader, Target};
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use std::f64::consts::TAU;

/// Paths with their measured error.
pub(crate) struct PathTable {
    pub(crate) paths: Vec<Path>,
    pub(crate) fineness: Fineness,
    pub(crate) error: FrameError,
    pub(crate) omitted_powers: OmittedPowers,
    /// Power of the dropped paths of each target, as in [`PrunedPaths`].
    pub(crate) dropped_powers: Vec<f64>,
    /// Power of the strongest dropped path of each target, as in [`PrunedPaths`].
    pub(crate) strongest_dropped: Vec<f64>,
    /// Peak memory of the moments from which it was blended, bytes.
    pub(crate) bytes: u64,
}

impl PathTable {
    /// Memory of its paths, bytes.
    fn paths_bytes(&self) -> u64 {
        paths_bytes(self.paths.len())
    }
}

/// Memory of a number of paths, bytes.
pub(crate) fn paths_bytes(paths: usize) -> u64 {
    (size_of::<Path>() * paths) as u64
}

/// Paths of bodies at the frame's middle with the fineness of another frame, in cells no larger than this
/// frame's motion and band permit.
pub(crate) fn paths_as_fine(
    scenery: &TracedScene<'_>,
    scatterer: &Scatterer<'_>,
    fineness: &Fineness,
) -> Result<PrunedPaths, BartError> {
    let plan = scenery.plan;
    let accuracy_of_body = accuracy_of_body(plan, fineness);
    let cells = CellFineness::no_larger(fineness, plan, (scatterer.world, &accuracy_of_body));
    BodyParts::of(scenery, scatterer).paths(&cells, 0)
}

/// Paths at another node, with nothing dropped.
pub(crate) fn paths_along(
    scenery: &TracedScene<'_>,
    scatterer: &Scatterer<'_>,
    fineness: &Fineness,
    node: &BlendNode<'_>,
) -> Result<Vec<Path>, BartError> {
    let plan = scenery.plan;
    let accuracy_of_body = accuracy_of_body(plan, fineness);
    let cells = CellFineness::no_larger(fineness, plan, (scatterer.world, &accuracy_of_body));
    let parts = BodyParts::along(scenery, scatterer, node);
    parts.trace(&cells, &parts.room())
}

/// Fineness of a table's cells.
struct CellFineness<'a> {
    cell_m: f64,
    accuracy_of_body: &'a [f64],
    outlines: Outlines,
}

impl<'a> CellFineness<'a> {
    /// The fineness of another frame, in cells no larger than this frame's motion and band permit.
    fn no_larger(
        fineness: &Fineness,
        plan: &Plan<'_>,
        (world, accuracy_of_body): (&World, &'a [f64]),
    ) -> Self {
        let cell_m = fineness.cell_m.min(largest_cell_of_world_m(plan, world));
        Self { cell_m, accuracy_of_body, outlines: fineness.outlines }
    }
}

/// Accuracy of each body; a new body is given the finest.
fn accuracy_of_body(plan: &Plan<'_>, fineness: &Fineness) -> Vec<f64> {
    let finest = fineness.integrals.iter().map(|of| of.accuracy).fold(plan.allowed_error(), f64::min);
    let of_body =
        |id: &str| fineness.integrals.iter().find(|of| of.body == id).map_or(finest, |of| of.accuracy);
    plan.header.targets.iter().map(|target| of_body(&target.id)).collect()
}

/// Meetings by order, on some sequences of bodies alone if they are named.
fn meetings(scatterer: &Scatterer<'_>, plan: &Plan<'_>, ways: Option<&BodySequences>) -> Vec<OrderJoints> {
    let of_order = |order: u8| OrderJoints::of(scatterer, order, &plan.meetings());
    let orders = 1..=plan.header.fidelity.bounces;
    match ways {
        None => orders.map(of_order).collect(),
        Some(ways) => {
            let present = orders.filter(|order| ways.has_order(*order));
            present.map(|order| of_order(order).along(scatterer, ways)).collect()
        }
    }
}

/// Parts of bodies from which paths are made.
struct BodyParts<'a> {
    scenery: &'a TracedScene<'a>,
    scatterer: &'a Scatterer<'a>,
    plan: &'a Plan<'a>,
    /// Place and moment at which they are traced.
    node: BlendNode<'a>,
    /// Meetings by order from 1, without orders that no sequence of the node has.
    meetings: Vec<OrderJoints>,
}

impl<'a> BodyParts<'a> {
    /// All parts at the frame's middle.
    fn of(scenery: &'a TracedScene<'a>, scatterer: &'a Scatterer<'a>) -> Self {
        let plan = scenery.plan;
        let node = BlendNode { ways: None, seconds: plan.middle_s, ends_m: [plan.position_m; 2] };
        Self::along(scenery, scatterer, &node)
    }

    /// Parts at a node, on its sequences of bodies alone.
    fn along(scenery: &'a TracedScene<'a>, scatterer: &'a Scatterer<'a>, node: &BlendNode<'a>) -> Self {
        let (plan, node) = (scenery.plan, *node);
        let meetings = meetings(scatterer, plan, node.ways);
        Self { scenery, scatterer, plan, node, meetings }
    }

    /// Whether outlines slide on polygons that are large in cells of some size.
    fn has_sliding_outlines(&self, size_m: f64) -> bool {
        has_sliding_corners(self.scatterer, &self.meetings, size_m)
    }

    /// Slides of the outlines of polygons that are large in cells of some size; `None` if none slides.
    fn slides(&self, outlines: Outlines, size_m: f64) -> Result<Option<OutlineSlides>, BartError> {
        if outlines == Outlines::Fixed || !self.has_sliding_outlines(size_m) {
            return Ok(None);
        }
        let of_others = |other: &Scatterer<'_>, ways: &BodySequences| meetings(other, self.plan, Some(ways));
        let of_node = (self.scatterer, self.meetings.as_slice());
        outline_slides(self.scenery, of_node, (&self.node, size_m), &of_others).map(Some)
    }

    /// Paths while other tables of `others` bytes are held.
    fn paths(&self, fineness: &CellFineness<'_>, others: u64) -> Result<PrunedPaths, BartError> {
        let paths = self.trace(fineness, &self.room().holding(others))?;
        Ok(pruned(paths, self.plan, self.scatterer.world))
    }

    /// Memory available for cells besides the beams.
    fn room(&self) -> CellMemory {
        let (trees, limit) = (self.scatterer.trees, self.scatterer.world.memory_limit());
        CellMemory::besides_beams(with_joints(trees.bytes()), limit, BYTES_PER_CELL)
    }

    /// Paths of all parts.
    fn trace(&self, fineness: &CellFineness<'_>, room: &CellMemory) -> Result<Vec<Path>, BartError> {
        let CellFineness { cell_m, accuracy_of_body, outlines } = *fineness;
        let slides = self.slides(outlines, cell_m)?;
        let wavenumbers = self.plan.band.wavenumbers_per_m();
        let settings = CellSettings {
            size_m: cell_m,
            wheel_size_m: wheel_cell_m(self.plan, self.scatterer.world, cell_m),
            refinement: (cell_m / largest_cell_of_world_m(self.plan, self.scatterer.world)).powi(2).min(1.0),
            velocity_quantum_mps: velocity_quantum_mps(self.plan.header),
            wavenumbers_per_m: &wavenumbers,
            accuracy_of_body,
            bracket: bracket_of(self.plan.header.fidelity.nodes),
            room,
        };
        let mut paths = Vec::new();
        for (index, meeting) in self.meetings.iter().enumerate() {
            paths.extend(self.of_order(meeting, slides.as_ref().map(|of| of.of_order(index)), &settings)?);
        }
        Ok(paths)
    }

    fn of_order(
        &self,
        meeting: &OrderJoints,
        slides: Option<SlidesOfOrder<'_>>,
        settings: &CellSettings<'_>,
    ) -> Result<Vec<Path>, BartError> {
        let BlendNode { seconds, ends_m, .. } = self.node;
        let mut found = cells(self.scatterer, (&meeting.facets, slides), settings);
        found.extend(edge_cells(self.scatterer, &meeting.edges, settings));
        found.extend(truncation_cells(self.scatterer, &meeting.truncations, settings));
        settings.room.check()?;
        let path_of = |cell: Cell| path_of(&cell, self.plan, seconds);
        Ok(gathered(found, self.scatterer.world, ends_m.map(Antenna::Point), settings, path_of))
    }
}

/// Function that blends a table from several nodes, if that helps, while other tables of a number of bytes
/// are held.
pub(crate) type Blend<'a> = dyn Fn(PathTable, u64) -> Result<PathTable, BartError> + 'a;
/// Function that makes a table with cells of a given size, while other tables of a number of bytes are held.
type Attempt<'a> = dyn Fn(f64, u64) -> Result<PathTable, BartError> + 'a;

/// Number of paths of a table from which no finer one is tried once moments were: more take minutes and
/// gigabytes.
const REFINED_PATHS_MAX: usize = 200_000;

/// Limits of the search for a table of smaller cells.
#[derive(Clone, Copy)]
struct SearchLimits {
    /// Number of paths of a table from which no finer one is tried.
    tried: usize,
    /// Maximum number of paths expected for the next table, given that their number grows with the inverse
    /// square of the cell size.
    next: usize,
}

/// Limits of a search for cells to be blended.
const BLENDED: SearchLimits = SearchLimits { tried: REFINED_PATHS_MAX, next: PATHS_MAX };
/// Limits where neither cells nor moments met the accuracy: an echo that almost vanishes relative to the
/// scattering of its parts (a flat side off its specular direction) would take any number of paths, and is
/// not accurate with a million.
const LAST: SearchLimits = SearchLimits { tried: REFINED_PATHS_MAX, next: 2 * REFINED_PATHS_MAX };
/// Minimum ratio, 1 dB, by which smaller cells of any size could reduce the error and meet the accuracy, for
/// them to be tried.
const WORTH_TRYING: f64 = 1.12;
/// Number of beams below which a moment takes next to no time: outlines slide before others are tried.
const FEW_BEAMS: usize = 1000;
/// Ratio of the error of outlines that slide to that of fixed ones below which they are worth their nodes,
/// each of which takes several times as long.
const WORTH_SLIDING: f64 = 0.7;
/// Ratio of the error to what is allowed, 1 dB, from which on both outlines that slide and fixed ones are
/// tried.
const FAR_OFF: f64 = 1.12;
/// Cell size relative to the first above which cells do not predict the error of smaller ones: a few paths
/// match or miss the check's moment by chance, and the error that moments leave of large cells is not known
/// before it is tried.
const TELLING: f64 = 0.35;

/// Common inputs of every attempt at a table.
pub(crate) struct Fit<'a> {
    parts: BodyParts<'a>,
    /// Paths of point targets, which are exact and part of the frame.
    points: &'a [Path],
    reference: &'a FrameReference,
    beams: [f64; 2],
}

impl<'a> Fit<'a> {
    pub(crate) fn new(
        scenery: &'a TracedScene<'a>,
        scatterer: &'a Scatterer<'a>,
        points: &'a [Path],
        reference: &'a FrameReference,
    ) -> Self {
        let plan = scenery.plan;
        let parts = BodyParts::of(scenery, scatterer);
        let beams = dropped_sections(scatterer, plan, &parts.meetings);
        Self { parts, points, reference, beams }
    }

    /// Table with the largest cells that meet the accuracy; the best found if none does within a few
    /// attempts.
    ///
    /// Smaller cells follow phases that rotate during the frame, and if they do not meet the accuracy,
    /// `split` blends their table from several moments. Large cells are blended at once if wheels rotate,
    /// which no cells follow, and if smaller ones would have more paths than all moments together, or too
    /// many to be blended.
    pub(crate) fn table(&self, split: &Blend<'_>) -> Result<PathTable, BartError> {
        let BodyParts { scatterer, plan, .. } = self.parts;
        let largest_m = largest_cell_of_world_m(plan, scatterer.world);
        if scatterer.world.fastest_wheel_radps() > 0.0 {
            let split_to = |cell_m, others| split(self.table_of(cell_m, Outlines::Fixed, others)?, others);
            let largest = split_to(largest_m, 0)?;
            return Ok(self.with_smaller_cells(largest, BLENDED, 0, &split_to)?.0);
        }
        let fixed = self.table_of(largest_m, Outlines::Fixed, 0)?;
        let is_simple = self.parts.scatterer.trees.transmit().beams.len() < FEW_BEAMS;
        let first = if is_simple { self.with_sliding_outlines(&fixed)? } else { None };
        let (best, other) = match first {
            None => (self.searched(fixed, split)?, None),
            Some(sliding) => (self.searched(sliding, split)?, Some(fixed)),
        };
        if best.error.measured() <= FAR_OFF * self.parts.plan.allowed_error() {
            return Ok(best);
        }
        let other = match other {
            None => self.with_sliding_outlines(&best)?,
            some => some,
        };
        // Of many beams each further node takes its time: outlines have to help at once.
        let helps = |of: &PathTable| is_simple || of.error.measured() < WORTH_SLIDING * best.error.measured();
        let Some(other) = other.filter(helps) else { return Ok(best) };
        let found = self.searched(other, split)?;
        Ok(if found.error.measured() < best.error.measured() { found } else { best })
    }

    /// A table in the largest cells, or in those of a table in which alone polygons are large, with outlines
    /// that slide; `None` if none does, or if the table meets the accuracy or misses it for other reasons.
    fn with_sliding_outlines(&self, fixed: &PathTable) -> Result<Option<PathTable>, BartError> {
        let BodyParts { scatterer, plan, .. } = self.parts;
        if self.is_met(fixed) || !fixed.error.is_mostly_freezing() {
            return Ok(None);
        }
        let sizes_m = [largest_cell_of_world_m(plan, scatterer.world), fixed.fineness.cell_m];
        match sizes_m.into_iter().find(|cell_m| self.parts.has_sliding_outlines(*cell_m)) {
            Some(cell_m) => self.table_of(cell_m, Outlines::Sliding, fixed.paths_bytes()).map(Some),
            None => Ok(None),
        }
    }

    /// Table with the largest cells that meet the accuracy, from that of the largest ones on.
    fn searched(&self, largest: PathTable, split: &Blend<'_>) -> Result<PathTable, BartError> {
        let (largest_m, outlines) = (largest.fineness.cell_m, largest.fineness.outlines);
        let alone = |cell_m: f64, others: u64| self.table_of(cell_m, outlines, others);
        let split_to = |cell_m: f64, others: u64| split(self.table_of(cell_m, outlines, others)?, others);
        let most = largest.paths.len().saturating_mul(MOMENTS_MAX as usize);
        let limits = SearchLimits { tried: most, next: PATHS_MAX };
        let (best, tried) = self.with_smaller_cells(largest, limits, 0, &alone)?;
        if self.is_met(&best) || tried <= most.min(PATHS_MAX / MOMENTS_USUAL as usize) {
            return split(best, 0);
        }
        let blended = split_to(largest_m, best.paths_bytes())?;
        if blended.fineness.moments.max(blended.fineness.places) == 1 {
            drop(blended);
            return Ok(self.with_smaller_cells(best, LAST, 0, &alone)?.0);
        }
        let (blended, _) = self.with_smaller_cells(blended, BLENDED, best.paths_bytes(), &split_to)?;
        Ok(if blended.error.measured() < best.error.measured() { blended } else { best })
    }

    fn is_met(&self, table: &PathTable) -> bool {
        table.error.measured() <= self.parts.plan.allowed_error()
    }

    /// Best of a few tables with ever smaller cells, until one meets the accuracy, has more paths than a
    /// limit, or shows that smaller ones would not help; and the number of paths of the last. Other tables of
    /// a number of bytes are held meanwhile.
    fn with_smaller_cells(
        &self,
        largest: PathTable,
        limits: SearchLimits,
        others: u64,
        table: &Attempt<'_>,
    ) -> Result<(PathTable, usize), BartError> {
        const ATTEMPTS: usize = 6;
        let plan = self.parts.plan;
        let asked = plan.allowed_error();
        let (first_m, first) = (largest.fineness.cell_m, largest.error.measured());
        let (mut size_m, mut tried) = (first_m, largest.paths.len());
        let mut best = largest;
        for _ in 1..ATTEMPTS {
            let error = best.error.measured();
            if error <= asked || size_m <= plan.band.wavelength_m() || tried > limits.tried {
                break;
            }
            // Errors of freezing and of the linear fit over frequency grow with the first to second power of
            // the size.
            let factor = (0.7 * asked / error).sqrt().clamp(0.4, 0.8);
            if tried as f64 > limits.next as f64 * factor * factor {
                break;
            }
            size_m *= factor;
            let finer = table(size_m, others + best.paths_bytes())?;
            tried = finer.paths.len();
            if finer.error.measured() < error {
                best = finer;
            }
            let left = left_without_cells(first, best.error.measured(), size_m / first_m);
            if size_m < TELLING * first_m && left > asked && best.error.measured() < WORTH_TRYING * left {
                break;
            }
        }
        Ok((best, tried))
    }

    fn table_of(&self, cell_m: f64, outlines: Outlines, others: u64) -> Result<PathTable, BartError> {
        let integration = &self.reference.integration;
        let accuracy_of_body = integration.accuracy_of_body.as_slice();
        let cells = CellFineness { cell_m, accuracy_of_body, outlines };
        let PrunedPaths { mut paths, dropped_powers, strongest_dropped } =
            self.parts.paths(&cells, others)?;
        paths.extend_from_slice(self.points);
        let omitted_powers = OmittedPowers {
            paths_power_m2: dropped_powers.iter().sum(),
            beams: self.beams,
            blends_power_m2: 0.0,
        };
        let error =
            FrameError::measured_on(self.parts.plan, &paths, self.points, self.reference, &omitted_powers);
        let of = |(target, accuracy): (&Target, &f64)| IntegralFineness {
            body: target.id.clone(),
            accuracy: *accuracy,
            echo_error: None,
        };
        let integrals =
            self.parts.plan.header.targets.iter().zip(&integration.accuracy_of_body).map(of).collect();
        let fineness = Fineness {
            cell_m,
            integrals,
            moments: 1,
            ways: vec![],
            places: 1,
            ways_of_places: vec![],
            outlines,
        };
        Ok(PathTable { paths, fineness, error, omitted_powers, dropped_powers, strongest_dropped, bytes: 0 })
    }
}

/// Error that infinitely small cells would leave, if cells `factor` times as large changed an error `coarse`
/// to `fine`: their part of the power falls at least with the square of their size.
fn left_without_cells(coarse: f64, fine: f64, factor: f64) -> f64 {
    let by_cells = (coarse.powi(2) - fine.powi(2)) / (1.0 - factor.powi(2));
    (coarse.powi(2) - by_cells.max(0.0)).max(0.0).sqrt()
}

/// Maximum side of the cells that one node, one amplitude and its slope may represent; smaller ones are tried
/// if the measured error requires it.
///
/// Within D/2 of its node the two-way length of a lit point differs from the node's by up to D: over the
/// band, ±Δk with Δk = πB/c, its phase varies by ±ΔkD, and a linear fit over frequency leaves at most
/// (ΔkD)²/4 of it. While the node moves by vT/2 at a right angle, or is seen from an element δ off the
/// radar's position, both legs rotate by (vT/2 + δ)/R: the phase between node and point varies by kD(vT/2 +
/// δ)/R. Neighbouring cells cancel most of both (physics.md §6 has −41 dB with cells of 12 cm where this
/// bound gives −14 dB), so either may reach four times the requested accuracy. A body that rotates by ωT/2
/// rotates the line from node to point equally against both legs.
pub fn largest_cell_m(header: &SceneHeader, nearest_m: f64, fastest_mps: f64, turn_radps: f64) -> f64 {
    let waveform = &header.radar.waveform;
    let allowed = 4.0 * header.fidelity.accuracy.amplitude();
    let band_per_m = std::f64::consts::PI * waveform.bandwidth_hz().abs() / SPEED_OF_LIGHT_MPS;
    let by_band = 2.0 * allowed.sqrt() / band_per_m;
    let wavenumber = TAU / waveform.wavelength_m();
    let half_frame_s = 0.5 * header.radar.frame_duration_s();
    let way_m = half_frame_s * fastest_mps + element_offset_m(header) + half_frame_s * turn_radps * nearest_m;
    let by_motion = allowed * nearest_m / (wavenumber * way_m);
    // For a sweep over more than a quarter of its carrier, range cells are finer than two wavelengths.
    let smallest_m = 2.0 * waveform.wavelength_m();
    by_band.min(by_motion).clamp(smallest_m, waveform.range_resolution_m().max(smallest_m))
}

/// Maximum side of cells on wheels, where other cells have side `cell_m`; smaller cells scale along.
///
/// While a wheel rotates, the phase of a point D/2 off its node rotates relative to it by kDω·t two-way,
/// which no path's own motion follows. Wheels are traced at several moments where that matters, and a cubic
/// through moments between which the phase rotates by θ errs by 3/128·θ⁴ ([`crate::frame::blends`]): D is
/// such that a grid half as fine as the finest meets the requested accuracy. Outlines of shadows rotate
/// faster than cells do.
fn wheel_cell_m(plan: &Plan<'_>, world: &World, cell_m: f64) -> f64 {
    let wheel_radps = world.fastest_wheel_radps();
    if wheel_radps == 0.0 {
        return cell_m;
    }
    let turn = (128.0 / 3.0 * plan.allowed_error()).powf(0.25);
    let step_s = plan.header.radar.frame_duration_s() / f64::from(WHEEL_STEPS / 2);
    let wavelength_m = plan.band.wavelength_m();
    let largest_m = turn * wavelength_m / (TAU * wheel_radps * step_s);
    let finer = (cell_m / largest_cell_of_world_m(plan, world)).min(1.0);
    (finer * largest_m).max(wavelength_m)
}

/// Maximum side of cells for the bodies of a world.
pub(crate) fn largest_cell_of_world_m(plan: &Plan<'_>, world: &World) -> f64 {
    let ranges_m = world.facets().iter().map(|f| plan.position_m.distance(f.corners_m[0]));
    let nearest_m = ranges_m.fold(f64::INFINITY, f64::min);
    largest_cell_m(plan.header, nearest_m, world.fastest_mps(), world.fastest_turn_radps())
}

/// Maximum distance of an element from the radar's position.
pub fn element_offset_m(header: &SceneHeader) -> f64 {
    let array = &header.radar.array;
    let centre = DVec3::from_array(header.radar.position_m);
    let elements = array.tx_m.iter().chain(&array.rx_m);
    elements.map(|p| DVec3::from_array(*p).distance(centre)).fold(0.0, f64::max)
}

/// Velocity difference below which the phase k·Δv·T/2 of each leg stays below the accuracy.
fn velocity_quantum_mps(header: &SceneHeader) -> f64 {
    let half_frame_s = 0.5 * header.radar.frame_duration_s();
    let wavenumber = TAU / header.radar.waveform.wavelength_m();
    header.fidelity.accuracy.amplitude() / (2.0 * wavenumber * half_frame_s)
}

/// Path of a cell in its state some `seconds` after the frame's first sample.
fn path_of(cell: &Cell, plan: &Plan<'_>, seconds: f64) -> Path {
    let (amplitude_m, slope_m_per_hz) = plan.band.line(&cell.amplitudes_m);
    let at_first_sample = [0, 1].map(|end| cell.motion[end].after(cell.apparent_m[end], -seconds));
    let [(tx_m, tx_mps), (rx_m, rx_mps)] =
        at_first_sample.map(|(at_m, mps)| (at_m.to_array(), mps.to_array()));
    let [tx_mps2, rx_mps2] = cell.motion.map(|motion| motion.acceleration_mps2.to_array());
    Path {
        target: cell.facets[0].body,
        order: cell.order,
        apparent_tx_m: tx_m,
        apparent_tx_mps: tx_mps,
        apparent_rx_m: rx_m,
        apparent_rx_mps: rx_mps,
        amplitude_m,
        slope_m_per_hz,
        facets: cell.facets,
        curve: Curve {
            apparent_tx_mps2: tx_mps2,
            apparent_rx_mps2: rx_mps2,
            array_side: cell.side.map(|side| side.of_row(plan.row.axis)),
            ..Curve::default()
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smaller_cells_leave_what_cells_do_not_make() {
        // Cells cause all of it, in proportion to their size.
        assert!(left_without_cells(0.3, 0.15, 0.5) < 1e-9);
        // Of √(0.3² + 0.4²) = 0.5, 0.3 is due to cells; √(0.15² + 0.4²) with cells of half the size.
        assert!(
            (left_without_cells(0.5, (0.15_f64.powi(2) + 0.4_f64.powi(2)).sqrt(), 0.5) - 0.4).abs() < 1e-12
        );
        // Cells cause none of it: the error remains, even if chance increased it slightly.
        assert_eq!(left_without_cells(0.7, 0.7, 0.4), 0.7);
        assert!((left_without_cells(0.7, 0.71, 0.4) - 0.7).abs() < 1e-12);
    }
}
