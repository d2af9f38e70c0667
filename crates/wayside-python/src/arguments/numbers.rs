//! Numbers that are given as arguments; those out of their range are refused by the argument's name, in the
//! words of the command line.

use crate::failure;
use pyo3::exceptions::PyOverflowError;
use pyo3::prelude::*;
use std::fmt::Display;
use std::ops::RangeInclusive;
use wayside::stepwise::bounds::{RANGES_M, or_infinite, outside};

/// Whole numbers of a seed, those that TOML has.
pub(crate) const SEEDS: RangeInclusive<i64> = 0..=i64::MAX;
/// Limits of memory, MiB.
pub(crate) const MEMORY_MIB: RangeInclusive<i64> = 1..=1 << 24;
/// Numbers of threads.
pub(crate) const THREADS: RangeInclusive<i64> = 1..=1024;

/// A number within a range.
pub(crate) fn number(name: &str, value: f64, allowed: &RangeInclusive<f64>) -> PyResult<f64> {
    match allowed.contains(&value) {
        true => Ok(value),
        false => Err(failure::argument_error(name, outside(allowed, value))),
    }
}

/// A distance in m, or infinitely far.
pub(crate) fn distance_m(name: &str, value: f64) -> PyResult<f64> {
    match value == f64::INFINITY || RANGES_M.contains(&value) {
        true => Ok(value),
        false => Err(failure::argument_error(name, or_infinite(outside(&RANGES_M, value)))),
    }
}

/// A whole number within a range, which has none below 0.
pub(crate) fn within(name: &str, value: i64, allowed: &RangeInclusive<i64>) -> PyResult<u64> {
    let fitting = Some(value).filter(|value| allowed.contains(value));
    fitting.and_then(|value| u64::try_from(value).ok()).ok_or_else(|| refused(name, value, allowed))
}

/// The same of whole numbers of any size.
pub(crate) fn whole(name: &str, given: &Bound<'_, PyAny>, allowed: &RangeInclusive<i64>) -> PyResult<u64> {
    let value = given.extract::<i64>().map_err(|error| match error {
        error if error.is_instance_of::<PyOverflowError>(given.py()) => refused(name, given, allowed),
        error => error,
    })?;
    within(name, value, allowed)
}

fn refused(name: &str, written: impl Display, allowed: &RangeInclusive<i64>) -> PyErr {
    let (first, last) = (allowed.start(), allowed.end());
    failure::argument_error(name, format!("it must be from {first} to {last}, is {written}"))
}

/// Limit of memory in MiB, where one is given.
pub(crate) fn memory_mib(given: Option<&Bound<'_, PyAny>>) -> PyResult<Option<u64>> {
    given.map(|given| whole("memory_limit_mib", given, &MEMORY_MIB)).transpose()
}
