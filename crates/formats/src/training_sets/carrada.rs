//! CARRADA (Ouaknine et al. 2020): range–Doppler and range–angle maps with annotations by frame.
//!
//! Layout as in the dataset's public code: `SEQUENCE/range_doppler_numpy/NNNNNN.npy` `[range, Doppler]`, near
//! first; `SEQUENCE/range_angle_numpy/NNNNNN.npy` `[range, angle]`, far first;
//! `annotations_frame_oriented.json`: sequence, frame, instance, then for each map `box` (two corners [row,
//! column]), `sparse` and `dense` (cells) and `label`.

use crate::azimuth_row::sines;
use crate::npy_stream::NpyStream;
use crate::safe_file_name::safe_file_name;
use crate::sub_frames::of_sub_frames;
use crate::training_sets::angle_spectrum::{AngleSpectrum, Tensor};
use crate::training_sets::cell_boxes::{CellBox, cell_box};
use crate::training_sets::set_folder::SetFolder;
use crate::training_sets::truth_boxes::{TruthBox, TruthBoxes};
use artifact::cube::CubeHeader;
use artifact::rdm::{Rdm, RdmFrame};
use artifact::settings::Class;
use artifact::{Radar, Reader, units};
use pipeline::host::failure::Failure;
use pipeline::host::files;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{Error, Write};
use std::path::Path;

/// Name of the sequence if no scene names one.
const SEQUENCE: &str = "sequence";

/// Writes the maps of a run as one sequence, labelled if a scene is given.
pub fn write(reader: Reader<Rdm>, scene: Option<&Path>, out: &Path) -> Result<(), Failure> {
    let header = reader.header().clone();
    let from = &reader.preamble().provenance;
    let mut truth = scene.map(|file| TruthBoxes::open(file, Some(&header.radar), from)).transpose()?;
    let name = truth.as_ref().map_or(SEQUENCE.to_owned(), |truth| safe_file_name(&truth.header().name));
    AngleSpectrum::of(&header.in_frame(0))?; // refuses radars without tensors before the work
    let mut set = SetFolder::begin(out)?;
    let mut times_s = Vec::new();
    let frames = set.each_frame(
        reader,
        |map| map.index,
        |set, map| {
            let header = header.in_frame(map.index);
            let tensor = AngleSpectrum::of(&header)?.tensor(&map);
            times_s.push((map.index, map.time_s));
            write_maps(set, &name, (&header, &map), &tensor)
        },
    )?;
    if let Some(truth) = &mut truth {
        let annotations = times_s.iter().map(|(index, time_s)| {
            let bodies = truth.of_frame(*index, *time_s)?;
            Ok((format!("{index:06}"), of_frame(&header.in_frame(*index).radar, &bodies)))
        });
        write_annotations(&set.place("annotations_frame_oriented.json"), &name, annotations)?;
    }
    let mut told = description(&header, frames);
    told["labelled"] = truth.is_some().into();
    set.finish(&told)
}

/// Writes the annotations frame by frame: all cells of all boxes are megabytes a frame.
fn write_annotations(
    place: &Path,
    name: &str,
    frames: impl Iterator<Item = Result<(String, Value), Failure>>,
) -> Result<(), Failure> {
    files::write_with(place, |stream| {
        write!(stream, "{{{}:{{", json!(name))?;
        for (number, frame) in frames.enumerate() {
            let (frame, of_frame) = frame.map_err(Error::other)?;
            write!(stream, "{}{}:{of_frame}", if number > 0 { ",\n" } else { "\n" }, json!(frame))?;
        }
        write!(stream, "\n}}}}\n")
    })
}

fn write_maps(
    set: &SetFolder,
    name: &str,
    (header, map): (&CubeHeader, &RdmFrame),
    tensor: &Tensor,
) -> Result<(), Failure> {
    let [ranges, azimuths, doppler] = tensor.shape;
    let channels = map.values.len() / (ranges * doppler).max(1);
    let level = |power: f64, channels| header.map_level_db(power, channels) as f32;
    let power = |range: usize, row: usize| -> f64 {
        let value = |channel: usize| map.values[(channel * doppler + row) * ranges + range];
        (0..channels).map(|channel| units::power(value(channel))).sum()
    };
    let of_range = |range| (0..doppler).map(move |row| level(power(range, row), channels));
    let range_doppler: Vec<f32> = (0..ranges).flat_map(of_range).collect();
    let strongest =
        |cells: &[num_complex::Complex32]| cells.iter().copied().map(units::power).fold(0.0, f64::max);
    let of_angles = tensor.by_range.iter().rev().flat_map(|cells| cells.chunks(doppler));
    let range_angle: Vec<f32> = of_angles.map(|cells| level(strongest(cells), channels)).collect();
    for (folder, columns, values) in
        [("range_doppler_numpy", doppler, range_doppler), ("range_angle_numpy", azimuths, range_angle)]
    {
        let place = set.place(&format!("{name}/{folder}/{:06}.npy", map.index));
        NpyStream::write::<f32>(&place, &[ranges, columns], |stream| stream.append(&values))?;
    }
    Ok(())
}

/// Annotations of a frame, one entry for each body within the maps.
fn of_frame(radar: &Radar, bodies: &[TruthBox]) -> Value {
    let ranges = radar.waveform.range_cells() as f64;
    let seen = bodies.iter().filter_map(|body| Some((body, cell_box(radar, body)?)));
    let entries = seen.map(|(body, CellBox { range, azimuth, doppler })| {
        let far_first = [ranges - 1.0 - range[1], ranges - 1.0 - range[0]];
        let of = |columns| annotation(range, columns, body.class);
        let angles = annotation(far_first, azimuth, body.class);
        (format!("{:06}", body.number), json!({ "range_doppler": of(doppler), "range_angle": angles }))
    });
    Value::Object(entries.collect())
}

/// A box and its cells; the only sparse point is its middle.
fn annotation(rows: [f64; 2], columns: [f64; 2], class: Class) -> Value {
    let cells = |[low, high]: [f64; 2]| [low.floor() as u32, high.ceil() as u32];
    let (rows, columns) = (cells(rows), cells(columns));
    let dense =
        (rows[0]..=rows[1]).flat_map(|row| (columns[0]..=columns[1]).map(move |column| [row, column]));
    json!({
        "box": [[rows[0], columns[0]], [rows[1], columns[1]]],
        "sparse": [[rows[0].midpoint(rows[1]), columns[0].midpoint(columns[1])]],
        "dense": dense.collect::<Vec<_>>(),
        "label": label(class),
    })
}

/// Label of a class: 1 and 2 are the dataset's pedestrians and cyclists; those after its cars are ours.
fn label(class: Class) -> u8 {
    match class {
        Class::Car => 3,
        Class::Bus => 4,
        Class::Truck => 5,
        Class::Motorcycle => 6,
    }
}

fn description(header: &CubeHeader, frames: usize) -> Value {
    json!({
        "set": "CARRADA", "frames": frames, "unit": header.unit.level_unit(),
        "axes": {
            "range_m": dsp::range_axis_m(header), "azimuth_sine": sines(),
            "velocity_mps": of_sub_frames(header, |header| json!(dsp::velocity_axis_mps(header))),
        },
        "labels": Class::ALL.iter().map(|class| (class.name(), label(*class))).collect::<BTreeMap<_, _>>(),
        "not_filled": ["camera_images", "data_seq_ref.json", "angle_doppler_processed"],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::training_sets::test_body::sub_framed;

    #[test]
    fn sub_frames_have_each_its_own_velocities() {
        let header = sub_framed();
        let told = &description(&header, 2)["axes"]["velocity_mps"];
        let axes: Vec<Vec<f64>> = serde_json::from_value(told.clone()).unwrap();
        assert_eq!(axes, [0, 1].map(|index| dsp::velocity_axis_mps(&header.in_frame(index))));
        assert!(axes[0][0] < 1.9 * axes[1][0], "{axes:?}");
    }

    #[test]
    fn an_annotation_has_the_corners_the_middle_and_all_cells_of_its_box() {
        let told = annotation([3.2, 4.1], [7.0, 8.0], Class::Car);
        assert_eq!(told["box"], json!([[3, 7], [5, 8]]));
        assert_eq!(told["sparse"], json!([[4, 7]]));
        assert_eq!(told["dense"].as_array().unwrap().len(), 6);
        assert_eq!(told["label"], 3);
    }
}
