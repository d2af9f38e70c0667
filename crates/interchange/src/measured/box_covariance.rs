//! Error of the middle of a track's box. A tracker knows the place of the reflecting parts; the extent of the
//! body beyond them is not measured.

use artifact::tracks::Track;

/// Longest vehicle of one piece (directive 96/53/EC, annex I), m.
const LONGEST_M: f64 = 12.0;

/// Covariance of the middle of a track's box along world x and y, m²: that of the place of the reflecting
/// parts, and along the heading half of the length by which a vehicle may exceed the box, assumed uniform up
/// to the longest: its mean square is a twelfth of the square of the largest excess.
pub(crate) fn middle_covariance(track: &Track) -> [[f64; 2]; 2] {
    let unseen_m = (LONGEST_M - track.footprint.length_m).max(0.0);
    let (sin, cos) = track.footprint.heading_rad.sin_cos();
    let along = [cos, sin];
    let of = |row: usize, column: usize| {
        track.covariance[row][column] + along[row] * along[column] * unseen_m * unseen_m / 12.0
    };
    [[of(0, 0), of(0, 1)], [of(1, 0), of(1, 1)]]
}
