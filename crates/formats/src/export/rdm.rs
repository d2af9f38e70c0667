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
        sidecar::leave_only(out, &json!({ MASK: mask_codes() }))
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

/// Refuses to replace a file that is not the mask of the maps in `out`: an array of bytes with three axes and
/// without a sidecar, of which the sidecar of `out` tells. An array itself can carry no mark.
fn keep_what_is_no_mask(place: &Path, out: &Path) -> Result<(), Failure> {
    let name = out.file_name().unwrap_or_default().to_string_lossy();
    let rule = format!("is no mask of {name}, beside which it would be written");
    let is_own = || is_mask(place) && !sidecar::beside(place).exists() && sidecar::has_own(out, MASK);
    files::refuse_unless(place, &rule, is_own)
}

/// Key of the codes of a mask in the sidecar of its maps.
const MASK: &str = "mask";

fn mask_codes() -> serde_json::Value {
    json!({ "0": "untested", "1": "tested", "2": "detected" })
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
        MASK: mask_codes(),
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
        pictures::write_gray(place, [side as usize; 2], &receding_upwards(&grey, side))
    })
}

/// Rows of growing velocity in the order of a picture, which begins at its top.
pub(crate) fn receding_upwards(rows: &[u8], side: u32) -> Vec<u8> {
    rows.chunks(side.max(1) as usize).rev().flatten().copied().collect()
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
    let mut name = out.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{frame:04}"));
    if let Some(kind) = out.extension() {
        name.push(".");
        name.push(kind);
    }
    out.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raw_data::test_cube;
    use artifact::cube::SampleUnit;
    use artifact::{Provenance, Writer};

    /// Maps of one frame in the folder.
    fn maps(folder: &Path) -> PathBuf {
        let (header, file) = (test_cube::header(SampleUnit::RootWatts), folder.join("a.rdm"));
        let [channels, doppler, range] = artifact::rdm::shape(&header);
        let frame = RdmFrame {
            index: 0,
            time_s: 0.0,
            values: vec![Complex32::ONE; channels * doppler * range],
            mask: vec![1; doppler * range],
            detections: 0,
            cells: (doppler * range) as u64,
            assumed_floor: None,
        };
        let mut writer = Writer::<Rdm>::create(&file, &Provenance::default(), &header).unwrap();
        writer.write(&frame).unwrap();
        writer.finish().unwrap();
        file
    }

    #[test]
    fn a_mask_is_replaced_where_the_sidecar_of_its_maps_tells_of_it_and_nowhere_else() {
        let folder = tempfile::tempdir().unwrap();
        let (file, out) = (maps(folder.path()), folder.path().join("x.npy"));
        let places = [out.clone(), mask_beside(&out), sidecar::beside(&out)];
        let export = || {
            let exported = npy(Reader::open(&file).unwrap(), &out);
            files::release(&places);
            exported.map_err(|failure| failure.to_string())
        };
        // Anybody's array of bytes with three axes.
        NpyStream::write::<u8>(&places[1], &[1, 2, 3], |stream| stream.append(&[7; 6])).unwrap();
        files::release(&places);
        let own = std::fs::read(&places[1]).unwrap();
        let refused = export().unwrap_err();
        assert!(refused.contains("x.mask.npy: is no mask of x.npy"), "{refused}");
        assert!(std::fs::read(&places[1]).unwrap() == own && !out.exists());
        std::fs::remove_file(&places[1]).unwrap();
        export().unwrap();
        export().unwrap();
        // As a command leaves it that ends before it writes the mask.
        sidecar::leave_only(&out, &json!({ MASK: mask_codes() })).unwrap();
        export().unwrap();
        std::fs::write(&places[2], json!({ "of": "x.npy" }).to_string()).unwrap();
        assert!(export().unwrap_err().contains("is no mask of x.npy"));
    }
}
