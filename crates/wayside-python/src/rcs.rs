//! Class `Rcs` and the function that makes it: S of a mesh over frequency and aspect.

use crate::arrays;
use crate::failure;
use crate::given::document;
use crate::given::numbers;
use crate::held::values::Values;
use crate::told;
use crate::work::{Hears, carry_out};
use artifact::Accuracy;
use artifact::material::Transmission;
use artifact::radar::Polarization;
use artifact::settings::{Edges, NodeRule, Sides, Surface};
use ndarray::{Array3, Ix3};
use num_complex::Complex64;
use numpy::{PyArray1, PyArray2, PyArray3};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use wayside::host::memory::Allowance;
use wayside::stepwise::bounds::{AZIMUTHS_DEG, BOUNCES, ELEVATIONS_DEG, FREQUENCIES_GHZ, UNIT_SCALES};
use wayside::stepwise::{self, RcsRequest, RcsTable, Standpoint};
use wayside::{CallOff, Failure};

/// Scattering amplitude S of a mesh over frequency, elevation and azimuth.
#[pyclass(frozen, module = "wayside")]
pub(crate) struct Rcs {
    table: RcsTable,
    request: RcsRequest,
    amplitude: Values<Complex64, Ix3>,
}

impl Rcs {
    fn of(py: Python<'_>, mut table: RcsTable, request: RcsRequest) -> PyResult<Self> {
        let values = std::mem::take(&mut table.amplitude_m);
        let amplitude = Values::of("s_m", &arrays::shaped(py, values, table.shape)?);
        Ok(Self { table, request, amplitude })
    }
}

fn degrees(radians: &[f64]) -> Vec<f64> {
    radians.iter().map(|angle| angle.to_degrees()).collect()
}

#[pymethods]
impl Rcs {
    /// Scattering amplitude S in metres, complex128 [freq, el, az], phase at the mesh's origin; |S|² is the
    /// RCS.
    #[getter]
    fn s_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<Complex64>>> {
        self.amplitude.view(py)
    }

    /// Radar cross section in dBsm, float64 [freq, el, az].
    #[getter]
    fn rcs_dbsm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let amplitude = self.amplitude.read(py)?;
        let levels: Array3<f64> = amplitude.as_array().mapv(|s| 10.0 * s.norm_sqr().log10());
        arrays::read_only(PyArray3::from_owned_array(py, levels))
    }

    /// Frequencies, Hz, float64 [freq].
    #[getter]
    fn freq_hz<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        arrays::axis(py, &self.request.frequency_hz)
    }

    /// Elevations above the body's horizon, degrees, float64 [el].
    #[getter]
    fn el_deg<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        arrays::axis(py, &degrees(&self.request.elevation_rad))
    }

    /// Azimuths, degrees, float64 [az]; 0 looks at the body's front, growing counter-clockwise from above.
    #[getter]
    fn az_deg<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        arrays::axis(py, &degrees(&self.request.azimuth_rad))
    }

    /// Distance of the antenna from the mesh's origin, m; infinite for the far field.
    #[getter]
    fn range_m(&self) -> f64 {
        self.request.range_m
    }

    /// Range from which on a table of infinite range is right, m: 2D²/λ.
    #[getter]
    fn far_field_from_m(&self) -> f64 {
        self.table.far_field_from_m
    }

    /// Numerical errors of the table in dB relative to it; None where not estimated and of no error.
    #[getter]
    fn error_db<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        told::errors(py, &self.table.error)
    }

    /// Errors of what the model leaves out, in dB relative to the table.
    #[getter]
    fn model_error_db<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        told::model_errors(py, &self.table.model_error)
    }

    /// Table with named axes: `xarray.Dataset`, where xarray is installed.
    fn to_xarray<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("wayside.tables")?.call_method1("rcs_to_xarray", (slf,))
    }

    fn __repr__(&self) -> String {
        format!("<wayside.Rcs {:?} [freq, el, az]>", self.table.shape)
    }
}

/// Makes S of a mesh by BART, as `wayside rcs` does: an `Rcs`, whose `s_m` is complex128 [freq, el, az] in
/// metres. `mesh` is a file (of assets of OpenMATERIAL 3D in their own materials) or the name of an own
/// vehicle. `freq_ghz` (GHz), `az_deg` and `el_deg` are a number or numbers and become the three axes.
/// Directions are those of the antenna in body axes, in degrees: `az_deg` 0 before the front, growing
/// counter-clockwise from above, `el_deg` above the horizon; left out they are 0°, one direction from ahead.
/// `range_m` is the antenna's distance in metres, infinite for the far field. `rx_az_deg`, `rx_el_deg`
/// (degrees) and `rx_range_m` are a receiver that stands still elsewhere. `materials` is a file that says
/// what the mesh's names of materials stand for, else everything conducts; `transmission="on"` follows waves
/// through its sheets and needs it, "off" lets nothing through.
#[pyfunction]
#[pyo3(signature = (mesh, freq_ghz, az_deg=None, el_deg=None, *, range_m=f64::INFINITY, pol="vv", bounces=3,
    edges="off", nodes="own-edge", surface="flat", sides="two", accuracy_db=-40.0, rx_az_deg=None,
    rx_el_deg=None, rx_range_m=None, unit_scale=None, materials=None, transmission="off",
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
    let receiver = receiver(rx_az_deg, rx_el_deg, rx_range_m, range_m)?;
    let (unit_scale, transmission) = (scale(unit_scale)?, transmitted(transmission, materials.as_deref())?);
    let request = RcsRequest {
        frequency_hz: scaled(values("freq_ghz", Some(freq_ghz), FREQUENCIES_GHZ)?, 1e9),
        elevation_rad: scaled(values("el_deg", el_deg, ELEVATIONS_DEG)?, 1.0_f64.to_radians()),
        azimuth_rad: scaled(values("az_deg", az_deg, AZIMUTHS_DEG)?, 1.0_f64.to_radians()),
        range_m,
        receiver,
        polarization: polarization(pol)?,
        bounces: numbers::within("bounces", bounces, &BOUNCES)? as u8,
        nodes: node_rule(nodes)?,
        sides: word("sides", sides, &[("two", Sides::Two), ("one", Sides::One)])?,
        edges: word("edges", edges, &[("off", Edges::Ignored), ("on", Edges::FirstOrder)])?,
        surface: word("surface", surface, &[("flat", Surface::Flat), ("smooth", Surface::Smooth)])?,
        accuracy: Accuracy::from_db(document::accuracy_db(accuracy_db)?),
    };
    let memory = Allowance::of(numbers::memory_mib(memory_limit_mib)?);
    let (asked, body) = (request.clone(), Body { mesh, unit_scale, materials, transmission });
    let given = body.clone();
    let files = [Some(given.mesh.as_path()), given.materials.as_deref()];
    let table =
        carry_out(py, &files, Hears::all(progress), move |call_off| body.table(&asked, memory, call_off))?;
    Rcs::of(py, table, request)
}

/// A body of which a table is made, as it was given.
#[derive(Clone)]
struct Body {
    mesh: PathBuf,
    unit_scale: Option<f64>,
    materials: Option<PathBuf>,
    transmission: Transmission,
}

impl Body {
    fn table(
        &self,
        request: &RcsRequest,
        memory: Allowance,
        call_off: &CallOff,
    ) -> Result<RcsTable, Failure> {
        let mesh = stepwise::mesh(&self.mesh, self.unit_scale)?;
        let map = stepwise::materials(self.materials.as_deref(), self.transmission, &request.frequency_hz)?;
        let mesh = stepwise::dressed(mesh, &self.mesh, &map, &request.frequency_hz)?;
        stepwise::rcs(&mesh, request, memory, call_off).map_err(|failure| failure.about(&self.mesh))
    }
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
    let read = read.map_err(|failure| failure::raised(py, &failure, &[Some(&mesh)]))?;
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
    of_transmitter_m: f64,
) -> PyResult<Option<Standpoint>> {
    let lacks = |lacking: &str, name: &str| Err(failure::of_argument(lacking, format!("{name} needs it")));
    match (az_deg, el_deg) {
        (Some(azimuth), Some(elevation)) => Ok(Some(Standpoint {
            azimuth_rad: numbers::number("rx_az_deg", azimuth, &AZIMUTHS_DEG)?.to_radians(),
            elevation_rad: numbers::number("rx_el_deg", elevation, &ELEVATIONS_DEG)?.to_radians(),
            range_m: numbers::distance_m("rx_range_m", range_m.unwrap_or(of_transmitter_m))?,
        })),
        (Some(_), None) => lacks("rx_el_deg", "rx_az_deg"),
        (None, Some(_)) => lacks("rx_az_deg", "rx_el_deg"),
        (None, None) if range_m.is_some() => lacks("rx_az_deg", "rx_range_m"),
        (None, None) => Ok(None),
    }
}

/// Whether waves are followed through sheets, which only a file of materials tells of.
fn transmitted(given: &str, materials: Option<&Path>) -> PyResult<Transmission> {
    let known = [("off", Transmission::Ignored), ("on", Transmission::Followed)];
    match word("transmission", given, &known)? {
        Transmission::Followed if materials.is_none() => {
            Err(failure::of_argument("materials", "transmission needs it"))
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
        return Err(failure::of_argument(name, "at least one value is needed"));
    }
    several.into_iter().map(|value| numbers::number(name, value, &allowed)).collect()
}

fn scaled(values: Vec<f64>, unit: f64) -> Vec<f64> {
    values.into_iter().map(|value| value * unit).collect()
}

fn polarization(word: &str) -> PyResult<Polarization> {
    let known = [
        ("vv", Polarization::Vv),
        ("hh", Polarization::Hh),
        ("vh", Polarization::Vh),
        ("hv", Polarization::Hv),
    ];
    self::word("pol", word, &known)
}

fn node_rule(word: &str) -> PyResult<NodeRule> {
    let known = [("own-edge", NodeRule::OwnEdge), ("exit", NodeRule::Exit), ("middle", NodeRule::Middle)];
    self::word("nodes", word, &known)
}

/// One of a few words.
fn word<T: Copy>(name: &str, given: &str, known: &[(&str, T)]) -> PyResult<T> {
    let found = known.iter().find(|(word, _)| *word == given).map(|(_, value)| *value);
    let words = || known.iter().map(|(word, _)| *word).collect::<Vec<_>>().join("`, `");
    found.ok_or_else(|| failure::of_argument(name, format!("`{given}`; it can be `{}`", words())))
}
