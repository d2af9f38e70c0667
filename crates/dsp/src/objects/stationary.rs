//! Whether an echo is at rest, as far as its velocity is known.
//!
//! The radar stands still, so that whatever stands still has no radial velocity, in whatever direction it is:
//! its peak lies in the row of zero Doppler, and so does the sum of any number of such echoes in one range
//! cell, for they turn alike from chirp to chirp. An echo is at rest if its velocity differs from zero by no
//! more than half a Doppler cell, which is what a frame tells apart, and three standard errors. Whole spans
//! of the map from zero (blind speeds) look alike, and count as rest unless their fold is told beyond doubt;
//! so does what moves across the line of sight.

use artifact::Radar;
use radar::doppler_ambiguity::shown_mps;
use std::f64::consts::TAU;

/// Certainty of the multiple of the map's span.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fold {
    /// The multiple is beyond doubt.
    Told,
    /// Any other is possible.
    Assumed,
}

/// Standard errors that an echo at rest may be off.
const ERRORS: f64 = 3.0;
/// Peaks of windowed maps lie 5 to 6 dB above the Cramér–Rao bound (docs/physics.md §8).
const OVER_BOUND: f64 = 2.0;

/// Whether an echo of this velocity is at rest; `over_noise` is the power ratio of its cell, added over
/// channels.
pub fn is_at_rest(radar: &Radar, velocity_mps: f64, fold: Fold, over_noise: f64) -> bool {
    let shown_mps = match fold {
        Fold::Told => velocity_mps,
        Fold::Assumed => shown_mps(radar, velocity_mps),
    };
    shown_mps.abs() <= tolerance_mps(radar, over_noise)
}

/// Half a cell and three standard errors; the bound of a tone over N chirps is √6/(2π) of a cell over the
/// root of the power ratio.
pub fn tolerance_mps(radar: &Radar, over_noise: f64) -> f64 {
    let bound_cells = 6f64.sqrt() / TAU / over_noise.max(1.0).sqrt();
    (0.5 + ERRORS * OVER_BOUND * bound_cells) * radar.velocity_resolution_mps()
}
