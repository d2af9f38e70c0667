//! Raw data of the University of Washington (Gao et al. 2022): a frame's samples and its labels.
//!
//! Layout as in the dataset's public description: `radar_raw_frame/NNNNNN.mat` with `adcData` `[sample,
//! chirp, receiver, transmitter]`, `text_labels/NNNNNN.csv` with rows `uid,class,px,py,wid,len`, m, x to the
//! right and y ahead of the radar.

use crate::levelled_axes::LevelledAxes;
use crate::mat_file;
use crate::raw_data::uwcr::{ARRAY, RADAR, SET, WAVEFORM, shape};
use crate::sub_frames::of_sub_frames;
use crate::training_sets::set_folder::SetFolder;
use crate::training_sets::truth_boxes::{TruthBox, TruthBoxes};
use artifact::Reader;
use artifact::cube::{Cube, CubeHeader};
use artifact::settings::Class;
use pipeline::host::failure::Failure;
use serde_json::json;
use std::path::Path;

/// Writes the cubes of a run, labelled if a scene is given.
pub fn write(reader: Reader<Cube>, scene: Option<&Path>, out: &Path) -> Result<(), Failure> {
    let header = reader.header().clone();
    let from = &reader.preamble().provenance;
    let mut truth = scene.map(|file| TruthBoxes::open(file, Some(&header.radar), from)).transpose()?;
    let mut set = SetFolder::begin(out)?;
    let axes = LevelledAxes::of(&header.radar);
    let frames = set.each_frame(
        reader,
        |frame| frame.index,
        |set, frame| {
            let shape = shape(&header);
            let array = mat_file::ComplexArray { name: ARRAY, shape, values: &frame.samples };
            set.write(&format!("radar_raw_frame/{:06}.mat", frame.index), &array.to_bytes())?;
            if let Some(truth) = &mut truth {
                let rows: String = truth
                    .of_frame(frame.index, frame.time_s)?
                    .iter()
                    .filter_map(|body| row(&axes, body))
                    .collect();
                set.write(&format!("text_labels/{:06}.csv", frame.index), rows.as_bytes())?;
            }
            Ok(())
        },
    )?;
    let mut told = description(&header, frames);
    told["labelled"] = truth.is_some().into();
    set.finish(&told)
}

/// A line of labels; none for a body behind the radar.
fn row(axes: &LevelledAxes, body: &TruthBox) -> Option<String> {
    let middle = axes.of_world(body.middle_m());
    let corners = body.corners_m().map(|corner| axes.of_world(corner));
    let extent = |along: fn(&glam::DVec3) -> f64| {
        let values = corners.iter().map(along);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    };
    let (width, length) = (extent(|corner| corner.y), extent(|corner| corner.x));
    let (number, class) = (body.number, class_id(body.class));
    (middle.x > 0.0)
        .then(|| format!("{number},{class},{:.4},{:.4},{width:.4},{length:.4}\n", -middle.y, middle.x))
}

/// Numbers of the dataset's classes.
fn class_id(class: Class) -> u8 {
    match class {
        Class::Car => 2,
        Class::Motorcycle => 3,
        Class::Bus => 5,
        Class::Truck => 7,
    }
}

fn interval_us(header: &CubeHeader) -> serde_json::Value {
    (header.radar.waveform.chirp_interval_s * 1e6).into()
}

fn description(header: &CubeHeader, frames: usize) -> serde_json::Value {
    let waveform = &header.radar.waveform;
    json!({
        "set": SET, "frames": frames, "array": ARRAY, "shape": shape(header),
        "axes": ["sample", "chirp", "receiver", "transmitter"],
        "unit": header.unit.name(), "full_scale": header.unit.full_scale(),
        RADAR: {
            WAVEFORM.start_frequency.name: waveform.start_frequency_hz / WAVEFORM.start_frequency.unit,
            WAVEFORM.slope.name: waveform.slope_hz_per_s / WAVEFORM.slope.unit,
            "chirpDuration_usec": of_sub_frames(header, interval_us),
            "numAdcSamples": waveform.samples,
            WAVEFORM.sample_rate.name: waveform.sample_rate_hz / WAVEFORM.sample_rate.unit,
            "numLoops": waveform.chirps,
        },
        "not_filled": ["images_0"],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raw_data::{self, IntegerStep, test_cube};
    use crate::training_sets::test_body::{bus, sub_framed};
    use radar::{aperture::Preset, paper};

    #[test]
    fn sub_frames_have_each_its_own_interval() {
        let told = &description(&sub_framed(), 2)["radar_configs"]["chirpDuration_usec"];
        assert_eq!(
            told.as_array().unwrap().iter().map(|us| us.as_f64().unwrap().round()).collect::<Vec<_>>(),
            [20.0, 40.0]
        );
    }

    #[test]
    fn frames_come_back_in_the_unit_of_the_set_for_the_radar_of_the_set_alone() {
        for unit in test_cube::UNITS {
            let folder = tempfile::tempdir().unwrap();
            let (header, out) = (test_cube::header(unit), folder.path().join("set"));
            write(Reader::open(&test_cube::write(folder.path(), &header)).unwrap(), None, &out).unwrap();
            let files = [out.join("radar_raw_frame/000000.mat")];
            let imported = raw_data::uwcr::read(&files, &header).unwrap();
            assert!(matches!(imported.step, IntegerStep::DescribedFloats(told, _) if told == unit));
            assert_eq!(imported.descriptions, raw_data::uwcr::descriptions(&files));
            let refused = raw_data::uwcr::read(&files, &test_cube::steeper(&header)).err().unwrap();
            let told = "set.json: freqSlopeConst_MHz_usec is 12.5, the scene's radar has 25.0";
            assert!(refused.to_string().ends_with(told), "{refused}");
            // Of another program's set with this layout.
            std::fs::write(out.join("set.json"), "{\"unit\": \"ADC steps\"}").unwrap();
            let imported = raw_data::uwcr::read(&files, &header).unwrap();
            assert_eq!((imported.step, imported.descriptions), (IntegerStep::Floats, vec![]));
        }
    }

    #[test]
    fn a_label_tells_right_ahead_and_the_sides_along_both() {
        let radar = paper::radar([0.0, 0.0, 6.0], paper::waveform(16, 8), Preset::OneByFour.elements());
        let axes = LevelledAxes::of(&radar);
        assert_eq!(row(&axes, &bus()).unwrap(), "3,5,2.0000,50.0000,2.5000,12.0000\n");
        let behind = TruthBox { foot_m: glam::DVec3::new(0.0, -5.0, 0.0), ..bus() };
        assert_eq!(row(&axes, &behind), None);
    }
}
