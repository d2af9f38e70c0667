//! A run's frames as folders in the layouts of sets that people train on: tensors, maps, samples and clouds
//! with the truth as boxes (docs/training-sets.md).
//!
//! Truth comes from the scene's snapshot alone and goes into labels alone; arrays and clouds are those of the
//! artifact.

mod truth_boxes; // labels, in the world
#[cfg(test)]
mod test_body; // what the tests share
mod angle_spectrum; // range, azimuth and Doppler
mod cell_boxes; // labels, in cells of it
mod set_folder;
mod radar_of_points; // whose axes clouds are told in
mod opened_points;
mod pickle;
mod raddet;
mod carrada;
mod uwcr;
mod kitti;
mod nuscenes_tables;
mod nuscenes;

use artifact::Reader;
use pipeline::host::failure::Failure;
use std::path::Path;

/// Set of a folder's layout; its labels are a scene's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Set {
    /// RADDet: range-azimuth-Doppler tensors and boxes.
    Raddet,
    /// CARRADA: range-Doppler and range-angle maps and annotations.
    Carrada,
    /// Raw data of the University of Washington: samples and labels.
    Uwcr,
    /// View-of-Delft and KITTI: clouds, boxes, a camera.
    Kitti,
    /// Set of nuScenes: clouds and the tables of its database.
    Nuscenes,
}

impl Set {
    /// Kind of the artifact that it is made of.
    fn made_of(self) -> &'static str {
        match self {
            Self::Raddet | Self::Carrada => "rdm",
            Self::Uwcr => "cube",
            Self::Kitti | Self::Nuscenes => "points",
        }
    }
}

/// Writes the frames of an artifact as a set; `None` where this kind of artifact is not what it is made of.
pub fn write(
    set: Set,
    kind: &str,
    file: &Path,
    scene: Option<&Path>,
    out: &Path,
) -> Option<Result<(), Failure>> {
    (set.made_of() == kind).then(|| match set {
        Set::Raddet => opened(file).and_then(|reader| raddet::write(reader, scene, out)),
        Set::Carrada => opened(file).and_then(|reader| carrada::write(reader, scene, out)),
        Set::Uwcr => opened(file).and_then(|reader| uwcr::write(reader, scene, out)),
        Set::Kitti => kitti::write(file, scene, out),
        Set::Nuscenes => nuscenes::write(file, scene, out),
    })
}

fn opened<S: artifact::Schema>(file: &Path) -> Result<Reader<S>, Failure> {
    Ok(Reader::open(file)?)
}
