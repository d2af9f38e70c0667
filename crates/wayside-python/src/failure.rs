//! Failures as exceptions of Python, `wayside.WaysideError`, with file, place and rule.

mod sentences; // of failures, taken apart

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use sentences::Sentence;
use std::path::Path;
use wayside::Failure;
use wayside::stepwise::SceneFault;

/// Exception of a failure. `files` are those that the work was given: it is about the one with whose name its
/// sentence begins, else about the first, where one is known.
pub(crate) fn exception_of(py: Python<'_>, failure: &Failure, files: &[Option<&Path>]) -> PyErr {
    let text = failure.to_string();
    let file = named(&text, files).or(files.first().copied().flatten());
    let name = file.map(|file| file.display().to_string());
    let fault = |told: &Sentence<'_>| made(|| fault_of(py, name.as_deref(), told));
    let faults = sentences::about(&text, name.as_deref()).iter().filter_map(fault).collect();
    exception(py, kind(failure), &text, faults)
}

/// The file, of those that were given, with whose name a sentence begins.
fn named<'a>(text: &str, given: &[Option<&'a Path>]) -> Option<&'a Path> {
    let begins = |file: &&Path| {
        let behind = text.strip_prefix(&file.display().to_string());
        behind.is_some_and(|behind| behind.starts_with([':', '/']))
    };
    given.iter().copied().flatten().find(begins)
}

/// Exception of a scene's broken rules; a scene from a dictionary has no file, and lines mean nothing.
pub(crate) fn scene_exception(
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
        let [line, column] = [0, 1].map(|at| position(fault).map(|position| position[at]));
        let told = Sentence { line, column, place: fault.place.as_deref(), rule: &fault.rule };
        fault_of(py, name.as_deref(), &told)
    };
    let told = faults.iter().filter_map(|fault| made(|| of(fault))).collect();
    exception(py, kind(failure), &text, told)
}

/// Exception of an argument that is out of what it may be.
pub(crate) fn argument_error(name: &str, rule: impl std::fmt::Display) -> PyErr {
    pyo3::exceptions::PyValueError::new_err(format!("{name}: {rule}"))
}

fn made<'py>(make: impl FnOnce() -> PyResult<Bound<'py, PyDict>>) -> Option<Bound<'py, PyDict>> {
    make().ok()
}

fn fault_of<'py>(py: Python<'py>, file: Option<&str>, told: &Sentence<'_>) -> PyResult<Bound<'py, PyDict>> {
    let fault = PyDict::new(py);
    fault.set_item("file", file)?;
    fault.set_item("line", told.line)?;
    fault.set_item("column", told.column)?;
    fault.set_item("place", told.place)?;
    fault.set_item("rule", told.rule)?;
    Ok(fault)
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
        Failure::Cancelled => "called off",
    }
}
