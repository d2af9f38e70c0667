//! Both sides of a lane with a course.

use artifact::settings::NetworkLane;

/// Largest distance of a corner's side, in half widths: at hairpins the true one would be anywhere.
const LONGEST_CORNER: f64 = 2.0;

/// Left and right side of a lane, half a width from its middle, with a place for each of the middle's.
pub(crate) fn lane_sides_m(course: &NetworkLane) -> [Vec<[f64; 2]>; 2] {
    [-0.5, 0.5].map(|share| beside(&course.line_m, share * course.width_m))
}

/// A line parallel to another, to its right.
fn beside(line_m: &[[f64; 2]], by_m: f64) -> Vec<[f64; 2]> {
    let rights: Vec<[f64; 2]> = line_m.windows(2).map(|ends| right(ends[0], ends[1])).collect();
    let corner = |(i, [x, y]): (usize, &[f64; 2])| {
        let (before, after) = (rights[i.saturating_sub(1)], rights[i.min(rights.len() - 1)]);
        let sum = [before[0] + after[0], before[1] + after[1]];
        // For unit vectors, their sum over half its square reaches the intersection of both sides.
        let half_square = 0.5 * (sum[0] * sum[0] + sum[1] * sum[1]);
        let reach = 1.0 / half_square.max(2.0 / LONGEST_CORNER.powi(2));
        [x + by_m * reach * sum[0], y + by_m * reach * sum[1]]
    };
    if rights.is_empty() { vec![] } else { line_m.iter().enumerate().map(corner).collect() }
}

/// The unit vector to the right of a displacement; zero for one without length.
fn right([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> [f64; 2] {
    let (dx, dy) = (x1 - x0, y1 - y0);
    let length = dx.hypot(dy);
    if length > 0.0 { [dy / length, -dx / length] } else { [0.0; 2] }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn course(line_m: &[[f64; 2]]) -> NetworkLane {
        NetworkLane { number: 1, name: "a_0".into(), width_m: 4.0, line_m: line_m.to_vec() }
    }

    fn is_near(got: &[[f64; 2]], asked: &[[f64; 2]]) -> bool {
        got.len() == asked.len()
            && got.iter().flatten().zip(asked.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-12)
    }

    #[test]
    fn sides_run_half_a_width_away_and_meet_at_corners() {
        // Northwards, then to the east.
        let [left, right] = lane_sides_m(&course(&[[0.0, 0.0], [0.0, 10.0], [10.0, 10.0]]));
        assert!(is_near(&left, &[[-2.0, 0.0], [-2.0, 12.0], [10.0, 12.0]]), "{left:?}");
        assert!(is_near(&right, &[[2.0, 0.0], [2.0, 8.0], [10.0, 8.0]]), "{right:?}");
    }

    #[test]
    fn a_hairpin_has_sides_that_stay_near_and_a_line_of_one_place_has_none() {
        let [left, right] = lane_sides_m(&course(&[[0.0, 0.0], [0.0, 10.0], [0.0, 0.0]]));
        assert!(
            left.iter().chain(&right).all(|[x, y]| x.abs() <= 4.0 && y.abs() <= 14.0),
            "{left:?} {right:?}"
        );
        assert!(lane_sides_m(&course(&[[0.0, 0.0]])).iter().all(Vec::is_empty));
    }
}
