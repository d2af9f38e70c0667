//! Kinds of imports, and the options that apply to each; other options are refused, not ignored.

use crate::program::cli::ImportArguments;
use artifact::cube::SampleUnit;
use artifact::radar::Sampling;
use formats::radar_cloud::import::{extension, frames_of};
use formats::raw_data::{IntegerStep, arrays, sigmf, uwcr};
use pipeline::host::failure::Failure;
use std::path::PathBuf;

/// Kind of an import.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ImportKind {
    /// A NumPy array of complex floats, or a folder of them.
    Array,
    /// The `.bin` of a DCA1000EVM.
    CaptureCard,
    /// A SigMF recording.
    Sigmf,
    /// A `.mat` of UWCR, or a folder of them.
    Uwcr,
    /// Clouds of detections, imported as points.
    Clouds,
}

impl ImportKind {
    /// Determines the kind of frames from the ending that their files share.
    fn of_frames(files: &[PathBuf]) -> Self {
        let is_mat = |file: &PathBuf| extension(file).is_some_and(|ending| uwcr::ENDINGS.contains(&ending));
        if files.first().is_some_and(is_mat) { Self::Uwcr } else { Self::Array }
    }
}

/// Endings of the frames in a folder of samples.
const FOLDER_ENDINGS: [&str; 2] = [uwcr::ENDINGS[0], arrays::ENDINGS[0]];

/// Kind of an import, with the files of its samples.
pub(super) struct Input {
    pub(super) kind: ImportKind,
    /// Files that hold the samples; none for clouds, which their own reader lists.
    pub(super) files: Vec<PathBuf>,
}

impl Input {
    /// Determines the kind from the names of input and output, and of the frames in a folder, which is listed
    /// here and nowhere else: files that appear in it later belong to no import.
    ///
    /// # Errors
    /// A folder that cannot be listed, or whose frames are not all arrays or all of UWCR.
    pub(super) fn of(arguments: &ImportArguments) -> Result<Self, Failure> {
        let asked = arguments.array.as_path();
        let (kind, files) = match extension(asked) {
            _ if extension(&arguments.out) == Some("points") => (ImportKind::Clouds, vec![]),
            Some("bin") => (ImportKind::CaptureCard, vec![asked.to_owned()]),
            Some("sigmf-meta" | "sigmf-data") => (ImportKind::Sigmf, sigmf::pair(asked).to_vec()),
            _ => {
                let files = frames_of(asked, &FOLDER_ENDINGS)?;
                (ImportKind::of_frames(&files), files)
            }
        };
        Ok(Self { kind, files })
    }
}

/// An option that applies to some kinds only.
struct KindOption {
    name: &'static str,
    is_given: fn(&ImportArguments) -> bool,
    kinds: &'static [ImportKind],
    rule: &'static str,
}

/// Options beside those that every kind takes: `--config`, `--device`, `--scene` and `--radar` describe the
/// radar.
const OPTIONS: [KindOption; 4] = [
    KindOption {
        name: "--step",
        is_given: |arguments| arguments.step.is_some(),
        kinds: &[ImportKind::CaptureCard, ImportKind::Sigmf],
        rule: INTEGERS,
    },
    KindOption {
        name: "--full-scale",
        is_given: |arguments| arguments.full_scale.is_some(),
        kinds: &[ImportKind::Array, ImportKind::CaptureCard, ImportKind::Sigmf, ImportKind::Uwcr],
        rule: "is for samples: a cloud of detections has none",
    },
    KindOption {
        name: "--layout",
        is_given: |arguments| arguments.layout.is_some(),
        kinds: &[ImportKind::CaptureCard],
        rule: CAPTURE_CARD,
    },
    KindOption {
        name: "--iq-order",
        is_given: |arguments| arguments.iq_order.is_some(),
        kinds: &[ImportKind::CaptureCard],
        rule: CAPTURE_CARD,
    },
];

const INTEGERS: &str =
    "is for samples that are integers: a DCA1000EVM's .bin, or a SigMF recording of ci16_le";
const CAPTURE_CARD: &str = "is for the .bin of a DCA1000EVM";

/// Refuses an option that does not apply to this kind of input.
pub(super) fn check(arguments: &ImportArguments, kind: ImportKind) -> Result<(), Failure> {
    let is_idle = |option: &&KindOption| (option.is_given)(arguments) && !option.kinds.contains(&kind);
    match OPTIONS.iter().find(is_idle) {
        Some(option) => Err(off(arguments, option.name, option.rule)),
        None => Ok(()),
    }
}

/// Refuses an option that does not apply to the samples that were found.
pub(super) fn check_samples(
    arguments: &ImportArguments,
    sampling: Sampling,
    step: &IntegerStep,
) -> Result<(), Failure> {
    let are_floats = matches!(step, IntegerStep::Floats | IntegerStep::DescribedFloats(..));
    if are_floats && arguments.step.is_some() {
        return Err(off(arguments, "--step", INTEGERS));
    }
    if let Some(rule) = full_scale_rule(step).filter(|_| arguments.full_scale.is_some()) {
        return Err(off(arguments, "--full-scale", &rule));
    }
    if sampling == Sampling::Real && arguments.iq_order.is_some() {
        return Err(off(arguments, "--iq-order", "is for complex samples: the scene's radar has real ones"));
    }
    Ok(())
}

/// Rule by which a full scale does not apply to samples, if there is one.
fn full_scale_rule(step: &IntegerStep) -> Option<String> {
    match step {
        IntegerStep::Described(_, place) => {
            Some(format!("is for samples in steps: {} tells what a step is, √W", place.display()))
        }
        IntegerStep::DescribedFloats(SampleUnit::RootWatts, place) => {
            Some(format!("is for samples in steps: {} tells that these are in √W", place.display()))
        }
        IntegerStep::ConverterSteps { full_scale: Some(steps), place, .. }
        | IntegerStep::DescribedFloats(SampleUnit::FullScale(steps), place) => {
            Some(format!("is told already: {} has a full scale of {steps} steps", place.display()))
        }
        IntegerStep::Unscaled => {
            Some("is for samples in steps: a tensor tells no factor of its values".to_owned())
        }
        _ => None,
    }
}

fn off(arguments: &ImportArguments, option: &str, rule: &str) -> Failure {
    Failure::System(format!("{}: {option} {rule}", arguments.array.display()))
}
