//! Nearest lit surface of each body.

use crate::beams::beam::BeamTree;
use crate::bodies::world::World;
use crate::geometry::nearest_point::{is_over, on_segment_m, sides};
use glam::DVec3;

/// Distance from `from_m` to the nearest point of a body's lit polygons of order 1, for each of `targets`;
/// `None` if the body is completely hidden.
pub(crate) fn nearest_range_m(
    world: &World,
    tree: &BeamTree,
    from_m: DVec3,
    targets: usize,
) -> Vec<Option<f64>> {
    let mut nearest = vec![None; targets];
    for beam in tree.beams.iter().take_while(|beam| beam.order == 1) {
        let range_m = distance_to_polygon_m(from_m, tree.polygon(beam), beam.lit_normal);
        if let Some(of_target) = nearest.get_mut(world.facet(beam.facet).id.body as usize) {
            *of_target = Some(of_target.map_or(range_m, |r: f64| r.min(range_m)));
        }
    }
    nearest
}

/// Distance to the perpendicular foot if it lies inside, else to the nearest edge.
fn distance_to_polygon_m(x_m: DVec3, corners_m: &[DVec3], normal: DVec3) -> f64 {
    if is_over(x_m, corners_m, normal) {
        (x_m - corners_m[0]).dot(normal).abs()
    } else {
        let of_side = |(a, b)| x_m.distance(on_segment_m(x_m, a, b));
        sides(corners_m).map(of_side).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_foot_inside_the_nearest_edge_and_the_nearest_corner_are_told_apart() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
        let distance = |x| distance_to_polygon_m(x, &square, DVec3::Z);
        assert_eq!(distance(DVec3::new(0.5, 0.5, 3.0)), 3.0);
        assert_eq!(distance(DVec3::new(4.0, 0.5, 4.0)), 5.0);
        assert!((distance(DVec3::new(2.0, 2.0, 1.0)) - 3.0_f64.sqrt()).abs() < 1e-15);
    }
}
