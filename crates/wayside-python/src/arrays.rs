//! Vectors as NumPy arrays: what Rust has allocated is Python's from then on, and nothing is copied.

use ndarray::{Array, Dimension, IntoDimension};
use numpy::{Element, PyArray, PyArray1, PyUntypedArray};
use pyo3::PyTypeCheck;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;

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

/// Array of which the library has the values in another form: what would be written into it would be lost.
/// So is the array that its memory is of, by which NumPy would let it be written to again.
pub(crate) fn read_only<T>(array: Bound<'_, T>) -> PyResult<Bound<'_, T>> {
    let base = array.as_any().getattr("base")?;
    if base.is_instance_of::<PyUntypedArray>() {
        base.call_method1("setflags", (false,))?;
    }
    array.as_any().call_method1("setflags", (false,))?;
    Ok(array)
}

/// Read-only array that is made when it is first asked for, and kept. Each call gives a new array over the
/// same memory, whose type and shape are its holder's own.
pub(crate) struct CachedArray<T>(PyOnceLock<Py<T>>);

impl<T> Default for CachedArray<T> {
    fn default() -> Self {
        Self(PyOnceLock::new())
    }
}

impl<T: PyTypeCheck> CachedArray<T> {
    /// Array over the kept memory; `make` makes that the first time.
    pub(crate) fn view<'py>(
        &self,
        py: Python<'py>,
        make: impl FnOnce() -> PyResult<Bound<'py, T>>,
    ) -> PyResult<Bound<'py, T>> {
        let kept = self.0.get_or_try_init(py, || make().and_then(read_only).map(Bound::unbind))?;
        Ok(kept.bind(py).as_any().call_method0("view")?.cast_into()?)
    }
}

impl<T: Element> CachedArray<PyArray1<T>> {
    /// Array over kept values of a kind, one each.
    pub(crate) fn each<'py, I: IntoIterator<Item = T>>(
        &self,
        py: Python<'py>,
        values: impl FnOnce() -> I,
    ) -> PyResult<Bound<'py, PyArray1<T>>> {
        self.view(py, || Ok(PyArray1::from_vec(py, values().into_iter().collect())))
    }
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
