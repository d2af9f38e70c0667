//! Labels of KITTI's object benchmark (Geiger et al. 2012) and of View-of-Delft (Palffy et al. 2022).
//!
//! `label_2/NAME.txt` has a label a line: class, truncation, occlusion, angle of observation, box in the
//! picture, height, width, length, x, y, z of the middle of the lower face and the rotation about y, in the
//! axes of a camera (x right, y down, z ahead). `calib/NAME.txt` relates these to the sensor's:
//! camera = R0_rect·Tr_velo_to_cam·sensor. View-of-Delft tells bodies apart by whole numbers in place of the
//! truncation, where it tells them.

use crate::radar_cloud::import::{extension, frames_of};
use crate::training_sets::labels::frame_names::{FrameNames, name_of};
use crate::training_sets::labels::label_collector::{Label, LabelCollector};
use crate::training_sets::labels::label_error::LabelError;
use crate::training_sets::labels::sensor_box::SensorBox;
use artifact::bounded;
use evaluation::LabelledBox;
use glam::{DMat3, DVec3};
use pipeline::host::failure::Failure;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Largest file of labels or of a calibration, bytes.
const LIMIT_BYTES: u64 = 1 << 20;

/// Classes without bodies to be found: regions without labels, things that are no road users, and riders,
/// whose bicycles and mopeds have labels of their own.
const LEFT_OUT: [&str; 7] =
    ["DontCare", "Misc", "bicycle", "bicycle_rack", "human_depiction", "ride_uncertain", "rider"];

/// Names of a label's columns.
const COLUMNS: &str =
    "class truncation occlusion angle left top right bottom height width length x y z rotation score";

/// Largest deviation of a calibration's axes from unit length and right angles.
const ROTATION_TOLERANCE: f64 = 1e-3;

/// Bodies of each frame that has a file of labels in the folder `place`, or of the one that `place` is.
///
/// # Errors
/// A file cannot be read, or there are labels of other frames or of other formats.
pub(super) fn frames(
    place: &Path,
    names: &FrameNames,
    reading: &mut LabelCollector,
) -> Result<Vec<Option<Vec<LabelledBox>>>, Failure> {
    let files: BTreeMap<String, PathBuf> =
        files(place)?.into_iter().map(|file| (name_of(&file), file)).collect();
    let files = names.matched(place, &files)?;
    files.into_iter().map(|file| file.map(|file| bodies(file, reading)).transpose()).collect()
}

/// Files of labels, none of which is in another format.
fn files(place: &Path) -> Result<Vec<PathBuf>, Failure> {
    let is_pickle = |file: &PathBuf| extension(file).is_some_and(|ending| PICKLES.contains(&ending));
    let refused = |rule: &str| Err(Failure::Refused(format!("{}: {rule}", place.display())));
    if frames_of(place, &PICKLES).is_ok_and(|files| files.iter().any(is_pickle)) {
        return refused("labels in Python's pickles are not read: a pickle is a program");
    }
    let files = frames_of(place, &["txt"])?;
    match files.iter().all(|file| extension(file) == Some("txt")) {
        true => Ok(files),
        false => refused("read are labels of KITTI (label_2, .txt) and the folder of nuScenes' tables"),
    }
}

/// Endings of Python's pickles.
const PICKLES: [&str; 2] = ["pickle", "pkl"];

/// Bodies of a file of labels.
fn bodies(file: &Path, reading: &mut LabelCollector) -> Result<Vec<LabelledBox>, Failure> {
    let (text, calibration) = (text_of(file)?, calibration_of(file)?);
    let camera = Camera::of(&text_of(&calibration)?);
    let camera = camera.map_err(|error| reading.fault(calibration.display(), &error)).ok();
    let mut labels = vec![];
    for (number, text) in (1..).zip(text.lines()).filter(|(_, text)| !text.trim().is_empty()) {
        let place = format!("{}:{number}", file.display());
        match Line::of(text) {
            Ok(line) if LEFT_OUT.contains(&line.class) => reading.leave_out(line.class),
            Ok(line) => labels.extend(camera.as_ref().map(|camera| line.label(place, camera))),
            Err(error) => reading.fault(place, &error),
        }
    }
    Ok(reading.frame(file.display(), &labels))
}

fn text_of(file: &Path) -> Result<String, Failure> {
    bounded::read_text(file, LIMIT_BYTES).map_err(|fault| Failure::unread(file, &fault))
}

/// Place of the calibration of a file of labels. Links stay: a folder of labels may be one to that of another
/// sensor, whose calibration is another.
fn calibration_of(file: &Path) -> Result<PathBuf, Failure> {
    let whole = std::path::absolute(file).map_err(|error| Failure::system(file, "be found", error))?;
    let labels = whole.parent().unwrap_or(&whole);
    Ok(labels.with_file_name("calib").join(whole.file_name().unwrap_or_default()))
}

/// A label in the camera's axes.
struct Line<'a> {
    class: &'a str,
    /// Number of the body, where the second column is a whole number.
    number: Option<u32>,
    /// Height, width, length, x, y, z, rotation.
    numbers: [f64; 7],
}

impl<'a> Line<'a> {
    fn of(text: &'a str) -> Result<Self, LabelError> {
        let words: Vec<&str> = text.split_whitespace().collect();
        if !(15..=16).contains(&words.len()) {
            return Err(LabelError::Columns(words.len()));
        }
        let numbers = words.iter().zip(COLUMNS.split(' ')).skip(1).map(|(word, column)| number(word, column));
        let numbers = numbers.collect::<Result<Vec<f64>, LabelError>>()?;
        let number = words[1].parse().ok();
        Ok(Self { class: words[0], number, numbers: std::array::from_fn(|at| numbers[7 + at]) })
    }

    fn label(&self, place: String, camera: &Camera) -> Label {
        let [height, width, length, x, y, z, rotation] = self.numbers;
        let (sine, cosine) = rotation.sin_cos();
        let seen = SensorBox {
            middle_m: camera.sensor_from_camera * (DVec3::new(x, y - 0.5 * height, z) - camera.shift_m),
            size_m: [length, width, height],
            front: camera.sensor_from_camera * DVec3::new(cosine, 0.0, -sine),
        };
        Label { place, number: self.number, seen }
    }
}

fn number(word: &str, column: &'static str) -> Result<f64, LabelError> {
    let number: Option<f64> = word.parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| LabelError::NoNumber { column, word: word.to_owned() })
}

/// The rectified camera of a calibration.
struct Camera {
    sensor_from_camera: DMat3,
    /// The sensor's place in the camera's axes, m.
    shift_m: DVec3,
}

impl Camera {
    fn of(text: &str) -> Result<Self, LabelError> {
        let rectification = DMat3::from_cols_array(&line_of(text, "R0_rect")?).transpose();
        let rows: [f64; 12] = line_of(text, "Tr_velo_to_cam")?;
        let column = |at: usize| DVec3::new(rows[at], rows[4 + at], rows[8 + at]);
        let camera_from_sensor = rectification * DMat3::from_cols(column(0), column(1), column(2));
        let squares = camera_from_sensor * camera_from_sensor.transpose();
        let is_rigid = squares.abs_diff_eq(DMat3::IDENTITY, ROTATION_TOLERANCE);
        if !is_rigid || camera_from_sensor.determinant() < 0.0 {
            return Err(LabelError::NoRotation("R0_rect·Tr_velo_to_cam"));
        }
        let sensor_from_camera = camera_from_sensor.inverse();
        Ok(Self { sensor_from_camera, shift_m: rectification * column(3) })
    }
}

/// Numbers of a line of a calibration, by its name.
fn line_of<const N: usize>(text: &str, name: &'static str) -> Result<[f64; N], LabelError> {
    let line = text.lines().find_map(|line| line.trim_start().strip_prefix(name)?.strip_prefix(':'));
    let words = line.ok_or(LabelError::NoLine(name))?.split_whitespace();
    let numbers: Option<Vec<f64>> = words.map(|word| number(word, name).ok()).collect();
    let numbers: Option<[f64; N]> = numbers.and_then(|numbers| numbers.try_into().ok());
    numbers.ok_or(LabelError::NotNumbers { line: name, count: N })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::levelled_axes::{LevelledAxes, wrapped};
    use crate::training_sets::kitti;
    use crate::training_sets::test_body::bus;
    use crate::training_sets::truth_boxes::TruthBox;
    use std::f64::consts::FRAC_PI_2;

    /// A camera that looks to the left of the sensor, which is 0.5 m to its right, 1 m below and 0.25 m
    /// behind it.
    const TO_THE_LEFT: &str = "P2: 1 0 0 0 0 1 0 0 0 0 1 0\nR0_rect: 1 0 0 0 1 0 0 0 1\n\
        Tr_velo_to_cam: 1 0 0 0.5 0 0 -1 1 0 1 0 -0.25\nTr_imu_to_velo: \n";

    /// Sensor 1 m above the world's origin, its axes along the world's.
    const AXES: LevelledAxes = LevelledAxes { origin_m: DVec3::Z, yaw_rad: 0.0 };

    /// Bodies of a file with this calibration beside it, and whether they are told apart.
    fn read(labels: &str, calibration: &str, axes: LevelledAxes) -> Result<(Vec<LabelledBox>, bool), String> {
        let folder = tempfile::tempdir().unwrap();
        for (part, text) in [("label_2", labels), ("calib", calibration)] {
            std::fs::create_dir(folder.path().join(part)).unwrap();
            std::fs::write(folder.path().join(part).join("00003.txt"), text).unwrap();
        }
        let place = folder.path().join("label_2");
        let mut reading = LabelCollector::of(axes);
        let found = frames(&place, &FrameNames::of(&[], 1), &mut reading);
        let found = found.and_then(|frames| Ok((frames, reading.finish(&place)?)));
        let (frames, tells_bodies) = found.map_err(|failure| failure.to_string())?;
        Ok((frames.into_iter().flatten().flatten().collect(), tells_bodies))
    }

    #[test]
    fn labels_that_are_exported_come_back_to_their_printed_digits() {
        let axes = LevelledAxes { origin_m: DVec3::new(1.0, 0.5, 6.0), yaw_rad: FRAC_PI_2 - 0.1 };
        let turned = TruthBox {
            number: 4,
            foot_m: DVec3::new(-7.123_456, 33.333_33, 0.1),
            yaw_rad: 2.345_678_9,
            ..bus()
        };
        let flat = TruthBox { number: 5, size_m: [0.0, 1.0, 0.5], ..bus() };
        let bodies = [bus(), turned, flat];
        let labels: String = bodies.iter().filter_map(|body| kitti::label(&axes, body)).collect();
        let (found, tells_bodies) = read(&labels, &kitti::calibration(), axes).unwrap();
        assert!(tells_bodies && found.len() == 3, "{found:?}");
        for (body, found) in bodies.iter().zip(found) {
            assert_eq!(found.number, body.number);
            // Half of the fourth digit along each axis, and half of the sixth of the rotation.
            assert!((found.foot_m - body.foot_m).abs().max_element() < 1e-4, "{found:?}");
            let sizes = found.size_m.iter().zip(body.size_m);
            assert!(sizes.clone().all(|(ours, theirs)| (ours - theirs).abs() < 0.51e-4), "{found:?}");
            assert!(wrapped(found.yaw_rad - body.yaw_rad).abs() < 0.51e-6, "{found:?}");
        }
    }

    /// Worked out by hand: in the camera's axes the middle is 2 m to the right of the sensor, 0.25 m below it
    /// and 10.25 m ahead, and its front points to the right, where the sensor looks.
    #[test]
    fn a_label_by_hand_is_the_box_in_the_sensor_s_axes() {
        let car = "Car 0.00 0 -0.24 600.00 170.00 650.00 200.00 1.50 1.80 4.50 2.50 2.00 10.00 0.00\n";
        let region = "DontCare -1 -1 -10 503.89 169.71 590.61 190.13 -1 -1 -1 -1000 -1000 -1000 -10\n";
        let (found, tells_bodies) = read(&format!("{car}{region}\n"), TO_THE_LEFT, AXES).unwrap();
        let [car] = found[..] else { panic!("{found:?}") };
        assert!(!tells_bodies, "a truncation is no number of a body");
        assert!((car.foot_m - DVec3::new(2.0, 10.25, 0.0)).length() < 1e-12, "{car:?}");
        assert_eq!((car.size_m, car.yaw_rad), ([4.5, 1.8, 1.5], 0.0));
        // The same camera, rectified by a quarter of a turn about its vertical: its x is ahead.
        let turned = TO_THE_LEFT.replace("R0_rect: 1 0 0 0 1 0 0 0 1", "R0_rect: 0 0 1 0 1 0 -1 0 0");
        let label = "Pedestrian 0 0 0 0 0 0 0 1.5 1.8 4.5 10 2 -2.5 0 0.9";
        let (found, _) = read(label, &turned, AXES).unwrap();
        assert!((found[0].foot_m - car.foot_m).length() < 1e-12, "{found:?}");
        assert!((found[0].yaw_rad - FRAC_PI_2).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn bodies_of_one_number_are_not_told_apart() {
        let line = |number: &str, z: f64| format!("Car {number} 0 0 0 0 0 0 1 1 1 0 0 {z} 0\n");
        for (numbers, told) in [(["0", "1"], true), (["1", "1"], false), (["0", "0.5"], false)] {
            let labels: String = numbers.map(|number| line(number, 20.0)).concat();
            let (found, tells_bodies) = read(&labels, TO_THE_LEFT, AXES).unwrap();
            assert_eq!((found.len(), tells_bodies), (2, told), "{numbers:?}");
        }
    }

    #[test]
    fn malformed_labels_and_calibrations_are_refused_all_at_once_by_file_line_and_rule() {
        let labels = "Car 0 0 0 0 0 0 0 1.5 1.8 4.5 2 2 10 0 1\nCar 0 0 0 0\n\n\
            Car 0 0 0 0 0 0 0 1.5 1.8 4.5 two 2 10 0\nCar 0 0 0 0 0 0 0 1.5 1.8 4.5 nan 2 10 0\n\
            Car 0 0 0 0 0 0 0 -1 1.8 4.5 2 2 10 0\nCar 0 0 0 0 0 0 0 1.5 1.8 4.5 2 2 1e9 0\n";
        let refused = read(labels, TO_THE_LEFT, AXES).unwrap_err();
        for (line, rule) in [
            (2, "5 columns are neither"),
            (4, "x `two` is no finite number"),
            (5, "x `nan` is no finite number"),
            (6, "length, width and height are not all from 0 to 1000 m"),
            (7, "the box is not within 100000 m of the sensor"),
        ] {
            assert!(refused.contains(&format!("00003.txt:{line}: {rule}")), "{refused}");
        }
        assert_eq!(refused.lines().count(), 5, "{refused}");
        for (from, to, rule) in [
            ("R0_rect: 1", "R0_rect: 2", "R0_rect·Tr_velo_to_cam is no rotation"),
            ("R0_rect: 1", "R0_rect: -1", "R0_rect·Tr_velo_to_cam is no rotation"),
            ("R0_rect:", "R0:", "it has no line R0_rect"),
            ("0.5 0 0 -1", "0.5 0 0 inf", "Tr_velo_to_cam has not 12 finite numbers"),
            (" -0.25", "", "Tr_velo_to_cam has not 12 finite numbers"),
        ] {
            let refused = read(labels, &TO_THE_LEFT.replace(from, to), AXES).unwrap_err();
            assert!(refused.contains(&format!("calib/00003.txt: {rule}")), "{from} -> {to}: {refused}");
            assert!(refused.contains("00003.txt:2: "), "{refused}");
        }
        let many = "Car 0 0 0 0 0 0 0 1 1 1 0 0 9 0\n".repeat(1_025);
        assert!(read(&many, TO_THE_LEFT, AXES).is_err_and(|refused| refused.contains("1024 bodies")));
    }
}
