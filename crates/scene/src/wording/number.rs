//! A number as a person writes it.

use std::fmt;

/// A number as a person writes it: with an exponent if the digits would be mostly zeros.
pub(crate) struct WrittenNumber(pub f64);

impl fmt::Display for WrittenNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plain = self.0 == 0.0 || !self.0.is_finite() || (1e-5..1e9).contains(&self.0.abs());
        if plain { write!(f, "{}", self.0) } else { write!(f, "{:e}", self.0) }
    }
}
