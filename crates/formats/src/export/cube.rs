//! Radar cubes as complex64 `[frame, channel, chirp, sample]`.

use crate::npy_stream::NpyStream;
use crate::sidecar;
use crate::sub_frames::of_sub_frames;
use artifact::Reader;
use artifact::cube::{Cube, CubeHeader};
use artifact::radar::{Multiplexing, Radar, Sampling};
use num_complex::Complex32;
use pipeline::host::failure::Failure;
use pipeline::host::progress;
use serde_json::{Value, json};
use std::io::Error;
use std::path::Path;

/// Writes a cube as a NumPy array `[frame, channel, chirp, sample]`, with axes and unit in its sidecar.
pub fn npy(reader: Reader<Cube>, out: &Path) -> Result<(), Failure> {
    sidecar::claim(out)?;
    let header = reader.header().clone();
    let [channels, chirps, samples] = header.shape();
    let shape = [reader.frames() as usize, channels, chirps, samples];
    let mut times = Vec::new();
    NpyStream::write::<Complex32>(out, &shape, |stream| {
        for frame in progress::frames(reader) {
            let frame = frame.map_err(Error::other)?;
            times.push(frame.time_s);
            stream.append(&frame.samples)?;
        }
        sidecar::remove_outdated(out)
    })?;
    sidecar::write(out, &axes(&header, &times))
}

fn axes(header: &CubeHeader, frame_times_s: &[f64]) -> Value {
    let waveform = &header.radar.waveform;
    let sample_times: Vec<f64> =
        (0..waveform.samples).map(|n| f64::from(n) / waveform.sample_rate_hz).collect();
    json!({
        "shape": ["frame", "channel", "chirp", "sample"],
        "unit": header.unit.name(),
        "full_scale": header.unit.full_scale(),
        "frame_times_s": frame_times_s,
        "sample_times_s": sample_times,
        "times_s": of_sub_frames(header, |header| times_of(&header.radar)),
        "channels": channels(header),
        "start_frequency_hz": waveform.start_frequency_hz,
        "slope_hz_per_s": waveform.slope_hz_per_s,
        "sample_rate_hz": waveform.sample_rate_hz,
        "samples_are_real": waveform.sampling == Sampling::Real,
    })
}

/// Start of each chirp relative to the record's first sample: `[chirp]`, with tdm `[tx][chirp]`, with bpm
/// `[slot][chirp]`.
fn times_of(radar: &Radar) -> Value {
    let of = |turn: usize| -> Vec<f64> {
        (0..radar.waveform.chirps as usize).map(|chirp| radar.chirp_start_s(turn, chirp)).collect()
    };
    match radar.array.multiplexing {
        Multiplexing::Tdm | Multiplexing::Bpm => json!((0..radar.slots()).map(of).collect::<Vec<_>>()),
        Multiplexing::Simultaneous | Multiplexing::Ddm => json!(of(0)),
    }
}

fn channels(header: &CubeHeader) -> Value {
    match header.radar.array.multiplexing {
        Multiplexing::Ddm => receivers(header).collect(),
        Multiplexing::Bpm => (0..header.radar.slots()).flat_map(|_| receivers(header)).collect(),
        Multiplexing::Simultaneous | Multiplexing::Tdm => map_channels(header),
    }
}

/// Channels of the receivers alone: they receive all transmitters, or a code without a transmitter.
fn receivers(header: &CubeHeader) -> impl Iterator<Item = Value> {
    header.radar.array.rx_m.iter().map(|rx| json!({ "tx_m": null, "rx_m": rx }))
}

/// Transmit–receive pairs, channel = tx·N_rx + rx, with bpm followed by codes without a transmitter.
pub(crate) fn map_channels(header: &CubeHeader) -> Value {
    let array = &header.radar.array;
    let pairs =
        array.tx_m.iter().flat_map(|tx| array.rx_m.iter().map(move |rx| json!({ "tx_m": tx, "rx_m": rx })));
    let idle_codes = match array.multiplexing {
        Multiplexing::Bpm => header.radar.slots() - array.tx_m.len(),
        Multiplexing::Simultaneous | Multiplexing::Tdm | Multiplexing::Ddm => 0,
    };
    pairs.chain((0..idle_codes).flat_map(|_| receivers(header))).collect()
}
