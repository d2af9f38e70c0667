//! A path shared by the tests of this folder.

use artifact::paths::Path;
use num_complex::Complex64;

/// A reflection at a moving position, with the same path out and back.
pub(super) fn path_by(at_m: [f64; 3], velocity_mps: [f64; 3]) -> Path {
    Path { order: 1, ..Path::of_point(at_m, velocity_mps, [[Complex64::ONE; 2]; 2]) }
}
