//! Range-Doppler maps as complex64 `[frame, channel, doppler, range]`, as EXR layers and as grey pictures.

use super::{NpyStream, cube::map_channels, fail};
use crate::commands::sidecar;
use crate::failure::Failure;
use crate::output;
use crate::pictures;
use artifact::Reader;
use artifact::cube::CubeHeader;
use artifact::rdm::{Rdm, RdmFrame};
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, Layer, LayerAttributes, SmallVec,
    WritableImage,
};
use num_complex::Complex32;
use serde_json::json;
use std::path::{Path, PathBuf};

pub(crate) fn npy(reader: Reader<Rdm>, out: &Path) -> Result<(), Failure> {
    let mask = mask_beside(out);
    output::claim(&[out.to_owned(), mask.clone(), sidecar::beside(out)])?;
    sidecar::claim(out)?;
    let header = reader.header().clone();
    let [channels, doppler, range] = artifact::rdm::shape(&header);
    let frames = reader.frames() as usize;
    let (mut masks, mut told, mut failed) = (Vec::new(), Vec::new(), None);
    let written = NpyStream::write::<Complex32>(out, &[frames, channels, doppler, range], |stream| {
        for frame in reader {
            let frame = frame.map_err(|e| fail(&mut failed, e))?;
            stream.append(&frame.values)?;
            told.push((frame.time_s, frame.detections, frame.cells));
            masks.extend_from_slice(&frame.mask);
        }
        Ok(())
    });
    failed.map_or(written, |error| Err(error.into()))?;
    NpyStream::write::<u8>(&mask, &[frames, doppler, range], |s| s.append(&masks))?;
    sidecar::write(out, &axes(&header, &told))
}

/// `F.npy` → `F.mask.npy`; a name without that ending keeps all of it.
fn mask_beside(out: &Path) -> PathBuf {
    let is_npy = out.extension().is_some_and(|kind| kind == "npy");
    let mut name = if is_npy { out.with_extension("") } else { out.to_owned() }.into_os_string();
    name.push(".mask.npy");
    PathBuf::from(name)
}

fn axes(header: &CubeHeader, told: &[(f64, u64, u64)]) -> serde_json::Value {
    json!({
        "shape": ["frame", "channel", "doppler", "range"],
        "unit": "sqrt(W)",
        "mask": { "0": "untested", "1": "tested", "2": "detected" },
        "frame_times_s": told.iter().map(|t| t.0).collect::<Vec<_>>(),
        "detections": told.iter().map(|t| t.1).collect::<Vec<_>>(),
        "cells": told.iter().map(|t| t.2).collect::<Vec<_>>(),
        "velocity_mps": velocities(header),
        "range_m": dsp::range_axis_m(header),
        "channels": map_channels(header),
    })
}

/// Of every row; with sub-frames a list of these.
fn velocities(header: &CubeHeader) -> serde_json::Value {
    match header.radar.schedule.sub_frames() {
        1 => json!(dsp::velocity_axis_mps(header)),
        count => (0..count).map(|index| json!(dsp::velocity_axis_mps(&header.in_frame(index)))).collect(),
    }
}

/// One file a frame; a single frame keeps the name that was asked for.
pub(crate) fn exr(reader: Reader<Rdm>, out: &Path) -> Result<(), Failure> {
    each_frame(reader, out, write_exr)
}

/// The paper's grey picture; receding is above, as in all pictures.
pub(crate) fn png(reader: Reader<Rdm>, out: &Path) -> Result<(), Failure> {
    each_frame(reader, out, |header, frame, place| {
        let side = dsp::PAPER_CROP.side;
        let grey = dsp::rdm_grayscale(header, frame).map_err(Failure::refused)?;
        let upwards: Vec<u8> = grey.chunks(side as usize).rev().flatten().copied().collect();
        pictures::write_gray(place, side, side, upwards)
    })
}

/// With axes in metres and m/s and a scale in decibels.
pub(crate) fn png_with_axes(reader: Reader<Rdm>, out: &Path) -> Result<(), Failure> {
    each_frame(reader, out, |header, frame, place| pictures::write_map(place, header, frame))
}

fn each_frame(
    reader: Reader<Rdm>,
    out: &Path,
    write: impl Fn(&CubeHeader, &RdmFrame, &Path) -> Result<(), Failure>,
) -> Result<(), Failure> {
    output::claim(&[out.to_owned()])?; // pictures of several frames are numbered after it
    let (header, single) = (reader.header().clone(), reader.frames() == 1);
    for frame in reader {
        let frame = frame?;
        let place = if single { out.to_owned() } else { numbered(out, frame.index) };
        write(&header, &frame, &place)?;
    }
    Ok(())
}

fn numbered(out: &Path, frame: u32) -> PathBuf {
    let (stem, kind) = (out.file_stem().unwrap_or_default(), out.extension().unwrap_or_default());
    out.with_file_name(format!("{}-{frame:04}.{}", stem.to_string_lossy(), kind.to_string_lossy()))
}

/// Floating-point layer with channels `power` (W, summed over channels), `re`/`im` of channel 0 and `mask`;
/// rows are Doppler cells, columns range cells.
pub(crate) fn write_exr(header: &CubeHeader, frame: &RdmFrame, out: &Path) -> Result<(), Failure> {
    let [_, doppler, range] = artifact::rdm::shape(header);
    let cells = doppler * range;
    let power: Vec<f32> = dsp::power_map(header, frame).map_err(Failure::refused)?.iter().map(|p| *p as f32).collect();
    let first = &frame.values[..cells];
    let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = SmallVec::from_vec(vec![
        AnyChannel::new("im", FlatSamples::F32(first.iter().map(|v| v.im).collect())),
        AnyChannel::new("mask", FlatSamples::F32(frame.mask.iter().map(|m| f32::from(*m)).collect())),
        AnyChannel::new("power", FlatSamples::F32(power)),
        AnyChannel::new("re", FlatSamples::F32(first.iter().map(|v| v.re).collect())),
    ]);
    let attributes = LayerAttributes::named("range-doppler");
    let layer = Layer::new((range, doppler), attributes, Encoding::SMALL_LOSSLESS, AnyChannels::sort(channels));
    let size = exr::math::Vec2(range, doppler);
    let image = Image::empty(ImageAttributes::with_size(size)).with_layer(layer);
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).map_err(|e| Failure::system(out, "encode", e))?;
    output::write_file(out, bytes.get_ref())
}
