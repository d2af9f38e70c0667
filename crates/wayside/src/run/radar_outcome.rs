//! Result of a run with one radar: its summary, and the frames that it wrote.

use crate::run::products;
use artifact::points::{Points, PointsFrame};
use artifact::tracks::{Tracks, TracksFrame};
use artifact::{Reader, Schema};
use pipeline::host::failure::Failure;
use pipeline::host::frame_matching::is_same_time;
use pipeline::outcome::summary::Summary;
use reporting::pictures::radar_frame::RadarFrame;
use std::path::{Path, PathBuf};

/// A finished run with one radar.
pub struct RadarOutcome {
    pub(crate) summary: Summary,
    /// Points and scenes of the run's first frames.
    pub(crate) frames: Vec<RadarFrame>,
    /// Folder of the run; where a scene has several radars, its last name is the radar's.
    pub(crate) out: PathBuf,
}

impl RadarOutcome {
    /// Folder of the run's files; where a scene has several radars, its last name is the radar's.
    pub fn folder(&self) -> &Path {
        &self.out
    }

    /// Summary of the run, as in `summary.json`.
    pub fn summary(&self) -> &Summary {
        &self.summary
    }

    /// Points and objects of every frame, read from `frames.points`.
    ///
    /// # Errors
    /// A file that was removed or damaged after the run.
    pub fn points(&self) -> Result<Vec<PointsFrame>, Failure> {
        frames::<Points>(&self.out.join(products::POINTS))
    }

    /// Tracks of every frame, read from `frames.tracks`.
    ///
    /// # Errors
    /// A file that was removed or damaged after the run.
    pub fn tracks(&self) -> Result<Vec<TracksFrame>, Failure> {
        frames::<Tracks>(&self.out.join(products::TRACKS))
    }

    /// Name of the radar, of a scene with several.
    pub(crate) fn id(&self) -> &str {
        self.out.file_name().and_then(|name| name.to_str()).unwrap_or_default()
    }

    /// Frame that begins at the given time.
    pub(crate) fn frame_at(&self, time_s: f64) -> Option<&RadarFrame> {
        self.frames.iter().find(|frame| is_same_time(frame.scene.time_s, time_s))
    }
}

/// All frames of an artifact of the run itself, which the next run may replace.
fn frames<S: Schema>(file: &Path) -> Result<Vec<S::Frame>, Failure> {
    Ok(Reader::<S>::open_own(file)?.collect::<Result<_, _>>()?)
}
