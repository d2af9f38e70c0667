//! A corrugated guard rail on its posts.

use crate::street::outline::rectangle;
use crate::street::prism::{Point, Prisms};
use std::f64::consts::TAU;

/// Height and depth of the W profile: 12¼ × 3¼ inches (AASHTO M 180), as for European rails. Its waves are
/// two periods of a cosine.
const RAIL_M: [f64; 2] = [0.312, 0.083];
/// Thickness of the sheet, 12 gauge.
const SHEET_M: f64 = 0.0027;
/// Height of the rail's upper edge.
const TOP_M: f64 = 0.75;
/// Number of chords, a multiple of four, so that the crests are among the corners. Chords of 13 mm on crests
/// of 15 mm radius represent a rail bent from flat strips: along the road, where ends and posts reflect, that
/// suffices, and perpendicular to it its crests are up to 9 dB off (`docs/physics.md` §3, chord over √(ρλ)
/// 1.7). Four times as many take a tracer four times as long.
const CHORDS: usize = 24;

/// Spacing of the posts, their size along and across, their height.
const SPACING_M: f64 = 2.0;
const POST_M: [f64; 2] = [0.1, 0.06];
const POST_HEIGHT_M: f64 = 0.7;
/// Gap of air between the rail's back and the posts.
const GAP_M: f64 = 0.01;

/// Adds the rail and its posts, from the middle outwards, without blocks and bolts.
pub(crate) fn draw(prisms: &mut Prisms, length_m: f64) {
    prisms.along(&profile(), [-0.5 * length_m, 0.5 * length_m], "steel");
    let spaces = ((length_m - POST_M[0]) / SPACING_M).floor().max(0.0) as usize;
    let back_m = -SHEET_M - GAP_M;
    for k in 0..=spaces {
        let x = SPACING_M * (k as f64 - 0.5 * spaces as f64);
        let half = 0.5 * POST_M[0];
        let outline = rectangle([x - half, back_m - POST_M[1]], [x + half, back_m]);
        prisms.upright(&outline, [0.0, POST_HEIGHT_M], "steel");
    }
}

/// Profile of the rail, up the face and down the back.
fn profile() -> Vec<Point> {
    let face = |k: usize| {
        let share = k as f64 / CHORDS as f64;
        let depth_m = 0.5 * RAIL_M[1] * (1.0 - (2.0 * TAU * share).cos());
        [depth_m, TOP_M - RAIL_M[0] * (1.0 - share)]
    };
    let back = |k: usize| {
        let [y, z] = face(k);
        [y - SHEET_M, z]
    };
    (0..=CHORDS).map(face).chain((0..=CHORDS).rev().map(back)).collect()
}
