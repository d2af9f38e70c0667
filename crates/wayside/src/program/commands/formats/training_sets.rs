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
mod pickle;
mod raddet;
mod carrada;
mod uwcr;
mod kitti;
mod nuscenes_tables;
mod nuscenes;

use crate::host::failure::Failure;
use crate::program::words::FormatWord;
use artifact::Reader;
use std::path::Path;

/// Formats that are folders of a set, each with the artifact that it is made of.
const SETS: [(FormatWord, &str); 5] = [
    (FormatWord::Raddet, "rdm"),
    (FormatWord::Carrada, "rdm"),
    (FormatWord::Uwcr, "cube"),
    (FormatWord::Kitti, "points"),
    (FormatWord::Nuscenes, "points"),
];

/// Whether a format is a training set's, whose labels are a scene's.
pub(crate) fn is_set(to: FormatWord) -> bool {
    SETS.iter().any(|(set, _)| *set == to)
}

/// Writes the frames of an artifact as a set; `None` where this kind of artifact is not what it is made of.
pub(crate) fn write(
    to: FormatWord,
    kind: &str,
    file: &Path,
    scene: Option<&Path>,
    out: &Path,
) -> Option<Result<(), Failure>> {
    let (set, _) = SETS.iter().find(|(set, of)| *set == to && *of == kind)?;
    Some(match set {
        FormatWord::Raddet => opened(file).and_then(|reader| raddet::write(reader, scene, out)),
        FormatWord::Carrada => opened(file).and_then(|reader| carrada::write(reader, scene, out)),
        FormatWord::Uwcr => opened(file).and_then(|reader| uwcr::write(reader, scene, out)),
        FormatWord::Kitti => kitti::write(file, scene, out),
        _ => nuscenes::write(file, scene, out),
    })
}

fn opened<S: artifact::Schema>(file: &Path) -> Result<Reader<S>, Failure> {
    Ok(Reader::open(file)?)
}
