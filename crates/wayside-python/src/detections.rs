//! Class `Detections`: points and the objects that they form.

use crate::arguments::words;
use crate::arrays::{CachedArray, Field, Records};
use crate::failure;
use crate::shared::artifacts;
use crate::shared::maps::Maps;
use crate::tracks::Tracks;
use crate::work::{ProgressListener, carry_out};
use artifact::points::{Height, Object, Point, Points};
use artifact::tracks::Tracks as TracksSchema;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use wayside::Failure;
use wayside::chain::loading;
use wayside::stepwise::{Classification, CompleteArtifact, Processing};

/// Detected points and objects of the frames of a cube.
#[pyclass(frozen, module = "wayside")]
pub(crate) struct Detections {
    /// The maps that they were found on; `None` of a file.
    maps: Option<Arc<Maps>>,
    all: Arc<CompleteArtifact<Points>>,
    points: CachedArray<PyAny>,
    objects: CachedArray<PyAny>,
}

const POINT: [Field; 11] = [
    ("frame", "i8"),
    ("range_m", "f8"),
    ("radial_velocity_mps", "f8"),
    ("azimuth_rad", "f8"),
    ("elevation_rad", "f8"),
    ("position_m", "(3,)f8"),
    ("snr_db", "f8"),
    ("object", "i8"),
    ("two_ways_rad", "(2,)f8"),
    ("stationary", "i8"),
    ("height", "i8"),
];

const OBJECT: [Field; 14] = [
    ("frame", "i8"),
    ("range_m", "f8"),
    ("radial_velocity_mps", "f8"),
    ("azimuth_rad", "f8"),
    ("position_m", "(3,)f8"),
    ("snr_db", "f8"),
    ("points", "i8"),
    ("lane", "i8"),
    ("range_extent_m", "(2,)f8"),
    ("velocity_extent_mps", "(2,)f8"),
    ("velocity_resolved", "i8"),
    ("ghost_share", "f8"),
    ("stationary", "i8"),
    ("height", "i8"),
];

/// Sources of a height by their numbers.
fn height(told: Height) -> i64 {
    match told {
        Height::None => 0,
        Height::Assumed => 1,
        Height::Measured => 2,
    }
}

fn add_point(records: &mut Records, frame: u32, point: &Point) {
    records.whole(frame).number(point.range_m).number(point.radial_velocity_mps);
    records.number(point.azimuth_rad).number(point.elevation_rad).numbers(&point.position_m);
    records.number(point.snr_db).whole_or_none(point.object);
    records.numbers(&point.two_ways_rad.unwrap_or([f64::NAN; 2])).whole_or_none(point.stationary);
    records.whole(height(point.height));
}

fn add_object(records: &mut Records, frame: u32, object: &Object) {
    records.whole(frame).number(object.range_m).number(object.radial_velocity_mps);
    records.number(object.azimuth_rad).numbers(&object.position_m).number(object.snr_db);
    records.whole(object.points).whole_or_none(object.lane).numbers(&object.range_extent_m);
    records.numbers(&object.velocity_extent_mps).whole(object.velocity_resolved);
    records.number_or_nan(object.ghost_share).whole_or_none(object.stationary);
    records.whole(height(object.height));
}

/// Classes of the objects of all frames: a probability a class, and the class that is told.
fn classes<'py>(py: Python<'py>, answers: &[(u32, Vec<Classification>)]) -> PyResult<Bound<'py, PyAny>> {
    let (names, mut records) = (Processing::class_names(), Records::default());
    for (frame, answers) in answers {
        for (object, answer) in answers.iter().enumerate() {
            let told = names.iter().position(|name| *name == answer.class_name).map(|at| at as i64);
            records.whole(*frame).whole(object as i64).numbers(&answer.probabilities.map(f64::from));
            records.whole_or_none(told);
        }
    }
    let of_classes = names.map(|name| (name, "f8"));
    let fields = [&[("frame", "i8"), ("object", "i8")], &of_classes[..], &[("told", "i8")]].concat();
    records.array(py, &fields)
}

/// Records that make a table.
#[derive(Clone, Copy)]
enum Table {
    Points,
    Objects,
    Classes,
}

const TABLES: [(&str, Table); 3] =
    [("points", Table::Points), ("objects", Table::Objects), ("classes", Table::Classes)];

/// Refusal of points of which no radar is known.
const WITHOUT_RADAR: &str = "these points were not found by the program, and no radar is told of them: \
                             objects cannot be followed";
/// Refusal of classes of points without maps.
const WITHOUT_MAPS: &str = "classes are told from the maps that the points were found on, which a file of \
                            points does not have: classify what `RangeDoppler.detect` returns";

impl Detections {
    /// Points and objects with the maps that they were found on; those of a file have none.
    pub(crate) fn of(all: CompleteArtifact<Points>, maps: Option<Arc<Maps>>) -> Self {
        Self { maps, all: Arc::new(all), points: CachedArray::default(), objects: CachedArray::default() }
    }

    /// Processing of the cubes of their radar.
    fn processing(&self) -> Result<Arc<Processing>, Failure> {
        if let Some(maps) = &self.maps {
            return Ok(Arc::clone(&maps.processing));
        }
        let header = self.all.header.cube.as_ref().ok_or_else(|| Failure::refused(WITHOUT_RADAR))?;
        Processing::of(header).map(Arc::new)
    }

    /// Objects followed over the frames.
    pub(crate) fn tracked(&self, py: Python<'_>, listener: ProgressListener<'_, '_>) -> PyResult<Tracks> {
        let processing = self.processing().map_err(|failure| failure::exception_of(py, &failure, &[]))?;
        let points = Arc::clone(&self.all);
        let all: CompleteArtifact<TracksSchema> = carry_out(py, &[], listener, move |cancellation| {
            let frames = processing.tracks(&points.frames, cancellation)?;
            Ok(CompleteArtifact { from: points.from.clone(), header: processing.tracks_header(), frames })
        })?;
        Ok(Tracks::of(all))
    }

    /// Classes of the objects by a model, or by the one that ships.
    pub(crate) fn classified<'py>(
        &self,
        py: Python<'py>,
        model: Option<PathBuf>,
        listener: ProgressListener<'_, '_>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let of_file = || failure::exception_of(py, &Failure::refused(WITHOUT_MAPS), &[]);
        let held = self.maps.as_ref().ok_or_else(of_file)?;
        let (maps, points) = (held.frames(py)?, Arc::clone(&self.all));
        let (processing, place) = (Arc::clone(&held.processing), model.clone());
        let answers = carry_out(py, &[model.as_deref()], listener, move |cancellation| {
            let Some(model) = loading::model(place.as_deref())? else { return Ok(vec![]) };
            processing.classes(&model, &maps, &points.frames, cancellation)
        })?;
        classes(py, &answers)
    }
}

#[pymethods]
impl Detections {
    /// Reads a `.points` artifact. Its points have no maps, so `classify` refuses them.
    #[staticmethod]
    #[pyo3(signature = (file))]
    fn read(py: Python<'_>, file: PathBuf) -> PyResult<Self> {
        Ok(Self::of(artifacts::read(py, &file)?, None))
    }

    /// Points of all frames, a read-only `numpy.recarray`: frame, range_m, radial_velocity_mps (receding
    /// positive), azimuth_rad (from +y towards +x), elevation_rad, position_m [3] in world metres, snr_db,
    /// object (index among its frame's objects, −1 of a lone one), two_ways_rad [2] (NaN where there are
    /// none), stationary (1 yes, 0 no, −1 not asked), height.
    ///
    /// height is an index into `wayside.HEIGHTS`: 2 measured by elevation rows, 1 assumed as
    /// `assumed_height_m` says, 0 none: no place has that height and the range, and z is the radar's own.
    #[getter]
    pub(crate) fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.points.view(py, || {
            let mut records = Records::default();
            let frames = self.all.frames.iter();
            frames.for_each(|f| f.points.iter().for_each(|point| add_point(&mut records, f.index, point)));
            records.array(py, &POINT)
        })
    }

    /// Objects of all frames, a read-only `numpy.recarray`: frame, range_m, radial_velocity_mps, azimuth_rad,
    /// position_m [3], snr_db, points (how many), lane (−1 of none), range_extent_m [2],
    /// velocity_extent_mps [2], velocity_resolved, ghost_share (NaN where the array cannot tell), stationary,
    /// height (as of points).
    #[getter]
    pub(crate) fn objects<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.objects.view(py, || {
            let mut records = Records::default();
            let frames = self.all.frames.iter();
            frames.for_each(|f| f.objects.iter().for_each(|it| add_object(&mut records, f.index, it)));
            records.array(py, &OBJECT)
        })
    }

    /// Objects followed over the frames.
    #[pyo3(signature = (*, progress=None))]
    fn track(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Tracks> {
        self.tracked(py, ProgressListener::all(progress))
    }

    /// Classes of the objects, a `numpy.recarray`: frame, object, a probability for each of
    /// `wayside.CLASSES`, told (index among them, −1 for "unknown"). `model` is a file or a folder of
    /// `wayside train`; the one that ships where it is left out.
    #[pyo3(signature = (model=None, *, progress=None))]
    fn classify<'py>(
        &self,
        py: Python<'py>,
        model: Option<PathBuf>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.classified(py, model, ProgressListener::all(progress))
    }

    /// Writes a `.points` artifact, the bytes of `wayside dsp`; another format's ending is refused.
    #[pyo3(signature = (file))]
    fn write(&self, py: Python<'_>, file: PathBuf) -> PyResult<()> {
        artifacts::write(py, &self.all, &file)
    }

    /// Table of all points, all objects or the objects' classes: `pandas.DataFrame`, where pandas is
    /// installed.
    ///
    /// `of` is "points", "objects" or "classes"; `model` and `progress` are those of `classify`.
    #[pyo3(signature = (of="points", *, model=None, progress=None))]
    fn to_pandas<'py>(
        &self,
        py: Python<'py>,
        of: &str,
        model: Option<PathBuf>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let records = match words::meaning("of", of, &TABLES)? {
            Table::Points => self.points(py)?,
            Table::Objects => self.objects(py)?,
            Table::Classes => self.classify(py, model, progress)?,
        };
        py.import("wayside.tables")?.call_method1("records_to_pandas", (records,))
    }

    fn __len__(&self) -> usize {
        self.all.frames.len()
    }

    fn __repr__(&self) -> String {
        let points: usize = self.all.frames.iter().map(|frame| frame.points.len()).sum();
        let objects: usize = self.all.frames.iter().map(|frame| frame.objects.len()).sum();
        let frames = self.all.frames.len();
        format!("<wayside.Detections: {frames} frames, {points} points, {objects} objects>")
    }
}
