//! Values in memory that Python has too. Whoever has an array can give it another type, shape or order, and
//! so can whoever has a view of it: they are looked at before each use.

use ndarray::Dimension;
use numpy::{Element, PyArray, PyArrayMethods, PyReadonlyArray, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Array of one type and shape, row by row.
pub(crate) struct Values<T, D> {
    name: &'static str,
    array: Py<PyArray<T, D>>,
    shape: D,
}

impl<T: Element, D: Dimension> Values<T, D> {
    /// Holds an array, which messages call by its name.
    pub(crate) fn of(name: &'static str, array: &Bound<'_, PyArray<T, D>>) -> Self {
        Self { name, array: array.clone().unbind(), shape: array.dims() }
    }

    /// An array over the same memory, anew each time: its type and shape are its holder's own.
    ///
    /// # Errors
    /// The array is not what it was.
    pub(crate) fn view<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray<T, D>>> {
        Ok(self.array(py)?.call_method0("view")?.cast_into()?)
    }

    /// The values as the library reads them.
    ///
    /// # Errors
    /// The array is not what it was.
    pub(crate) fn read<'py>(&self, py: Python<'py>) -> PyResult<PyReadonlyArray<'py, T, D>> {
        Ok(self.array(py)?.try_readonly()?)
    }

    fn array<'py>(&self, py: Python<'py>) -> PyResult<&Bound<'py, PyArray<T, D>>> {
        let array = self.array.bind(py).as_any().cast::<PyArray<T, D>>().ok();
        let is_as_it_was =
            |array: &&Bound<'py, PyArray<T, D>>| array.dims() == self.shape && array.is_c_contiguous();
        array.filter(is_as_it_was).ok_or_else(|| self.changed())
    }

    fn changed(&self) -> PyErr {
        let Self { name, shape, .. } = self;
        let shape = shape.slice();
        PyValueError::new_err(format!("{name}: the array has no longer its type and its shape {shape:?}"))
    }
}
