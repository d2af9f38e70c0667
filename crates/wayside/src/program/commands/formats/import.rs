//! `import`: IF samples from anywhere as a radar cube.

use crate::chain::keys::cube_header;
use crate::chain::loading::{self, provenance};
use crate::chain::stages::Stage;
use crate::host::failure::Failure;
use crate::host::progress;
use crate::program::cli::ImportArguments;
use crate::program::commands::formats::raw_data::dca1000;
use crate::program::commands::formats::raw_data::npy;
use crate::program::commands::formats::raw_data::sigmf;
use crate::program::commands::formats::raw_data::{Imported, IntegerStep, LIMIT_BYTES};
use crate::stepwise;
use artifact::bounded;
use artifact::cube::{Cube, CubeFrame};
use artifact::scene::SceneHeader;
use artifact::{ErrorBudget, Provenance, Writer};
use ndarray::{Array4, Axis};
use num_complex::Complex32;
use std::path::Path;

pub(crate) fn run(arguments: &ImportArguments) -> Result<(), Failure> {
    let scene = loading::radar_only(&arguments.scene, arguments.radar.as_deref())?;
    let header = cube_header(&scene);
    let file = arguments.array.as_path();
    if arguments.step.is_some_and(|step| !(step.is_finite() && step > 0.0)) {
        return Err(Failure::Refused("--step: a step must be a positive number".to_owned()));
    }
    let Imported { frames, step } = match file.extension().and_then(|e| e.to_str()) {
        Some("bin") => dca1000::read(file, &header, arguments.step)?,
        Some("sigmf-meta" | "sigmf-data") => sigmf::read(file, &header, arguments.step)?,
        _ => Imported { frames: of_array(file, header.shape())?, step: IntegerStep::Floats },
    };
    let from = provenance_of(arguments, &scene, &step)?;
    let mut writer = Writer::<Cube>::create(&arguments.out, &from, &header)?;
    for (index, samples) in frames.into_iter().enumerate() {
        let time_s = scene.frame_time_s(index as u32);
        stepwise::finite(index, &samples, header.shape()).map_err(|failure| failure.about(file))?;
        writer.write(&CubeFrame { index: index as u32, time_s, samples, error: ErrorBudget::default() })?;
    }
    Ok(writer.finish()?)
}

/// The step of integer samples stands among the settings, and the file that told it among the inputs.
fn provenance_of(
    arguments: &ImportArguments,
    scene: &SceneHeader,
    step: &IntegerStep,
) -> Result<Provenance, Failure> {
    let mut files = vec![arguments.array.clone(), arguments.scene.clone()];
    match step {
        IntegerStep::Told(_, place) => files.push(place.clone()),
        IntegerStep::Unknown => progress::note(format!(
            "note: {}: no step is told (--step): samples are taken as √W of 1 a step, and levels are no powers",
            arguments.array.display()
        )),
        IntegerStep::Asked(_) | IntegerStep::Floats => {}
    }
    let from = provenance(Stage::FmcwEcho, scene, loading::hashed(&files)?);
    let told = match step {
        IntegerStep::Floats => return Ok(from),
        IntegerStep::Unknown => "1 (not told)".to_owned(),
        IntegerStep::Asked(step) | IntegerStep::Told(step, _) => step.to_string(),
    };
    Ok(Provenance { settings: format!("{}, sqrt_w_per_step {told}", from.settings), ..from })
}

fn of_array(file: &Path, shape: [usize; 3]) -> Result<Vec<Vec<Complex32>>, Failure> {
    let array = read(file)?;
    let found = &array.shape()[1..];
    if found != shape {
        let text = format!("[channel, chirp, sample] is {found:?}, the scene's radar has {shape:?}");
        return Err(Failure::Refused(format!("{}: {text}", file.display())));
    }
    Ok(array.axis_iter(Axis(0)).map(|frame| frame.iter().copied().collect()).collect())
}

fn read(file: &Path) -> Result<Array4<Complex32>, Failure> {
    let bytes = bounded::read(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
    let rule = "a .npy of complex64 in the shape [frame, channel, chirp, sample] is needed";
    let refused = |why: String| Failure::Refused(format!("{}: {why}: {rule}", file.display()));
    npy::complex_values(&bytes).map_err(refused)
}
