//! Labels of nuScenes (Caesar et al. 2020), by its public schema: boxes of `sample_annotation` in a global
//! frame, brought to the axes of the radar of each keyframe's cloud (`sample_data`) by the tables `ego_pose`
//! and `calibrated_sensor`.

use crate::training_sets::labels::frame_names::{FrameNames, name_of};
use crate::training_sets::labels::json_rows::each_row;
use crate::training_sets::labels::label_collector::{Label, LabelCollector};
use crate::training_sets::labels::label_error::LabelError;
use crate::training_sets::labels::sensor_box::SensorBox;
use evaluation::LabelledBox;
use glam::{DQuat, DVec3};
use pipeline::host::failure::Failure;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Groups of categories without bodies to be found: barriers, cones, debris, bicycle racks.
const LEFT_OUT: [&str; 2] = ["movable_object", "static_object"];

/// Largest deviation of a quaternion from unit length.
const ROTATION_TOLERANCE: f64 = 1e-3;

/// Whether a folder has the tables.
pub(super) fn is_at(folder: &Path) -> bool {
    table(folder, "sample_annotation").is_file()
}

/// Bodies of each frame whose cloud is in the tables.
///
/// # Errors
/// A table cannot be read or has other rows, or the clouds are of other frames.
pub(super) fn frames(
    folder: &Path,
    names: &FrameNames,
    reading: &mut LabelCollector,
) -> Result<Vec<Option<Vec<LabelledBox>>>, Failure> {
    let mut clouds = BTreeMap::new();
    each_row(&table(folder, "sample_data"), |cloud: Cloud, _| {
        if cloud.is_key_frame && cloud.filename.ends_with(".pcd") {
            clouds.insert(name_of(Path::new(&cloud.filename)), cloud);
        }
    })?;
    let frames = names.matched(folder, &clouds)?;
    let of_frames: Vec<&Cloud> = frames.iter().copied().flatten().collect();
    let tables = Tables::of(folder, &of_frames)?;
    Ok(frames.into_iter().map(|cloud| cloud.map(|cloud| tables.bodies(cloud, reading))).collect())
}

fn table(folder: &Path, name: &str) -> PathBuf {
    folder.join(format!("{name}.json"))
}

/// A row of `sample_data`.
#[derive(Deserialize)]
struct Cloud {
    sample_token: String,
    ego_pose_token: String,
    calibrated_sensor_token: String,
    filename: String,
    is_key_frame: bool,
}

/// A row of `ego_pose` or `calibrated_sensor`.
#[derive(Deserialize)]
struct Pose {
    token: String,
    translation: [f64; 3],
    /// Quaternion w, x, y, z.
    rotation: [f64; 4],
}

/// A row of `sample_annotation`.
#[derive(Deserialize)]
struct Annotation {
    sample_token: String,
    instance_token: String,
    translation: [f64; 3],
    /// Width, length, height.
    size: [f64; 3],
    rotation: [f64; 4],
}

/// A row of `instance`.
#[derive(Deserialize)]
struct Instance {
    token: String,
    category_token: String,
}

/// A row of `category`.
#[derive(Deserialize)]
struct Category {
    token: String,
    name: String,
}

/// Rows of the tables that some frames need.
struct Tables {
    folder: PathBuf,
    ego_poses: BTreeMap<String, Pose>,
    sensors: BTreeMap<String, Pose>,
    /// Annotations with their numbers in the table, by samples.
    annotations: BTreeMap<String, Vec<(usize, Annotation)>>,
    /// Numbers and categories of instances.
    instances: BTreeMap<String, (u32, String)>,
}

impl Tables {
    fn of(folder: &Path, clouds: &[&Cloud]) -> Result<Self, Failure> {
        let samples = tokens(clouds, |cloud| &cloud.sample_token);
        let ego_poses = tokens(clouds, |cloud| &cloud.ego_pose_token);
        let sensors = tokens(clouds, |cloud| &cloud.calibrated_sensor_token);
        let mut annotations: BTreeMap<String, Vec<_>> = BTreeMap::new();
        each_row(&table(folder, "sample_annotation"), |row: Annotation, number| {
            if samples.contains(row.sample_token.as_str()) {
                annotations.entry(row.sample_token.clone()).or_default().push((number, row));
            }
        })?;
        Ok(Self {
            folder: folder.to_owned(),
            ego_poses: poses(&table(folder, "ego_pose"), &ego_poses)?,
            sensors: poses(&table(folder, "calibrated_sensor"), &sensors)?,
            annotations,
            instances: instances(folder)?,
        })
    }

    /// Bodies of a cloud's sample.
    fn bodies(&self, cloud: &Cloud, reading: &mut LabelCollector) -> Vec<LabelledBox> {
        let place = table(&self.folder, "sample_data").display().to_string();
        let place = format!("{place}: {}", cloud.filename);
        let sensor = match self.sensor(cloud) {
            Ok(sensor) => sensor,
            Err(error) => {
                reading.fault(place, &error);
                return vec![];
            }
        };
        let mut labels = vec![];
        for (row, annotation) in self.annotations.get(&cloud.sample_token).into_iter().flatten() {
            let place = format!("{}: row {row}", table(&self.folder, "sample_annotation").display());
            match self.instance(annotation).and_then(|of| Ok((of, sensor.seen(annotation)?))) {
                Ok(((_, group), _)) if LEFT_OUT.contains(&group) => reading.leave_out(group),
                Ok(((number, _), seen)) => labels.push(Label { place, number: Some(number), seen }),
                Err(error) => reading.fault(place, &error),
            }
        }
        reading.frame(place, &labels)
    }

    /// Number of an annotation's instance, and the group of its category.
    fn instance(&self, annotation: &Annotation) -> Result<(u32, &str), LabelError> {
        let (number, category) = row_of(&self.instances, "instance_token", &annotation.instance_token)?;
        Ok((*number, category.split('.').next().unwrap_or_default()))
    }

    fn sensor(&self, cloud: &Cloud) -> Result<Sensor, LabelError> {
        let ego = row_of(&self.ego_poses, "ego_pose_token", &cloud.ego_pose_token)?;
        let own = row_of(&self.sensors, "calibrated_sensor_token", &cloud.calibrated_sensor_token)?;
        let global_from_ego = rotation(ego.rotation, "rotation of its ego_pose")?;
        let ego_from_sensor = rotation(own.rotation, "rotation of its calibrated_sensor")?;
        let origin_m = DVec3::from(ego.translation) + global_from_ego * DVec3::from(own.translation);
        Ok(Sensor { origin_m, sensor_from_global: (global_from_ego * ego_from_sensor).inverse() })
    }
}

/// Position and rotation of a radar in the global frame.
struct Sensor {
    origin_m: DVec3,
    sensor_from_global: DQuat,
}

impl Sensor {
    fn seen(&self, annotation: &Annotation) -> Result<SensorBox, LabelError> {
        let [width, length, height] = annotation.size;
        Ok(SensorBox {
            middle_m: self.sensor_from_global * (DVec3::from(annotation.translation) - self.origin_m),
            size_m: [length, width, height],
            front: self.sensor_from_global * (rotation(annotation.rotation, "rotation")? * DVec3::X),
        })
    }
}

fn row_of<'a, Row>(
    rows: &'a BTreeMap<String, Row>,
    key: &'static str,
    token: &str,
) -> Result<&'a Row, LabelError> {
    rows.get(token).ok_or_else(|| LabelError::NoRow { key, token: token.to_owned() })
}

fn rotation([w, x, y, z]: [f64; 4], name: &'static str) -> Result<DQuat, LabelError> {
    let turn = DQuat::from_xyzw(x, y, z, w);
    let is_unit = (turn.length() - 1.0).abs() <= ROTATION_TOLERANCE;
    is_unit.then(|| turn.normalize()).ok_or(LabelError::NoRotation(name))
}

/// Tokens of one kind that clouds name.
fn tokens<'a>(clouds: &[&'a Cloud], token: fn(&Cloud) -> &str) -> BTreeSet<&'a str> {
    clouds.iter().copied().map(token).collect()
}

/// Rows of a table of poses that have one of these tokens.
fn poses(file: &Path, tokens: &BTreeSet<&str>) -> Result<BTreeMap<String, Pose>, Failure> {
    let mut poses = BTreeMap::new();
    each_row(file, |pose: Pose, _| {
        if tokens.contains(pose.token.as_str()) {
            poses.insert(pose.token.clone(), pose);
        }
    })?;
    Ok(poses)
}

/// Numbers and categories of all instances that have one.
fn instances(folder: &Path) -> Result<BTreeMap<String, (u32, String)>, Failure> {
    let (mut categories, mut instances) = (BTreeMap::new(), BTreeMap::new());
    each_row(&table(folder, "category"), |row: Category, _| {
        categories.insert(row.token, row.name);
    })?;
    each_row(&table(folder, "instance"), |row: Instance, number| {
        if let Some(category) = categories.get(&row.category_token) {
            instances.insert(row.token, (number as u32, category.clone()));
        }
    })?;
    Ok(instances)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::levelled_axes::{LevelledAxes, wrapped};
    use crate::training_sets::nuscenes_tables::{AnnotatedBody, Tables as Written};
    use crate::training_sets::test_body::bus;
    use crate::training_sets::truth_boxes::TruthBox;
    use serde_json::{Value, json};
    use std::f64::consts::FRAC_PI_2;

    /// Bodies of each frame by these tables.
    fn read(
        tables: &BTreeMap<&str, Value>,
        frames: usize,
        axes: LevelledAxes,
    ) -> Result<Vec<Vec<LabelledBox>>, String> {
        let folder = tempfile::tempdir().unwrap();
        for (name, rows) in tables {
            std::fs::write(table(folder.path(), name), rows.to_string()).unwrap();
        }
        assert!(is_at(folder.path()));
        let mut reading = LabelCollector::of(axes);
        let found = super::frames(folder.path(), &FrameNames::of(&[], frames), &mut reading);
        let found = found.and_then(|frames| reading.finish(folder.path()).map(|_| frames));
        found.map(|frames| frames.into_iter().flatten().collect()).map_err(|failure| failure.to_string())
    }

    #[test]
    fn labels_that_are_exported_come_back() {
        let axes = LevelledAxes { origin_m: DVec3::new(1.0, 0.5, 6.0), yaw_rad: FRAC_PI_2 - 0.1 };
        let turned = || TruthBox { number: 4, yaw_rad: 2.3, ..bus() };
        let mut written = Written::of("street", &axes);
        let seen = |body| AnnotatedBody { body, points: 0 };
        written.add(0.0, "samples/RADAR_FRONT/000000.pcd", vec![seen(bus()), seen(turned())]);
        written.add(0.1, "samples/RADAR_FRONT/000001.pcd", vec![]);
        written.add(0.2, "samples/RADAR_FRONT/000002.pcd", vec![seen(turned())]);
        let found = read(&written.content().into_iter().collect(), 3, axes).unwrap();
        assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [2, 0, 1]);
        // Instances are numbered in the order of the bodies.
        assert_eq!(found.concat().iter().map(|body| body.number).collect::<Vec<_>>(), [0, 1, 1]);
        for (body, found) in [bus(), turned(), turned()].iter().zip(found.concat()) {
            // Sums and rotations of numbers below 100.
            assert!((found.foot_m - body.foot_m).length() < 1e-11, "{found:?}");
            assert_eq!(found.size_m, body.size_m);
            assert!(wrapped(found.yaw_rad - body.yaw_rad).abs() < 1e-12, "{found:?}");
        }
    }

    /// A vehicle at (100, 200) m that faces global +y, its radar 3 m before and 0.5 m above its middle, and
    /// what is 10 m ahead of the radar and faces as it does.
    fn by_hand() -> BTreeMap<&'static str, Value> {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let along_y = json!([half, 0.0, 0.0, half]);
        let annotation = |instance: &str| {
            json!({
                "sample_token": "s", "instance_token": instance, "translation": [100.0, 213.0, 1.0],
                "size": [2.0, 5.0, 1.0], "rotation": along_y, "num_radar_pts": 0,
            })
        };
        let clouds = ["samples/R/1.pcd", "sweeps/R/2.pcd", "samples/L/3.bin"].map(|name| {
            json!({
                "sample_token": "s", "ego_pose_token": "e", "calibrated_sensor_token": "c",
                "filename": name, "is_key_frame": name.starts_with("samples"),
            })
        });
        let categories = [
            ("cone", "movable_object.trafficcone"),
            ("car", "vehicle.car"),
            ("walker", "human.pedestrian.adult"),
        ];
        let category = |(token, name): (&str, &str)| json!({ "token": format!("of {token}"), "name": name });
        let instance =
            |(token, _): (&str, &str)| json!({ "token": token, "category_token": format!("of {token}") });
        [
            ("sample_data", json!(clouds)),
            ("ego_pose", json!([{ "token": "e", "translation": [100.0, 200.0, 0.0], "rotation": along_y }])),
            (
                "calibrated_sensor",
                json!([{ "token": "c", "translation": [3.0, 0.0, 0.5], "rotation": [1.0, 0.0, 0.0, 0.0] }]),
            ),
            ("sample_annotation", json!([annotation("cone"), annotation("car"), annotation("walker")])),
            ("instance", json!(categories.map(instance))),
            ("category", json!(categories.map(category))),
        ]
        .into()
    }

    #[test]
    fn labels_by_hand_are_boxes_in_the_radar_s_axes_without_what_is_no_road_user() {
        let axes = LevelledAxes { origin_m: DVec3::new(0.0, 0.0, 0.75), yaw_rad: 0.0 };
        let found = read(&by_hand(), 1, axes).unwrap().concat();
        assert_eq!(found.iter().map(|body| body.number).collect::<Vec<_>>(), [1, 2]);
        for body in found {
            // The middle is 10 m ahead of the radar and 0.5 m above it.
            assert!((body.foot_m - DVec3::new(10.0, 0.0, 0.75)).length() < 1e-11, "{body:?}");
            assert_eq!(body.size_m, [5.0, 2.0, 1.0]);
            assert!(body.yaw_rad.abs() < 1e-12, "{body:?}");
        }
    }

    #[test]
    fn malformed_tables_are_refused_all_at_once_by_table_row_and_rule() {
        let axes = LevelledAxes { origin_m: DVec3::ZERO, yaw_rad: 0.0 };
        let mut tables = by_hand();
        let rows = tables.get_mut("sample_annotation").unwrap();
        rows[0]["instance_token"] = "none".into();
        rows[1]["rotation"] = json!([1, 1, 0, 0]);
        rows[2]["size"] = json!([-1, 5, 1]);
        let refused = read(&tables, 1, axes).unwrap_err();
        for rule in [
            "sample_annotation.json: row 0: instance_token `none` is of no row",
            "sample_annotation.json: row 1: rotation is no rotation",
            "sample_annotation.json: row 2: length, width and height are not all from 0 to 1000 m",
        ] {
            assert!(refused.contains(rule), "{refused}");
        }
        assert_eq!(refused.lines().count(), 3, "{refused}");
        let with = |name: &'static str, rows: Value| {
            let mut tables = by_hand();
            tables.insert(name, rows);
            read(&tables, 1, axes).unwrap_err()
        };
        for (refused, rule) in [
            (
                with("ego_pose", json!([])),
                "sample_data.json: samples/R/1.pcd: ego_pose_token `e` is of no row",
            ),
            (
                with(
                    "calibrated_sensor",
                    json!([{ "token": "c", "translation": [0, 0, 0], "rotation": [0, 0, 0, 0] }]),
                ),
                "samples/R/1.pcd: rotation of its calibrated_sensor is no rotation",
            ),
            (with("category", json!({})), "category.json: invalid type: map, expected a list of rows"),
            (with("sample_data", json!([])), "it has labels of 0 frames, the points are 1 frames"),
        ] {
            assert!(refused.contains(rule), "{refused}");
        }
    }
}
