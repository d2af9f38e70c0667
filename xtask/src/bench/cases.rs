//! The comparisons, room by room.

mod echo;
mod maps;
mod scattering;

use crate::bench::Comparison;
use std::time::Instant;
use wayside::host::failure::Failure;

/// How large the cases are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sizes {
    /// Of rays and samples.
    per_wavelength: f64,
    frequency_hz: f64,
    paths: usize,
    /// Seconds that a quick piece of work is repeated for.
    repeated_s: f64,
}

pub(super) const FULL: Sizes = Sizes { per_wavelength: 4.0, frequency_hz: 77.3125e9, paths: 67_000, repeated_s: 0.5 };
pub(super) const QUICK: Sizes = Sizes { per_wavelength: 2.0, frequency_hz: 10e9, paths: 2_000, repeated_s: 0.1 };

pub(super) fn all(sizes: Sizes) -> Result<Vec<Comparison>, Failure> {
    let mut list = scattering::all(sizes)?;
    list.extend(echo::all(sizes)?);
    list.extend(maps::all(sizes)?);
    Ok(list)
}

fn timed<T>(work: impl FnOnce() -> Result<T, Failure>) -> Result<(T, f64), Failure> {
    let start = Instant::now();
    let value = work()?;
    Ok((value, start.elapsed().as_secs_f64()))
}

/// The quickest run of three at least, and what it gave.
fn quickest<T>(sizes: Sizes, mut work: impl FnMut() -> Result<T, Failure>) -> Result<(T, f64), Failure> {
    let start = Instant::now();
    let (mut value, mut quickest_s) = timed(&mut work)?;
    let mut runs = 1;
    while runs < 3 || start.elapsed().as_secs_f64() < sizes.repeated_s {
        let (again, seconds) = timed(&mut work)?;
        (value, quickest_s, runs) = (again, quickest_s.min(seconds), runs + 1);
    }
    Ok((value, quickest_s))
}
