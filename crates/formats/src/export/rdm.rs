//! Range-Doppler maps as complex64 `[frame, channel, doppler, range]`, as EXR layers and as grey pictures.

use crate::export::cube::map_channels;
use crate::npy_stream::NpyStream;
use crate::sidecar;
use crate::sub_frames::of_sub_frames;
use artifact::Reader;
use artifact::cube::CubeHeader;
use artifact::rdm::{Rdm, RdmFrame};
use num_complex::Complex32;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::progress;
use reporting::pictures;
use reporting::pictures::rdm_exr;
use serde_json::json;
use std::io::{Error, Read};
use std::path::{Path, PathBuf};

/// Writes the maps as a NumPy array `[frame, channel, doppler, range]`, the detected cells as another, and a
/// sidecar with the axes.
pub fn npy(reader: Reader<Rdm>, out: &Path) -> Result<(), Failure> {
    let mask = mask_beside(out);
    files::claim(&[out.to_owned(), mask.clone(), sidecar::beside(out)])?;
    sidecar::claim(out)?;
    keep_what_is_no_mask(&mask, out)?;
    let header = reader.header().clone();
    let [channels, doppler, range] = artifact::rdm::shape(&header);
    let frames = reader.frames() as usize;
    let (mut masks, mut told) = (Vec::new(), Vec::new());
    NpyStream::write::<Complex32>(out, &[frames, channels, doppler, range], |stream| {
        for frame in progress::frames(reader) {
            let frame = frame.map_err(Error::other)?;
            stream.append(&frame.values)?;
            told.push((frame.time_s, frame.detections, frame.cells));
            masks.extend_from_slice(&frame.mask);
        }
        sidecar::remove_outdated(out)
    })?;
    NpyStream::write::<u8>(&mask, &[frames, doppler, range], |s| s.append(&masks))?;
    sidecar::write(out, &axes(&header, &told))
}

/// `F.npy` → `F.mask.npy`; another ending is kept as part of the name.
fn mask_beside(out: &Path) -> PathBuf {
    let is_npy = out.extension().is_some_and(|kind| kind == "npy");
    let mut name = if is_npy { out.with_extension("") } else { out.to_owned() }.into_os_string();
    name.push(".mask.npy");
    PathBuf::from(name)
}

/// Refuses to replace a file that is not a mask of maps, i.e. an array of bytes with three axes and without a
/// sidecar.
fn keep_what_is_no_mask(place: &Path, out: &Path) -> Result<(), Failure> {
    let name = out.file_name().unwrap_or_default().to_string_lossy();
    let rule = format!("is no mask of {name}, beside which it would be written");
    files::refuse_unless(place, &rule, || is_mask(place) && !sidecar::beside(place).exists())
}

/// Whether the head of a file is that of a mask written here.
fn is_mask(file: &Path) -> bool {
    let mut head = Vec::new();
    let read = std::fs::File::open(file).and_then(|file| file.take(128).read_to_end(&mut head));
    let head = String::from_utf8_lossy(&head);
    let shape = || Some(head.split_once("'shape': (")?.1.split_once(')')?.0);
    let axes = || shape().map(|shape| shape.split_terminator(", ").count());
    read.is_ok() && head.contains("'descr': '|u1'") && axes() == Some(3)
}

fn axes(header: &CubeHeader, told: &[(f64, u64, u64)]) -> serde_json::Value {
    json!({
        "shape": ["frame", "channel", "doppler", "range"],
        "unit": header.unit.name(),
        "full_scale": header.unit.full_scale(),
        "mask": { "0": "untested", "1": "tested", "2": "detected" },
        "frame_times_s": told.iter().map(|t| t.0).collect::<Vec<_>>(),
        "detections": told.iter().map(|t| t.1).collect::<Vec<_>>(),
        "cells": told.iter().map(|t| t.2).collect::<Vec<_>>(),
        "velocity_mps": of_sub_frames(header, |header| json!(dsp::velocity_axis_mps(header))),
        "range_m": dsp::range_axis_m(header),
        "channels": map_channels(header),
    })
}

/// Writes one file per frame; a single frame keeps the requested name.
pub fn exr(reader: Reader<Rdm>, out: &Path) -> Result<(), Failure> {
    each_frame(reader, out, rdm_exr)
}

/// Writes the paper's grey picture; receding is at the top, as in all pictures.
pub fn png(reader: Reader<Rdm>, out: &Path) -> Result<(), Failure> {
    each_frame(reader, out, |header, frame, place| {
        let side = dsp::PAPER_CROP.side;
        let grey = dsp::rdm_grayscale(header, frame).map_err(Failure::refused)?;
        let upwards: Vec<u8> = grey.chunks(side as usize).rev().flatten().copied().collect();
        pictures::write_gray(place, [side as usize; 2], &upwards)
    })
}

/// Writes a picture of each frame, with axes in metres and m/s and a scale in decibels.
pub fn png_with_axes(reader: Reader<Rdm>, out: &Path) -> Result<(), Failure> {
    each_frame(reader, out, |header, frame, place| pictures::write_map(place, header, frame))
}

fn each_frame(
    reader: Reader<Rdm>,
    out: &Path,
    write: impl Fn(&CubeHeader, &RdmFrame, &Path) -> Result<(), Failure>,
) -> Result<(), Failure> {
    files::claim(&[out.to_owned()])?; // pictures of several frames add numbers to it
    let (header, single) = (reader.header().clone(), reader.frames() == 1);
    if !single {
        (0..reader.frames()).try_for_each(|index| {
            files::refuse_foreign_head(&numbered(out, index as u32), pictures::is_own)
        })?;
    }
    for frame in progress::frames(reader) {
        let frame = frame?;
        let place = if single { out.to_owned() } else { numbered(out, frame.index) };
        write(&header, &frame, &place)?;
    }
    Ok(())
}

fn numbered(out: &Path, frame: u32) -> PathBuf {
    let stem = out.file_stem().unwrap_or_default().to_string_lossy();
    let kind = out.extension().map(|kind| format!(".{}", kind.to_string_lossy())).unwrap_or_default();
    out.with_file_name(format!("{stem}-{frame:04}{kind}"))
}
