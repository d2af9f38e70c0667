//! Triangles that belong to a body of revolution: rotated about its axis by some fraction of a turn they
//! coincide with others of the mesh, and together they close a ring.

use glam::DVec3;
use std::f64::consts::TAU;

/// Least number of sectors of a round body; hubs have five holes, rims seldom more than ten spokes, and
/// neither closes a ring.
const FEWEST_SECTORS: usize = 8;

/// Largest number of similar triangles in one ring and one sector.
const MOST_ALIKE: usize = 4;

/// Least share of a sector that each triangle of a ring must cover: spokes leave gaps.
const COVERED: f64 = 0.95;

/// Tolerance of lengths, as a share of the body's radius.
const SAME_LENGTH_SHARE: f64 = 1e-3;

/// Whether each triangle (metres from a point of the axis, which is y) belongs to a body of revolution.
pub(crate) fn are_of_revolution(triangles_m: &[[DVec3; 3]]) -> Vec<bool> {
    let measures: Vec<TriangleMeasures> = triangles_m.iter().map(TriangleMeasures::of).collect();
    let radius_m = triangles_m.iter().flatten().map(|p| p.x.hypot(p.z)).fold(0.0, f64::max);
    let mut is_round = vec![false; triangles_m.len()];
    for alike in alike(&measures, SAME_LENGTH_SHARE * radius_m) {
        if closes_a_ring(&measures, &alike) {
            alike.into_iter().for_each(|i| is_round[i] = true);
        }
    }
    is_round
}

/// Measures of a triangle that rotation about the axis preserves, and its angles about it.
struct TriangleMeasures {
    /// Mean and greatest distance of the corners from the axis.
    mean_radius_m: f64,
    greatest_radius_m: f64,
    /// Mean and greatest position of the corners along the axis.
    mean_along_m: f64,
    greatest_along_m: f64,
    /// Length of the three sides.
    perimeter_m: f64,
    /// Middle of the covered angle: the same for both halves of a quadrilateral, however it is split.
    angle_rad: f64,
    /// Covered angle.
    width_rad: f64,
}

impl TriangleMeasures {
    fn of(corners_m: &[DVec3; 3]) -> Self {
        let [a, b, c] = *corners_m;
        let radii_m = corners_m.map(|p| p.x.hypot(p.z));
        let middle = (a + b + c) / 3.0;
        let middle_rad = angle(middle);
        let from_middle = |p: &DVec3| (angle(*p) - middle_rad + 1.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
        // A corner on the axis has no angle.
        let off_axis = corners_m
            .iter()
            .zip(radii_m)
            .filter(|(_, radius)| *radius > SAME_LENGTH_SHARE * radii_m[0].max(radii_m[1]));
        let angles = off_axis.map(|(p, _)| from_middle(p));
        let (low, high) = angles.fold((0.0_f64, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
        Self {
            mean_radius_m: radii_m.iter().sum::<f64>() / 3.0,
            greatest_radius_m: radii_m.into_iter().fold(0.0, f64::max),
            mean_along_m: middle.y,
            greatest_along_m: a.y.max(b.y).max(c.y),
            perimeter_m: a.distance(b) + b.distance(c) + c.distance(a),
            angle_rad: (middle_rad + 0.5 * (low + high)).rem_euclid(TAU),
            width_rad: high - low,
        }
    }
}

fn angle(p: DVec3) -> f64 {
    p.z.atan2(p.x).rem_euclid(TAU)
}

/// Groups of triangles with similar lengths.
fn alike(measures: &[TriangleMeasures], tolerance_m: f64) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = vec![(0..measures.len()).collect()];
    let lengths: [fn(&TriangleMeasures) -> f64; 5] = [
        |measures| measures.mean_radius_m,
        |measures| measures.greatest_radius_m,
        |measures| measures.mean_along_m,
        |measures| measures.greatest_along_m,
        |measures| measures.perimeter_m,
    ];
    for length_m in lengths {
        let of = |i: usize| length_m(&measures[i]);
        groups = groups.into_iter().flat_map(|group| split_at_jumps(group, of, tolerance_m)).collect();
    }
    groups
}

/// Splits a group at jumps of a length.
fn split_at_jumps(mut group: Vec<usize>, of: impl Fn(usize) -> f64, tolerance_m: f64) -> Vec<Vec<usize>> {
    group.sort_by(|a, b| of(*a).total_cmp(&of(*b)).then(a.cmp(b)));
    group.chunk_by(|a, b| of(*b) - of(*a) <= tolerance_m).map(<[usize]>::to_vec).collect()
}

/// Whether similar triangles are evenly spaced all round without a gap.
fn closes_a_ring(measures: &[TriangleMeasures], alike: &[usize]) -> bool {
    let mut angles: Vec<f64> = alike.iter().map(|&i| measures[i].angle_rad).collect();
    angles.sort_by(f64::total_cmp);
    let narrowest_rad = alike.iter().map(|&i| measures[i].width_rad).fold(f64::INFINITY, f64::min);
    (1..=MOST_ALIKE).any(|in_sector| {
        let sectors = angles.len() / in_sector;
        let step_rad = TAU / sectors as f64;
        sectors >= FEWEST_SECTORS
            && sectors * in_sector == angles.len()
            && narrowest_rad >= COVERED * step_rad
            && is_repeated(&angles, in_sector, step_rad)
    })
}

/// Whether ascending angles coincide again after a step.
fn is_repeated(angles: &[f64], in_sector: usize, step_rad: f64) -> bool {
    let count = angles.len();
    (0..count).all(|i| {
        let turned = (angles[(i + in_sector) % count] - angles[i]).rem_euclid(TAU);
        (turned - step_rad).abs() < 0.05 * step_rad
    })
}
