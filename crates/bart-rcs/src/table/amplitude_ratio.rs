//! Two powers compared as amplitudes.

/// Amplitude ratio of two powers; 0 of nothing.
pub(crate) fn ratio(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { (part / whole).sqrt() } else { 0.0 }
}
