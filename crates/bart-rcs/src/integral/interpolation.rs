//! The integral over a lit polygon, shared among the nodes of a grid by interpolation of third degree.
//!
//! While a body moves, the phase of a point changes relative to that of its node. A cell with its node in its
//! middle follows this as a step. What is left is periodic over the cells, and like the lobes of a grating it
//! has speculars of its own, which outweigh a polygon off its specular. Interpolated between the nodes of
//! elements (Lagrange), e^{−jkL} has no steps, and errs by (k·δg·h)⁴/24, δg the change of the length's
//! gradient and h the distance of nodes.

use crate::geometry::plane_frame::PlaneFrame;
use crate::integral::field::Field;
use crate::integral::physical_optics::{for_each_tile, largest_amplitude};
use crate::integral::tile_integrals::QuadraticTriangle;
use artifact::paths::Amplitude;
use glam::{DVec2, DVec3};
use num_complex::Complex64;

/// Cells along a side of an element.
pub(crate) const DEGREE: u32 = 3;
/// Nodes along a side of an element.
pub(crate) const NODES: usize = DEGREE as usize + 1;

/// Values at `x` of the polynomials that are 1 at one of the places 0, 1, 2, 3 and 0 at the others.
pub(crate) fn lagrange(x: f64) -> [f64; NODES] {
    let places = [0.0, 1.0, 2.0, 3.0];
    places.map(|own| {
        let others = places.iter().filter(|other| **other != own);
        others.map(|other| (x - other) / (own - other)).product()
    })
}

/// Number of cells of at most `size_m` along a length, by whole elements.
pub(crate) fn cells_along(length_m: f64, size_m: f64) -> u32 {
    let elements = (length_m / (f64::from(DEGREE) * size_m)).ceil().max(1.0);
    DEGREE * elements as u32
}

/// A rectangle of 3 × 3 cells, among whose 16 nodes integrals are shared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GridElement {
    pub(crate) frame: PlaneFrame,
    pub(crate) low_m: DVec2,
    /// Sides of a cell.
    pub(crate) cell_m: DVec2,
}

impl GridElement {
    pub(crate) fn middle_m(&self) -> DVec3 {
        self.frame.to_world(self.low_m + 0.5 * f64::from(DEGREE) * self.cell_m)
    }

    pub(crate) fn nodes_m(&self) -> impl Iterator<Item = DVec3> {
        let steps = (0..NODES).flat_map(|j| (0..NODES).map(move |i| DVec2::new(i as f64, j as f64)));
        steps.map(|step| self.frame.to_world(self.low_m + step * self.cell_m))
    }

    /// Shares of a point that its nodes have.
    fn shares(&self, x_m: DVec3) -> [f64; NODES * NODES] {
        let place = (self.frame.plane_from_world(x_m) - self.low_m) / self.cell_m;
        let [along, across] = [lagrange(place.x), lagrange(place.y)];
        std::array::from_fn(|node| along[node % NODES] * across[node / NODES])
    }
}

/// Amplitudes of an element's nodes over the wavenumbers, as of its middle.
pub(crate) struct ElementSums {
    of_nodes: Vec<Vec<Amplitude>>,
    /// Bound of the error of their sum.
    pub(crate) error_m: f64,
}

impl ElementSums {
    pub(crate) fn none(wavenumbers: usize) -> Self {
        Self { of_nodes: vec![vec![Amplitude::default(); wavenumbers]; NODES * NODES], error_m: 0.0 }
    }

    /// Amplitudes of the nodes' own paths, by a field whose reference is the element's middle.
    pub(crate) fn of_paths(
        self,
        field: &Field<'_>,
        element: &GridElement,
        wavenumbers_per_m: &[f64],
    ) -> Vec<Vec<Amplitude>> {
        let of_node = |(node_m, amplitudes)| field.as_of(node_m, amplitudes, wavenumbers_per_m);
        element.nodes_m().zip(self.of_nodes).map(of_node).collect()
    }
}

impl Field<'_> {
    /// Adds the node's polygon, of which the field's reference is the element's middle.
    pub(crate) fn add_interpolated(
        &self,
        element: &GridElement,
        wavenumbers_per_m: &[f64],
        sums: &mut ElementSums,
    ) {
        let highest = wavenumbers_per_m.iter().copied().fold(0.0, f64::max);
        for_each_tile(self, highest, &mut |tile, error| {
            sums.error_m += largest_amplitude(error * tile.area_m2(), highest);
            let corners_m = tile.corners_m();
            for pair in corners_m[1..].windows(2) {
                let triangle = self.six_points([corners_m[0], pair[0], pair[1]]);
                self.add_shared(&triangle, element, wavenumbers_per_m, sums);
            }
        });
    }

    /// Adds a triangle's amplitudes to those of an element's nodes.
    fn add_shared(
        &self,
        triangle: &QuadraticTriangle,
        element: &GridElement,
        wavenumbers_per_m: &[f64],
        sums: &mut ElementSums,
    ) {
        let mut integrals_m2 = vec![[Complex64::ZERO; 6]; wavenumbers_per_m.len()];
        triangle.for_each_integral(wavenumbers_per_m, &mut |i, of_points| integrals_m2[i] = of_points);
        for (index, point) in triangle.points.iter().enumerate() {
            let own: Vec<[Complex64; 1]> = integrals_m2.iter().map(|of| [of[index]]).collect();
            let amplitudes = self.amplitudes_of(&[*point], wavenumbers_per_m, &own);
            for (sum, share) in sums.of_nodes.iter_mut().zip(element.shares(point.x_m)) {
                let values = sum.iter_mut().flatten().flatten();
                let added = amplitudes.iter().flatten().flatten();
                values.zip(added).for_each(|(sum, added)| *sum += share * added);
            }
        }
    }

    /// Amplitude of the reference point as that of a path from another one.
    fn as_of(&self, x_m: DVec3, mut amplitudes: Vec<Amplitude>, wavenumbers_per_m: &[f64]) -> Vec<Amplitude> {
        let spread: f64 = self.spread(x_m).iter().product();
        let length_m = self.length_m(x_m);
        for (amplitude, k) in amplitudes.iter_mut().zip(wavenumbers_per_m) {
            let factor = Complex64::from_polar(1.0 / spread, k * length_m);
            amplitude.iter_mut().flatten().for_each(|a| *a *= factor);
        }
        amplitudes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::antenna::Antenna;
    use crate::integral::leg_surfaces::LegSurfaces;
    use crate::integral::node::{Bracket, Leg, Node};
    use crate::integral::physical_optics::node_amplitudes;
    use crate::integral::polarization::Mirrors;

    const WAVENUMBER_PER_M: f64 = std::f64::consts::TAU * 77e9 / artifact::units::SPEED_OF_LIGHT_MPS;

    #[test]
    fn shares_carry_polynomials_of_third_degree_over() {
        for x in [-0.3, 0.0, 0.4, 1.7, 3.0] {
            for power in 0..4 {
                let sum: f64 = (0..4).map(|i| lagrange(x)[i as usize] * f64::from(i).powi(power)).sum();
                assert!((sum - x.powi(power)).abs() < 1e-12, "x = {x}, power {power}: {sum}");
            }
        }
    }

    /// An element of 6 cm in the plane x = 0, its whole area lit by one antenna.
    fn with_field<T>(antenna_m: DVec3, element: &GridElement, of: impl FnOnce(&Field<'_>) -> T) -> T {
        let leg = Leg {
            image: Antenna::Point(antenna_m),
            mirrors: Mirrors::NONE,
            steps: LegSurfaces::default(),
            zenith_h: DVec3::Y,
        };
        let [low, side] = [element.low_m, f64::from(DEGREE) * element.cell_m];
        let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        let corners_m = corners.map(|corner| element.frame.to_world(low + corner * side));
        let (bend, material, bracket) = (None, None, Bracket::Symmetrised);
        let (transmit, receive, normal) = (&leg, &leg, element.frame.normal());
        let node = Node { corners_m: &corners_m, normal, bend, material, transmit, receive, bracket };
        of(&Field::new(&node, element.middle_m(), 1e-9))
    }

    /// Paths from the nodes follow an antenna that moves: their error grows as the fourth power of the phase
    /// between them.
    #[test]
    fn nodes_follow_an_antenna_that_moves_as_the_fourth_power_of_its_way() {
        let frame = PlaneFrame::new(DVec3::ZERO, DVec3::X);
        let element = GridElement { frame, low_m: DVec2::splat(-0.03), cell_m: DVec2::splat(0.02) };
        let (from_m, wavenumbers) = (DVec3::new(6.0, 1.0, 2.0), [WAVENUMBER_PER_M]);
        let of_nodes = with_field(from_m, &element, |field| {
            let mut sums = ElementSums::none(1);
            field.add_interpolated(&element, &wavenumbers, &mut sums);
            sums.of_paths(field, &element, &wavenumbers)
        });
        let area_m = largest_amplitude(0.06 * 0.06, WAVENUMBER_PER_M);
        let error = |way_m: f64| {
            let [by_nodes, exact] = with_field(from_m + way_m * DVec3::Y, &element, |field| {
                let of_node = |(at_m, amplitudes): (DVec3, &Vec<Amplitude>)| {
                    let spread: f64 = field.spread(at_m).iter().product();
                    let phase = -WAVENUMBER_PER_M * field.length_m(at_m);
                    amplitudes[0][0][0] * Complex64::from_polar(spread, phase)
                };
                let sum: Complex64 = element.nodes_m().zip(&of_nodes).map(of_node).sum();
                [sum, node_amplitudes(field.node, element.middle_m(), &wavenumbers, 1e-9).value[0][0][0]]
            });
            // The change of the phase between two nodes, of both legs.
            let turn = 2.0 * WAVENUMBER_PER_M * element.cell_m.x * way_m / from_m.length();
            let error = (by_nodes - exact).norm() / area_m;
            println!("{way_m} m: {turn:.2} rad, error {error:.1e} of the area");
            assert!(error <= turn.powi(4) / 24.0 + 1e-6, "{way_m} m: {error:e}");
            error
        };
        assert!(error(0.0) < 1e-12);
        let ratios = [0.04, 0.08].map(|way_m| error(2.0 * way_m) / error(way_m));
        assert!(ratios.iter().all(|ratio| (8.0..32.0).contains(ratio)), "{ratios:?}");
    }
}
