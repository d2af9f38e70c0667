//! Figures as dictionaries of Python.

use artifact::{ErrorBudget, ModelError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use wayside::outcome::error_figures::{ErrorFigures, ModelErrorFigures};
use wayside::stepwise::{error_figures, model_error_figures};

/// Numerical errors in dB relative to the echo; `None` where not estimated and of no error at all.
pub(crate) fn errors<'py>(py: Python<'py>, error: &ErrorBudget) -> PyResult<Bound<'py, PyDict>> {
    figures(py, &error_figures(error))
}

/// Errors of the physical model in dB relative to the echo.
pub(crate) fn model_errors<'py>(py: Python<'py>, error: &ModelError) -> PyResult<Bound<'py, PyDict>> {
    model_figures(py, &model_error_figures(error))
}

/// Figures of numerical errors by their names.
pub(crate) fn figures<'py>(py: Python<'py>, figures: &ErrorFigures) -> PyResult<Bound<'py, PyDict>> {
    let dictionary = PyDict::new(py);
    dictionary.set_item("total", figures.total)?;
    figures.shares().iter().try_for_each(|(name, value)| dictionary.set_item(name, value))?;
    Ok(dictionary)
}

/// Figures of the physical model's errors by their names.
pub(crate) fn model_figures<'py>(
    py: Python<'py>,
    figures: &ModelErrorFigures,
) -> PyResult<Bound<'py, PyDict>> {
    let dictionary = PyDict::new(py);
    let sources = figures.sources();
    sources.iter().try_for_each(|(name, value)| dictionary.set_item(name.replace(' ', "_"), value))?;
    Ok(dictionary)
}

/// JSON as Python has it.
pub(crate) fn json<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (text,))
}
