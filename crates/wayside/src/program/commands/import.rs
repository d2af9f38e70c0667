//! `import`: IF samples of other sources as a radar cube.

mod options;

use crate::program::cli::ImportArguments;
use crate::stepwise;
use artifact::cube::{Cube, CubeFrame, CubeHeader, SampleUnit};
use artifact::radar::Sampling;
use artifact::scene::SceneHeader;
use artifact::{ErrorBudget, Provenance, Writer};
use formats::device_config::{self, ConfigFile, DeviceSettings, scene_with};
use formats::devices::{IqOrder, Lanes};
use formats::radar_cloud;
use formats::raw_data::arrays;
use formats::raw_data::dca1000;
use formats::raw_data::sigmf;
use formats::raw_data::uwcr;
use formats::raw_data::{ImportedFrames, IntegerStep, ShapeSource};
use num_complex::Complex32;
use options::{ImportKind, Input};
use pipeline::chain::keys::cube_header;
use pipeline::chain::loading::{self, provenance};
use pipeline::chain::stages::Stage;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use std::path::PathBuf;

pub(crate) fn run(arguments: &ImportArguments) -> Result<(), Failure> {
    let input = Input::of(arguments)?;
    options::check(arguments, input.kind)?;
    let told_by = radar_files(arguments);
    if input.kind == ImportKind::Clouds {
        let file = arguments.array.as_path();
        let read = || scene_of(arguments, settings_of(arguments)?.as_ref());
        return radar_cloud::import::points(file, &told_by, read, &arguments.out);
    }
    let files = [input.files.as_slice(), &told_by].concat();
    let beside = match input.kind {
        ImportKind::CaptureCard => dca1000::descriptions(&arguments.array),
        ImportKind::Array => arrays::descriptions(&input.files),
        ImportKind::Uwcr => uwcr::descriptions(&input.files),
        ImportKind::Sigmf | ImportKind::Clouds => vec![],
    };
    let of_all = [files.as_slice(), &beside].concat();
    let (Samples { scene, header, frames, step, descriptions }, mut hashed) =
        loading::read_hashed(&of_all, || samples(arguments, &input))?;
    let of_beside = hashed.split_off(files.len());
    let is_told = |place: &PathBuf| step.is_described() && descriptions.contains(place);
    hashed.extend(beside.iter().zip(of_beside).filter(|(place, _)| is_told(place)).map(|(_, named)| named));
    let from = provenance_of(arguments, &scene, (&step, header.unit), hashed);
    let mut writer = Writer::<Cube>::create(&arguments.out, &from, &header)?;
    let of = frames.len();
    for (index, samples) in progress::counted("frames", frames, of).enumerate() {
        let time_s = scene.frame_time_s(index as u32);
        stepwise::sound(index, &samples, &header).map_err(|failure| failure.about(&arguments.array))?;
        writer.write(&CubeFrame { index: index as u32, time_s, samples, error: ErrorBudget::default() })?;
    }
    Ok(writer.finish()?)
}

/// Samples with the radar that they are attributed to.
struct Samples {
    scene: SceneHeader,
    header: CubeHeader,
    frames: Vec<Vec<Complex32>>,
    step: IntegerStep,
    /// Descriptions beside the recording that were found to be of these samples.
    descriptions: Vec<PathBuf>,
}

fn samples(arguments: &ImportArguments, input: &Input) -> Result<Samples, Failure> {
    let settings = settings_of(arguments)?;
    let scene = scene_of(arguments, settings.as_ref())?;
    let (file, mut header) = (arguments.array.as_path(), cube_header(&scene));
    let ImportedFrames { frames, step, descriptions } = match input.kind {
        ImportKind::CaptureCard => {
            if let (Some(file), Some(settings)) = (&arguments.config, &settings) {
                device_config::check_stream(file, settings)?;
            }
            let shape = if settings.is_some() { ShapeSource::Described } else { ShapeSource::Assumed };
            let layout = (layout(arguments, settings.as_ref()), shape);
            let imported = dca1000::read(file, &header, arguments.step, layout)?;
            if imported.descriptions.is_empty() {
                note_layout(arguments, settings.as_ref(), header.radar.waveform.sampling);
            }
            imported
        }
        ImportKind::Sigmf => sigmf::read(file, &header, arguments.step)?,
        ImportKind::Uwcr => uwcr::read(&input.files, &header)?,
        ImportKind::Array | ImportKind::Clouds => arrays::read(&input.files, &header)?,
    };
    options::check_samples(arguments, header.radar.waveform.sampling, &step)?;
    let converter = ConverterProperties {
        full_scale: arguments.full_scale,
        bits: settings.as_ref().map(DeviceSettings::bits),
    };
    let of_file = |failure: Failure| failure.about(file);
    header.unit = unit_of(&step, &frames, converter).map_err(of_file)?;
    stepwise::check_parts(frames.iter().flatten(), header.radar.waveform.sampling).map_err(of_file)?;
    Ok(Samples { scene, header, frames, step, descriptions })
}

/// Settings of the board's configuration, if one is given.
fn settings_of(arguments: &ImportArguments) -> Result<Option<DeviceSettings>, Failure> {
    arguments.config.as_deref().map(|file| device_config::read(file, arguments.device)).transpose()
}

/// Properties of a converter, from the command and the configuration.
struct ConverterProperties {
    full_scale: Option<f64>,
    bits: Option<u32>,
}

/// Unit of samples: √W if a step is given; of floats the one that a description gives, else √W; otherwise the
/// converter's step. Floats without a description that are all whole numbers count as steps of an unknown
/// converter too. The full scale is that of the command, else that of the step's file, else that of the
/// configuration's bits.
fn unit_of(
    step: &IntegerStep,
    frames: &[Vec<Complex32>],
    converter: ConverterProperties,
) -> Result<SampleUnit, Failure> {
    let of_bits = |bits: u32| f64::from(1 << (bits - 1));
    Ok(match (step, converter.full_scale) {
        (IntegerStep::Given(_) | IntegerStep::Described(..), _) => SampleUnit::RootWatts,
        (IntegerStep::Unscaled, _) => SampleUnit::Steps,
        (_, Some(steps)) => SampleUnit::FullScale(steps),
        (IntegerStep::DescribedFloats(unit, _), None) => *unit,
        (IntegerStep::Unknown, None) => SampleUnit::FullScale(of_bits(converter.bits.unwrap_or(16))),
        (IntegerStep::ConverterSteps { full_scale, .. }, None) => {
            full_scale.or(converter.bits.map(of_bits)).map_or(SampleUnit::Steps, SampleUnit::FullScale)
        }
        (IntegerStep::Floats, None) => stepwise::unit_of_floats(frames.iter().flatten(), None)?,
    })
}

/// The scene, with the radar settings that only the board's configuration specifies.
fn scene_of(arguments: &ImportArguments, settings: Option<&DeviceSettings>) -> Result<SceneHeader, Failure> {
    let (file, radar) = (arguments.scene.as_path(), arguments.radar.as_deref());
    match (settings, arguments.config.as_deref()) {
        (Some(settings), Some(config)) => scene_with(file, radar, &ConfigFile { file: config, settings }),
        _ => loading::radar_only(file, radar),
    }
}

/// Layout of a capture card's file by the command, else by the configuration.
fn layout(arguments: &ImportArguments, settings: Option<&DeviceSettings>) -> dca1000::Layout {
    let (lanes, order) = layout_told(arguments, settings);
    dca1000::Layout { lanes: lanes.unwrap_or(Lanes::Two), order: order.unwrap_or(IqOrder::InPhaseFirst) }
}

/// Lanes and order of I and Q that the command gives, else the configuration.
fn layout_told(
    arguments: &ImportArguments,
    settings: Option<&DeviceSettings>,
) -> (Option<Lanes>, Option<IqOrder>) {
    let lanes = arguments.layout.or(settings.and_then(DeviceSettings::lanes));
    (lanes, arguments.iq_order.or(settings.and_then(|s| s.iq_order)))
}

/// Notes the layout that is assumed of a recording where neither the command nor a configuration gives it:
/// another one reads as other ranges and velocities, not as noise.
fn note_layout(arguments: &ImportArguments, settings: Option<&DeviceSettings>, sampling: Sampling) {
    let (lanes, order) = layout_told(arguments, settings);
    let assumed = match (lanes.is_some(), order.is_some() || sampling == Sampling::Real) {
        (true, true) => return,
        (true, false) => "I before Q is",
        (false, true) => "two lanes are",
        (false, false) => "two lanes and I before Q are",
    };
    progress::note(format!(
        "note: {}: {assumed} assumed; the board's configuration (--config) tells, or --layout and --iq-order",
        arguments.array.display()
    ));
}

/// Files that tell the radar: the scene, the pattern and the calibration that it names, and the board's
/// configuration. Of those that cannot be read the scene and the configuration, whose reader tells why.
fn radar_files(arguments: &ImportArguments) -> Vec<PathBuf> {
    let (scene, radar) = (arguments.scene.as_path(), arguments.radar.as_deref());
    let config = arguments.config.as_deref();
    let read = |file| Some((file, device_config::read_unremarked(file, arguments.device).ok()?));
    let files = match config.and_then(read) {
        Some((file, settings)) => {
            device_config::files_with(scene, radar, &ConfigFile { file, settings: &settings })
        }
        None => scene::inputs_without_models(scene, &[], radar).map_err(loading::scene_failure),
    };
    files.unwrap_or_else(|_| std::iter::once(scene.to_owned()).chain(arguments.config.clone()).collect())
}

/// Provenance of the cube, with the step of integer samples among the settings.
fn provenance_of(
    arguments: &ImportArguments,
    scene: &SceneHeader,
    (step, unit): (&IntegerStep, SampleUnit),
    hashed: Vec<(String, String)>,
) -> Provenance {
    if *step == IntegerStep::Unknown {
        progress::note(format!(
            "note: {}: no step is told (--step): samples are counted in steps of the converter, and levels are no powers",
            arguments.array.display()
        ));
    }
    if *step == IntegerStep::Unscaled {
        progress::note(format!(
            "note: {}: a tensor tells no factor of its values: samples are those of a converter to an unknown factor, and levels are no powers",
            arguments.array.display()
        ));
    }
    let is_inferred = *step == IntegerStep::Floats && arguments.full_scale.is_none();
    if is_inferred && unit != SampleUnit::RootWatts {
        progress::note(format!(
            "note: {}: all samples are whole numbers: they are counted in steps of a converter, and levels are no powers",
            arguments.array.display()
        ));
    }
    let from = provenance(Stage::FmcwEcho, scene, hashed);
    let told = match step {
        IntegerStep::Floats | IntegerStep::DescribedFloats(..) => return from,
        IntegerStep::Unscaled => "samples of a tensor, their factor not told".to_owned(),
        IntegerStep::Unknown => "sqrt_w_per_step not told: samples are steps".to_owned(),
        IntegerStep::Given(step) | IntegerStep::Described(step, _) => format!("sqrt_w_per_step {step}"),
        IntegerStep::ConverterSteps { step, .. } => format!("adc_steps_per_step {step}"),
    };
    Provenance { settings: format!("{}, {told}", from.settings), ..from }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::cli::{Arguments, Command};
    use clap::Parser;
    use ndarray::Array4;
    use ndarray_npy::WriteNpyExt;
    use std::fs::File;
    use std::path::Path;

    fn arguments(array: &Path, scene: &Path) -> ImportArguments {
        let words = ["wayside", "import", "--out", "a.cube", "--scene"].map(Path::new);
        let words = words.into_iter().chain([scene, array]);
        let Command::Import(arguments) = Arguments::try_parse_from(words).unwrap().command else {
            panic!("it is an import")
        };
        *arguments
    }

    #[test]
    fn frames_are_those_that_the_folder_held_when_it_was_listed() {
        let folder = tempfile::tempdir().unwrap();
        let scene = folder.path().join("s.toml");
        std::fs::write(&scene, "name = \"s\"\n[radar.waveform]\nsamples = 64\nchirps = 32\n").unwrap();
        let [channels, chirps, length] = cube_header(&loading::radar_only(&scene, None).unwrap()).shape();
        let frame = Array4::from_elem((1, channels, chirps, length), Complex32::new(0.5, -0.25));
        let write = |name: &str| frame.write_npy(File::create(folder.path().join(name)).unwrap()).unwrap();
        write("a.npy");
        let arguments = arguments(folder.path(), &scene);
        let input = Input::of(&arguments).unwrap();
        write("b.npy");
        assert_eq!((input.kind, input.files.len()), (ImportKind::Array, 1));
        assert_eq!(samples(&arguments, &input).unwrap().frames.len(), 1);
    }
}
