//! Class `Rcs` and the function that makes it: S of a mesh over frequency and aspect.

use crate::arguments::document;
use crate::arguments::numbers;
use crate::arguments::words::meaning;
use crate::arrays::{self, CachedArray};
use crate::dictionaries;
use crate::failure;
use crate::shared::values::Values;
use crate::work::{ProgressListener, carry_out};
use artifact::material::Transmission;
use ndarray::{Array3, Ix3};
use num_complex::Complex64;
use numpy::{PyArray1, PyArray2, PyArray3, PyUntypedArrayMethods};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use wayside::Failure;
use wayside::host::memory::Allowance;
use wayside::stepwise::bounds::{
    ACCURACIES_DB, AZIMUTHS_DEG, BOUNCES, ELEVATIONS_DEG, FREQUENCIES_GHZ, UNIT_SCALES,
};
use wayside::stepwise::table_words::{
    EDGES, NODES, POLARIZATIONS, SIDES, SMALL_PARTS, SURFACES, TRANSMISSION,
};
use wayside::stepwise::{
    self, DENSITY_PER_WAVELENGTH, DescribedTable, RequestedReceiver, RequestedTable, TableDescription,
};

/// Scattering amplitude S of a mesh over frequency, elevation and azimuth.
#[pyclass(frozen, module = "wayside")]
pub(crate) struct Rcs {
    description: TableDescription,
    amplitude: Values<Complex64, Ix3>,
    freq_hz: CachedArray<PyArray1<f64>>,
    el_deg: CachedArray<PyArray1<f64>>,
    az_deg: CachedArray<PyArray1<f64>>,
}

impl Rcs {
    fn of(description: TableDescription, amplitude: &Bound<'_, PyArray3<Complex64>>) -> Self {
        Self {
            description,
            amplitude: Values::of("s_m", amplitude),
            freq_hz: CachedArray::default(),
            el_deg: CachedArray::default(),
            az_deg: CachedArray::default(),
        }
    }
}

/// S of a file of NumPy in the shape that its description tells.
fn loaded<'py>(py: Python<'py>, file: &Path, shape: [usize; 3]) -> PyResult<Bound<'py, PyArray3<Complex64>>> {
    let numpy = py.import("numpy")?;
    let words = PyDict::new(py);
    words.set_item("allow_pickle", false)?;
    let read = numpy.call_method("load", (file,), Some(&words));
    let read = read.map_err(|error| unread(py, file, &error))?;
    let array = numpy.call_method1("ascontiguousarray", (read,))?.cast_into::<PyArray3<Complex64>>().ok();
    let rule = format!("S is complex128 {shape:?}, as the description beside it tells");
    let other = || failure::exception_of(py, &Failure::refused(rule).about(file), &[Some(file)]);
    array.filter(|array| array.shape() == shape).ok_or_else(other)
}

/// Exception of a file that NumPy does not read.
fn unread(py: Python<'_>, file: &Path, error: &PyErr) -> PyErr {
    let failure = match error.is_instance_of::<PyOSError>(py) {
        true => Failure::system(file, "read", error.value(py)),
        false => Failure::refused(error.value(py)).about(file),
    };
    failure::exception_of(py, &failure, &[Some(file)])
}

#[pymethods]
impl Rcs {
    /// Reads a table of `wayside rcs` or of `write`: `S.npy` with the `S.json` beside it.
    #[staticmethod]
    #[pyo3(signature = (file))]
    fn read(py: Python<'_>, file: PathBuf) -> PyResult<Self> {
        let read = py.detach(|| TableDescription::read(&file));
        let description = read.map_err(|failure| failure::exception_of(py, &failure, &[Some(&file)]))?;
        let amplitude = loaded(py, &file, description.shape())?;
        Ok(Self::of(description, &amplitude))
    }

    /// Writes the table as `S.npy`, the bytes of `wayside rcs`, and its description as `S.json` beside it;
    /// another format's ending is refused.
    #[pyo3(signature = (file))]
    fn write(&self, py: Python<'_>, file: PathBuf) -> PyResult<()> {
        let values = self.amplitude.read(py)?.as_slice()?.to_vec();
        let written = py.detach(|| self.description.write(&file, &values));
        written.map_err(|failure| failure::exception_of(py, &failure, &[Some(&file)]))
    }

    /// Scattering amplitude S in metres, complex128 [freq, el, az], phase at the mesh's origin; |S|² is the
    /// RCS.
    #[getter]
    fn s_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<Complex64>>> {
        self.amplitude.view(py)
    }

    /// Radar cross section in dBsm, float64 [freq, el, az]; of `s_m` as it is now.
    #[getter]
    fn rcs_dbsm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let amplitude = self.amplitude.read(py)?;
        let levels: Array3<f64> = amplitude.as_array().mapv(|s| 10.0 * s.norm_sqr().log10());
        arrays::read_only(PyArray3::from_owned_array(py, levels))
    }

    /// Frequencies, Hz, float64 [freq].
    #[getter]
    fn freq_hz<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.freq_hz.each(py, || self.description.frequency_hz.clone())
    }

    /// Elevations above the body's horizon, degrees, float64 [el].
    #[getter]
    fn el_deg<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.el_deg.each(py, || self.description.elevation_deg.clone())
    }

    /// Azimuths, degrees, float64 [az]; 0 looks at the body's front, growing counter-clockwise from above.
    #[getter]
    fn az_deg<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.az_deg.each(py, || self.description.azimuth_deg.clone())
    }

    /// Distance of the antenna from the mesh's origin, m; infinite for the far field.
    #[getter]
    fn range_m(&self) -> f64 {
        self.description.range_m
    }

    /// Range from which on a table of infinite range is right, m: 2D²/λ.
    #[getter]
    fn far_field_from_m(&self) -> f64 {
        self.description.far_field_from_m
    }

    /// Numerical errors of the table in dB relative to it; None where not estimated and of no error.
    #[getter]
    fn error_db<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        dictionaries::figures(py, &self.description.error)
    }

    /// Errors of what the model leaves out, in dB relative to the table.
    #[getter]
    fn model_error_db<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        dictionaries::model_figures(py, &self.description.model_error)
    }

    /// Table with named axes: `xarray.Dataset`, where xarray is installed.
    fn to_xarray<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("wayside.tables")?.call_method1("rcs_to_xarray", (slf,))
    }

    fn __repr__(&self) -> String {
        format!("<wayside.Rcs {:?} [freq, el, az]>", self.description.shape())
    }
}

/// Makes S of a mesh by BART, as `wayside rcs` does: `s_m` of the result is complex128 [freq, el, az] in
/// metres.
///
/// `mesh` is a file (of assets of OpenMATERIAL 3D in their own materials) or the name of an own vehicle.
/// `freq_ghz` (GHz), `az_deg` and `el_deg` are a number or numbers and become the three axes. Directions are
/// those of the antenna in body axes, in degrees: `az_deg` 0 before the front, growing counter-clockwise from
/// above, `el_deg` above the horizon; left out they are 0°, one direction from ahead. `range_m` is the
/// antenna's distance in metres, infinite for the far field. `rx_az_deg`, `rx_el_deg` (degrees) and
/// `rx_range_m` are a receiver that stands still elsewhere. `detail="statistical"` draws the small parts that
/// the mesh lacks. `materials` is a file that says what the mesh's names of materials stand for, else
/// everything conducts; `transmission="on"` follows waves through its sheets and needs it, "off" lets nothing
/// through.
#[pyfunction]
#[pyo3(signature = (mesh, freq_ghz, az_deg=None, el_deg=None, *, range_m=f64::INFINITY, pol="vv", bounces=3,
    edges="off", nodes="own-edge", surface="flat", detail="mesh", sides="two", accuracy_db=-40.0,
    rx_az_deg=None, rx_el_deg=None, rx_range_m=None, unit_scale=None, materials=None, transmission="off",
    memory_limit_mib=None, progress=None))]
#[allow(clippy::too_many_arguments, reason = "keywords of Python, each with a name where it is given")]
pub(crate) fn rcs(
    py: Python<'_>,
    mesh: PathBuf,
    freq_ghz: &Bound<'_, PyAny>,
    az_deg: Option<&Bound<'_, PyAny>>,
    el_deg: Option<&Bound<'_, PyAny>>,
    range_m: f64,
    pol: &str,
    bounces: i64,
    edges: &str,
    nodes: &str,
    surface: &str,
    detail: &str,
    sides: &str,
    accuracy_db: f64,
    rx_az_deg: Option<f64>,
    rx_el_deg: Option<f64>,
    rx_range_m: Option<f64>,
    unit_scale: Option<f64>,
    materials: Option<PathBuf>,
    transmission: &str,
    memory_limit_mib: Option<&Bound<'_, PyAny>>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Rcs> {
    let range_m = numbers::distance_m("range_m", range_m)?;
    let requested = RequestedTable {
        receiver: receiver(rx_az_deg, rx_el_deg, rx_range_m)?,
        unit_scale: scale(unit_scale)?,
        transmission: transmitted(transmission, materials.as_deref())?,
        method: "bart".to_owned(),
        density_per_wavelength: DENSITY_PER_WAVELENGTH,
        frequency_hz: in_hz(values("freq_ghz", Some(freq_ghz), FREQUENCIES_GHZ)?),
        elevation_deg: values("el_deg", el_deg, ELEVATIONS_DEG)?,
        azimuth_deg: values("az_deg", az_deg, AZIMUTHS_DEG)?,
        range_m,
        polarization: meaning("pol", pol, &POLARIZATIONS)?,
        bounces: numbers::within("bounces", bounces, &BOUNCES)? as u8,
        nodes: meaning("nodes", nodes, &NODES)?,
        sides: meaning("sides", sides, &SIDES)?,
        edges: meaning("edges", edges, &EDGES)?,
        surface: meaning("surface", surface, &SURFACES)?,
        small_parts: meaning("detail", detail, &SMALL_PARTS)?,
        accuracy_db: document::accuracy_db(accuracy_db, &ACCURACIES_DB)?,
        mesh: mesh.clone(),
        materials: materials.clone(),
    };
    let memory = Allowance::of(numbers::memory_mib(memory_limit_mib)?);
    let (files, listener) = ([Some(mesh.as_path()), materials.as_deref()], ProgressListener::all(progress));
    let table =
        carry_out(py, &files, listener, move |cancellation| stepwise::rcs(&requested, memory, cancellation))?;
    let DescribedTable { amplitude_m, description } = table;
    let amplitude = arrays::shaped(py, amplitude_m, description.shape())?;
    Ok(Rcs::of(description, &amplitude))
}

/// Lowest and highest coordinates of a mesh in metres, body axes as its file has them, float64 [2, 3].
#[pyfunction]
#[pyo3(signature = (mesh, unit_scale=None))]
pub(crate) fn mesh_bounds_m(
    py: Python<'_>,
    mesh: PathBuf,
    unit_scale: Option<f64>,
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let unit_scale = scale(unit_scale)?;
    let read = py.detach(|| stepwise::mesh(&mesh, unit_scale));
    let read = read.map_err(|failure| failure::exception_of(py, &failure, &[Some(&mesh)]))?;
    let along = |axis: usize| read.vertices_m.iter().map(move |vertex| vertex[axis]);
    let low = (0..3).map(|axis| along(axis).fold(f64::INFINITY, f64::min));
    let high = (0..3).map(|axis| along(axis).fold(f64::NEG_INFINITY, f64::max));
    arrays::shaped(py, low.chain(high).collect(), [2, 3])
}

/// A fixed receiver, told by two angles; its distance is that of the transmitter where none is told.
fn receiver(
    az_deg: Option<f64>,
    el_deg: Option<f64>,
    range_m: Option<f64>,
) -> PyResult<Option<RequestedReceiver>> {
    let lacks = |lacking: &str, name: &str| Err(failure::argument_error(lacking, format!("{name} needs it")));
    match (az_deg, el_deg) {
        (Some(azimuth), Some(elevation)) => Ok(Some(RequestedReceiver {
            azimuth_deg: numbers::number("rx_az_deg", azimuth, &AZIMUTHS_DEG)?,
            elevation_deg: numbers::number("rx_el_deg", elevation, &ELEVATIONS_DEG)?,
            range_m: range_m.map(|range_m| numbers::distance_m("rx_range_m", range_m)).transpose()?,
        })),
        (Some(_), None) => lacks("rx_el_deg", "rx_az_deg"),
        (None, Some(_)) => lacks("rx_az_deg", "rx_el_deg"),
        (None, None) if range_m.is_some() => lacks("rx_az_deg", "rx_range_m"),
        (None, None) => Ok(None),
    }
}

/// Whether waves are followed through sheets, which only a file of materials tells of.
fn transmitted(given: &str, materials: Option<&Path>) -> PyResult<Transmission> {
    match meaning("transmission", given, &TRANSMISSION)? {
        Transmission::Followed if materials.is_none() => {
            Err(failure::argument_error("materials", "transmission needs it"))
        }
        found => Ok(found),
    }
}

fn scale(given: Option<f64>) -> PyResult<Option<f64>> {
    given.map(|scale| numbers::number("unit_scale", scale, &UNIT_SCALES)).transpose()
}

/// One number or an array of them; 0 where nothing is said.
fn values(name: &str, given: Option<&Bound<'_, PyAny>>, allowed: RangeInclusive<f64>) -> PyResult<Vec<f64>> {
    let Some(given) = given else { return Ok(vec![0.0]) };
    let one = given.extract::<f64>().map(|value| vec![value]);
    let several = one.or_else(|_| given.extract::<Vec<f64>>())?;
    if several.is_empty() {
        return Err(failure::argument_error(name, "at least one value is needed"));
    }
    several.into_iter().map(|value| numbers::number(name, value, &allowed)).collect()
}

fn in_hz(frequencies_ghz: Vec<f64>) -> Vec<f64> {
    frequencies_ghz.into_iter().map(|ghz| ghz * 1e9).collect()
}
