//! Sizes and durations of the cases.

use std::time::Instant;
use wayside::host::failure::Failure;

/// Sizes of the cases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sizes {
    /// Rays and samples per wavelength.
    pub(super) per_wavelength: f64,
    pub(super) frequency_hz: f64,
    pub(super) paths: usize,
    /// Total seconds for repeating short work.
    pub(super) repeated_s: f64,
}

pub(crate) const FULL: Sizes =
    Sizes { per_wavelength: 4.0, frequency_hz: 77.3125e9, paths: 67_000, repeated_s: 0.5 };
pub(crate) const QUICK: Sizes =
    Sizes { per_wavelength: 2.0, frequency_hz: 10e9, paths: 2_000, repeated_s: 0.1 };

/// Sizes for the chart: a small body, because other methods are charted on it separately, and many paths.
pub(crate) const CHARTED: Sizes = Sizes { paths: FULL.paths, repeated_s: FULL.repeated_s, ..QUICK };

/// Does work and measures its seconds.
pub(super) fn timed<T>(work: impl FnOnce() -> Result<T, Failure>) -> Result<(T, f64), Failure> {
    let start = Instant::now();
    let value = work()?;
    Ok((value, start.elapsed().as_secs_f64()))
}

/// The fastest of at least three runs, with its result.
pub(super) fn quickest<T>(
    sizes: Sizes,
    mut work: impl FnMut() -> Result<T, Failure>,
) -> Result<(T, f64), Failure> {
    let start = Instant::now();
    let (mut value, mut quickest_s) = timed(&mut work)?;
    let mut runs = 1;
    while runs < 3 || start.elapsed().as_secs_f64() < sizes.repeated_s {
        let (again, seconds) = timed(&mut work)?;
        (value, quickest_s, runs) = (again, quickest_s.min(seconds), runs + 1);
    }
    Ok((value, quickest_s))
}
