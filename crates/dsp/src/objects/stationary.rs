//! Test whether an echo is at rest, as far as its velocity is known.
//!
//! The radar is stationary, so stationary echoes have no radial velocity in any direction: their peaks lie in
//! the row of zero Doppler, and so does the sum of any number of them in one range cell, since their phases
//! turn alike from chirp to chirp. An echo is at rest if its velocity differs from zero by at most half a
//! Doppler cell, the resolution of a frame, plus three standard errors. Velocities whole spans of the map
//! from zero (blind speeds) look alike, and count as rest unless their fold is resolved beyond doubt; so does
//! motion across the line of sight.

use artifact::Radar;
use radar::doppler_ambiguity::apparent_velocity_mps;
use std::f64::consts::TAU;

/// Certainty of the fold, the multiple of the map's span.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FoldCertainty {
    /// The fold is resolved beyond doubt.
    Resolved,
    /// Other folds are possible.
    Assumed,
}

/// Standard errors by which an echo at rest may deviate.
const ERRORS: f64 = 3.0;
/// Standard error relative to the Cramér–Rao bound: peaks of windowed maps lie 5 to 6 dB above it
/// (docs/physics.md §8).
const OVER_BOUND: f64 = 2.0;

/// Whether an echo with this velocity is at rest; `over_noise` is the power ratio of its cell, summed over
/// channels.
pub fn is_at_rest(radar: &Radar, velocity_mps: f64, fold: FoldCertainty, over_noise: f64) -> bool {
    let shown_mps = match fold {
        FoldCertainty::Resolved => velocity_mps,
        FoldCertainty::Assumed => apparent_velocity_mps(radar, velocity_mps),
    };
    shown_mps.abs() <= tolerance_mps(radar, over_noise)
}

/// Half a cell plus three standard errors, m/s; the bound for a tone over N chirps is √6/(2π) of a cell over
/// the root of the power ratio.
pub fn tolerance_mps(radar: &Radar, over_noise: f64) -> f64 {
    let bound_cells = 6f64.sqrt() / TAU / over_noise.max(1.0).sqrt();
    (0.5 + ERRORS * OVER_BOUND * bound_cells) * radar.velocity_resolution_mps()
}
