//! Points scored by the labels of a set: as by the scene that the labels were exported of, matched by the
//! names of their clouds, and refused where labels are malformed, of other frames or of another format.
#![allow(clippy::unwrap_used, reason = "a helper of tests fails the test")]

use crate::common::Workplace;
use serde_json::Value;

/// Two corners, of which the second is turned away and missed, and a third one that is clutter and false.
const MORE: &str = r#"
[[target]]
kind = "mesh"
id = "corner-2"
class = "truck"
model = "corner.obj"
position_m = [4.0, 25.0, 0.0]
velocity_mps = [0.0, 5.0, 0.0]
yaw_deg = 90.0

[[clutter]]
id = "pole"
model = "corner.obj"
position_m = [1.0, 33.0, 0.0]
"#;

/// A run of both corners, its points exported with labels to `kitti` and `nuscenes`, and their clouds
/// imported.
fn exported() -> Workplace {
    let place = Workplace::new();
    let corner = crate::common::SMALL_SCENE.split("\n[[target]]\nkind = \"point\"").next().unwrap();
    let scene = corner.replace("frames = 2", "frames = 6") + MORE;
    std::fs::write(place.path("small.toml"), scene).unwrap();
    place.run("run small.toml --out run --no-cache --quiet");
    for (set, clouds) in [("kitti", "training/velodyne"), ("nuscenes", "samples/RADAR_FRONT")] {
        place
            .run(&format!("export run/frames.points --to {set} --scene run/scene.scene --out {set} --quiet"));
        place.run(&format!("import {set}/{clouds} --scene small.toml --out {set}.points --quiet"));
    }
    place
}

fn scored(place: &Workplace, points: &str, truth: &str) -> Value {
    serde_json::from_str(&place.run(&format!("score {points} {truth} --quiet"))).unwrap()
}

const LABELS: [(&str, &str); 2] =
    [("kitti", "--labels kitti/training/label_2"), ("nuscenes", "--labels nuscenes/v1.0-wayside")];

/// Compares two scores: counts are equal, and distances differ by the printed digits of places and sizes, a
/// tenth of a millimetre.
fn assert_same(ours: &Value, theirs: &Value, about: &str) {
    for kind in ["objects", "tracks"] {
        for count in ["found", "missed", "false", "stationary", "removed", "lane_rate"] {
            assert_eq!(ours[kind][count], theirs[kind][count], "{about} {kind} {count}");
        }
        for distance in ["gospa_m", "ospa_m", "localisation_rms_m"] {
            let [ours, theirs] = [ours, theirs].map(|score| score[kind][distance].as_f64().unwrap());
            assert!((ours - theirs).abs() < 2e-4, "{about} {kind} {distance}: {ours}, {theirs}");
        }
    }
    assert_eq!(ours["identities"], theirs["identities"], "{about}");
}

#[test]
fn the_score_by_exported_labels_is_the_one_by_their_scene() {
    let place = exported();
    for (set, labels) in LABELS {
        for points in ["run/frames.points", &format!("{set}.points")] {
            let theirs = scored(&place, points, "--scene run/scene.scene");
            let counts = ["found", "missed", "false"].map(|count| theirs["objects"][count].as_u64());
            assert_eq!(counts, [Some(6); 3], "{points}: each of the counts is tried");
            assert_same(&scored(&place, points, labels), &theirs, &format!("{set} {points}"));
        }
    }
    let (_, labels) = LABELS[0];
    let followed = scored(&place, "run/frames.points", &format!("{labels} --tracks run/frames.tracks"));
    assert_eq!(followed, scored(&place, "run/frames.points", labels));
}

#[test]
fn labels_belong_to_clouds_of_their_names_and_what_is_left_out_is_told() {
    let place = exported();
    let labels = |frame: u32| place.path(&format!("kitti/training/label_2/{frame:05}.txt"));
    std::fs::remove_file(labels(2)).unwrap();
    let told = std::fs::read_to_string(labels(0)).unwrap();
    let told =
        told.replace("Car 0 0", "Car 0.00 0") + "DontCare -1 -1 -10 1 2 3 4 -1 -1 -1 -1000 -1000 -1000 -10\n";
    std::fs::write(labels(0), told.replace("truck", "bicycle_rack")).unwrap();
    let output = place.try_run("score kitti.points --labels kitti/training/label_2");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
    assert!(
        said.contains("kitti/training/label_2: not counted as bodies: 1 DontCare, 1 bicycle_rack"),
        "{said}"
    );
    assert!(said.contains("kitti/training/label_2: 1 of 6 frames have no labels"), "{said}");
    let score: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!([&score["objects"]["found"], &score["objects"]["missed"]], [5, 4]);
    // A truncation is no number of a body.
    assert_eq!(score["identities"], Value::Null);
}

#[test]
fn labels_of_other_frames_other_formats_and_malformed_ones_are_refused_by_name() {
    let place = exported();
    std::fs::create_dir_all(place.path("raddet/gt")).unwrap();
    std::fs::create_dir(place.path("alone")).unwrap();
    std::fs::write(place.path("raddet/gt/000000.pickle"), "cos\nsystem\n").unwrap();
    std::fs::write(place.path("alone/00000.txt"), "Car 0\n").unwrap();
    std::fs::write(place.path("kitti/training/label_2/00001.txt"), "Car 0\nCar 1 x 0 0\n").unwrap();
    std::fs::write(place.path("nuscenes/v1.0-wayside/instance.json"), "{}").unwrap();
    let kitti = "kitti/training/label_2";
    for (words, code, told) in [
        (&*format!("kitti.points --labels {kitti}"), 1, "label_2/00001.txt:2: 5 columns"),
        (&*format!("nuscenes.points --labels {kitti}"), 1, "label_2: it has labels of none of the frames"),
        ("run/frames.points --labels alone", 1, "alone: it has labels of 1 frames, the points are 6"),
        ("kitti.points --labels alone", 2, "calib/00000.txt: cannot be read"),
        ("kitti.points --labels raddet/gt", 1, "raddet/gt: labels in Python's pickles are not read"),
        ("kitti.points --labels raddet", 1, "raddet: no file in it ends in .txt"),
        ("kitti.points --labels small.toml", 1, "small.toml: read are labels of KITTI"),
        ("kitti.points --labels nowhere", 2, "nowhere: cannot be read"),
        ("nuscenes.points --labels nuscenes/v1.0-wayside", 1, "instance.json: invalid type: map"),
        ("kitti.points", 2, "--scene or --labels has to give the truth"),
        ("kitti.points --labels alone --scene run/scene.scene", 2, "cannot be used with"),
        ("kitti.points --labels alone --paths run/frames.paths", 2, "cannot be used with"),
    ] {
        let output = place.try_run(&format!("score {words} --quiet"));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "{words}: {said}");
        assert!(said.contains(told), "{words}: {said}");
    }
    let output = place.try_run(&format!("score kitti.points --labels {kitti} --quiet"));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("label_2/00001.txt:1: 2 columns"), "{said}");
}
