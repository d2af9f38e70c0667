//! Parts of large polygons as paths from the nodes of a grid, among which their points are shared.

use crate::frame::cells::path_cells::{Cell, CellKind, CellsOfJoint};
use crate::geometry::convex_intersection::{bounds, left_of};
use crate::geometry::plane_frame::{PlaneFrame, area_m2};
use crate::integral::field::Field;
use crate::integral::interpolation::{DEGREE, ElementSums, GridElement, NODES, cells_along};
use crate::integral::node::Estimate;
use crate::joins::scatterer::{PolygonPart, Scatterer, sum};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// Coarsest accuracy of the integrals: the grid cuts tiles so that their errors do not cancel as those of the
/// whole polygon do.
const COARSEST: f64 = 1e-3;
/// Nodes of an element.
const NODES_OF_ELEMENT: u32 = (NODES * NODES) as u32;

impl CellsOfJoint<'_> {
    /// Nodes of a grid that covers a convex polygon; elements share those on their borders.
    pub(super) fn grid_nodes(&self, frame: PlaneFrame, polygon_m: &[DVec2]) -> Vec<Cell> {
        let mut nodes: BTreeMap<[u32; 2], Cell> = BTreeMap::new();
        for (place, element) in elements(frame, polygon_m, self.side_m) {
            let pieces = pieces(&element, polygon_m);
            if pieces.is_empty() {
                continue;
            }
            if !self.has_room_for(NODES_OF_ELEMENT) {
                break;
            }
            for (index, node) in (0..).zip(self.element_nodes(&element, &pieces)) {
                let steps = [index % NODES as u32, index / NODES as u32];
                add(&mut nodes, [place[0] + steps[0], place[1] + steps[1]], node);
            }
        }
        nodes.into_values().collect()
    }

    /// Nodes of an element with the pieces of a polygon in it.
    fn element_nodes(&self, element: &GridElement, pieces: &[Vec<DVec2>]) -> Vec<Cell> {
        let wavenumbers_per_m = self.settings.wavenumbers_per_m;
        let mut sums = ElementSums::none(wavenumbers_per_m.len());
        for piece in pieces {
            self.with_piece(element, piece, |field| {
                field.add_interpolated(element, wavenumbers_per_m, &mut sums);
            });
        }
        let share = 1.0 / f64::from(NODES_OF_ELEMENT);
        let area_m2 = share * pieces.iter().map(|piece| area_m2(piece)).sum::<f64>();
        let error = share * sums.error_m;
        let node = |(node_m, value): (DVec3, _)| {
            let mut estimate = Estimate { value, error };
            Scatterer::weigh(self.joint, wavenumbers_per_m, &mut estimate);
            self.cell(CellKind::FixedNode, node_m, area_m2, estimate)
        };
        let amplitudes =
            self.with_piece(element, &pieces[0], |field| sums.of_paths(field, element, wavenumbers_per_m));
        element.nodes_m().zip(amplitudes).map(node).collect()
    }

    /// Integrand over a piece, as of the element's middle.
    fn with_piece<T>(&self, element: &GridElement, piece: &[DVec2], of: impl FnOnce(&Field<'_>) -> T) -> T {
        let corners_m: Vec<DVec3> = piece.iter().map(|c| element.frame.to_world(*c)).collect();
        let (reference_m, bracket) = (element.middle_m(), self.settings.bracket);
        let part = PolygonPart { corners_m: &corners_m, reference_m, bracket };
        let request = (self.settings.wavenumbers_per_m, self.accuracy.min(COARSEST));
        self.scatterer.with_field(self.joint, &part, request, of)
    }
}

/// Adds a node's share to what there is at its place.
fn add(nodes: &mut BTreeMap<[u32; 2], Cell>, place: [u32; 2], node: Cell) {
    match nodes.entry(place) {
        Entry::Vacant(place) => {
            place.insert(node);
        }
        Entry::Occupied(mut place) => {
            let there = place.get_mut();
            there.area_m2 += node.area_m2;
            there.error_m += node.error_m;
            for (total, own) in there.amplitudes_m.iter_mut().zip(&node.amplitudes_m) {
                *total = sum(total, own);
            }
        }
    }
}

/// Elements of a grid of cells of at most `side_m` over a polygon's rectangle, with the column and the row of
/// each one's first node.
fn elements(
    frame: PlaneFrame,
    polygon_m: &[DVec2],
    side_m: f64,
) -> impl Iterator<Item = ([u32; 2], GridElement)> {
    let [low, high] = bounds(polygon_m);
    let [columns, rows] = (high - low).to_array().map(|length_m| cells_along(length_m, side_m));
    let cell_m = (high - low) / DVec2::new(f64::from(columns), f64::from(rows));
    let steps = |count: u32| (0..count).step_by(DEGREE as usize);
    let places = steps(columns).flat_map(move |column| steps(rows).map(move |row| [column, row]));
    places.map(move |place| {
        let low_m = low + DVec2::from_array(place.map(f64::from)) * cell_m;
        (place, GridElement { frame, low_m, cell_m })
    })
}

/// Parts of a convex polygon in the cells of an element.
fn pieces(element: &GridElement, polygon_m: &[DVec2]) -> Vec<Vec<DVec2>> {
    let GridElement { low_m, cell_m, .. } = *element;
    let within = |part: &[DVec2], low_m: DVec2, axis: DVec2| {
        left_of(&left_of(part, low_m, -axis.perp()), low_m + cell_m, axis.perp())
    };
    let mut pieces = vec![];
    for i in 0..DEGREE {
        let strip_m = low_m + DVec2::new(f64::from(i) * cell_m.x, 0.0);
        let strip = within(polygon_m, strip_m, DVec2::X);
        let piece = |j| within(&strip, strip_m + DVec2::new(0.0, f64::from(j) * cell_m.y), DVec2::Y);
        pieces.extend((0..DEGREE).map(piece));
    }
    pieces.retain(|piece| area_m2(piece) > 0.0);
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_of_all_elements_are_the_polygon() {
        let polygon_m = [[0.0, 0.0], [1.0, 0.2], [0.7, 0.9], [0.1, 0.5]].map(DVec2::from_array);
        let frame = PlaneFrame::new(DVec3::ZERO, DVec3::Z);
        let mut covered_m2 = 0.0;
        for (_, element) in elements(frame, &polygon_m, 0.07) {
            assert!(element.cell_m.max_element() <= 0.07);
            for piece in pieces(&element, &polygon_m) {
                let [low, high] = bounds(&piece);
                assert!((high - low - element.cell_m).max_element() <= 1e-12);
                covered_m2 += area_m2(&piece);
            }
        }
        assert!((covered_m2 - area_m2(&polygon_m)).abs() < 1e-14);
    }
}
