//! Distinction between bends of tessellated curves and edges of bodies: a curve keeps bending, an edge bends
//! once.

/// Angle above which bends are edges of the body, not steps of a curve: twelve facets round a cylinder bend
/// by 30°.
const CURVE_BEND_RAD: f64 = 35.0 * std::f64::consts::PI / 180.0;

/// Maximum ratio of two bends of one curve: where an arc ends in a plane its last bend is half of the others.
const CURVE_RATIO: f64 = 3.0;

/// Whether a bend is small enough to be a step of a curve.
pub(crate) fn may_be_a_step(turn_rad: f64) -> bool {
    turn_rad.abs() <= CURVE_BEND_RAD
}

/// Whether two bends, with equal signs if they bend the same way, may be steps of one curve.
pub(crate) fn may_be_of_one_curve(turn_rad: f64, other_rad: f64) -> bool {
    let ratio = other_rad / turn_rad;
    may_be_a_step(turn_rad) && may_be_a_step(other_rad) && (1.0 / CURVE_RATIO..=CURVE_RATIO).contains(&ratio)
}
