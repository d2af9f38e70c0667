//! RADDet (Zhang, Nowruzi, Laganiere 2021): one range–azimuth–Doppler tensor per frame, and boxes in its
//! cells.
//!
//! Layout as in the dataset's public description, axes as in its loaders: `RAD/PART/NNNNNN.npy`, complex64
//! `[range, azimuth, Doppler]`, the farthest range first; `gt/PART/NNNNNN.pickle` with `classes`, `boxes`
//! (middle and size along the tensor's axes, cells) and `cart_boxes` (middle and size in rows and columns of
//! a map of the ground with as many rows as range cells and twice as many columns, the radar below its
//! middle).

use crate::azimuth_row::sines;
use crate::npy_stream::NpyStream;
use crate::sub_frames::of_sub_frames;
use crate::training_sets::angle_spectrum::{AngleSpectrum, Tensor};
use crate::training_sets::cell_boxes::{CellBox, cell_box};
use crate::training_sets::pickle::{PickleValue, dictionary};
use crate::training_sets::set_folder::SetFolder;
use crate::training_sets::truth_boxes::{TruthBox, TruthBoxes};
use artifact::cube::CubeHeader;
use artifact::rdm::Rdm;
use artifact::{Radar, Reader, units};
use glam::{DVec2, DVec3};
use num_complex::Complex32;
use pipeline::host::failure::Failure;
use serde_json::json;
use std::path::Path;

/// Median power of the first frame's cells after scaling: that of the noise in RADDet's own tensors, whose
/// loaders take log₁₀(|x|² + 1).
const MEDIAN_POWER: f32 = 1000.0;

/// Writes the maps of a run as one part of the dataset, labelled if a scene is given.
pub fn write(reader: Reader<Rdm>, scene: Option<&Path>, out: &Path) -> Result<(), Failure> {
    let header = reader.header().clone();
    let from = &reader.preamble().provenance;
    let mut truth = scene.map(|file| TruthBoxes::open(file, Some(&header.radar), from)).transpose()?;
    AngleSpectrum::of(&header.in_frame(0))?; // refuses radars without tensors before the work
    let mut set = SetFolder::begin(out)?;
    let mut scale = None;
    let frames = set.each_frame(
        reader,
        |map| map.index,
        |set, map| {
            let header = header.in_frame(map.index);
            let mut tensor = AngleSpectrum::of(&header)?.tensor(&map);
            let scale = *scale.get_or_insert_with(|| scale_of(tensor.by_range.iter().flatten()));
            tensor.by_range.iter_mut().flatten().for_each(|value| *value *= scale);
            write_tensor(set, map.index, &tensor)?;
            if let Some(truth) = &mut truth {
                let ground_truth = ground_truth(&header.radar, &truth.of_frame(map.index, map.time_s)?);
                set.write(&format!("gt/part1/{:06}.pickle", map.index), &ground_truth)?;
            }
            Ok(())
        },
    )?;
    let mut told = description(&header, frames, scale);
    told["labelled"] = truth.is_some().into();
    set.finish(&told)
}

fn write_tensor(set: &SetFolder, index: u32, tensor: &Tensor) -> Result<(), Failure> {
    NpyStream::write::<Complex32>(&set.place(&format!("RAD/part1/{index:06}.npy")), &tensor.shape, |stream| {
        tensor.by_range.iter().rev().try_for_each(|of_range| stream.append(of_range))
    })
}

/// Factor that scales the cells of a frame to the median power; 1 if that is zero.
fn scale_of<'a>(values: impl Iterator<Item = &'a Complex32>) -> f32 {
    let mut powers: Vec<f64> = values.copied().map(units::power).collect();
    if powers.is_empty() {
        return 1.0;
    }
    let middle = powers.len() / 2;
    let (_, median, _) = powers.select_nth_unstable_by(middle, f64::total_cmp);
    let scale = (f64::from(MEDIAN_POWER) / *median).sqrt() as f32;
    if *median > 0.0 && scale.is_finite() { scale } else { 1.0 }
}

fn ground_truth(radar: &Radar, bodies: &[TruthBox]) -> Vec<u8> {
    let seen: Vec<(&TruthBox, CellBox)> =
        bodies.iter().filter_map(|body| Some((body, cell_box(radar, body)?))).collect();
    let ranges = radar.waveform.range_cells() as f64;
    let classes = seen.iter().map(|(body, _)| body.class.name().to_owned()).collect();
    let boxes = seen.iter().map(|(_, cells)| polar_box(*cells, ranges)).collect();
    let on_ground = seen.iter().map(|(body, _)| ground_box(radar, body)).collect();
    dictionary(&[
        ("classes", PickleValue::Words(classes)),
        ("boxes", PickleValue::Rows(boxes)),
        ("cart_boxes", PickleValue::Rows(on_ground)),
    ])
}

/// Middle and size along range (from far to near), azimuth and Doppler.
fn polar_box(cells: CellBox, ranges: f64) -> Vec<f64> {
    let far_first = [ranges - 1.0 - cells.range[1], ranges - 1.0 - cells.range[0]];
    let axes = [far_first, cells.azimuth, cells.doppler];
    let middles = axes.map(|[low, high]| 0.5 * (low + high));
    let sizes = axes.map(|[low, high]| high - low);
    [middles, sizes].concat()
}

/// Middle row and column, rows and columns on the map of the ground.
fn ground_box(radar: &Radar, body: &TruthBox) -> Vec<f64> {
    let [right, ahead, _] = radar::aperture::axes(radar);
    let forward = ahead.truncate().normalize_or_zero();
    let places = body.corners_m().map(|corner| {
        let away = (corner - DVec3::from(radar.position_m)).truncate();
        DVec2::new(right.truncate().dot(away), forward.dot(away))
    });
    let resolution_m = radar.waveform.range_resolution_m();
    let ranges = radar.waveform.range_cells() as f64;
    let corner = |pick: fn(DVec2, DVec2) -> DVec2| places.into_iter().reduce(pick).unwrap_or(DVec2::ZERO);
    let [low, high] = [corner(DVec2::min), corner(DVec2::max)].map(|corner| corner / resolution_m);
    let middle = 0.5 * (low + high);
    vec![ranges - 1.0 - middle.y, middle.x + ranges - 1.0, high.y - low.y, high.x - low.x]
}

fn description(header: &CubeHeader, frames: usize, scale: Option<f32>) -> serde_json::Value {
    let mut ranges_m = dsp::range_axis_m(header);
    ranges_m.reverse();
    json!({
        "set": "RADDet", "frames": frames,
        "axes": {
            "range_m": ranges_m, "azimuth_sine": sines(),
            "velocity_mps": of_sub_frames(header, |header| json!(dsp::velocity_axis_mps(header))),
        },
        "unit": header.unit.name(), "scale": scale,
        "not_filled": ["stereo_image", "sensors_para"],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::training_sets::test_body::{bus, sub_framed};
    use radar::{aperture::Preset, paper};

    #[test]
    fn sub_frames_have_each_its_own_velocities() {
        let header = sub_framed();
        let told = &description(&header, 2, None)["axes"]["velocity_mps"];
        let axes: Vec<Vec<f64>> = serde_json::from_value(told.clone()).unwrap();
        assert_eq!(axes, [0, 1].map(|index| dsp::velocity_axis_mps(&header.in_frame(index))));
        assert!(axes[0][0] < 1.9 * axes[1][0], "{axes:?}");
    }

    #[test]
    fn cells_of_noise_have_the_power_that_raddet_s_have() {
        let values: Vec<Complex32> = (1..100).map(|i| Complex32::new(i as f32 * 1e-9, 0.0)).collect();
        let scaled = values[49] * scale_of(values.iter());
        assert!((scaled.norm_sqr() - MEDIAN_POWER).abs() < 1e-2);
        assert_eq!((scale_of([].iter()), scale_of([Complex32::ZERO].iter())), (1.0, 1.0));
    }

    #[test]
    fn the_farthest_range_is_the_first_row_of_tensors_and_of_the_ground() {
        let radar = paper::radar([0.0; 3], paper::waveform(256, 128), Preset::ThreeByFour.elements());
        let cells = CellBox { range: [10.0, 20.0], azimuth: [100.0, 110.0], doppler: [3.0, 4.0] };
        assert_eq!(polar_box(cells, 256.0), [240.0, 105.0, 3.5, 10.0, 10.0, 1.0]);
        // The bus is 12 m long along the columns of ranges, its middle 50 m ahead and 2 m to the right.
        let resolution_m = radar.waveform.range_resolution_m();
        let expected = [255.0 - 50.0 / resolution_m, 255.0 + 2.0 / resolution_m];
        let found = ground_box(&radar, &bus());
        assert!((found[0] - expected[0]).abs() < 1e-9 && (found[1] - expected[1]).abs() < 1e-9, "{found:?}");
        assert!(
            (found[2] * resolution_m - 12.0).abs() < 1e-9 && (found[3] * resolution_m - 2.5).abs() < 1e-9
        );
    }
}
