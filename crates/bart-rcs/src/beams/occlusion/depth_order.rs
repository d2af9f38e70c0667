//! Depth order of two facets as seen by an antenna, decided once for both.
//!
//! Facets of imported meshes often lie within rounding of each other over large areas. If "A hides B" and "B
//! hides A" were decided separately, a strip between them could be lit twice or not at all, as wide as
//! rounding over the sine of their angle. There is therefore one answer for the pair, and intersecting facets
//! are separated by one plane, through the antenna and the line of intersection of their planes.

use crate::geometry::antenna::Antenna;
use crate::geometry::facet_geometry::FacetGeometry;
use crate::geometry::plane::Plane;

/// Order in which a ray that meets both facets meets them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum DepthOrder {
    /// The first is met first.
    FirstInFront,
    /// The second is met first.
    SecondInFront,
    /// Both are one surface to within rounding.
    Coincident,
    /// The first is met first on the positive side.
    PartedBy(Plane),
}

/// Depth order of two facets, each with its plane facing the antenna. Exchanging the facets exactly exchanges
/// the answer.
pub(crate) fn depth_order(
    first: (&Plane, &FacetGeometry),
    second: (&Plane, &FacetGeometry),
    antenna: Antenna,
    tolerance_m: f64,
) -> DepthOrder {
    if first.1.id <= second.1.id {
        return in_listed_order(first, second, antenna, tolerance_m);
    }
    match in_listed_order(second, first, antenna, tolerance_m) {
        DepthOrder::FirstInFront => DepthOrder::SecondInFront,
        DepthOrder::SecondInFront => DepthOrder::FirstInFront,
        DepthOrder::Coincident => DepthOrder::Coincident,
        DepthOrder::PartedBy(plane) => DepthOrder::PartedBy(-plane),
    }
}

/// Whether two facets are one surface to within rounding: all corners of either lie in the plane of the
/// other.
pub(crate) fn are_coincident(a: &FacetGeometry, b: &FacetGeometry, tolerance_m: f64) -> bool {
    lies_in(a.plane.extent_m(&b.corners_m), tolerance_m)
        || lies_in(b.plane.extent_m(&a.corners_m), tolerance_m)
}

fn in_listed_order(
    (plane, facet): (&Plane, &FacetGeometry),
    (other_plane, other_facet): (&Plane, &FacetGeometry),
    antenna: Antenna,
    tolerance_m: f64,
) -> DepthOrder {
    let other = plane.extent_m(&other_facet.corners_m);
    let own = other_plane.extent_m(&facet.corners_m);
    match () {
        () if lies_in(other, tolerance_m) || lies_in(own, tolerance_m) => DepthOrder::Coincident,
        () if other.1 <= tolerance_m || own.0 >= -tolerance_m => DepthOrder::FirstInFront,
        () if other.0 >= -tolerance_m || own.1 <= tolerance_m => DepthOrder::SecondInFront,
        () => Plane::through_meeting(antenna, other_plane, plane)
            .map_or(DepthOrder::Coincident, DepthOrder::PartedBy),
    }
}

fn lies_in((low_m, high_m): (f64, f64), tolerance_m: f64) -> bool {
    low_m >= -tolerance_m && high_m <= tolerance_m
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::world::World;
    use artifact::scene::Mesh;

    /// Depth order of two triangles, both ways, seen from far above.
    fn both_ways(corners_m: [[f64; 3]; 6]) -> [DepthOrder; 2] {
        let triangles = vec![[0, 1, 2], [3, 4, 5]];
        let world =
            World::of_mesh(&Mesh { vertices_m: corners_m.to_vec(), triangles, ..Mesh::default() }).unwrap();
        let antenna = Antenna::Direction(glam::DVec3::Z);
        let [a, b] = [0, 1].map(|i| (&world.facet(i).plane, world.facet(i)));
        [depth_order(a, b, antenna, world.tolerance_m()), depth_order(b, a, antenna, world.tolerance_m())]
    }

    #[test]
    fn the_order_of_a_pair_is_decided_once() {
        let flat = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]];
        let pair = |a: [[f64; 3]; 3], b: [[f64; 3]; 3]| both_ways([a[0], a[1], a[2], b[0], b[1], b[2]]);
        use DepthOrder::{Coincident, FirstInFront, PartedBy, SecondInFront};
        assert_eq!(pair(flat(1.0), flat(0.0)), [FirstInFront, SecondInFront]);
        assert_eq!(pair(flat(0.0), flat(1.0)), [SecondInFront, FirstInFront]);
        assert_eq!(pair(flat(0.0), flat(1e-15)), [Coincident, Coincident]);
        let leaning = [[0.0, 0.0, -0.5], [1.0, 0.0, 0.5], [0.0, 1.0, -0.5]];
        let [PartedBy(a), PartedBy(b)] = pair(flat(0.0), leaning) else { panic!("they cross") };
        assert_eq!(a, -b);
        assert!(
            a.distance_m(glam::DVec3::ZERO) > 0.4,
            "the flat one is in front where the leaning one is low"
        );
    }
}
