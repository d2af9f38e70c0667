//! Artifacts that are read side by side, frame by frame.

use crate::host::failure::Failure;
use artifact::scene::{SceneFrame, SceneHeader};
use artifact::{ArtifactError, Provenance, Reader, Schema};
use std::path::{Path, PathBuf};

/// An artifact that is read beside the points: its frame of the same index as theirs.
pub struct FrameMatcher<S: Schema> {
    file: PathBuf,
    reader: Reader<S>,
    index_of: fn(&S::Frame) -> u32,
}

impl<S: Schema> FrameMatcher<S> {
    /// Opens the artifact; `index_of` returns the number of a frame.
    pub fn open(file: &Path, index_of: fn(&S::Frame) -> u32) -> Result<Self, Failure> {
        let reader = Reader::open(file).map_err(|error| unopened(file, error))?;
        Ok(Self { file: file.to_owned(), reader, index_of })
    }

    /// Header of the artifact.
    pub fn header(&self) -> &S::Header {
        self.reader.header()
    }

    /// Origin of the artifact.
    pub fn provenance(&self) -> &Provenance {
        &self.reader.preamble().provenance
    }

    /// Returns the frame of this index; earlier frames are skipped.
    pub fn frame(&mut self, index: u32) -> Result<S::Frame, Failure> {
        let index_of = self.index_of;
        let found = self.reader.find(|frame| frame.as_ref().map_or(true, |frame| index_of(frame) >= index));
        let found: Option<Result<S::Frame, ArtifactError>> = found;
        found.transpose()?.filter(|frame| index_of(frame) == index).ok_or_else(|| {
            Failure::Refused(format!(
                "{}: frame {index} of the points is not in it, or not in the order of the points",
                self.file.display()
            ))
        })
    }
}

/// Refusal of a file that is no artifact; for a scene file it names the artifact to give instead.
fn unopened(file: &Path, error: ArtifactError) -> Failure {
    if file.is_file() && file.extension().is_some_and(|ending| ending == "toml") {
        let rule = "is a scene file; needed is the artifact `scene.scene`, which a run of it leaves";
        return Failure::Refused(format!("{}: {rule}", file.display()));
    }
    Failure::from(error)
}

/// Largest rounding difference, s, between the times of frames that begin together.
pub const SAME_TIME_S: f64 = 1e-9;

/// Whether two frames begin at the same time up to rounding, s.
pub fn is_same_time(one_s: f64, other_s: f64) -> bool {
    (one_s - other_s).abs() <= SAME_TIME_S
}

/// Refuses a frame of the scene that begins more than `within_s` from the frame beside it.
pub fn check_time(file: &Path, frame: &SceneFrame, (time_s, within_s): (f64, f64)) -> Result<(), Failure> {
    let (index, of_scene_s) = (frame.index, frame.time_s);
    if (of_scene_s - time_s).abs() <= within_s {
        return Ok(());
    }
    let rule = format!("frame {index} begins at {of_scene_s} s, that of the frames beside it at {time_s} s");
    Err(Failure::Refused(format!("{}: {rule}", file.display())))
}

/// Rounding error of times of other programs, which are in whole milliseconds: half of one.
pub const ROUNDED_TIME_S: f64 = 0.5e-3 + SAME_TIME_S;

/// Refuses a frame of a file that begins more than `within_s` from the scene's frame beside it.
pub fn check_begin(
    file: &Path,
    (index, time_s): (u32, f64),
    of_scene: &SceneFrame,
    within_s: f64,
) -> Result<(), Failure> {
    let of_scene_s = of_scene.time_s;
    if (time_s - of_scene_s).abs() <= within_s {
        return Ok(());
    }
    let rule = "is of another run, or of another scene";
    let rule = format!("frame {index} begins at {time_s} s, that of the scene at {of_scene_s} s: it {rule}");
    Err(Failure::Refused(format!("{}: {rule}", file.display())))
}

/// Refuses a frame of the scene whose number of poses is not the number of bodies in view.
pub fn check_poses(file: &Path, view: &SceneHeader, frame: &SceneFrame) -> Result<(), Failure> {
    let (poses, bodies, index) = (frame.poses.len(), view.targets.len(), frame.index);
    if poses == bodies {
        return Ok(());
    }
    let rule = format!("frame {index} has {poses} poses of {bodies} bodies in view");
    Err(Failure::Refused(format!("{}: {rule}", file.display())))
}
