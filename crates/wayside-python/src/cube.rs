//! Class `Cube`: radar data cubes, simulated or anybody's.

use crate::arrays::CachedArray;
use crate::dictionaries;
use crate::failure;
use crate::range_doppler::RangeDoppler;
use crate::shared::artifacts;
use crate::shared::handle::Handle;
use crate::shared::samples::Samples;
use crate::work::{ProgressListener, carry_out};
use artifact::cube::Cube as Schema;
use num_complex::Complex32;
use numpy::{PyArray1, PyArray4, PyArrayMethods, PyReadonlyArray4};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;
use wayside::stepwise::{CompleteArtifact, Processing, cubes_of_samples};

/// Radar data cubes of the frames of a scene, √W or what was imported.
///
/// `Cube(samples, scene)` makes them of anybody's samples: complex values [frame, channel, chirp, sample], or
/// of one frame [channel, chirp, sample]; `scene` is a Scene, a path or a dictionary and says what the radar
/// is. Their unit is what `import` takes it for: steps of a converter where `full_scale`, the largest part of
/// a sample, is told, or all samples are whole numbers; else √W.
#[pyclass(frozen, module = "wayside")]
pub(crate) struct Cube {
    samples: Arc<Samples>,
    time_s: CachedArray<PyArray1<f64>>,
}

impl Cube {
    /// Hands the cubes over to Python.
    pub(crate) fn of(py: Python<'_>, recorded: CompleteArtifact<Schema>) -> PyResult<Self> {
        Ok(Self::with(Samples::of(py, recorded)?))
    }

    fn with(samples: Samples) -> Self {
        Self { samples: Arc::new(samples), time_s: CachedArray::default() }
    }

    /// Range-Doppler maps of all channels.
    pub(crate) fn maps(&self, py: Python<'_>, listener: ProgressListener<'_, '_>) -> PyResult<RangeDoppler> {
        let (header, frames) = (self.samples.header.clone(), self.samples.frames(py)?);
        let (processing, maps) = carry_out(py, &[], listener, move |cancellation| {
            let processing = Processing::of(&header)?;
            let maps = processing.maps(&frames, cancellation)?;
            Ok((processing, maps))
        })?;
        let Samples { from, header, .. } = &*self.samples;
        let recorded =
            CompleteArtifact { from: processing.provenance(from), header: header.clone(), frames: maps };
        RangeDoppler::of(py, recorded, processing, Some(Arc::clone(&self.samples)))
    }
}

/// Samples as complex64 `[frame, channel, chirp, sample]`; the very array where it is that already.
fn four_axes<'py>(samples: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray4<Complex32>>> {
    let numpy = samples.py().import("numpy")?;
    if samples.py().import("numpy.ma")?.call_method1("is_masked", (samples,))?.is_truthy()? {
        let rule = "it is a masked array, and what its mask hides has no value: fill it, samples.filled(0)";
        return Err(failure::argument_error("samples", rule));
    }
    let as_they_are_read = ["C_CONTIGUOUS", "ALIGNED", "ENSUREARRAY"];
    let array = numpy.call_method1("require", (samples, numpy.getattr("complex64")?, as_they_are_read))?;
    let axes: usize = array.getattr("ndim")?.extract()?;
    let whole = if axes == 3 { array.get_item(numpy.getattr("newaxis")?)? } else { array };
    let rule = "complex values [frame, channel, chirp, sample], or of one frame [channel, chirp, sample]";
    whole.cast_into().map_err(|_| failure::argument_error("samples", format!("{axes} axes: {rule}")))
}

#[pymethods]
impl Cube {
    #[new]
    #[pyo3(signature = (samples, scene, *, full_scale=None))]
    fn new(
        py: Python<'_>,
        samples: &Bound<'_, PyAny>,
        scene: &Bound<'_, PyAny>,
        full_scale: Option<f64>,
    ) -> PyResult<Self> {
        let handle = Handle::of_any(scene)?;
        let (read, array) = (handle.get(), four_axes(samples)?);
        let opened = read.opened(py)?;
        let readonly: PyReadonlyArray4<'_, Complex32> = array.try_readonly()?;
        let shape = readonly.as_array().dim().into();
        let made = cubes_of_samples(&opened, shape, readonly.as_slice()?, full_scale);
        let recorded = made.map_err(|failure| failure::exception_of(py, &failure, &[read.message_path()]))?;
        drop(readonly);
        Ok(Self::with(Samples::in_array(recorded, &array)))
    }

    /// Reads a `.cube` artifact.
    #[staticmethod]
    #[pyo3(signature = (file))]
    fn read(py: Python<'_>, file: PathBuf) -> PyResult<Self> {
        Self::of(py, artifacts::read(py, &file)?)
    }

    /// Writes a `.cube` artifact, the bytes of `wayside echo`; another format's ending is refused.
    #[pyo3(signature = (file))]
    fn write(&self, py: Python<'_>, file: PathBuf) -> PyResult<()> {
        artifacts::write(py, &self.samples.recorded(py)?, &file)
    }

    /// Unit of the samples: "sqrt(W)", or "ADC steps" of a file that was imported so.
    #[getter]
    fn unit(&self) -> &'static str {
        self.samples.header.unit.name()
    }

    /// IF samples in `unit`, complex64 [frame, channel, chirp, sample]; channel = tx·N_rx + rx.
    #[getter]
    fn samples<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray4<Complex32>>> {
        self.samples.array.view(py)
    }

    /// Times of the frames' first samples, s, float64 [frame].
    #[getter]
    fn time_s<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.time_s.each(py, || self.samples.times_s())
    }

    /// Numerical errors of each frame in dB relative to the echo.
    #[getter]
    fn error_db<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        self.samples.errors().map(|error| dictionaries::errors(py, error)).collect()
    }

    /// Range-Doppler maps of all channels, with the cells that the detector found.
    #[pyo3(signature = (*, progress=None))]
    fn range_doppler(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<RangeDoppler> {
        self.maps(py, ProgressListener::all(progress))
    }

    /// Cube with named axes: `xarray.DataArray`, where xarray is installed.
    fn to_xarray<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("wayside.tables")?.call_method1("cube_to_xarray", (slf,))
    }

    fn __len__(&self) -> usize {
        self.samples.errors().count()
    }

    fn __repr__(&self) -> String {
        let [channels, chirps, samples] = self.samples.header.shape();
        format!("<wayside.Cube: {} frames × [{channels}, {chirps}, {samples}]>", self.__len__())
    }
}
