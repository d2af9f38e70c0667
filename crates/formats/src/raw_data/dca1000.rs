//! The `.bin` of a DCA1000EVM, one file: read in all layouts (`lanes.rs`), written in that of two lanes.

use crate::raw_data::described_waveform::OWN_KEYS;
pub use crate::raw_data::lanes::Layout;
use crate::raw_data::lanes::TWO_LANES;
use crate::raw_data::{ImportedFrames, IntegerStep, LIMIT_BYTES, RecordingShape, ShapeSource};
use crate::sidecar;
use artifact::Reader;
use artifact::bounded;
use artifact::cube::{Cube, CubeHeader, SampleUnit};
use artifact::radar::Sampling;
use num_complex::Complex32;
use pipeline::chain::loading;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use serde_json::{Value, json};
use std::io::{Error, Write};
use std::path::{Path, PathBuf};

/// Writes a cube; samples that were steps keep their values if they fit; of all others the strongest takes
/// most of the converter's range. The `.json` beside it holds the step and the samples' BLAKE3 hash: a later
/// recording under this name has its own steps.
///
/// # Errors
/// The cube cannot be recorded this way, or has changed when it is read for the second time.
pub fn write(file: &Path, out: &Path) -> Result<(), Failure> {
    write_in_two(file, out, || {})
}

/// Writes as [`write`] does; `between` runs between reading the cube for its step and for its samples.
fn write_in_two(file: &Path, out: &Path, between: impl FnOnce()) -> Result<(), Failure> {
    let reader = Reader::<Cube>::open(file)?;
    let header = reader.header().clone();
    let recording = RecordingShape::of_complex(file, &header)?;
    TWO_LANES.check(file, &recording, Sampling::Complex)?;
    sidecar::claim(out)?;
    let (mut parts, mut seen) = (SampleRange::NONE, blake3::Hasher::new());
    for frame in progress::frames(reader) {
        let samples = frame?.samples;
        hash(&mut seen, &samples);
        parts = samples.iter().flat_map(|x| [x.re, x.im]).fold(parts, SampleRange::with);
    }
    let step = step_of(header.unit, parts);
    between();
    let (mut hasher, mut seen_again) = (blake3::Hasher::new(), blake3::Hasher::new());
    let mut reader = Reader::<Cube>::open(file)?;
    if *reader.header() != header {
        return Err(loading::changed(file));
    }
    let (frames, mut is_changed) = (reader.frames(), false);
    let written = files::write_with(out, |stream| {
        progress::counted("frames", reader.by_ref(), frames as usize).try_for_each(|frame| {
            let frame = frame.map_err(Error::other)?;
            hash(&mut seen_again, &frame.samples);
            let bytes = bytes(&recording.by_slot(&frame.samples), step);
            hasher.update(&bytes);
            stream.write_all(&bytes)
        })?;
        is_changed = seen.finalize() != seen_again.finalize();
        if is_changed { Err(Error::other("its step is that of other samples")) } else { Ok(()) }
    });
    if is_changed {
        return Err(loading::changed(file));
    }
    written?;
    let mut told = description(&header, &recording, frames, step);
    told[HASH] = hasher.finalize().to_hex().to_string().into();
    sidecar::write(out, &told)
}

/// Reads frames; a step is `step`, √W, else that of the `.json` beside the file for these samples, else the
/// unit of the file. The waveform in that `.json` must be the radar's. The layout comes with what tells the
/// shape of a frame where no `.json` does.
pub fn read(
    file: &Path,
    header: &CubeHeader,
    step: Option<f32>,
    (layout, mut shape): (Layout, ShapeSource),
) -> Result<ImportedFrames, Failure> {
    let (recording, sampling) = (RecordingShape::of(file, header)?, header.radar.waveform.sampling);
    layout.check(file, &recording, sampling)?;
    let bytes = bounded::read(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))?;
    let unit = layout.unit_bytes(sampling);
    if !bytes.len().is_multiple_of(unit) {
        let text = format!(
            "{} bytes: the least that belongs together, {}, take {unit}",
            bytes.len(),
            layout.unit(sampling)
        );
        return Err(Failure::Refused(format!("{}: {text}", file.display())));
    }
    let beside = description_of(file, &bytes);
    if let Some((told, place)) = &beside {
        OWN_KEYS.check(told, place, &header.radar.waveform)?;
        shape = check_sizes(told, place, &recording)?;
    }
    recording.check_frames(file, bytes.len() / layout.value_bytes(sampling), shape)?;
    let descriptions = beside.iter().map(|(_, place)| place.clone()).collect();
    let step = IntegerStep::of(step, || match beside {
        Some((told, place)) => described_step(&told, place),
        None => {
            note_of_others(file);
            None
        }
    });
    let values = layout.by_slot(&bytes, &recording, sampling, step.factor());
    let frames =
        values.chunks_exact(recording.values()).map(|frame| recording.cube_of_slots(frame)).collect();
    Ok(ImportedFrames { frames, step, descriptions })
}

/// Steps, of 32,767, of the strongest sample: the rest is for a reader's noise.
const FULL_SCALE: f32 = 32_000.0;

/// Values of the samples that determine the step.
#[derive(Debug, Clone, Copy, PartialEq)]
struct SampleRange {
    least: f32,
    most: f32,
    are_whole: bool,
}

impl SampleRange {
    const NONE: Self = Self { least: 0.0, most: 0.0, are_whole: true };

    fn with(self, part: f32) -> Self {
        Self {
            least: self.least.min(part),
            most: self.most.max(part),
            are_whole: self.are_whole && part.fract() == 0.0,
        }
    }

    fn are_integers_of_16_bits(self) -> bool {
        self.are_whole && self.least >= f32::from(i16::MIN) && self.most <= f32::from(i16::MAX)
    }
}

/// Step of the samples; those that were steps keep their values if they fit.
fn step_of(unit: SampleUnit, parts: SampleRange) -> f32 {
    let peak = parts.most.max(-parts.least);
    match unit {
        SampleUnit::FullScale(_) | SampleUnit::Steps if parts.are_integers_of_16_bits() => 1.0,
        _ if peak > 0.0 => peak / FULL_SCALE,
        _ => 1.0,
    }
}

fn hash(seen: &mut blake3::Hasher, samples: &[Complex32]) {
    let bytes: Vec<u8> = samples.iter().flat_map(|x| [x.re, x.im]).flat_map(f32::to_le_bytes).collect();
    seen.update(&bytes);
}

fn bytes(values: &[Complex32], step: f32) -> Vec<u8> {
    let steps = |x: f32| (x / step).round() as i16;
    let pair = |[a, b]: &[Complex32; 2]| [a.re, b.re, a.im, b.im].map(steps).map(i16::to_le_bytes);
    values.as_chunks::<2>().0.iter().flat_map(pair).flatten().collect()
}

fn description(header: &CubeHeader, recording: &RecordingShape, frames: u64, step: f32) -> Value {
    let (waveform, unit) = (&header.radar.waveform, header.unit);
    json!({
        "shape": SHAPE,
        SIZES: [frames, recording.slots(), recording.receivers, recording.samples],
        STEP: (unit == SampleUnit::RootWatts).then_some(step),
        COUNT: (unit != SampleUnit::RootWatts).then_some(step),
        "unit": unit.name(),
        FULL_SCALE_KEY: unit.full_scale(),
        "sample_rate_hz": waveform.sample_rate_hz,
        "start_frequency_hz": waveform.start_frequency_hz,
        "slope_hz_per_s": waveform.slope_hz_per_s,
    })
}

/// Key of the samples' BLAKE3 hash.
const HASH: &str = "blake3";
/// Key of the sizes in the order of `shape`.
const SIZES: &str = "sizes";
const SHAPE: [&str; 4] = ["frame", "chirp of any transmitter", "receiver", "sample"];

/// Places of the description of a file: the present one, and that of earlier versions.
fn places(file: &Path) -> [PathBuf; 2] {
    [sidecar::beside(file), file.with_extension("json")]
}

/// Descriptions beside a file, whatever samples they describe.
pub fn descriptions(file: &Path) -> Vec<PathBuf> {
    places(file).into_iter().filter(|place| place.is_file()).collect()
}

/// The description beside the file and its place; one of other samples is ignored.
fn description_of(file: &Path, samples: &[u8]) -> Option<(Value, PathBuf)> {
    let told = places(file).into_iter().filter_map(|place| Some((sidecar::read(&place)?, place)));
    told.into_iter().find(|(told, _)| is_of(told, samples))
}

/// Notes steps beside the file that belong to other samples.
fn note_of_others(file: &Path) {
    for place in places(file) {
        if sidecar::read(&place).is_some_and(|told| told.get(STEP).is_some()) {
            let why = format!("its step is not that of {}: it belongs to other samples", file.display());
            progress::note(format!("note: {}: {why}", place.display()));
        }
    }
}

/// Refuses frames of another shape than the radar's.
fn check_sizes(told: &Value, place: &Path, recording: &RecordingShape) -> Result<ShapeSource, Failure> {
    let sizes = [&told[SIZES][1], &told[SIZES][2], &told[SIZES][3]];
    let radars = [recording.slots(), recording.receivers, recording.samples];
    let names = ["chirps", "receivers", "samples"];
    for ((name, size), radars) in names.into_iter().zip(sizes).zip(radars) {
        if size.as_u64().is_some_and(|size| size != radars as u64) {
            let text = format!("{SIZES} tells {size} {name}, the scene's radar has {radars}");
            return Err(Failure::Refused(format!("{}: {text}", place.display())));
        }
    }
    Ok(ShapeSource::of(&sizes))
}

/// The step in a description, √W or in steps of the original converter.
fn described_step(told: &Value, place: PathBuf) -> Option<IntegerStep> {
    let number = |key: &str| {
        let number = told[key].as_f64()?;
        (number.is_finite() && number > 0.0).then_some(number)
    };
    match number(STEP) {
        Some(step) => Some(IntegerStep::Described(step as f32, place)),
        None => number(COUNT).map(|step| IntegerStep::ConverterSteps {
            step: step as f32,
            full_scale: number(FULL_SCALE_KEY),
            place,
        }),
    }
}

/// Whether a sidecar describes these samples: by their hash, in earlier versions by shape and length.
fn is_of(told: &Value, samples: &[u8]) -> bool {
    match told[HASH].as_str() {
        Some(hash) => hash == blake3::hash(samples).to_hex().as_str(),
        None => {
            let sizes = told[SIZES].as_array().into_iter().flatten().map(Value::as_u64);
            let values = sizes.collect::<Option<Vec<u64>>>().map(|sizes| sizes.iter().product::<u64>());
            told["shape"] == json!(SHAPE) && values.is_some_and(|values| values * 4 == samples.len() as u64)
        }
    }
}

/// Key of the step, √W.
const STEP: &str = "sqrt_w_per_step";
/// Key of the step of samples without a value in √W: steps of the original converter.
const COUNT: &str = "adc_steps_per_step";
/// Key of the full scale of that converter.
const FULL_SCALE_KEY: &str = "full_scale";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raw_data::test_cube;

    #[test]
    fn a_step_is_believed_of_the_samples_that_it_tells_of_alone() {
        let samples = [1_u8; 32];
        let of = |told: Value| is_of(&told, &samples);
        assert!(of(json!({ HASH: blake3::hash(&samples).to_hex().to_string() })));
        assert!(!of(
            json!({ HASH: blake3::hash(&[2]).to_hex().to_string(), "shape": SHAPE, "sizes": [1, 1, 1, 8] })
        ));
        assert!(of(json!({ "shape": SHAPE, "sizes": [1, 2, 2, 2] })), "of an earlier version");
        assert!(!of(json!({ "shape": SHAPE, "sizes": [1, 2, 2, 3] })));
        assert!(!of(json!({ "shape": ["frame", "channel", "chirp", "sample"], "sizes": [1, 2, 2, 2] })));
        assert!(!of(json!({ STEP: 1.0 })) && !of(json!([])));
    }

    #[test]
    fn steps_that_fit_stay_and_whatever_else_takes_most_of_the_range() {
        let step = |unit, parts: &[f32]| {
            step_of(unit, parts.iter().copied().fold(SampleRange::NONE, SampleRange::with))
        };
        let full = SampleUnit::FullScale(1.0);
        assert_eq!(step(SampleUnit::Steps, &[-32768.0, 32767.0]), 1.0, "the least integer of 16 bits fits");
        assert_eq!(step(SampleUnit::FullScale(32_768.0), &[-32768.0]), 1.0);
        assert_eq!(step(SampleUnit::Steps, &[32768.0]), 32768.0 / FULL_SCALE);
        assert_eq!(step(full, &[-0.5, 0.25]), 0.5 / FULL_SCALE);
        assert_eq!(step(full, &[1.0, 0.0, -1.0]), 1.0);
        assert_eq!(step(SampleUnit::RootWatts, &[1.0]), 1.0 / FULL_SCALE);
        assert_eq!(step(SampleUnit::RootWatts, &[]), 1.0);
    }

    #[test]
    fn a_cube_that_is_replaced_while_it_is_read_is_refused_and_nothing_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let (file, out) = (folder.path().join("a.cube"), folder.path().join("a.bin"));
        let elements = [radar::aperture::row(1, 1.0), radar::aperture::row(2, 1.0)];
        let radar = radar::paper::radar([0.0; 3], radar::paper::waveform(8, 2), elements);
        let (noise, dsp) = (artifact::settings::Noise::Absent, radar::paper::processing());
        let header = CubeHeader { radar, noise, dsp, unit: SampleUnit::RootWatts };
        let (strong, weak) = (folder.path().join("strong.cube"), folder.path().join("weak.cube"));
        let put = |file: &Path, level: f32| {
            let from = artifact::Provenance::default();
            let mut writer = artifact::Writer::<Cube>::create(file, &from, &header).unwrap();
            let samples = vec![Complex32::new(level, 0.0); header.shape().iter().product()];
            let error = artifact::ErrorBudget::default();
            writer.write(&artifact::cube::CubeFrame { index: 0, time_s: 0.0, samples, error }).unwrap();
            writer.finish().unwrap();
        };
        put(&weak, 1.0);
        put(&strong, 10.0);
        std::fs::copy(&weak, &file).unwrap();
        write_in_two(&file, &out, || {}).unwrap();
        std::fs::remove_file(&out).unwrap();
        // Ten times as strong: all steps would be at the end of the range.
        let refused = write_in_two(&file, &out, || drop(std::fs::copy(&strong, &file))).unwrap_err();
        assert!(refused.to_string().contains("was changed while this command read it"), "{refused}");
        assert!(!out.exists());
    }

    #[test]
    fn the_description_of_a_recording_is_accepted_whatever_the_command_gives_as_its_step() {
        let folder = tempfile::tempdir().unwrap();
        let (header, out) = (test_cube::header(SampleUnit::RootWatts), folder.path().join("x.bin"));
        write(&test_cube::write(folder.path(), &header), &out).unwrap();
        let layout = (TWO_LANES, ShapeSource::Assumed);
        for step in [None, Some(1e-9)] {
            let imported = read(&out, &header, step, layout).unwrap();
            assert_eq!(
                (imported.descriptions, imported.step.is_described()),
                (descriptions(&out), step.is_none())
            );
            assert_eq!(descriptions(&out), [sidecar::beside(&out)]);
        }
        std::fs::remove_file(sidecar::beside(&out)).unwrap();
        assert!(read(&out, &header, None, layout).unwrap().descriptions.is_empty());
    }

    #[test]
    fn two_samples_are_i_i_q_q() {
        let values = [Complex32::new(1.0, -2.0), Complex32::new(3.0, 258.0)];
        assert_eq!(bytes(&values, 1.0), [1, 0, 3, 0, 254, 255, 2, 1]);
    }
}
