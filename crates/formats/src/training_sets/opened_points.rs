//! A run's points with what a set of clouds needs of them and of their scene.

use crate::heights::Heights;
use crate::levelled_axes::LevelledAxes;
use crate::training_sets::radar_of_points::radar_of;
use crate::training_sets::truth_boxes::TruthBoxes;
use artifact::Reader;
use artifact::points::{Points, PointsHeader};
use pipeline::host::failure::Failure;
use pipeline::host::provenance_checks;
use std::path::Path;

/// A file of points that is open, and the scene beside it where one is given.
pub(crate) struct OpenedPoints {
    pub(crate) reader: Reader<Points>,
    pub(crate) header: PointsHeader,
    pub(crate) heights: Heights,
    /// Boxes of the scene.
    pub(crate) truth: Option<TruthBoxes>,
    /// Axes of the radar that the points are of.
    pub(crate) axes: LevelledAxes,
}

impl OpenedPoints {
    /// Opens the points, and the scene that they are of.
    ///
    /// # Errors
    /// A file is damaged, the scene is another one, or neither tells of a radar.
    pub(crate) fn open(file: &Path, scene: Option<&Path>) -> Result<Self, Failure> {
        let (reader, heights) = (Reader::<Points>::open(file)?, Heights::of(file)?);
        let header = reader.header().clone();
        let radar = header.cube.as_ref().map(|cube| &cube.radar);
        let from = &reader.preamble().provenance;
        let truth = scene.map(|file| TruthBoxes::open(file, radar, from)).transpose()?;
        if let (Some(scene), Some(truth)) = (scene, &truth) {
            provenance_checks::has_bodies(scene, truth.header(), &header.targets)?;
        }
        let axes = LevelledAxes::of(radar_of(&header, truth.as_ref())?);
        Ok(Self { reader, header, heights, truth, axes })
    }
}
