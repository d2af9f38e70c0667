//! View-of-Delft (Palffy et al. 2022) in KITTI's layout: clouds, labels in a camera's axes, and the camera.
//!
//! `training/velodyne/NNNNN.bin` has rows of float32 x, y, z, RCS, v_r, v_r compensated, time in the levelled
//! axes of the radar; `training/label_2/NNNNN.txt` the boxes, `training/calib/NNNNN.txt` a fictitious camera:
//! a pinhole at the radar's place that looks along its x axis.

use crate::levelled_axes::{LevelledAxes, wrapped};
use crate::radar_cloud::{Detection, velodyne};
use crate::training_sets::opened_points::OpenedPoints;
use crate::training_sets::radar_of_points::sections_of;
use crate::training_sets::set_folder::SetFolder;
use crate::training_sets::truth_boxes::TruthBox;
use artifact::points::{PointsFrame, PointsHeader};
use artifact::settings::Class;
use glam::DVec3;
use pipeline::host::failure::Failure;
use serde_json::json;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

/// Focal length of the camera, pixels.
const FOCAL_PX: f64 = 1000.0;
/// Width and height of its picture, pixels: 88° by 57°.
const PICTURE_PX: [f64; 2] = [1936.0, 1216.0];
/// Least distance of projection, m.
const NEAREST_M: f64 = 0.1;

/// Writes the points of a run, labelled if a scene is given.
pub fn write(file: &Path, scene: Option<&Path>, out: &Path) -> Result<(), Failure> {
    let OpenedPoints { reader, header, heights, mut truth, axes } = OpenedPoints::open(file, scene)?;
    let mut set = SetFolder::begin(out)?;
    let mut names = String::new();
    let frames = set.each_frame(
        reader,
        |frame| frame.index,
        |set, frame| {
            let name = format!("{:05}", frame.index);
            set.write(&format!("training/velodyne/{name}.bin"), &cloud(&header, &axes, &frame))?;
            set.write(&format!("training/calib/{name}.txt"), calibration().as_bytes())?;
            if let Some(truth) = &mut truth {
                let bodies = truth.of_frame(frame.index, frame.time_s)?;
                let lines: String = bodies.iter().filter_map(|body| label(&axes, body)).collect();
                set.write(&format!("training/label_2/{name}.txt"), lines.as_bytes())?;
            }
            names += &format!("{name}\n");
            Ok(())
        },
    )?;
    set.write("ImageSets/train.txt", names.as_bytes())?;
    set.finish(&json!({
        "set": "View-of-Delft", "frames": frames, "labelled": truth.is_some(),
        "columns": ["x", "y", "z", "RCS", "v_r", "v_r_compensated", "time"],
        "RCS": sections_of(&header), "camera": "made up", "heights": heights.words(),
        "not_filled": ["image_2", "pose", "truncated (the body's number)", "occluded (0)"],
    }))
}

fn cloud(header: &PointsHeader, axes: &LevelledAxes, frame: &PointsFrame) -> Vec<u8> {
    let seen = frame.points.iter().map(|point| Detection::of(header.cube.as_ref(), axes, point));
    velodyne::to_bytes(&seen.filter(Detection::is_sound).collect::<Vec<_>>())
}

/// The camera's matrix, and the rotation from the radar's axes to the camera's: x right, y down, z ahead.
/// Lines are identified by position, not by name.
pub(super) fn calibration() -> String {
    let [width, height] = PICTURE_PX.map(|side| 0.5 * side);
    let camera = format!("{FOCAL_PX} 0 {width} 0 0 {FOCAL_PX} {height} 0 0 0 1 0");
    let cameras: String = (0..4).map(|number| format!("P{number}: {camera}\n")).collect();
    let turn = "0 -1 0 0 0 0 -1 0 1 0 0 0";
    format!("{cameras}R0_rect: 1 0 0 0 1 0 0 0 1\nTr_velo_to_cam: {turn}\nTr_imu_to_velo: \n")
}

/// A line of labels; none for a body whose middle is behind the radar.
pub(super) fn label(axes: &LevelledAxes, body: &TruthBox) -> Option<String> {
    let foot = camera_axes(axes.of_world(body.foot_m));
    if foot.z <= NEAREST_M {
        return None;
    }
    let turn = wrapped(-axes.yaw_of_world(body.yaw_rad) - FRAC_PI_2);
    let seen_turn = wrapped(turn - foot.x.atan2(foot.z));
    let [left, top, right, bottom] = picture_box(axes, body);
    let [length, width, height] = body.size_m;
    let (class, number) = (class_name(body.class), body.number);
    Some(format!(
        "{class} {number} 0 {seen_turn:.6} {left:.2} {top:.2} {right:.2} {bottom:.2} {height:.4} {width:.4} \
         {length:.4} {:.4} {:.4} {:.4} {turn:.6} 1\n",
        foot.x, foot.y, foot.z
    ))
}

/// Right, down, ahead of a place in the radar's axes.
fn camera_axes(place_m: DVec3) -> DVec3 {
    DVec3::new(-place_m.y, -place_m.z, place_m.x)
}

/// Left, top, right and bottom of the box in the picture, clipped to its sides.
fn picture_box(axes: &LevelledAxes, body: &TruthBox) -> [f64; 4] {
    let pixels = body.corners_m().map(|corner| {
        let place_m = camera_axes(axes.of_world(corner));
        let scale = FOCAL_PX / place_m.z.max(NEAREST_M);
        [place_m.x * scale + 0.5 * PICTURE_PX[0], place_m.y * scale + 0.5 * PICTURE_PX[1]]
    });
    let along = |axis: usize| pixels.iter().map(move |pixel| pixel[axis].clamp(0.0, PICTURE_PX[axis] - 1.0));
    let least = |axis| along(axis).fold(f64::INFINITY, f64::min);
    let most = |axis| along(axis).fold(f64::NEG_INFINITY, f64::max);
    [least(0), least(1), most(0), most(1)]
}

/// Names of the dataset's classes; it has none for buses.
fn class_name(class: Class) -> &'static str {
    match class {
        Class::Car => "Car",
        Class::Truck => "truck",
        Class::Motorcycle => "motor",
        Class::Bus => "vehicle_other",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::training_sets::test_body::bus;

    /// The numbers are worked out by hand: the bus is 50 m ahead, 2 m to the right, 6 m below the radar, and
    /// comes nearer.
    #[test]
    fn a_label_tells_the_box_in_the_camera_s_axes() {
        let axes = LevelledAxes { origin_m: DVec3::new(0.0, 0.0, 6.0), yaw_rad: FRAC_PI_2 };
        let line = label(&axes, &bus()).unwrap();
        let words: Vec<&str> = line.split_whitespace().collect();
        assert_eq!(words.len(), 16);
        assert_eq!(words[..3], ["vehicle_other", "3", "0"]);
        assert_eq!(words[8..14], ["3.0000", "2.5000", "12.0000", "2.0000", "6.0000", "50.0000"]);
        // It drives towards the camera: KITTI's rotation about y is +90° or, wrapped, the same less a turn.
        let turn: f64 = words[14].parse().unwrap();
        assert!((turn.abs() - FRAC_PI_2).abs() < 1e-5, "{turn}");
        assert!((turn - FRAC_PI_2).abs() < 1e-5, "{turn}");
        let pixels: Vec<f64> = words[4..8].iter().map(|word| word.parse().unwrap()).collect();
        assert!((pixels[0] - (968.0 + 1000.0 * 0.75 / 56.0)).abs() < 0.01, "{pixels:?}");
        assert!((pixels[3] - (608.0 + 1000.0 * 6.0 / 44.0)).abs() < 0.01, "{pixels:?}");
    }

    #[test]
    fn the_turn_of_the_calibration_is_that_of_the_labels() {
        let text = calibration();
        let line = text.lines().nth(5).unwrap();
        let turn: Vec<f64> = line.split(' ').skip(1).map(|word| word.parse().unwrap()).collect();
        let place = DVec3::new(3.0, 4.0, 5.0);
        let row = |at: usize| DVec3::new(turn[at], turn[at + 1], turn[at + 2]).dot(place);
        assert_eq!(DVec3::new(row(0), row(4), row(8)), camera_axes(place));
        assert_eq!(text.lines().nth(2).unwrap().split(' ').count(), 13);
    }
}
