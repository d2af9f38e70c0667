//! Constants and conversions for inputs and outputs; internally all quantities are SI, radians and linear.

use num_complex::Complex32;

/// Speed of light in vacuum (SI definition; in air it is 3e-4 lower, which is neglected), m/s.
pub const SPEED_OF_LIGHT_MPS: f64 = 299_792_458.0;
/// Boltzmann constant (SI definition), J/K.
pub const BOLTZMANN_J_PER_K: f64 = 1.380_649e-23;
/// Lowest decibel value that is printed: a relative error of zero in a table or in JSON.
pub const LOWEST_DB: f64 = -300.0;

/// Decibels of a power ratio, at least [`LOWEST_DB`].
pub fn db_from_power(ratio: f64) -> f64 {
    (10.0 * ratio.log10()).max(LOWEST_DB)
}

/// Decibels of an amplitude ratio, at least [`LOWEST_DB`].
pub fn db_from_amplitude(ratio: f64) -> f64 {
    (20.0 * ratio.log10()).max(LOWEST_DB)
}

/// Amplitude ratio of two powers; 0 if the whole is 0.
pub fn amplitude_ratio(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { (part / whole).sqrt() } else { 0.0 }
}

/// Power ratio of a decibel value.
pub fn power_from_db(db: f64) -> f64 {
    10.0_f64.powf(db / 10.0)
}

/// Amplitude ratio of a decibel value.
pub fn amplitude_from_db(db: f64) -> f64 {
    10.0_f64.powf(db / 20.0)
}

/// Power |value|² in double precision: single precision has no squares of amplitudes below 4e-23.
#[inline]
pub fn power(value: Complex32) -> f64 {
    f64::from(value.re).powi(2) + f64::from(value.im).powi(2)
}

/// Watts of a level in dBm.
pub fn watts_from_dbm(dbm: f64) -> f64 {
    1e-3 * power_from_db(dbm)
}
