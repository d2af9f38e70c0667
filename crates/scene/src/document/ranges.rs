//! Ranges of numbers that several tables share.

use crate::wording::allowed_range::AllowedRange;
use artifact::seed::SEEDS as SEEDS_TAKEN;

/// Seeds accepted everywhere.
pub(crate) const SEEDS: AllowedRange = AllowedRange::Between(0.0, *SEEDS_TAKEN.end() as f64);

/// Coordinates; larger ones are an error of units. Within the range f64 resolves 1.5e-11 m, 4e-9 of a
/// wavelength at 77 GHz.
pub(crate) const COORDINATES_M: AllowedRange = AllowedRange::Between(-1e5, 1e5);

/// Velocities up to the speed of sound, beyond which nothing drives.
pub(crate) const VELOCITIES_MPS: AllowedRange = AllowedRange::Between(-340.0, 340.0);
