//! Numbers that a table of S is asked with: each has a range within which the work ends. The command line
//! and the Python package refuse the others in the same words.

use std::fmt::Display;
use std::ops::RangeInclusive;

/// Frequencies in GHz: from radio waves that bend around a vehicle to where heat begins.
pub const FREQUENCIES_GHZ: RangeInclusive<f64> = 1e-3..=1e4;
/// Azimuths in degrees: turns as many as one likes.
pub const AZIMUTHS_DEG: RangeInclusive<f64> = -1e6..=1e6;
/// Elevations in degrees, straight down to straight up: beyond lies the other side, which has an azimuth of
/// its own.
pub const ELEVATIONS_DEG: RangeInclusive<f64> = -90.0..=90.0;
/// Distances in m that are not infinite. Squares of them and of their inverses stay numbers.
pub const RANGES_M: RangeInclusive<f64> = 1e-3..=1e9;
/// Metres in a unit of a mesh file.
pub const UNIT_SCALES: RangeInclusive<f64> = 1e-9..=1e6;
/// Highest bounce orders.
pub const BOUNCES: RangeInclusive<i64> = 1..=5;

/// Sentence that refuses a number outside a range, as it was written.
pub fn outside(allowed: &RangeInclusive<f64>, written: impl Display) -> String {
    format!("it must be from {} to {}, is {written}", plain(*allowed.start()), plain(*allowed.end()))
}

/// Sentence that refuses a distance, from the one that refuses a number: it may be infinite.
pub fn or_infinite(refusal: String) -> String {
    refusal + ", or inf"
}

/// Writes a number, with an exponent where the digits would only be zeros.
fn plain(number: f64) -> String {
    let is_plain = number == 0.0 || (1e-3..1e7).contains(&number.abs());
    if is_plain { number.to_string() } else { format!("{number:e}") }
}
