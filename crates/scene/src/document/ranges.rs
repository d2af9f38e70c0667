//! Ranges of numbers that several tables share.

use crate::wording::allowed::Allowed;
use artifact::seed::SEEDS as SEEDS_TAKEN;

/// Seeds that are taken everywhere.
pub(crate) const SEEDS: Allowed = Allowed::Between(0.0, *SEEDS_TAKEN.end() as f64);

/// Coordinates beyond this are a slip of units; within it f64 resolves 1.5e-11 m, 4e-9 of a wavelength at 77
/// GHz.
pub(crate) const COORDINATES_M: Allowed = Allowed::Between(-1e5, 1e5);

/// Beyond the speed of sound nothing drives.
pub(crate) const VELOCITIES_MPS: Allowed = Allowed::Between(-340.0, 340.0);
