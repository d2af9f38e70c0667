//! Vectors as NumPy arrays: what Rust has allocated is Python's from then on, and nothing is copied.

use ndarray::{Array, Dimension, IntoDimension};
use numpy::{Element, PyArray, PyArray1, ToPyArray};
use pyo3::prelude::*;

/// Array of a vector in a shape, row-major.
///
/// # Errors
/// The vector has another number of values than the shape.
pub(crate) fn shaped<T: Element, D: Dimension>(
    py: Python<'_>,
    values: Vec<T>,
    shape: impl IntoDimension<Dim = D>,
) -> PyResult<Bound<'_, PyArray<T, D>>> {
    let array = Array::from_shape_vec(shape.into_dimension(), values);
    let array = array.map_err(|error| pyo3::exceptions::PyValueError::new_err(error.to_string()))?;
    Ok(PyArray::from_owned_array(py, array))
}

/// Array that is made when it is asked for, and made anew the next time: what would be written into it would
/// be lost.
pub(crate) fn read_only<T>(array: Bound<'_, T>) -> PyResult<Bound<'_, T>> {
    array.as_any().call_method1("setflags", (false,))?;
    Ok(array)
}

/// Axis of numbers, read-only.
pub(crate) fn axis<'py>(py: Python<'py>, values: &[f64]) -> PyResult<Bound<'py, PyArray1<f64>>> {
    read_only(values.to_pyarray(py))
}

/// Values of a kind, one each, read-only.
pub(crate) fn each<'py, T: Element>(
    py: Python<'py>,
    values: impl Iterator<Item = T>,
) -> PyResult<Bound<'py, PyArray1<T>>> {
    read_only(PyArray1::from_vec(py, values.collect()))
}

/// Rows of a record array: every field is made of words of 64 bits, so that no field is out of its place.
#[derive(Default)]
pub(crate) struct Records {
    words: Vec<u64>,
}

/// A field of a record array: its name, and how NumPy describes it.
pub(crate) type Field = (&'static str, &'static str);

impl Records {
    /// Adds a number.
    pub(crate) fn number(&mut self, value: f64) -> &mut Self {
        self.words.push(value.to_bits());
        self
    }

    /// Adds a number, NaN where there is none.
    pub(crate) fn number_or_nan(&mut self, value: Option<f64>) -> &mut Self {
        self.number(value.unwrap_or(f64::NAN))
    }

    /// Adds several numbers.
    pub(crate) fn numbers(&mut self, values: &[f64]) -> &mut Self {
        self.words.extend(values.iter().map(|value| value.to_bits()));
        self
    }

    /// Adds a whole number.
    pub(crate) fn whole(&mut self, value: impl Into<i64>) -> &mut Self {
        self.words.push(value.into() as u64);
        self
    }

    /// Adds a whole number, −1 where there is none.
    pub(crate) fn whole_or_none(&mut self, value: Option<impl Into<i64>>) -> &mut Self {
        self.whole(value.map_or(-1, Into::into))
    }

    /// The record array of these fields, `numpy.recarray`; its memory is that of the words.
    pub(crate) fn array<'py>(self, py: Python<'py>, fields: &[Field]) -> PyResult<Bound<'py, PyAny>> {
        let numpy = py.import("numpy")?;
        let kind = numpy.call_method1("dtype", (fields.to_vec(),))?;
        let records = numpy.getattr("recarray")?;
        PyArray1::from_vec(py, self.words).call_method1("view", (kind, records))
    }
}
