//! The Python package `wayside`: a scene goes in, as a file or as a dictionary, NumPy arrays come out.
//!
//! Each class has a file. What is computed is computed by the crate `wayside` (`stepwise`, `run`); here stand
//! the ways from and to Python: [`failure`] makes exceptions, [`work`] lets the interpreter go while the
//! library works, [`arrays`] hands vectors over without a copy, [`arguments`] takes what names a scene.

mod failure; // exceptions with file, place and rule
mod arguments; // numbers, words and scenes, as Python gives them
mod work; // beside the interpreter, with progress and Ctrl-C
mod arrays; // vectors and records as NumPy arrays
mod dictionaries; // figures as dictionaries
mod shared; // scenes, samples and maps, as classes share them, and files
mod paths_frame;
mod paths;
mod tracks;
mod detections;
mod range_doppler;
mod cube;
mod scene;
mod rcs;

use pyo3::prelude::*;

/// Native part of the package `wayside`.
#[pymodule]
mod _core {
    use super::*;
    #[pymodule_export]
    use crate::arguments::document::file_keys;
    #[pymodule_export]
    use crate::cube::Cube;
    #[pymodule_export]
    use crate::detections::Detections;
    #[pymodule_export]
    use crate::paths::Paths;
    #[pymodule_export]
    use crate::paths_frame::PathsFrame;
    #[pymodule_export]
    use crate::range_doppler::RangeDoppler;
    #[pymodule_export]
    use crate::rcs::{Rcs, mesh_bounds_m, rcs};
    #[pymodule_export]
    use crate::scene::Scene;
    #[pymodule_export]
    use crate::tracks::Tracks;
    #[pymodule_export]
    use crate::work::{set_threads, withdraw};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        crate::work::listen();
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
