//! The radar of points, and the cross sections that follow from its noise.

use crate::training_sets::truth_boxes::TruthBoxes;
use artifact::Radar;
use artifact::points::PointsHeader;
use artifact::settings::Noise;
use pipeline::host::failure::Failure;

/// The radar of points: that of their header, else the scene's.
pub(crate) fn radar_of<'a>(
    points: &'a PointsHeader,
    truth: Option<&'a TruthBoxes>,
) -> Result<&'a Radar, Failure> {
    let told = points.cube.as_ref().map(|cube| &cube.radar);
    told.or(truth.map(|truth| &truth.header().radar)).ok_or_else(|| {
        Failure::refused("no radar stands in these points, by whose axes they could be told: give --scene")
    })
}

/// Sentence about the cross sections of a cloud.
pub(crate) fn sections_of(points: &PointsHeader) -> &'static str {
    let is_known = points.cube.as_ref().is_some_and(|cube| matches!(cube.noise, Noise::Figure { .. }));
    if is_known { "dBsm, by the radar equation" } else { "not known: 0" }
}
