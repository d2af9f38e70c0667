//! Class `PathsFrame`: the paths of one frame as a structure of arrays.

use crate::arrays::{self, CachedArray, Field, Records};
use crate::dictionaries;
use artifact::paths::{Path, Paths as Schema, PathsFrame as Frame};
use num_complex::Complex64;
use numpy::{PyArray1, PyArray2, PyArray3};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;
use wayside::stepwise::{CompleteArtifact, delay_at_middle};

/// Scattering paths of one frame, n of them, referred to the frame's first sample.
#[pyclass(frozen, module = "wayside")]
pub(crate) struct PathsFrame {
    /// Paths of all frames.
    all: Arc<CompleteArtifact<Schema>>,
    /// Place among them.
    at: usize,
    arrays: Arrays,
}

/// Arrays of a frame by their names in Python.
#[derive(Default)]
struct Arrays {
    a_m: CachedArray<PyArray3<Complex64>>,
    slope_m_per_hz: CachedArray<PyArray3<Complex64>>,
    x_a_m: CachedArray<PyArray2<f64>>,
    x_b_m: CachedArray<PyArray2<f64>>,
    v_a_mps: CachedArray<PyArray2<f64>>,
    v_b_mps: CachedArray<PyArray2<f64>>,
    order: CachedArray<PyArray1<u8>>,
    target: CachedArray<PyArray1<u32>>,
    spans: CachedArray<PyAny>,
    delay_s: CachedArray<PyArray1<f64>>,
    delay_rate: CachedArray<PyArray1<f64>>,
}

impl PathsFrame {
    /// Frame at a place among those of all paths.
    pub(crate) fn of(all: Arc<CompleteArtifact<Schema>>, at: usize) -> Self {
        Self { all, at, arrays: Arrays::default() }
    }

    fn frame(&self) -> &Frame {
        &self.all.frames[self.at]
    }

    fn vectors<'py>(
        &self,
        py: Python<'py>,
        kept: &CachedArray<PyArray2<f64>>,
        of: impl Fn(&Path) -> [f64; 3],
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let paths = &self.frame().paths;
        kept.view(py, || arrays::shaped(py, paths.iter().flat_map(of).collect(), [paths.len(), 3]))
    }

    fn matrices<'py>(
        &self,
        py: Python<'py>,
        kept: &CachedArray<PyArray3<Complex64>>,
        of: impl Fn(&Path) -> [[Complex64; 2]; 2],
    ) -> PyResult<Bound<'py, PyArray3<Complex64>>> {
        let paths = &self.frame().paths;
        let values = || paths.iter().flat_map(|path| of(path).into_iter().flatten()).collect();
        kept.view(py, || arrays::shaped(py, values(), [paths.len(), 2, 2]))
    }

    /// Delays at the frame's middle from the array's centre, s, with their rates, s/s.
    fn delays(&self) -> impl Iterator<Item = (f64, f64)> {
        let radar = self.all.header.radar.in_frame(self.frame().index);
        self.frame().paths.iter().map(move |path| delay_at_middle(&radar, path))
    }
}

const SPAN: [Field; 13] = [
    ("first_s", "f8"),
    ("step_s", "f8"),
    ("moments", "i8"),
    ("moment", "i8"),
    ("transmit", "(3,)f8"),
    ("receive", "(3,)f8"),
    ("first_m", "f8"),
    ("step_m", "f8"),
    ("places", "i8"),
    ("place", "i8"),
    ("side_transmit", "(3,)f8"),
    ("side_receive", "(3,)f8"),
    ("side_from_m", "f8"),
];

fn add_span(records: &mut Records, path: &Path) {
    let (span, array) = (path.curve.span, path.curve.array_span);
    let [first_s, step_s] = [span.map(|span| span.first_s), span.map(|span| span.step_s)];
    records.number_or_nan(first_s).number_or_nan(step_s);
    records.whole_or_none(span.map(|span| span.moments)).whole_or_none(span.map(|span| span.moment));
    records.numbers(&array.map_or([f64::NAN; 3], |span| span.transmit));
    records.numbers(&array.map_or([f64::NAN; 3], |span| span.receive));
    let [first_m, step_m] = [array.map(|span| span.first_m), array.map(|span| span.step_m)];
    records.number_or_nan(first_m).number_or_nan(step_m);
    records.whole_or_none(array.map(|span| span.places)).whole_or_none(array.map(|span| span.place));
    let side = path.curve.array_side;
    records.numbers(&side.map_or([f64::NAN; 3], |side| side.transmit));
    records.numbers(&side.map_or([f64::NAN; 3], |side| side.receive));
    records.number_or_nan(side.map(|side| side.from_m));
}

#[pymethods]
impl PathsFrame {
    /// Index of the frame, from 0.
    #[getter]
    fn index(&self) -> u32 {
        self.frame().index
    }

    /// Time of the frame's first sample, s.
    #[getter]
    fn time_s(&self) -> f64 {
        self.frame().time_s
    }

    /// Scattering amplitude a in metres, complex128 [n, receive, transmit], v = 0, h = 1, at f_c.
    #[getter]
    fn a_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<Complex64>>> {
        self.matrices(py, &self.arrays.a_m, |path| path.amplitude_m)
    }

    /// Slope da/df in m/Hz, complex128 [n, receive, transmit].
    #[getter]
    fn slope_m_per_hz<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<Complex64>>> {
        self.matrices(py, &self.arrays.slope_m_per_hz, |path| path.slope_m_per_hz)
    }

    /// Place x_a where the node appears from the transmitter, world metres, float64 [n, 3].
    #[getter]
    fn x_a_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.vectors(py, &self.arrays.x_a_m, |path| path.apparent_tx_m)
    }

    /// Place x_b where the node appears from the receiver, world metres, float64 [n, 3].
    #[getter]
    fn x_b_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.vectors(py, &self.arrays.x_b_m, |path| path.apparent_rx_m)
    }

    /// Velocity of x_a, m/s, float64 [n, 3].
    #[getter]
    fn v_a_mps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.vectors(py, &self.arrays.v_a_mps, |path| path.apparent_tx_mps)
    }

    /// Velocity of x_b, m/s, float64 [n, 3].
    #[getter]
    fn v_b_mps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.vectors(py, &self.arrays.v_b_mps, |path| path.apparent_rx_mps)
    }

    /// Number of bounces, uint8 [n]; 0 of a point target.
    #[getter]
    fn order<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u8>>> {
        self.arrays.order.each(py, || self.frame().paths.iter().map(|path| path.order))
    }

    /// Index of the target in `Paths.targets`, uint32 [n]; 4,294,967,295 of the road's own backscatter.
    #[getter]
    fn target<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u32>>> {
        self.arrays.target.each(py, || self.frame().paths.iter().map(|path| path.target))
    }

    /// Part of the frame and of the array that each path stands for, a `numpy.recarray` [n]: first_s, step_s,
    /// moments, moment (of ways that were traced at several moments, each blended with its neighbours),
    /// transmit [3], receive [3], first_m, step_m, places, place (likewise from several places along the
    /// array's row), side_transmit [3], side_receive [3], side_from_m (of outlines that are those of the
    /// transmitter or of the receiver); NaN and −1 of a path that stands for all of it.
    #[getter]
    fn spans<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.arrays.spans.view(py, || {
            let mut records = Records::default();
            self.frame().paths.iter().for_each(|path| add_span(&mut records, path));
            records.array(py, &SPAN)
        })
    }

    /// Delay at the frame's middle from the array's centre, s, float64 [n].
    #[getter]
    fn delay_s<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.arrays.delay_s.each(py, || self.delays().map(|(delay_s, _)| delay_s))
    }

    /// Rate of the delay at the frame's middle, s/s, float64 [n].
    #[getter]
    fn delay_rate<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.arrays.delay_rate.each(py, || self.delays().map(|(_, rate)| rate))
    }

    /// Numerical errors in dB relative to the echo; None where not estimated and of no error at all.
    #[getter]
    fn error_db<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        dictionaries::errors(py, &self.frame().error)
    }

    /// Errors of what the model leaves out, in dB relative to the echo.
    #[getter]
    fn model_error_db<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        dictionaries::model_errors(py, &self.frame().model_error)
    }

    fn __len__(&self) -> usize {
        self.frame().paths.len()
    }

    fn __repr__(&self) -> String {
        format!("<wayside.PathsFrame {}: {} paths>", self.frame().index, self.frame().paths.len())
    }
}
