//! The `.bin` of a DCA1000EVM, one file: read in all layouts (`lanes.rs`), written as behind two lanes.

pub use crate::raw_data::lanes::Layout;
use crate::raw_data::lanes::TWO_LANES;
use crate::raw_data::{Imported, IntegerStep, LIMIT_BYTES, Recording};
use crate::sidecar;
use crate::writing::fail;
use artifact::Reader;
use artifact::bounded;
use artifact::cube::{Cube, CubeHeader, SampleUnit};
use artifact::radar::Sampling;
use num_complex::Complex32;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use serde_json::{Value, json};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Writes a cube; the strongest sample takes most of the converter's range, the `.json` beside it says what
/// one step is and of which samples, by their BLAKE3: whatever else is recorded under this name later has
/// steps of its own.
pub fn write(file: &Path, out: &Path) -> Result<(), Failure> {
    let reader = Reader::<Cube>::open(file)?;
    let header = reader.header().clone();
    let recording = Recording::of_complex(file, &header)?;
    TWO_LANES.check(file, &recording, Sampling::Complex)?;
    sidecar::claim(out)?;
    let mut peak = 0.0_f32;
    for frame in progress::frames(reader) {
        peak = frame?.samples.iter().fold(peak, |peak, x| peak.max(x.re.abs()).max(x.im.abs()));
    }
    let step = step_of(header.unit, peak);
    let (mut failed, mut hasher) = (None, blake3::Hasher::new());
    let mut reader = Reader::<Cube>::open(file)?;
    let frames = reader.frames();
    let written = files::write_with(out, |stream| {
        progress::counted("frames", reader.by_ref(), frames as usize).try_for_each(|frame| {
            let frame = frame.map_err(|e| fail(&mut failed, e))?;
            let bytes = bytes(&recording.by_slot(&frame.samples), step);
            hasher.update(&bytes);
            stream.write_all(&bytes)
        })
    });
    failed.map_or(written, |error| Err(error.into()))?;
    let mut told = told(&header, &recording, frames, step);
    told[HASH] = hasher.finalize().to_hex().to_string().into();
    sidecar::write(out, &told)
}

/// Reads frames; a step is `step`, √W, else what the `.json` beside the file says of these very samples, else
/// the unit of what is read.
pub fn read(
    file: &Path,
    header: &CubeHeader,
    step: Option<f32>,
    layout: Layout,
) -> Result<Imported, Failure> {
    let (recording, sampling) = (Recording::of(file, header)?, header.radar.waveform.sampling);
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
    recording.frames(file, bytes.len() / layout.value_bytes(sampling))?;
    let step = IntegerStep::of(step, || step_beside(file, &bytes));
    let values = layout.by_slot(&bytes, &recording, sampling, step.sqrt_w());
    let frames =
        values.chunks_exact(recording.values()).map(|frame| recording.cube_of_slots(frame)).collect();
    Ok(Imported { frames, step })
}

/// Steps, of 32,767, that the strongest sample takes: some are left for a reader's noise.
const FULL_SCALE: f32 = 32_000.0;

/// Samples that were steps stay what they were, where they fit.
fn step_of(unit: SampleUnit, peak: f32) -> f32 {
    match unit {
        SampleUnit::FullScale(_) | SampleUnit::Steps if peak <= f32::from(i16::MAX) => 1.0,
        _ if peak > 0.0 => peak / FULL_SCALE,
        _ => 1.0,
    }
}

fn bytes(values: &[Complex32], step: f32) -> Vec<u8> {
    let steps = |x: f32| (x / step).round() as i16;
    let pair = |[a, b]: &[Complex32; 2]| [a.re, b.re, a.im, b.im].map(steps).map(i16::to_le_bytes);
    values.as_chunks::<2>().0.iter().flat_map(pair).flatten().collect()
}

fn told(header: &CubeHeader, recording: &Recording, frames: u64, step: f32) -> Value {
    let (waveform, unit) = (&header.radar.waveform, header.unit);
    json!({
        "shape": SHAPE,
        "sizes": [frames, recording.slots(), recording.receivers, recording.samples],
        STEP: (unit == SampleUnit::RootWatts).then_some(step),
        "unit": unit.name(),
        "sample_rate_hz": waveform.sample_rate_hz,
        "start_frequency_hz": waveform.start_frequency_hz,
        "slope_hz_per_s": waveform.slope_hz_per_s,
    })
}

/// Key of the samples' BLAKE3.
const HASH: &str = "blake3";
const SHAPE: [&str; 4] = ["frame", "chirp of any transmitter", "receiver", "sample"];

/// The step told beside the file and where; what belongs to other samples is not believed.
fn step_beside(file: &Path, samples: &[u8]) -> Option<(f32, PathBuf)> {
    let places = [sidecar::beside(file), file.with_extension("json")];
    let told = places.into_iter().filter_map(|place| Some((sidecar::read(&place)?, place)));
    let (told, place) = told.into_iter().find(|(told, place)| {
        let is_of_these = is_of(told, samples);
        if !is_of_these && told.get(STEP).is_some() {
            let why = format!("its step is not that of {}: it belongs to other samples", file.display());
            progress::note(format!("note: {}: {why}", place.display()));
        }
        is_of_these
    })?;
    let step = told[STEP].as_f64()?;
    (step.is_finite() && step > 0.0).then_some((step as f32, place))
}

/// Whether a sidecar tells of these samples: by their hash, in earlier versions by shape and length.
fn is_of(told: &Value, samples: &[u8]) -> bool {
    match told[HASH].as_str() {
        Some(hash) => hash == blake3::hash(samples).to_hex().as_str(),
        None => {
            let sizes = told["sizes"].as_array().into_iter().flatten().map(Value::as_u64);
            let values = sizes.collect::<Option<Vec<u64>>>().map(|sizes| sizes.iter().product::<u64>());
            told["shape"] == json!(SHAPE) && values.is_some_and(|values| values * 4 == samples.len() as u64)
        }
    }
}

/// Key of the step.
const STEP: &str = "sqrt_w_per_step";

#[cfg(test)]
mod tests {
    use super::*;

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
    fn two_samples_are_i_i_q_q() {
        let values = [Complex32::new(1.0, -2.0), Complex32::new(3.0, 258.0)];
        assert_eq!(bytes(&values, 1.0), [1, 0, 3, 0, 254, 255, 2, 1]);
    }
}
