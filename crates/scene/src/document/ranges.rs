//! Ranges of numbers that several tables share.

use crate::wording::allowed::Allowed;
use artifact::seed::SEEDS as SEEDS_TAKEN;

/// Seeds accepted everywhere.
pub(crate) const SEEDS: Allowed = Allowed::Between(0.0, *SEEDS_TAKEN.end() as f64);

/// Coordinates; larger ones are an error of units. Within the range f64 resolves 1.5e-11 m, 4e-9 of a
/// wavelength at 77 GHz.
pub(crate) const COORDINATES_M: Allowed = Allowed::Between(-1e5, 1e5);

/// Velocities up to the speed of sound, beyond which nothing drives.
pub(crate) const VELOCITIES_MPS: Allowed = Allowed::Between(-340.0, 340.0);
