//! Cubes as they are handed on.

mod reproducibility;
mod refusals;
