//! Ranges of the numbers that specify a table of S, for which the work ends. The command line and the Python
//! package refuse others in the same words.

use std::fmt::Display;
use std::ops::RangeInclusive;

/// Frequencies in GHz: from radio waves that bend around a vehicle to the beginning of thermal radiation.
pub const FREQUENCIES_GHZ: RangeInclusive<f64> = 1e-3..=1e4;
/// Azimuths in degrees, with any number of turns.
pub const AZIMUTHS_DEG: RangeInclusive<f64> = -1e6..=1e6;
/// Elevations in degrees, straight down to straight up: beyond them lies the other side, which has another
/// azimuth.
pub const ELEVATIONS_DEG: RangeInclusive<f64> = -90.0..=90.0;
/// Finite distances in m. Their squares and inverse squares are finite.
pub const RANGES_M: RangeInclusive<f64> = 1e-3..=1e9;
/// Metres per unit of a mesh file.
pub const UNIT_SCALES: RangeInclusive<f64> = 1e-9..=1e6;
/// Accuracies of a table of S in dB, 0 excluded: at 0 dB the error equals the result, and f64 ends some way
/// beyond −200 dB.
pub const ACCURACIES_DB: RangeInclusive<f64> = -200.0..=0.0;
/// Accuracies of a scene in dB, 0 excluded, as its key `accuracy_db` takes them.
pub const SCENE_ACCURACIES_DB: RangeInclusive<f64> = scene::LEAST_ACCURACY_DB..=0.0;
/// Highest bounce orders.
pub const BOUNCES: RangeInclusive<i64> = 1..=5;

/// Sentence that refuses a number outside a range; `written` is the number as given.
pub fn outside(allowed: &RangeInclusive<f64>, written: impl Display) -> String {
    format!("it must be {}, is {written}", from_to(allowed))
}

/// Words of a range.
pub(crate) fn from_to(allowed: &RangeInclusive<f64>) -> String {
    format!("from {} to {}", plain(*allowed.start()), plain(*allowed.end()))
}

/// Extends the refusal of a number to that of a distance, which may be infinite.
pub fn or_infinite(refusal: String) -> String {
    refusal + ", or inf"
}

/// Formats a number, with an exponent if the digits would be mostly zeros.
fn plain(number: f64) -> String {
    let is_plain = number == 0.0 || (1e-3..1e7).contains(&number.abs());
    if is_plain { number.to_string() } else { format!("{number:e}") }
}
