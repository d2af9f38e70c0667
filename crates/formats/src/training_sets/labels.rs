//! Labels of datasets as the truth of points: those of KITTI and View-of-Delft, and nuScenes'.
//!
//! Boxes come through the set's own calibration to the axes of its sensor, and from these to the world as its
//! clouds do: the axes are those of the points' radar, levelled. Only scores use them.

mod label_error;
mod sensor_box; // boxes in a sensor's axes
mod label_collector; // bodies, faults and what is left out
mod frame_names; // which labels belong to which frame
mod kitti;
mod json_rows; // tables of any length
mod nuscenes;

use crate::levelled_axes::LevelledAxes;
use artifact::cube::CubeHeader;
use artifact::points::{Points, PointsFrame};
use artifact::{ArtifactError, Radar, Reader};
use evaluation::{FrameTruth, LabelledBox};
use frame_names::FrameNames;
use label_collector::LabelCollector;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use std::collections::BTreeMap;
use std::path::Path;

/// Labels of the frames of a file of points.
pub struct SetLabels {
    cube: CubeHeader,
    /// Bodies of each frame with labels, by its number.
    bodies: BTreeMap<u32, Vec<LabelledBox>>,
    tells_bodies: bool,
}

impl SetLabels {
    /// Reads the labels at `place` for a file of points: KITTI's folder `label_2` or a file of it, or the
    /// folder of nuScenes' tables. What is left out is noted.
    ///
    /// # Errors
    /// The points name no radar, the labels are of other frames, or some of them are malformed: all of these
    /// are told.
    pub fn of_points(place: &Path, points: &Path) -> Result<Self, Failure> {
        let reader = Reader::<Points>::open(points)?;
        let cube = reader.header().cube.clone().ok_or_else(|| without_radar(points))?;
        let inputs = reader.preamble().provenance.inputs.clone();
        let indices = reader.map(|frame| frame.map(|frame| frame.index));
        let indices = indices.collect::<Result<Vec<u32>, ArtifactError>>()?;
        let names = FrameNames::of(&inputs, indices.len());
        let mut reading = LabelCollector::of(LevelledAxes::of(&cube.radar));
        let work = format!("reading the labels of {}", place.display());
        let frames = progress::during(work, || frames(place, &names, &mut reading))?;
        let tells_bodies = reading.finish(place)?;
        note_unlabelled(place, &frames);
        let bodies = indices.into_iter().zip(frames).filter_map(|(index, bodies)| Some((index, bodies?)));
        Ok(Self { cube, bodies: bodies.collect(), tells_bodies })
    }

    /// The radar of the points.
    pub fn radar(&self) -> &Radar {
        &self.cube.radar
    }

    /// Whether the labels tell which body of a frame is which of another.
    pub fn tells_bodies(&self) -> bool {
        self.tells_bodies
    }

    /// Ground truth of a frame of the points; `None` if it has no labels.
    pub fn truth(&self, frame: &PointsFrame) -> Option<FrameTruth> {
        let bodies = self.bodies.get(&frame.index)?;
        Some(FrameTruth::of_labels(&self.cube.in_frame(frame.index), bodies, &frame.objects))
    }
}

fn without_radar(points: &Path) -> Failure {
    let rule = "no radar stands in these points, in whose axes labels could be told";
    Failure::Refused(format!("{}: {rule}", points.display()))
}

/// Bodies of each frame, in the order of the points' frames; `None` where there are no labels.
fn frames(
    place: &Path,
    names: &FrameNames,
    reading: &mut LabelCollector,
) -> Result<Vec<Option<Vec<LabelledBox>>>, Failure> {
    std::fs::metadata(place).map_err(|error| Failure::system(place, "be read", error))?;
    if nuscenes::is_at(place) {
        return nuscenes::frames(place, names, reading);
    }
    kitti::frames(place, names, reading)
}

fn note_unlabelled(place: &Path, frames: &[Option<Vec<LabelledBox>>]) {
    let unlabelled = frames.iter().filter(|bodies| bodies.is_none()).count();
    if unlabelled > 0 {
        let (place, all) = (place.display(), frames.len());
        progress::note(format!("note: {place}: {unlabelled} of {all} frames have no labels: not scored"));
    }
}
