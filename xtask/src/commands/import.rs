//! `import`: IF samples from anywhere as a radar cube.

use super::load::{self, provenance};
use super::raw_data::{Frames, dca1000, sigmf};
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
    let scene = load::radar_only(&arguments.scene, arguments.radar.as_deref())?;
    let header = cube_header(&scene);
    let file = arguments.array.as_path();
    if arguments.step.is_some_and(|step| !(step.is_finite() && step > 0.0)) {
        return Err(Failure::Refused("--step: a step must be a positive number".to_owned()));
    }
    let frames = match file.extension().and_then(|e| e.to_str()) {
        Some("bin") => dca1000::read(file, &header, arguments.step)?,
        Some("sigmf-meta" | "sigmf-data") => sigmf::read(file, &header, arguments.step)?,
        _ => of_array(file, header.shape())?,
    };
    let inputs = load::hashed(&[arguments.array.clone(), arguments.scene.clone()])?;
    let from = provenance(Stage::FmcwEcho, &scene, inputs);
    let mut writer = Writer::<Cube>::create(&arguments.out, &from, &header)?;
    for (index, samples) in frames.into_iter().enumerate() {
        let time_s = scene.frame_time_s(index as u32);
        check(file, index, &samples, header.shape())?;
        writer.write(&CubeFrame { index: index as u32, time_s, samples, error: ErrorBudget::default() })?;
    }
    Ok(writer.finish()?)
}

fn of_array(file: &Path, shape: [usize; 3]) -> Result<Frames, Failure> {
    let array = read(file)?;
    let found = &array.shape()[1..];
    if found != shape {
        let text = format!("[channel, chirp, sample] is {found:?}, the scene's radar has {shape:?}");
        return Err(Failure::Refused(format!("{}: {text}", file.display())));
    }
    Ok(array.axis_iter(Axis(0)).map(|frame| frame.iter().copied().collect()).collect())
}

fn read(file: &Path) -> Result<Array4<Complex32>, Failure> {
    let handle = std::fs::File::open(file).map_err(|e| Failure::system(file, "open", e))?;
    let rule = "a .npy of complex64 in the shape [frame, channel, chirp, sample] is needed";
    Array4::read_npy(std::io::BufReader::new(handle))
        .map_err(|e| Failure::Refused(format!("{}: {e}: {rule}", file.display())))
}

fn check(file: &Path, frame: usize, samples: &[Complex32], [_, chirps, length]: [usize; 3]) -> Result<(), Failure> {
    match samples.iter().position(|v| !(v.re.is_finite() && v.im.is_finite())) {
        Some(at) => {
            let place = (frame, at / (chirps * length), at / length % chirps, at % length);
            let text = format!("{} at [frame, channel, chirp, sample] {place:?}: samples must be finite", samples[at]);
            Err(Failure::Refused(format!("{}: {text}", file.display())))
        }
        None => Ok(()),
    }
}
