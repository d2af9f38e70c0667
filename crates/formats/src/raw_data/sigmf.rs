//! SigMF recordings (sigmf.org, version 1.0): `.sigmf-data`, receivers interleaved, and `.sigmf-meta` beside
//! it.

use crate::raw_data::described_unit::UnitKeys;
use crate::raw_data::described_waveform::{NumberKey, WaveformKeys, same};
use crate::raw_data::{ImportedFrames, IntegerStep, LIMIT_BYTES, RecordingShape, ShapeSource};
use artifact::bounded;
use artifact::cube::{Cube, CubeHeader};
use artifact::{Reader, Waveform};
use num_complex::Complex32;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use serde_json::{Value, json};
use std::io::{Error, Write};
use std::path::{Path, PathBuf};

/// Writes a cube as `cf32_le`, in its own unit; every frame is a capture.
pub fn write(file: &Path, out: &Path) -> Result<(), Failure> {
    let reader = Reader::<Cube>::open(file)?;
    let header = reader.header().clone();
    let recording = RecordingShape::of_complex(file, &header)?;
    let (data, meta_place) = (part_of(out, DATA), part_of(out, META));
    files::claim(&[data.clone(), meta_place.clone()])?;
    files::refuse_foreign(&meta_place, META_LIMIT_BYTES, is_own)?;
    if out != data {
        let rule = "has no description of this program's beside it, and was not named itself";
        files::refuse_unless(&data, rule, || meta_place.exists())?;
    }
    let mut times = Vec::new();
    files::write_with(&data, |stream| {
        progress::frames(reader).try_for_each(|frame| {
            let frame = frame.map_err(Error::other)?;
            times.push(frame.time_s);
            let values = recording.interleaved(&recording.by_slot(&frame.samples));
            let bytes: Vec<u8> =
                values.iter().flat_map(|x| [x.re, x.im]).flat_map(f32::to_le_bytes).collect();
            stream.write_all(&bytes)
        })?;
        // If the command ends before the description is written, the old one must not describe the new
        // samples.
        files::remove_description(&meta_place, NOTHING_TOLD)
    })?;
    let text = serde_json::to_string_pretty(&meta(&header, &recording, &times)).map_err(Failure::refused)?;
    files::write_file(&meta_place, text.as_bytes())
}

/// `x` or either file of the pair → `x.sigmf-data` or `x.sigmf-meta`; any other ending is part of the name.
fn part_of(out: &Path, ending: &str) -> PathBuf {
    let is_pair = out.extension().is_some_and(|told| told == DATA || told == META);
    let mut name = if is_pair { out.with_extension("") } else { out.to_owned() }.into_os_string();
    name.push(".");
    name.push(ending);
    PathBuf::from(name)
}

/// Whether this text describes a recording of this program.
fn is_own(meta: &[u8]) -> bool {
    serde_json::from_slice::<Value>(meta).is_ok_and(|told| told["global"]["core:recorder"] == RECORDER)
}

/// Both files of a recording, the requested one first.
pub fn pair(asked: &Path) -> [PathBuf; 2] {
    let other = if asked.extension().is_some_and(|told| told == META) { DATA } else { META };
    [asked.to_owned(), asked.with_extension(other)]
}

/// Reads frames of `cf32_le`, in the unit of the description if it has one, or of `ci16_le`, of which one
/// step is `step` √W, else the unit. The waveform in the description must be the radar's.
pub fn read(file: &Path, header: &CubeHeader, step: Option<f32>) -> Result<ImportedFrames, Failure> {
    let recording = RecordingShape::of_complex(file, header)?;
    let (meta, data) = (file.with_extension(META), file.with_extension(DATA));
    let text = bounded::read_text(&meta, META_LIMIT_BYTES).map_err(|fault| Failure::unread(&meta, &fault))?;
    let told: Value = serde_json::from_str(&text).map_err(|e| refused(&meta, e.to_string()))?;
    check_layout(&told, &meta)?;
    check_radar(&told["global"], &meta, header, &recording)?;
    check_carriers(&told, &meta, &header.radar.waveform)?;
    let bytes = bounded::read(&data, LIMIT_BYTES).map_err(|fault| Failure::unread(&data, &fault))?;
    let (values, step) = match told["global"]["core:datatype"].as_str() {
        Some("cf32_le") => (of_floats(&bytes), UNIT.meaning(&told["global"], &meta)?),
        Some("ci16_le") => {
            let step = IntegerStep::of(step, || None);
            (of_integers(&bytes, step.factor()), step)
        }
        other => {
            let found = other.unwrap_or("nothing");
            return Err(refused(&meta, format!("core:datatype is {found}; cf32_le and ci16_le are read")));
        }
    };
    let values = values.ok_or_else(|| refused(&data, "ends within a sample".to_owned()))?;
    let global = &told["global"];
    recording.check_frames(&data, values.len(), ShapeSource::of(&[&global[CHIRPS], &global[SAMPLES]]))?;
    let cube = |frame: &[Complex32]| recording.cube_of_slots(&recording.deinterleaved(frame));
    let frames = values.chunks_exact(recording.values()).map(cube).collect();
    Ok(ImportedFrames { frames, step, descriptions: vec![meta] })
}

/// Refuses missing samples, and files with other data.
fn check_layout(told: &Value, meta: &Path) -> Result<(), Failure> {
    let global = &told["global"];
    if global["core:metadata_only"] == true {
        return Err(refused(meta, "core:metadata_only is true: there are no samples".to_owned()));
    }
    if let Some(name) = global.get("core:dataset") {
        let text = format!("core:dataset is {name}: samples are read of the .sigmf-data beside it alone");
        return Err(refused(meta, text));
    }
    let captures = told["captures"].as_array().into_iter().flatten();
    let heads = captures.map(|capture| ("core:header_bytes", &capture["core:header_bytes"]));
    let ends = std::iter::once(("core:trailing_bytes", &global["core:trailing_bytes"]));
    match heads.chain(ends).find(|(_, bytes)| !bytes.is_null() && **bytes != 0) {
        Some((key, bytes)) => {
            Err(refused(meta, format!("{key} is {bytes}: files of samples alone are read")))
        }
        None => Ok(()),
    }
}

/// Refuses samples of another radar than the scene's.
fn check_radar(
    global: &Value,
    meta: &Path,
    header: &CubeHeader,
    recording: &RecordingShape,
) -> Result<(), Failure> {
    let channels = match &global["core:num_channels"] {
        Value::Null => 1.into(),
        told => told.clone(),
    };
    if channels.as_f64() != Some(recording.receivers as f64) {
        let text = format!(
            "core:num_channels is {channels}, the scene's radar has {} receivers",
            recording.receivers
        );
        return Err(refused(meta, text));
    }
    WAVEFORM.check(global, meta, &header.radar.waveform)?;
    same(global, meta, CHIRPS, recording.slots() as f64)?;
    same(global, meta, SAMPLES, recording.samples as f64)
}

/// Refuses captures of another carrier: beyond the radar's sweep by half of it or more. The frequency may be
/// the middle of the sweep, its beginning, or that of a ramp whose first part is not sampled.
fn check_carriers(told: &Value, meta: &Path, waveform: &Waveform) -> Result<(), Failure> {
    let (centre_hz, width_hz) = (waveform.centre_frequency_hz(), waveform.bandwidth_hz().abs());
    for (number, capture) in told["captures"].as_array().into_iter().flatten().enumerate() {
        if let Some(hz) = capture[FREQUENCY].as_f64().filter(|hz| (hz - centre_hz).abs() > width_hz) {
            let radars = format!("the scene's radar sweeps {width_hz:?} Hz about {centre_hz:?}");
            return Err(refused(meta, format!("{FREQUENCY} of capture {number} is {hz:?}, {radars}")));
        }
    }
    Ok(())
}

/// Key of a capture's carrier, defined by SigMF.
const FREQUENCY: &str = "core:frequency";

/// Keys of the waveform; the rate is defined by SigMF.
const WAVEFORM: WaveformKeys = WaveformKeys {
    sample_rate: NumberKey::of_base_unit("core:sample_rate"),
    start_frequency: NumberKey::of_base_unit("wayside:start_frequency_hz"),
    slope: NumberKey::of_base_unit("wayside:slope_hz_per_s"),
};
/// Keys of the unit of the samples.
const UNIT: UnitKeys = UnitKeys { unit: "wayside:unit", full_scale: "wayside:full_scale" };
/// Key of the number of chirps of all transmitters in a frame.
const CHIRPS: &str = "wayside:chirps";
/// Key of the number of samples of a chirp.
const SAMPLES: &str = "wayside:samples";

const DATA: &str = "sigmf-data";
const META: &str = "sigmf-meta";
/// This program's name as the recorder in a description.
const RECORDER: &str = "wayside";
/// Description of a recording of this program without properties of its samples.
const NOTHING_TOLD: &[u8] = b"{\"global\": {\"core:recorder\": \"wayside\"}}";
/// Largest description: a capture for each of a hundred thousand frames.
const META_LIMIT_BYTES: u64 = 16 << 20;

fn refused(file: &Path, text: String) -> Failure {
    Failure::Refused(format!("{}: {text}", file.display()))
}

fn of_floats(bytes: &[u8]) -> Option<Vec<Complex32>> {
    let (values, rest) = bytes.as_chunks::<8>();
    let part = |v: &[u8; 8], i: usize| f32::from_le_bytes([v[i], v[i + 1], v[i + 2], v[i + 3]]);
    rest.is_empty().then(|| values.iter().map(|v| Complex32::new(part(v, 0), part(v, 4))).collect())
}

fn of_integers(bytes: &[u8], step: f32) -> Option<Vec<Complex32>> {
    let (values, rest) = bytes.as_chunks::<4>();
    let part = |v: &[u8; 4], i: usize| f32::from(i16::from_le_bytes([v[i], v[i + 1]])) * step;
    rest.is_empty().then(|| values.iter().map(|v| Complex32::new(part(v, 0), part(v, 2))).collect())
}

fn meta(header: &CubeHeader, recording: &RecordingShape, times_s: &[f64]) -> Value {
    let waveform = &header.radar.waveform;
    let of_a_frame = recording.slots() * recording.samples;
    let frequency_hz = waveform.centre_frequency_hz();
    let capture = |(i, time_s): (usize, &f64)| {
        let start = i * of_a_frame;
        json!({ "core:sample_start": start, FREQUENCY: frequency_hz, "wayside:time_s": time_s })
    };
    let description = format!(
        "IF samples of an FMCW radar, {}: frame, chirp of any transmitter, sample, receiver",
        header.unit.name()
    );
    json!({
        "global": {
            "core:version": "1.0.0",
            "core:datatype": "cf32_le",
            "core:num_channels": recording.receivers,
            WAVEFORM.sample_rate.name: waveform.sample_rate_hz,
            "core:description": description,
            "core:recorder": RECORDER,
            "core:extensions": [{ "name": "wayside", "version": "1.0.0", "optional": true }],
            CHIRPS: recording.slots(),
            SAMPLES: recording.samples,
            WAVEFORM.start_frequency.name: waveform.start_frequency_hz,
            WAVEFORM.slope.name: waveform.slope_hz_per_s,
            UNIT.unit: header.unit.name(),
            UNIT.full_scale: header.unit.full_scale(),
        },
        "captures": times_s.iter().enumerate().map(capture).collect::<Vec<_>>(),
        "annotations": [],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raw_data::test_cube::{self, UNITS};

    #[test]
    fn a_recording_comes_back_in_the_unit_of_its_description() {
        for unit in UNITS {
            let folder = tempfile::tempdir().unwrap();
            let (header, out) = (test_cube::header(unit), folder.path().join("x"));
            write(&test_cube::write(folder.path(), &header), &out).unwrap();
            let meta = part_of(&out, META);
            let imported = read(&meta, &header, None).unwrap();
            assert_eq!(imported.step, IntegerStep::DescribedFloats(unit, meta.clone()));
            let global = &serde_json::from_slice::<Value>(&std::fs::read(&meta).unwrap()).unwrap()["global"];
            assert_eq!(global["wayside:unit"], unit.name());
            assert_eq!(global["wayside:full_scale"].as_f64(), unit.full_scale());
        }
    }
}
