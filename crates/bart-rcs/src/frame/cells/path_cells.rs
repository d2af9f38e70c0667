//! Lit polygons cut and gathered into cells so small that one node, one amplitude and one slope stand for
//! each during a frame.

use crate::beams::beam::BeamTree;
use crate::beams::image_tree::origin;
use crate::bodies::motion::Motion;
use crate::bodies::road::HalfSpace;
use crate::bodies::world::World;
use crate::frame::cells::cell_memory::CellMemory;
use crate::frame::cells::corner_slide::{ApparentPoints, BorderPlace, RowSide, SlidesOfJoint, SlidesOfOrder};
use crate::frame::cells::critical_cells::{SplitJoint, split_joint};
use crate::geometry::antenna::Antenna;
use crate::geometry::convex_intersection::{bounds, left_of};
use crate::geometry::plane_frame::{PlaneFrame, area_m2, centroid_m};
use crate::integral::critical_points::COARSEST;
use crate::integral::critical_points::terms::CriticalPoint;
use crate::integral::field::length_difference_m;
use crate::integral::node::{Bracket, Estimate};
use crate::joins::joint::{Joint, Joints, Reverse};
use crate::joins::scatterer::{Integration, PolygonPart, Scatterer, scaled, sequence, sum, transposed};
use artifact::paths::{Amplitude, Facet, MAX_ORDER, Path};
use glam::{DVec2, DVec3};
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// A part of the scattering with one node: amplitudes at several frequencies, apparent points and their
/// velocities.
#[derive(Debug, Clone)]
pub(crate) struct Cell {
    pub(crate) order: u8,
    pub(crate) facets: [Facet; MAX_ORDER],
    /// Apparent points from the transmitter and from the receiver; world metres at the world's instant.
    pub(crate) apparent_m: [DVec3; 2],
    pub(crate) motion: [Motion; 2],
    /// `a` of a path record at each wavenumber.
    pub(crate) amplitudes_m: Vec<Amplitude>,
    pub(crate) area_m2: f64,
    /// Bound of the error of every amplitude.
    pub(crate) error_m: f64,
    pub(crate) kind: CellKind,
    /// Side of the array's row that it stands for; `None` for all pairs of elements.
    pub(crate) side: Option<RowSide>,
}

/// Kinds of cells, which are not gathered with each other: the node of a corner is the corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum CellKind {
    /// A part of an area, or a diffracting edge.
    PolygonPart,
    /// A term of a large polygon, or a node of its grid: gathered with others at the same point alone.
    FixedNode,
}

/// Bytes of a cell with its amplitudes at three frequencies where it is made, in a list that has grown to
/// more than it needs, in the list of all, and as the path that it becomes (1.39 KB were measured).
pub(crate) const BYTES_PER_CELL: usize =
    3 * size_of::<Cell>() + 2 * 3 * size_of::<Amplitude>() + size_of::<Path>();

/// Size of cells, and how exactly they are integrated.
#[derive(Clone, Copy)]
pub(crate) struct CellSettings<'a> {
    pub(crate) size_m: f64,
    /// Size of cells on wheels that turn, and of ways that meet one.
    pub(crate) wheel_size_m: f64,
    /// Accuracy of large polygons, relative to that of cells of the largest size: both are refined together.
    pub(crate) refinement: f64,
    /// Apparent points whose velocities differ by less may share a cell.
    pub(crate) velocity_quantum_mps: f64,
    pub(crate) wavenumbers_per_m: &'a [f64],
    /// Accuracy of every integral, by the body that it is taken on.
    pub(crate) accuracy_of_body: &'a [f64],
    pub(crate) bracket: Bracket,
    /// No more cells are made than it has a place for.
    pub(crate) room: &'a CellMemory,
}

impl CellSettings<'_> {
    /// Largest side of the cells of a way that meets some facets.
    pub(crate) fn side_m(&self, world: &World, facets: &[Facet]) -> f64 {
        let is_on_wheel =
            self.wheel_size_m < self.size_m && facets.iter().any(|facet| world.is_wheel(facet.body));
        if is_on_wheel { self.wheel_size_m } else { self.size_m }
    }
}

/// Cells of all joints, the reverse ones behind their own; in the order of the joints.
pub(crate) fn cells(
    scatterer: &Scatterer<'_>,
    (joints, slides): (&Joints, Option<SlidesOfOrder<'_>>),
    settings: &CellSettings<'_>,
) -> Vec<Cell> {
    let of_joint = |(index, joint): (usize, &Joint)| {
        let slide = slides.and_then(|slides| slides.of_joint(index));
        cells_of(scatterer, (joint, joints.polygon(joint)), settings, slide)
    };
    joined(joints.list.par_iter().enumerate().map(of_joint).collect())
}

/// Cells in one list, which has room for no more than these.
pub(crate) fn joined(parts: Vec<Vec<Cell>>) -> Vec<Cell> {
    let mut all = Vec::with_capacity(parts.iter().map(Vec::len).sum());
    parts.into_iter().for_each(|part| all.extend(part));
    all
}

/// Cells whose apparent points lie in one cube, seen through the same bodies and as fast, become one, and
/// that one a path.
pub(crate) fn gathered(
    mut cells: Vec<Cell>,
    world: &World,
    ends: [Antenna; 2],
    settings: &CellSettings<'_>,
    path_of: impl Fn(Cell) -> Path,
) -> Vec<Path> {
    let side_m = |cell: &Cell| settings.side_m(world, &cell.facets[..usize::from(cell.order)]);
    let key = |cell: &Cell| key(cell, ends, side_m(cell), settings.velocity_quantum_mps);
    cells.sort_by_cached_key(key);
    cells.chunk_by(|a, b| key(a) == key(b)).map(|group| path_of(one_of(group, ends, settings))).collect()
}

fn cells_of(
    scatterer: &Scatterer<'_>,
    (joint, corners_m): (&Joint, &[DVec3]),
    settings: &CellSettings<'_>,
    slides: Option<SlidesOfJoint<'_>>,
) -> Vec<Cell> {
    let facets = facets_of(scatterer, joint.forward, joint.backward);
    let accuracy = settings.accuracy_of_body[scatterer.node_body(joint.forward)];
    let side_m = settings.side_m(scatterer.world, &facets);
    let CellSettings { wavenumbers_per_m, bracket, .. } = *settings;
    let of_large = settings.refinement * (OF_TERMS * accuracy).min(COARSEST);
    let request = Integration { wavenumbers_per_m, accuracy: of_large, bracket };
    let of_joint = CellsOfJoint { scatterer, joint, facets, settings, side_m, accuracy };
    let mut cells = match split_joint(scatterer, joint, corners_m, (side_m, slides.is_some()), &request) {
        SplitJoint::Small(frame, polygon_m) => of_joint.squares(&frame, polygon_m),
        SplitJoint::Large(frame, near_m, terms) => {
            let near = near_m.iter().flat_map(|part_m| of_joint.grid_nodes(frame, part_m));
            let terms = terms.into_iter().map_while(|(term, place)| {
                let cell = of_joint.term(term)?;
                let cells = match slides {
                    Some(slides) => slid(cell, slides, &place),
                    None => vec![cell],
                };
                (cells.len() == 1 || of_joint.has_room_for(1)).then_some(cells)
            });
            near.chain(terms.flatten()).collect()
        }
    };
    if joint.reverse == Reverse::Included {
        let back: Vec<Cell> = cells.iter().map(reversed).collect();
        cells.extend(back);
    }
    cells
}

/// The cell of a term as it slides with the outline, on each side of the array's row.
fn slid(cell: Cell, slides: SlidesOfJoint<'_>, place: &BorderPlace) -> Vec<Cell> {
    let points = [0, 1].map(|end| (cell.apparent_m[end], cell.motion[end]));
    let of_side = |(side, ends): (Option<RowSide>, ApparentPoints)| Cell {
        apparent_m: ends.map(|(at_m, _)| at_m),
        motion: ends.map(|(_, motion)| motion),
        side,
        ..cell.clone()
    };
    slides.sliding(&points, place).into_iter().map(of_side).collect()
}

/// Accuracy of the terms of large polygons relative to that of integrals: of several corners less may be left
/// than any of them.
const OF_TERMS: f64 = 0.2;

/// Cells of a joint, as long as there is room for them.
pub(super) struct CellsOfJoint<'a> {
    pub(super) scatterer: &'a Scatterer<'a>,
    pub(super) joint: &'a Joint,
    facets: Vec<Facet>,
    pub(super) settings: &'a CellSettings<'a>,
    pub(super) side_m: f64,
    pub(super) accuracy: f64,
}

impl CellsOfJoint<'_> {
    fn squares(&self, frame: &PlaneFrame, polygon_m: Vec<DVec2>) -> Vec<Cell> {
        let square = |piece: Vec<DVec2>| {
            let reference_m = frame.to_world(centroid_m(&piece));
            let corners_m: Vec<DVec3> = piece.iter().map(|c| frame.to_world(*c)).collect();
            let part = PolygonPart { corners_m: &corners_m, reference_m, bracket: self.settings.bracket };
            let (joint, wavenumbers_per_m) = (self.joint, self.settings.wavenumbers_per_m);
            let estimate = self.scatterer.amplitudes(joint, &part, wavenumbers_per_m, self.accuracy);
            self.cell(CellKind::PolygonPart, reference_m, area_m2(&piece), estimate)
        };
        let squares = cut_into_squares(polygon_m, self.side_m);
        squares.into_iter().map_while(|piece| self.has_room_for(1).then(|| square(piece))).collect()
    }

    fn term(&self, CriticalPoint { at_m, length_m, amplitudes, .. }: CriticalPoint) -> Option<Cell> {
        let corner_m = 1.0 / highest_per_m(self.settings);
        let area_m2 = as_area_m2(length_m + corner_m, self.settings);
        self.has_room_for(1).then(|| self.cell(CellKind::FixedNode, at_m, area_m2, amplitudes))
    }

    pub(super) fn has_room_for(&self, cells: u32) -> bool {
        self.settings.room.take(cells * self.joint.reverse.ways())
    }

    pub(super) fn cell(
        &self,
        kind: CellKind,
        node_m: DVec3,
        area_m2: f64,
        estimate: Estimate<Vec<Amplitude>>,
    ) -> Cell {
        Cell {
            order: self.facets.len() as u8,
            facets: padded(&self.facets),
            apparent_m: self.scatterer.apparent_m(self.joint, node_m),
            motion: motions(self.scatterer, self.joint.forward, self.joint.backward, node_m),
            amplitudes_m: estimate.value,
            area_m2,
            error_m: estimate.error,
            kind,
            side: None,
        }
    }
}

/// The area whose largest amplitude, kA/√π, is an edge's, length/√π: its weight among polygons. A corner's,
/// 1/k√π, is that of an edge of 1/k.
pub(crate) fn as_area_m2(length_m: f64, settings: &CellSettings<'_>) -> f64 {
    length_m / highest_per_m(settings)
}

fn highest_per_m(settings: &CellSettings<'_>) -> f64 {
    settings.wavenumbers_per_m.iter().copied().fold(TAU, f64::max)
}

/// The cell of the way back.
pub(crate) fn reversed(cell: &Cell) -> Cell {
    let mut facets = cell.facets;
    facets[..usize::from(cell.order)].reverse();
    Cell {
        facets,
        apparent_m: [cell.apparent_m[1], cell.apparent_m[0]],
        motion: [cell.motion[1], cell.motion[0]],
        amplitudes_m: cell.amplitudes_m.iter().map(transposed).collect(),
        side: cell.side.map(RowSide::other),
        ..*cell
    }
}

/// The facets of a way in the order of travel, by its beams.
pub(crate) fn facets_of(scatterer: &Scatterer<'_>, forward: u32, backward: u32) -> Vec<Facet> {
    sequence(scatterer, forward, backward).into_iter().map(|facet| scatterer.world.facet(facet).id).collect()
}

/// Facets as a path record holds them.
pub(crate) fn padded(facets: &[Facet]) -> [Facet; MAX_ORDER] {
    let mut all = [Facet::default(); MAX_ORDER];
    all.iter_mut().zip(facets).for_each(|(place, facet)| *place = *facet);
    all
}

/// Motions of the apparent points of a node at `node_m`.
pub(crate) fn motions(scatterer: &Scatterer<'_>, forward: u32, backward: u32, node_m: DVec3) -> [Motion; 2] {
    let world = scatterer.world;
    let of_node = world.motion(scatterer.trees.transmit().beams[forward as usize].facet, node_m);
    let through = |tree: &BeamTree, beam: u32| {
        let mirrors =
            std::iter::successors(tree.beams[beam as usize].parent, |b| tree.beams[*b as usize].parent);
        let (_, at_antenna) = mirrors.fold((node_m, of_node), |(at_m, motion), mirror| {
            world.moving_plane(tree.beams[mirror as usize].facet).image(at_m, motion)
        });
        match origin(tree, &tree.beams[beam as usize]) {
            HalfSpace::Above => at_antenna,
            HalfSpace::Below => at_antenna.below_road(),
        }
    };
    [through(scatterer.trees.transmit(), forward), through(scatterer.trees.receive(), backward)]
}

/// Convex parts of a polygon between the lines of a square grid.
pub(crate) fn cut_into_squares(polygon: Vec<DVec2>, size_m: f64) -> Vec<Vec<DVec2>> {
    let strips = cut_along(polygon, DVec2::X, size_m);
    strips.into_iter().flat_map(|strip| cut_along(strip, DVec2::Y, size_m)).collect()
}

/// Strips of equal width, at most `size_m`, across `axis`.
fn cut_along(polygon: Vec<DVec2>, axis: DVec2, size_m: f64) -> Vec<Vec<DVec2>> {
    let [low, high] = bounds(&polygon).map(|corner| corner.dot(axis));
    let count = ((high - low) / size_m).ceil().max(1.0);
    let line = |i: f64| axis * (low + (high - low) * i / count);
    let mut strips = Vec::new();
    let mut rest = polygon;
    for i in 1..count as u64 {
        strips.push(left_of(&rest, line(i as f64), axis.perp()));
        rest = left_of(&rest, line(i as f64), -axis.perp());
    }
    strips.push(rest);
    strips.retain(|strip| area_m2(strip) > 0.0);
    strips
}

/// Key that cells must have in common to be gathered.
type Key = (u8, (CellKind, Option<RowSide>), [u32; MAX_ORDER], [[i64; 3]; 4]);

/// Distance below which fixed nodes are the same point, m.
const SAME_POINT_M: f64 = 1e-6;

/// Cubes are counted from the antennas, so that a scene moved as a whole keeps its cells.
fn key(cell: &Cell, ends: [Antenna; 2], side_m: f64, quantum_mps: f64) -> Key {
    let cube = |v: DVec3, side: f64| (v / side).round().to_array().map(|x| x as i64);
    let side_m = if cell.kind == CellKind::FixedNode { SAME_POINT_M } else { side_m };
    let places = [0, 1].map(|end| cube(-ends[end].towards(cell.apparent_m[end]), side_m));
    let speeds = cell.motion.map(|motion| cube(motion.velocity_mps, quantum_mps));
    let kind = (cell.kind, cell.side);
    (cell.order, kind, cell.facets.map(|facet| facet.body), [places[0], places[1], speeds[0], speeds[1]])
}

/// The sum of a group as seen from its centre of area; named by its strongest member.
fn one_of(group: &[Cell], ends: [Antenna; 2], settings: &CellSettings<'_>) -> Cell {
    let area_m2: f64 = group.iter().map(|cell| cell.area_m2).sum();
    let mean = |of: &dyn Fn(&Cell) -> DVec3| group.iter().map(|c| c.area_m2 * of(c)).sum::<DVec3>() / area_m2;
    let apparent_m = [0, 1].map(|end| mean(&|cell: &Cell| cell.apparent_m[end]));
    let motion =
        [0, 1].map(|end| Motion::weighed(group.iter().map(|c| (c.area_m2 / area_m2, c.motion[end]))));
    let strongest =
        group.iter().fold(&group[0], |best, cell| if strength(cell) > strength(best) { cell } else { best });
    let mut amplitudes_m = vec![Amplitude::default(); settings.wavenumbers_per_m.len()];
    let mut error_m = 0.0;
    for cell in group {
        let difference =
            [0, 1].map(|end| length_difference_m(ends[end], cell.apparent_m[end], apparent_m[end]));
        let spread: f64 = (0..2)
            .map(|end| {
                ends[end].path_length_m(apparent_m[end]) / ends[end].path_length_m(cell.apparent_m[end])
            })
            .product();
        for ((total, a), k) in amplitudes_m.iter_mut().zip(&cell.amplitudes_m).zip(settings.wavenumbers_per_m)
        {
            let factor = Complex64::from_polar(spread, -k * (difference[0] + difference[1]));
            *total = sum(total, &scaled(a, factor));
        }
        error_m += spread * cell.error_m;
    }
    Cell { apparent_m, motion, amplitudes_m, area_m2, error_m, ..*strongest }
}

/// Power of the middle frequency, both co-polarizations.
fn strength(cell: &Cell) -> f64 {
    let a = &cell.amplitudes_m[cell.amplitudes_m.len() / 2];
    a[0][0].norm_sqr() + a[1][1].norm_sqr()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_cover_a_polygon_without_overlap() {
        let corners = [[0.0, 0.0], [1.0, 0.2], [0.7, 0.9], [0.1, 0.5]].map(|[x, y]| DVec3::new(x, y, 0.0));
        let frame = PlaneFrame::new(corners[0], DVec3::Z);
        let polygon = corners.map(|c| frame.plane_from_world(c));
        let whole = area_m2(&polygon);
        let pieces = cut_into_squares(polygon.to_vec(), 0.13);
        let total: f64 = pieces.iter().map(|p| area_m2(p)).sum();
        assert!((total - whole).abs() < 1e-14 && pieces.len() > 30);
        for piece in &pieces {
            let [low, high] = bounds(piece);
            assert!((high - low).max_element() <= 0.13 + 1e-12);
        }
    }
}
