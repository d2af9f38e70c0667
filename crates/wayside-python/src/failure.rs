//! Failures as exceptions of Python, `wayside.WaysideError`, with file, place and rule.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::path::Path;
use wayside::Failure;
use wayside::stepwise::SceneFault;

/// Exception of a failure. `file` is the one that the work was about, where one is known.
pub(crate) fn raised(py: Python<'_>, failure: &Failure, file: Option<&Path>) -> PyErr {
    let text = failure.to_string();
    let name = file.map(|file| file.display().to_string());
    let rule = name.as_ref().and_then(|name| text.strip_prefix(&format!("{name}: "))).unwrap_or(&text);
    let fault = made(|| fault_of(py, name.as_deref(), None, None, rule));
    exception(py, kind(failure), &text, fault.into_iter().collect())
}

/// The file, of those that were given, with whose name the sentence of a failure begins.
pub(crate) fn named<'a>(failure: &Failure, given: impl IntoIterator<Item = &'a Path>) -> Option<&'a Path> {
    let text = failure.to_string();
    let begins = |file: &&Path| {
        let behind = text.strip_prefix(&file.display().to_string());
        behind.is_some_and(|behind| behind.starts_with([':', '/']))
    };
    given.into_iter().find(begins)
}

/// Exception of a scene's broken rules; a scene from a dictionary has no file, and lines mean nothing.
pub(crate) fn of_scene(
    py: Python<'_>,
    failure: &Failure,
    faults: &[SceneFault],
    file: Option<&Path>,
) -> PyErr {
    let name = file.map(|file| file.display().to_string());
    let sentence = |fault: &SceneFault| {
        let place = fault.place.as_ref().map(|place| format!("{place}: ")).unwrap_or_default();
        let position = fault.position.map(|[line, column]| format!("{line}:{column}:")).unwrap_or_default();
        let file = name.as_ref().map(|name| format!("{name}:{position} ")).unwrap_or_default();
        format!("{file}{place}{}", fault.rule)
    };
    let text = faults.iter().map(sentence).collect::<Vec<_>>().join("\n");
    let position = |fault: &SceneFault| fault.position.filter(|_| name.is_some());
    let of = |fault: &SceneFault| {
        fault_of(py, name.as_deref(), position(fault), fault.place.as_deref(), &fault.rule)
    };
    let told = faults.iter().filter_map(|fault| made(|| of(fault))).collect();
    exception(py, kind(failure), &text, told)
}

/// Exception of an argument that is out of what it may be.
pub(crate) fn of_argument(name: &str, rule: impl std::fmt::Display) -> PyErr {
    pyo3::exceptions::PyValueError::new_err(format!("{name}: {rule}"))
}

fn made<'py>(make: impl FnOnce() -> PyResult<Bound<'py, PyDict>>) -> Option<Bound<'py, PyDict>> {
    make().ok()
}

fn fault_of<'py>(
    py: Python<'py>,
    file: Option<&str>,
    position: Option<[u32; 2]>,
    place: Option<&str>,
    rule: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let told = PyDict::new(py);
    told.set_item("file", file)?;
    told.set_item("line", position.map(|[line, _]| line))?;
    told.set_item("column", position.map(|[_, column]| column))?;
    told.set_item("place", place)?;
    told.set_item("rule", rule)?;
    Ok(told)
}

fn exception(py: Python<'_>, kind: &str, text: &str, faults: Vec<Bound<'_, PyDict>>) -> PyErr {
    let make = || {
        let class = py.import("wayside.errors")?.getattr("WaysideError")?;
        class.call1((text, kind, PyList::new(py, faults)?))
    };
    make().map_or_else(|error| error, PyErr::from_value)
}

/// Whether an input was refused or the system is to blame, as the exit codes of the program tell it.
fn kind(failure: &Failure) -> &'static str {
    match failure {
        Failure::Refused(_) | Failure::Unplaced(_) => "refused",
        Failure::System(_) => "system",
        Failure::CalledOff => "called off",
    }
}
