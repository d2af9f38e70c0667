//! Class `RangeDoppler`: maps of all channels and what the detector made of them.

use crate::arrays::{self, CachedArray};
use crate::detections::Detections;
use crate::failure;
use crate::shared::artifacts;
use crate::shared::maps::Maps;
use crate::shared::samples::Samples;
use crate::work::{ProgressListener, carry_out};
use artifact::points::Points;
use artifact::rdm::Rdm;
use num_complex::Complex32;
use numpy::{PyArray1, PyArray2, PyArray3, PyArray4};
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use wayside::host::progress;
use wayside::stepwise::{CompleteArtifact, Processing};

/// Range-Doppler maps of the frames of a cube.
#[pyclass(frozen, module = "wayside")]
pub(crate) struct RangeDoppler {
    maps: Arc<Maps>,
    range_m: CachedArray<PyArray1<f64>>,
    velocity_mps: CachedArray<PyArray1<f64>>,
    velocity_of_frames_mps: CachedArray<PyArray2<f64>>,
    time_s: CachedArray<PyArray1<f64>>,
}

impl RangeDoppler {
    /// Hands the maps over to Python; those of a file have no samples.
    pub(crate) fn of(
        py: Python<'_>,
        recorded: CompleteArtifact<Rdm>,
        processing: Processing,
        samples: Option<Arc<Samples>>,
    ) -> PyResult<Self> {
        Ok(Self {
            maps: Arc::new(Maps::of(py, recorded, processing, samples)?),
            range_m: CachedArray::default(),
            velocity_mps: CachedArray::default(),
            velocity_of_frames_mps: CachedArray::default(),
            time_s: CachedArray::default(),
        })
    }

    /// Points and objects of the maps.
    pub(crate) fn found(&self, py: Python<'_>, listener: ProgressListener<'_, '_>) -> PyResult<Detections> {
        let Maps { samples, processing, from, .. } = &*self.maps;
        let cubes = samples.as_ref().map(|samples| samples.frames(py)).transpose()?;
        let (maps, processing, from) = (self.maps.frames(py)?, Arc::clone(processing), from.clone());
        let all: CompleteArtifact<Points> = carry_out(py, &[], listener, move |cancellation| {
            let header = processing.points_header();
            let frames = match &cubes {
                Some(cubes) => processing.points(&maps, cubes, cancellation)?,
                None => processing.points_of_maps(&maps, cancellation)?,
            };
            processing.remarks(&frames).into_iter().for_each(progress::note);
            Ok(CompleteArtifact { from, header, frames })
        })?;
        Ok(Detections::of(all, Some(Arc::clone(&self.maps))))
    }
}

#[pymethods]
impl RangeDoppler {
    /// Reads a `.rdm` artifact. Its maps have no samples, so `detect` refuses them where `refine` of [dsp] is
    /// "on".
    #[staticmethod]
    #[pyo3(signature = (file))]
    fn read(py: Python<'_>, file: PathBuf) -> PyResult<Self> {
        let recorded: CompleteArtifact<Rdm> = artifacts::read(py, &file)?;
        let processing = Processing::of(&recorded.header);
        let processing = processing.map_err(|failure| failure::exception_of(py, &failure, &[Some(&file)]))?;
        Self::of(py, recorded, processing, None)
    }

    /// Writes a `.rdm` artifact, the bytes of `wayside dsp`; another format's ending is refused.
    #[pyo3(signature = (file))]
    fn write(&self, py: Python<'_>, file: PathBuf) -> PyResult<()> {
        artifacts::write(py, &self.maps.recorded(py)?, &file)
    }

    /// Map values in `unit`, complex64 [frame, channel, doppler, range]; zero velocity at N/2.
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray4<Complex32>>> {
        self.maps.values.view(py)
    }

    /// State of each cell, uint8 [frame, doppler, range]: 0 untested, 1 tested, 2 detected.
    #[getter]
    fn mask<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        self.maps.mask.view(py)
    }

    /// Ranges of the columns, m, float64 [range].
    #[getter]
    fn range_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.range_m.each(py, || self.maps.processing.axes().0)
    }

    /// Radial velocities of the rows, m/s, receding positive, float64 [doppler]; of the first sub-frame.
    #[getter]
    fn velocity_mps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.velocity_mps.each(py, || self.maps.processing.axes().1)
    }

    /// Radial velocities of the rows of each frame, m/s, receding positive, float64 [frame, doppler].
    #[getter]
    fn velocity_of_frames_mps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let Maps { processing, frames, .. } = &*self.maps;
        let rows = || processing.axes().1.len();
        let values = || frames.iter().flat_map(|frame| processing.velocities_mps(frame.index)).collect();
        self.velocity_of_frames_mps.view(py, || arrays::shaped(py, values(), [frames.len(), rows()]))
    }

    /// Unit of the values: "sqrt(W)", or "ADC steps" of samples that were imported so.
    #[getter]
    fn unit(&self) -> &'static str {
        self.maps.header.unit.name()
    }

    /// Times of the frames' first samples, s, float64 [frame].
    #[getter]
    fn time_s<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.time_s.each(py, || self.maps.frames.iter().map(|frame| frame.time_s))
    }

    /// Number of cells above the detector's threshold in each frame.
    #[getter]
    fn detections(&self) -> Vec<u64> {
        self.maps.frames.iter().map(|frame| frame.detections).collect()
    }

    /// Points and objects of the maps. What their directions lack (an array that tells no azimuth, points
    /// without a height) is told to the logger `wayside`.
    #[pyo3(signature = (*, progress=None))]
    fn detect(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Detections> {
        self.found(py, ProgressListener::all(progress))
    }

    /// Maps with named axes: `xarray.Dataset`, where xarray is installed.
    fn to_xarray<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("wayside.tables")?.call_method1("maps_to_xarray", (slf,))
    }

    fn __len__(&self) -> usize {
        self.maps.frames.len()
    }

    fn __repr__(&self) -> String {
        format!("<wayside.RangeDoppler: {} frames>", self.maps.frames.len())
    }
}
