//! The thirteen tables of nuScenes' database, by its public schema. Tokens are hashes of the scene's name,
//! the table and a number, so they are the same for the same run.

use crate::levelled_axes::LevelledAxes;
use crate::training_sets::truth_boxes::TruthBox;
use artifact::settings::Class;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// A body of a frame.
pub(crate) struct AnnotatedBody {
    pub(crate) body: TruthBox,
    /// Number of points on it.
    pub(crate) points: usize,
}

/// A frame with its bodies.
struct Frame {
    timestamp: i64,
    file: String,
    seen: Vec<AnnotatedBody>,
}

/// Frames that become the tables.
pub(crate) struct Tables {
    scene: String,
    axes: LevelledAxes,
    frames: Vec<Frame>,
    /// Frames of each body, in order, with its class.
    instances: BTreeMap<u32, (Class, Vec<usize>)>,
}

impl Tables {
    /// Tables of one scene without frames.
    pub(crate) fn of(scene: &str, axes: &LevelledAxes) -> Self {
        Self { scene: scene.to_owned(), axes: *axes, frames: vec![], instances: BTreeMap::new() }
    }

    /// Appends a frame.
    pub(crate) fn add(&mut self, time_s: f64, file: &str, seen: Vec<AnnotatedBody>) {
        for AnnotatedBody { body, .. } in &seen {
            let (_, frames) = self.instances.entry(body.number).or_insert((body.class, vec![]));
            frames.push(self.frames.len());
        }
        let timestamp = (time_s * 1e6).round() as i64;
        self.frames.push(Frame { timestamp, file: file.to_owned(), seen });
    }

    /// Name and rows of each table.
    pub(crate) fn content(&self) -> Vec<(&'static str, Value)> {
        vec![
            ("scene", self.scenes()),
            ("sample", self.each_frame(|tables, at| tables.sample(at))),
            ("sample_data", self.each_frame(|tables, at| tables.sample_data(at))),
            ("ego_pose", self.each_frame(|tables, at| tables.ego_pose(at))),
            ("sample_annotation", self.annotations()),
            ("instance", self.instances.keys().map(|number| self.instance(*number)).collect()),
            ("category", Class::ALL.iter().map(|class| self.category(*class)).collect()),
            ("attribute", (0..2).map(|at| self.attribute(at)).collect()),
            ("visibility", json!([])),
            (
                "sensor",
                json!([{ "token": self.token("sensor", 0), "channel": "RADAR_FRONT", "modality": "radar" }]),
            ),
            ("calibrated_sensor", self.calibrated_sensor()),
            ("log", self.logs()),
            ("map", self.maps()),
        ]
    }

    fn token(&self, table: &str, number: usize) -> String {
        let text = format!("{}\0{table}\0{number}", self.scene);
        blake3::hash(text.as_bytes()).to_hex()[..32].to_owned()
    }

    /// Token of the row before or after another; empty at the ends.
    fn beside(&self, table: &str, at: Option<usize>) -> String {
        let there = at.filter(|at| *at < self.frames.len());
        there.map_or_else(String::new, |at| self.token(table, at))
    }

    fn each_frame(&self, row: fn(&Self, usize) -> Value) -> Value {
        (0..self.frames.len()).map(|at| row(self, at)).collect()
    }

    fn scenes(&self) -> Value {
        json!([{
            "token": self.token("scene", 0), "name": self.scene, "description": "simulated by wayside",
            "log_token": self.token("log", 0), "nbr_samples": self.frames.len(),
            "first_sample_token": self.beside("sample", Some(0)),
            "last_sample_token": self.beside("sample", self.frames.len().checked_sub(1)),
        }])
    }

    fn sample(&self, at: usize) -> Value {
        json!({
            "token": self.token("sample", at), "timestamp": self.frames[at].timestamp,
            "scene_token": self.token("scene", 0),
            "prev": self.beside("sample", at.checked_sub(1)), "next": self.beside("sample", Some(at + 1)),
        })
    }

    fn sample_data(&self, at: usize) -> Value {
        json!({
            "token": self.token("sample_data", at), "sample_token": self.token("sample", at),
            "ego_pose_token": self.token("ego_pose", at),
            "calibrated_sensor_token": self.token("calibrated_sensor", 0),
            "filename": self.frames[at].file, "fileformat": "pcd", "width": 0, "height": 0,
            "timestamp": self.frames[at].timestamp, "is_key_frame": true,
            "prev": self.beside("sample_data", at.checked_sub(1)),
            "next": self.beside("sample_data", Some(at + 1)),
        })
    }

    fn ego_pose(&self, at: usize) -> Value {
        let [x, y, _] = self.axes.origin_m.to_array();
        json!({
            "token": self.token("ego_pose", at), "timestamp": self.frames[at].timestamp,
            "translation": [x, y, 0.0], "rotation": about_z(self.axes.yaw_rad),
        })
    }

    fn calibrated_sensor(&self) -> Value {
        json!([{
            "token": self.token("calibrated_sensor", 0), "sensor_token": self.token("sensor", 0),
            "translation": [0.0, 0.0, self.axes.origin_m.z], "rotation": about_z(0.0), "camera_intrinsic": [],
        }])
    }

    fn annotations(&self) -> Value {
        let of_frame = |(at, frame): (usize, &Frame)| -> Vec<Value> {
            frame.seen.iter().map(|seen| self.annotation(at, seen)).collect()
        };
        self.frames.iter().enumerate().flat_map(of_frame).collect()
    }

    fn annotation(&self, at: usize, AnnotatedBody { body, points }: &AnnotatedBody) -> Value {
        let frames = self.instances.get(&body.number).map_or(&[][..], |(_, frames)| frames);
        let place = frames.partition_point(|frame| *frame < at);
        let of = |place: Option<usize>| {
            let frame = place.and_then(|place| frames.get(place));
            frame.map_or_else(String::new, |frame| self.annotation_token(*frame, body.number))
        };
        let [length, width, height] = body.size_m;
        let moves = usize::from(body.velocity_mps.length() < AT_REST_MPS);
        json!({
            "token": self.annotation_token(at, body.number), "sample_token": self.token("sample", at),
            "instance_token": self.token("instance", body.number as usize),
            "attribute_tokens": [self.token("attribute", moves)], "visibility_token": "",
            "translation": body.middle_m().to_array(), "size": [width, length, height],
            "rotation": about_z(body.yaw_rad), "num_lidar_pts": 0, "num_radar_pts": points,
            "prev": of(place.checked_sub(1)), "next": of(Some(place + 1)),
        })
    }

    fn annotation_token(&self, at: usize, number: u32) -> String {
        self.token(&format!("sample_annotation\0{number}"), at)
    }

    fn instance(&self, number: u32) -> Value {
        let (class, frames) = &self.instances[&number];
        let of = |frame: Option<&usize>| frame.map(|frame| self.annotation_token(*frame, number));
        json!({
            "token": self.token("instance", number as usize), "category_token": self.token(category(*class), 0),
            "nbr_annotations": frames.len(),
            "first_annotation_token": of(frames.first()), "last_annotation_token": of(frames.last()),
        })
    }

    fn category(&self, class: Class) -> Value {
        json!({ "token": self.token(category(class), 0), "name": category(class), "description": "" })
    }

    fn attribute(&self, at: usize) -> Value {
        let name = ["vehicle.moving", "vehicle.stopped"][at];
        json!({ "token": self.token("attribute", at), "name": name, "description": "" })
    }

    fn logs(&self) -> Value {
        json!([{
            "token": self.token("log", 0), "logfile": "", "vehicle": "wayside", "date_captured": "",
            "location": "singapore-onenorth",
        }])
    }

    /// A map of one point, which the dataset's reader requires.
    fn maps(&self) -> Value {
        json!([{
            "token": self.token("map", 0), "log_tokens": [self.token("log", 0)],
            "category": "semantic_prior", "filename": "maps/none.png",
        }])
    }
}

/// Speed below which a body is at rest, m/s.
const AT_REST_MPS: f64 = 0.1;

/// Quaternion w, x, y, z of a rotation about z.
fn about_z(angle_rad: f64) -> [f64; 4] {
    let (sine, cosine) = (0.5 * angle_rad).sin_cos();
    [cosine, 0.0, 0.0, sine]
}

/// Names of the dataset's categories.
fn category(class: Class) -> &'static str {
    match class {
        Class::Car => "vehicle.car",
        Class::Bus => "vehicle.bus.rigid",
        Class::Truck => "vehicle.truck",
        Class::Motorcycle => "vehicle.motorcycle",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::training_sets::test_body::bus;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn annotations_of_a_body_are_a_chain_over_the_frames_that_have_it() {
        let axes = LevelledAxes { origin_m: glam::DVec3::new(1.0, 0.0, 6.0), yaw_rad: FRAC_PI_2 };
        let mut tables = Tables::of("street", &axes);
        for (frame, there) in [true, false, true].into_iter().enumerate() {
            let seen = if there { vec![AnnotatedBody { body: bus(), points: 4 }] } else { vec![] };
            tables.add(0.1 * frame as f64, "f.pcd", seen);
        }
        let content: BTreeMap<&str, Value> = tables.content().into_iter().collect();
        let annotations = content["sample_annotation"].as_array().unwrap();
        assert_eq!(annotations.len(), 2);
        assert_eq!(annotations[0]["next"], annotations[1]["token"]);
        assert_eq!((&annotations[0]["prev"], &annotations[1]["next"]), (&json!(""), &json!("")));
        assert_eq!(annotations[1]["sample_token"], content["sample"][2]["token"]);
        assert_eq!(annotations[0]["size"], json!([2.5, 12.0, 3.0]));
        assert_eq!(content["instance"][0]["nbr_annotations"], 2);
        assert_eq!(content["sample"][1]["prev"], content["sample"][0]["token"]);
        assert_eq!(content["sample"][2]["timestamp"], 200_000);
        assert_eq!(content.len(), 13);
    }
}
