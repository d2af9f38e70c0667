//! A run's points with the parts of their scene that cloud datasets need.

use crate::height_source::HeightSource;
use crate::levelled_axes::LevelledAxes;
use crate::training_sets::radar_of_points::radar_of;
use crate::training_sets::truth_boxes::TruthBoxes;
use artifact::Reader;
use artifact::points::{Points, PointsHeader};
use pipeline::host::failure::Failure;
use pipeline::host::provenance_checks;
use std::path::Path;

/// An open file of points, with its scene if one is given.
pub(crate) struct OpenedPoints {
    pub(crate) reader: Reader<Points>,
    pub(crate) header: PointsHeader,
    pub(crate) heights: HeightSource,
    /// Boxes of the scene.
    pub(crate) truth: Option<TruthBoxes>,
    /// Axes of the points' radar.
    pub(crate) axes: LevelledAxes,
}

impl OpenedPoints {
    /// Opens the points and their scene.
    ///
    /// # Errors
    /// A file is damaged, the scene is another one, or neither describes a radar.
    pub(crate) fn open(file: &Path, scene: Option<&Path>) -> Result<Self, Failure> {
        let (reader, heights) = (Reader::<Points>::open(file)?, HeightSource::of(file)?);
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
