//! The `.bin` of a DCA1000EVM behind a device with two LVDS lanes (xWR16xx, 18xx, 68xx), complex samples, one file.
//!
//! Little-endian 16-bit integers, chirp after chirp, receiver after receiver, two samples at a time: I₀ I₁ Q₀ Q₁ (Texas
//! Instruments, Mmwave Radar Device ADC Raw Data Capture, SWRA581B, section 6.2, lanes not interleaved).

use super::{Frames, Recording};
use crate::commands::export::{fail, sidecar, write_sidecar};
use crate::failure::Failure;
use crate::output;
use artifact::Reader;
use artifact::cube::{Cube, CubeHeader};
use num_complex::Complex32;
use serde_json::{Value, json};
use std::io::Write;
use std::path::Path;

/// Writes a cube; the strongest sample takes most of the converter's range, the `.json` beside it says what one step is.
pub(crate) fn write(file: &Path, out: &Path) -> Result<(), Failure> {
    let reader = Reader::<Cube>::open(file)?;
    let header = reader.header().clone();
    let recording = even(file, Recording::of(file, &header)?)?;
    let mut peak = 0.0_f32;
    for frame in reader {
        peak = frame?.samples.iter().fold(peak, |peak, x| peak.max(x.re.abs()).max(x.im.abs()));
    }
    let step = if peak > 0.0 { peak / FULL_SCALE } else { 1.0 };
    let mut failed = None;
    let mut reader = Reader::<Cube>::open(file)?;
    let frames = reader.frames();
    let written = output::write_with(out, |stream| {
        reader.by_ref().try_for_each(|frame| {
            let frame = frame.map_err(|e| fail(&mut failed, e))?;
            stream.write_all(&bytes(&recording.by_slot(&frame.samples), step))
        })
    });
    failed.map_or(written, |error| Err(error.into()))?;
    write_sidecar(out, &told(&header, &recording, frames, step))
}

/// Reads frames; a step is what the `.json` beside the file says, else `step`, √W.
pub(crate) fn read(file: &Path, header: &CubeHeader, step: Option<f32>) -> Result<Frames, Failure> {
    let recording = even(file, Recording::of(file, header)?)?;
    let bytes = std::fs::read(file).map_err(|e| Failure::system(file, "read", e))?;
    if !bytes.len().is_multiple_of(8) {
        let text = format!("{} bytes: two complex samples of 16 bits take 8", bytes.len());
        return Err(Failure::Refused(format!("{}: {text}", file.display())));
    }
    recording.frames(file, bytes.len() / 4)?;
    let step = step.or_else(|| step_beside(file)).unwrap_or(1.0);
    let values: Vec<Complex32> = bytes.as_chunks::<8>().0.iter().flat_map(|pair| two(pair, step)).collect();
    Ok(values.chunks_exact(recording.values()).map(|frame| recording.cube_of_slots(frame)).collect())
}

/// Of 32,767 steps the strongest sample takes these: some are left for a reader's noise.
const FULL_SCALE: f32 = 32_000.0;

fn even(file: &Path, recording: Recording) -> Result<Recording, Failure> {
    if recording.samples.is_multiple_of(2) {
        return Ok(recording);
    }
    let text = format!("a chirp has {} samples: they are recorded by twos", recording.samples);
    Err(Failure::Refused(format!("{}: {text}", file.display())))
}

fn bytes(values: &[Complex32], step: f32) -> Vec<u8> {
    let steps = |x: f32| (x / step).round() as i16;
    let pair = |[a, b]: &[Complex32; 2]| [a.re, b.re, a.im, b.im].map(steps).map(i16::to_le_bytes);
    values.as_chunks::<2>().0.iter().flat_map(pair).flatten().collect()
}

/// The two samples of eight bytes.
fn two(bytes: &[u8; 8], step: f32) -> [Complex32; 2] {
    let at = |i: usize| f32::from(i16::from_le_bytes([bytes[2 * i], bytes[2 * i + 1]])) * step;
    [Complex32::new(at(0), at(2)), Complex32::new(at(1), at(3))]
}

fn told(header: &CubeHeader, recording: &Recording, frames: u64, step: f32) -> Value {
    let waveform = &header.radar.waveform;
    json!({
        "shape": ["frame", "chirp of any transmitter", "receiver", "sample"],
        "sizes": [frames, recording.slots(), recording.receivers, recording.samples],
        "sqrt_w_per_step": step,
        "sample_rate_hz": waveform.sample_rate_hz,
        "start_frequency_hz": waveform.start_frequency_hz,
        "slope_hz_per_s": waveform.slope_hz_per_s,
    })
}

fn step_beside(file: &Path) -> Option<f32> {
    let text = std::fs::read_to_string(sidecar(file)).ok()?;
    let step = serde_json::from_str::<Value>(&text).ok()?["sqrt_w_per_step"].as_f64()?;
    (step.is_finite() && step > 0.0).then_some(step as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_samples_are_i_i_q_q_and_come_back() {
        let values = [Complex32::new(1.0, -2.0), Complex32::new(3.0, 258.0)];
        let written = bytes(&values, 1.0);
        assert_eq!(written, [1, 0, 3, 0, 254, 255, 2, 1]);
        assert_eq!(two(&written.try_into().unwrap(), 1.0), values);
    }
}
