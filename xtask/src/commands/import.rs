//! `import`: IF samples from anywhere as a radar cube.

use super::load::{self, provenance};
use crate::cli::ImportArguments;
use crate::failure::Failure;
use crate::keys::cube_header;
use crate::stages::Stage;
use artifact::ErrorBudget;
use artifact::Writer;
use artifact::cube::{Cube, CubeFrame};
use ndarray::{Array4, Axis};
use ndarray_npy::ReadNpyExt;
use num_complex::Complex32;
use std::path::Path;

pub(crate) fn run(arguments: &ImportArguments) -> Result<(), Failure> {
    let scene = load::radar_only(&arguments.scene)?;
    let header = cube_header(&scene);
    let array = read(&arguments.array)?;
    check(&arguments.array, &array, header.shape())?;
    let inputs = load::hashed(&[arguments.array.clone(), arguments.scene.clone()])?;
    let from = provenance(Stage::FmcwEcho, &scene, inputs);
    let mut writer = Writer::<Cube>::create(&arguments.out, &from, &header)?;
    for (index, frame) in array.axis_iter(Axis(0)).enumerate() {
        let time_s = index as f64 * scene.frame_interval_s;
        let samples = frame.iter().copied().collect();
        writer.write(&CubeFrame { index: index as u32, time_s, samples, error: ErrorBudget::default() })?;
    }
    Ok(writer.finish()?)
}

fn read(file: &Path) -> Result<Array4<Complex32>, Failure> {
    let handle = std::fs::File::open(file).map_err(|e| Failure::system(file, "open", e))?;
    let rule = "a .npy of complex64 in the shape [frame, channel, chirp, sample] is needed";
    Array4::read_npy(std::io::BufReader::new(handle))
        .map_err(|e| Failure::Refused(format!("{}: {e}: {rule}", file.display())))
}

fn check(file: &Path, array: &Array4<Complex32>, shape: [usize; 3]) -> Result<(), Failure> {
    let found = &array.shape()[1..];
    if found != shape {
        let text = format!("[channel, chirp, sample] is {found:?}, the scene's radar has {shape:?}");
        return Err(Failure::Refused(format!("{}: {text}", file.display())));
    }
    match array.indexed_iter().find(|(_, v)| !(v.re.is_finite() && v.im.is_finite())) {
        Some((place, value)) => {
            Err(Failure::Refused(format!("{}: {value} at {place:?}: samples must be finite", file.display())))
        }
        None => Ok(()),
    }
}
