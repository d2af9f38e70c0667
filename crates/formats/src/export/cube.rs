//! Radar cubes as complex64 `[frame, channel, chirp, sample]`.

use crate::npy_stream::NpyStream;
use crate::raw_data::arrays;
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
        "shape": arrays::AXES,
        "unit": header.unit.name(),
        "full_scale": header.unit.full_scale(),
        arrays::FRAME_TIMES: frame_times_s,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raw_data::test_cube::{UNITS, header, steeper, write};
    use crate::raw_data::{ImportedFrames, IntegerStep};
    use artifact::cube::SampleUnit;
    use std::path::PathBuf;

    #[test]
    fn an_array_comes_back_in_the_unit_of_its_sidecar_for_the_radar_of_its_sidecar_alone() {
        for unit in UNITS {
            let folder = tempfile::tempdir().unwrap();
            let (header, out) = (header(unit), folder.path().join("x.npy"));
            npy(Reader::open(&write(folder.path(), &header)).unwrap(), &out).unwrap();
            let (place, files) = (sidecar::beside(&out), [out.clone()]);
            let ImportedFrames { frames, step, descriptions } = arrays::read(&files, &header).unwrap();
            assert_eq!((frames.len(), step), (1, IntegerStep::DescribedFloats(unit, place.clone())));
            assert_eq!(
                (descriptions, arrays::descriptions(&files)),
                (vec![place.clone()], vec![place.clone()])
            );
            let refused = arrays::read(&files, &steeper(&header)).err().unwrap().to_string();
            assert!(refused.contains("x.npy.json: slope_hz_per_s is 12500000000000.0, "), "{refused}");
            // Of an array with another number of frames.
            let mut told = sidecar::read(&place).unwrap();
            told["frame_times_s"] = json!([0.0, 0.1]);
            std::fs::write(&place, told.to_string()).unwrap();
            assert_eq!(arrays::read(&files, &header).unwrap().step, IntegerStep::Floats);
        }
    }

    #[test]
    fn arrays_of_one_folder_in_several_units_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let export = |(number, unit): (usize, &SampleUnit)| {
            let (own, out) = (tempfile::tempdir().unwrap(), folder.path().join(format!("{number}.npy")));
            npy(Reader::open(&write(own.path(), &header(*unit))).unwrap(), &out).unwrap();
            out
        };
        let files: Vec<PathBuf> = UNITS.iter().enumerate().map(export).collect();
        let read =
            |files: &[PathBuf]| arrays::read(files, &header(UNITS[0])).map_err(|failure| failure.to_string());
        assert_eq!(read(&[files[1].clone(), files[1].clone()]).unwrap().descriptions.len(), 2);
        let refused = read(&files[..2]).err().unwrap();
        assert!(refused.ends_with("samples are in ADC steps, those of the first file in its folder in √W"));
        std::fs::remove_file(sidecar::beside(&files[2])).unwrap();
        let refused = read(&files[1..]).err().unwrap();
        assert!(
            refused.contains("samples are in a unit that no file gives, those of the first"),
            "{refused}"
        );
    }
}
