//! Nearest lit surface of each body.

use crate::beams::beam::BeamTree;
use crate::bodies::world::World;
use glam::DVec3;

/// Distance from `from_m` to the nearest point of a body's lit polygons of order 1, for each of `targets`;
/// `None` if all of it is hidden.
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

/// Distance to the plane where the foot lies inside, else to the nearest edge.
fn distance_to_polygon_m(x_m: DVec3, corners_m: &[DVec3], normal: DVec3) -> f64 {
    let edges = || corners_m.iter().zip(corners_m.iter().cycle().skip(1));
    let inside = edges().all(|(a, b)| (b - a).cross(x_m - a).dot(normal) >= 0.0);
    if inside {
        (x_m - corners_m[0]).dot(normal).abs()
    } else {
        edges().map(|(a, b)| distance_to_segment_m(x_m, *a, *b)).fold(f64::INFINITY, f64::min)
    }
}

fn distance_to_segment_m(x_m: DVec3, a_m: DVec3, b_m: DVec3) -> f64 {
    let along = b_m - a_m;
    let share = (x_m - a_m).dot(along) / along.length_squared();
    let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
    x_m.distance(a_m + share * along)
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
