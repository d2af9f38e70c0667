//! Class `Tracks`: vehicles followed over frames.

use crate::arrays::{CachedArray, Field, Records};
use crate::shared::artifacts;
use artifact::tracks::{Track, Tracks as Schema};
use pyo3::prelude::*;
use std::path::PathBuf;
use wayside::stepwise::CompleteArtifact;

/// Tracks of the frames of a cube.
#[pyclass(frozen, module = "wayside")]
pub(crate) struct Tracks {
    all: CompleteArtifact<Schema>,
    records: CachedArray<PyAny>,
}

impl Tracks {
    /// Tracks of an artifact.
    pub(crate) fn of(all: CompleteArtifact<Schema>) -> Self {
        Self { all, records: CachedArray::default() }
    }
}

const TRACK: [Field; 14] = [
    ("frame", "i8"),
    ("id", "i8"),
    ("state", "i8"),
    ("age_frames", "i8"),
    ("missed_frames", "i8"),
    ("position_m", "(2,)f8"),
    ("velocity_mps", "(2,)f8"),
    ("covariance", "(4,4)f8"),
    ("velocity_resolved", "i8"),
    ("lane", "i8"),
    ("box_centre_m", "(2,)f8"),
    ("box_length_m", "f8"),
    ("box_width_m", "f8"),
    ("box_heading_rad", "f8"),
];

fn add(records: &mut Records, frame: u32, track: &Track) {
    records.whole(frame).whole(track.id).whole(track.state as i64).whole(track.age_frames);
    records.whole(track.missed_frames).numbers(&track.position_m).numbers(&track.velocity_mps);
    records.numbers(&track.covariance.concat()).whole(track.velocity_resolved);
    let footprint = &track.footprint;
    records.whole_or_none(track.lane).numbers(&footprint.centre_m).number(footprint.length_m);
    records.number(footprint.width_m).number(footprint.heading_rad);
}

#[pymethods]
impl Tracks {
    /// Tracks of all frames, a read-only `numpy.recarray`: frame, id, state (0 tentative, 1 confirmed,
    /// 2 coasting), age_frames, missed_frames, position_m [2], velocity_mps [2], covariance [4, 4] of
    /// (x, y, v_x, v_y), velocity_resolved, lane (−1 of none), box_centre_m [2], box_length_m, box_width_m,
    /// box_heading_rad (from world +x towards +y).
    #[getter]
    fn records<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.records.view(py, || {
            let mut records = Records::default();
            let frames = self.all.frames.iter();
            frames.for_each(|f| f.tracks.iter().for_each(|track| add(&mut records, f.index, track)));
            records.array(py, &TRACK)
        })
    }

    /// Reads a `.tracks` artifact.
    #[staticmethod]
    #[pyo3(signature = (file))]
    fn read(py: Python<'_>, file: PathBuf) -> PyResult<Self> {
        Ok(Self::of(artifacts::read(py, &file)?))
    }

    /// Writes a `.tracks` artifact, the bytes of `wayside dsp`; another format's ending is refused.
    #[pyo3(signature = (file))]
    fn write(&self, py: Python<'_>, file: PathBuf) -> PyResult<()> {
        artifacts::write(py, &self.all, &file)
    }

    /// Table of all tracks: `pandas.DataFrame`, where pandas is installed.
    fn to_pandas<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("wayside.tables")?.call_method1("records_to_pandas", (slf.getattr("records")?,))
    }

    fn __len__(&self) -> usize {
        self.all.frames.len()
    }

    fn __repr__(&self) -> String {
        format!("<wayside.Tracks: {} frames>", self.all.frames.len())
    }
}
