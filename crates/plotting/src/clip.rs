//! Polygons and lines cut off at the edges of a drawing (Sutherland & Hodgman 1974; Liang & Barsky 1984).

/// The part of a closed polygon within a box, [left, top, right, bottom]; empty where there is none.
pub fn polygon(corners: &[[f64; 2]], [left, top, right, bottom]: [f64; 4]) -> Vec<[f64; 2]> {
    let edges = [(0, left, 1.0), (0, right, -1.0), (1, top, 1.0), (1, bottom, -1.0)];
    edges.into_iter().fold(corners.to_vec(), |kept, (axis, at, side)| half(&kept, axis, at, side))
}

/// The part of a straight line within a box, [left, top, right, bottom].
pub fn segment([from, to]: [[f64; 2]; 2], frame: [f64; 4]) -> Option<[[f64; 2]; 2]> {
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for axis in [0, 1] {
        let (run, low, high) = (to[axis] - from[axis], frame[axis], frame[axis + 2]);
        if run == 0.0 {
            if !(low..=high).contains(&from[axis]) {
                return None;
            }
            continue;
        }
        let (a, b) = ((low - from[axis]) / run, (high - from[axis]) / run);
        enters = enters.max(a.min(b));
        leaves = leaves.min(a.max(b));
    }
    let at = |share: f64| [0, 1].map(|axis: usize| from[axis] + share * (to[axis] - from[axis]));
    (enters < leaves).then(|| [at(enters), at(leaves)])
}

/// Part of a polygon at one side of a line along an axis.
fn half(corners: &[[f64; 2]], axis: usize, at: f64, side: f64) -> Vec<[f64; 2]> {
    let inside = |p: &[f64; 2]| side * (p[axis] - at) >= 0.0;
    let mut kept = vec![];
    for (i, to) in corners.iter().enumerate() {
        let from = &corners[(i + corners.len() - 1) % corners.len()];
        if inside(from) != inside(to) {
            let share = (at - from[axis]) / (to[axis] - from[axis]);
            kept.push([0, 1].map(|a: usize| from[a] + share * (to[a] - from[a])));
        }
        if inside(to) {
            kept.push(*to);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_over_an_edge_is_cut_there() {
        let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let kept = polygon(&square, [0.0, 0.0, 10.0, 10.0]);
        let area = (0..kept.len())
            .map(|i| (kept[i], kept[(i + 1) % kept.len()]))
            .map(|(a, b)| 0.5 * (a[0] * b[1] - b[0] * a[1]))
            .sum::<f64>();
        assert_eq!(area, 1.0, "{kept:?}");
        let diagonal = segment([[-5.0, -5.0], [20.0, 20.0]], [0.0, 0.0, 10.0, 10.0]);
        assert_eq!(diagonal, Some([[0.0, 0.0], [10.0, 10.0]]));
        assert_eq!(segment([[-5.0, 3.0], [-1.0, 3.0]], [0.0, 0.0, 10.0, 10.0]), None);
        assert!(polygon(&square, [2.0, 2.0, 3.0, 3.0]).is_empty());
    }
}
