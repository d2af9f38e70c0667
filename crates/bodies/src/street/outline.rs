//! Outlines of prisms, each of an even number of points, counter-clockwise.

use crate::street::prism::Point;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Wavelength at 77 GHz.
const WAVELENGTH_M: f64 = 3.893e-3;
/// Chord over √(ρλ): facets no wider reproduce the round surface within 0.35 dB (`docs/physics.md` §3).
const CHORD_SHARE: f64 = 0.35;

/// Number of chords that an arc needs.
pub(crate) fn chords(radius_m: f64, angle_rad: f64) -> usize {
    (radius_m * angle_rad / (CHORD_SHARE * (radius_m * WAVELENGTH_M).sqrt())).ceil() as usize
}

/// A circle around a centre; a multiple of four points, so that it is as wide as it is long.
pub(crate) fn circle(centre_m: Point, diameter_m: f64) -> Vec<Point> {
    let radius_m = 0.5 * diameter_m;
    let points = 4 * chords(radius_m, FRAC_PI_2).max(2);
    let at = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / points as f64).sin_cos();
        [centre_m[0] + radius_m * cos, centre_m[1] + radius_m * sin]
    };
    (0..points).map(at).collect()
}

/// A rectangle between two corners.
pub(crate) fn rectangle(low_m: Point, high_m: Point) -> Vec<Point> {
    vec![low_m, [high_m[0], low_m[1]], high_m, [low_m[0], high_m[1]]]
}

/// Width, height above the road, and bevel of the upper edges: kerbstones between carriageway and footway are
/// 10 to 15 cm high and 12 to 18 cm wide. Rounded edges instead of bevels take a tracer twice as long for 4 m
/// of kerb at 38 m, 7.7 processor seconds, with the same echo of −45 to −48 dBsm.
const KERB_M: [f64; 2] = [0.15, 0.12];
const BEVEL_M: f64 = 0.02;

/// A kerbstone seen from ahead, its middle on the axis.
pub(crate) fn kerbstone() -> Vec<Point> {
    let ([width_m, height_m], bevel_m) = (KERB_M, BEVEL_M);
    let half = 0.5 * width_m;
    let (side, top) = (height_m - bevel_m, half - bevel_m);
    vec![[half, 0.0], [half, side], [top, height_m], [-top, height_m], [-half, side], [-half, 0.0]]
}
