//! Training sets in the layouts of others: their arrays and clouds are those of the artifacts, whatever
//! labels say; they come back as artifacts; nothing is written over anything.
#![allow(clippy::unwrap_used, reason = "a helper of tests fails the test")]

use crate::common::Workplace;

/// A run of the small scene.
fn run() -> Workplace {
    let place = Workplace::new();
    place.run("run small.toml --out run --no-cache --quiet");
    place
}

/// Numbers of a column of a csv file.
fn column(place: &Workplace, file: &str, name: &str) -> Vec<f64> {
    let text = String::from_utf8(place.bytes(file)).unwrap();
    let at = text.lines().next().unwrap().split(',').position(|column| column == name).unwrap();
    let mut values: Vec<f64> =
        text.lines().skip(1).map(|line| line.split(',').nth(at).unwrap().parse().unwrap()).collect();
    values.sort_by(f64::total_cmp);
    values
}

#[test]
fn samples_through_a_set_of_raw_frames_are_the_same_samples() {
    let place = run();
    place.run("export run/frames.cube --to uwcr --scene run/scene.scene --out raw --quiet");
    place.run("import raw/radar_raw_frame --scene small.toml --out b.cube --quiet");
    place.run("import raw/radar_raw_frame/000001.mat --scene small.toml --out one.cube --quiet");
    for name in ["run/frames", "b", "one"] {
        place.run(&format!("export {name}.cube --to npy --out {}.npy --quiet", name.replace('/', "-")));
    }
    let (all, one) = (place.bytes("run-frames.npy"), place.bytes("one.npy"));
    assert_eq!(all, place.bytes("b.npy"));
    assert_eq!(all[all.len() - 8 * 4 * 16 * 64..], one[one.len() - 8 * 4 * 16 * 64..]);
    // A corner of 0.5 m, its middle 40 m ahead on the left.
    let labels = String::from_utf8(place.bytes("raw/text_labels/000000.csv")).unwrap();
    assert!(labels.starts_with("0,2,-5.75") && labels.lines().count() == 1, "{labels}");
}

/// Frames do not tell the errors of their radar, the scene does.
#[test]
fn frames_of_a_radar_with_errors_are_of_their_own_scene() {
    let place = Workplace::new();
    let errors = "preset = \"1x4\"\nrx_gain_errors_db = [0.0, 0.5, -0.5, 0.2]";
    let scene = crate::common::SMALL_SCENE.replace("preset = \"1x4\"", errors);
    std::fs::write(place.path("small.toml"), scene).unwrap();
    place.run("run small.toml --out run --no-cache --quiet");
    for (artifact, set) in [("rdm", "raddet"), ("cube", "uwcr"), ("points", "kitti")] {
        place.run(&format!(
            "export run/frames.{artifact} --to {set} --scene run/scene.scene --out {set} --quiet"
        ));
    }
}

#[test]
fn clouds_through_both_sets_are_the_same_points_and_are_scored() {
    let place = run();
    place.run("export run/frames.points --to csv --out a.csv --quiet");
    for (set, folder) in [("kitti", "training/velodyne"), ("nuscenes", "samples/RADAR_FRONT")] {
        place
            .run(&format!("export run/frames.points --to {set} --scene run/scene.scene --out {set} --quiet"));
        place.run(&format!("import {set}/{folder} --scene small.toml --out {set}.points --quiet"));
        place.run(&format!("export {set}.points --to csv --out {set}.csv --quiet"));
        for (name, within) in
            [("range_m", 1e-5), ("radial_velocity_mps", 1e-5), ("snr_db", 1e-4), ("az_deg", 1e-4)]
        {
            let (ours, theirs) = (column(&place, "a.csv", name), column(&place, &format!("{set}.csv"), name));
            assert!(!ours.is_empty() && ours.len() == theirs.len(), "{set} {name}");
            let worst = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            // Numbers of 24 bits; a cross section is one of them.
            assert!(worst < within, "{set} {name}: {worst}");
        }
        let score = place.run(&format!("score {set}.points --scene run/scene.scene"));
        assert!(score.contains("gospa_m"), "{score}");
    }
}

/// The corner drives by at −3 m/s, the point is at rest.
#[test]
fn static_and_nearest_m_of_a_scene_apply_to_clouds_too() {
    let place = run();
    place.run("export run/frames.points --to kitti --scene run/scene.scene --out kitti --quiet");
    let imported = |settings: &str| {
        let scene = crate::common::SMALL_SCENE.replace("[dsp]", &format!("[dsp]\n{settings}"));
        std::fs::write(place.path("other.toml"), scene).unwrap();
        place.run("import kitti/training/velodyne --scene other.toml --out b.points --quiet");
        place.run("export b.points --to csv --out b.csv --quiet");
        let text = String::from_utf8(place.bytes("b.csv")).unwrap();
        let index = text.lines().next().unwrap().split(',').position(|name| name == "stationary").unwrap();
        text.lines().skip(1).map(|row| row.split(',').nth(index).unwrap().to_owned()).collect::<Vec<_>>()
    };
    let all = imported("static = \"keep\"");
    let marked = imported("static = \"mark\"");
    let at_rest = marked.iter().filter(|mark| *mark == "yes").count();
    assert!(all.iter().all(String::is_empty) && marked.len() == all.len(), "{all:?}, {marked:?}");
    assert!(at_rest > 0 && at_rest < marked.len(), "{marked:?}");
    assert_eq!(imported("static = \"remove\"").len(), all.len() - at_rest);
    assert!(imported("nearest_m = 35.0").len() < all.len());
}

#[test]
fn bodies_of_no_class_have_no_labels_and_that_is_told() {
    let place = Workplace::new();
    let said = |set: &str| {
        let artifact = if set == "kitti" { "points" } else { "rdm" };
        let words = format!("export run/frames.{artifact} --to {set} --scene run/scene.scene --out {set}");
        let output = place.try_run(&words);
        assert!(output.status.success());
        std::fs::remove_dir_all(place.path(set)).unwrap();
        String::from_utf8(output.stderr).unwrap()
    };
    place.run("run small.toml --out run --no-cache --quiet");
    assert!(!["kitti", "carrada"].iter().any(|set| said(set).contains("class")));
    let scene = crate::common::SMALL_SCENE.replace("class = \"car\"\n", "");
    std::fs::write(place.path("small.toml"), scene).unwrap();
    place.run("run small.toml --out run --no-cache --quiet");
    for set in ["kitti", "carrada"] {
        let told = said(set);
        assert!(
            told.contains("run/scene.scene: bodies of corner.obj have no labels, as no class is told"),
            "{told}"
        );
    }
}

/// Noise in the first range cell has no direction, and no place that a sensor sees.
#[test]
fn points_at_the_radar_are_in_no_cloud() {
    let place = Workplace::new();
    let scene = crate::common::SMALL_SCENE.replace("[dsp]", "[dsp]\nfalse_alarm_rate = 0.1");
    let scene = scene.replace("frames = 2", "frames = 30");
    std::fs::write(place.path("small.toml"), scene).unwrap();
    place.run("run small.toml --out run --no-cache --quiet");
    place.run("export run/frames.points --to csv --out a.csv --quiet");
    let ranges = column(&place, "a.csv", "range_m");
    let at_the_radar = ranges.iter().filter(|range_m| **range_m < 1e-3).count();
    assert!(at_the_radar > 0, "of {} points", ranges.len());
    for (set, folder) in [("kitti", "training/velodyne"), ("nuscenes", "samples/RADAR_FRONT")] {
        place.run(&format!("export run/frames.points --to {set} --out {set} --quiet"));
        place.run(&format!("import {set}/{folder} --scene small.toml --out {set}.points --quiet"));
        place.run(&format!("export {set}.points --to csv --out {set}.csv --quiet"));
        assert_eq!(column(&place, &format!("{set}.csv"), "range_m").len(), ranges.len() - at_the_radar);
    }
}

#[test]
fn arrays_are_the_same_with_labels_and_without() {
    let place = run();
    for set in ["raddet", "carrada"] {
        place.run(&format!(
            "export run/frames.rdm --to {set} --scene run/scene.scene --out {set}-told --quiet"
        ));
        place.run(&format!("export run/frames.rdm --to {set} --out {set} --quiet"));
    }
    for file in ["RAD/part1/000000.npy", "RAD/part1/000001.npy"] {
        assert_eq!(place.bytes(&format!("raddet/{file}")), place.bytes(&format!("raddet-told/{file}")));
    }
    assert!(place.path("raddet-told/gt/part1/000001.pickle").is_file() && !place.path("raddet/gt").exists());
    for folder in ["range_doppler_numpy", "range_angle_numpy"] {
        let of = |set: &str| place.bytes(&format!("{set}/{folder}/000001.npy"));
        assert_eq!(of("carrada/sequence"), of("carrada-told/small"));
    }
    let told = place.summary("carrada-told/annotations_frame_oriented.json");
    assert_eq!(told["small"]["000001"]["000000"]["range_angle"]["label"], 3);
    let axes = place.summary("raddet/set.json");
    assert_eq!(axes["axes"]["azimuth_sine"].as_array().unwrap().len(), 256);
}

#[test]
fn sets_are_refused_where_something_is_there_or_the_scene_is_another_one() {
    let place = run();
    let other = crate::common::SMALL_SCENE.replace("chirps = 16", "chirps = 32");
    std::fs::write(place.path("other.toml"), other).unwrap();
    place.run("run other.toml --out other --no-cache --quiet");
    std::fs::create_dir(place.path("full")).unwrap();
    std::fs::write(place.path("full/mine.txt"), "mine").unwrap();
    std::fs::create_dir(place.path("mixed")).unwrap();
    for name in ["mixed/a.bin", "mixed/b.pcd", "cut.mat"] {
        std::fs::write(place.path(name), "MATLAB").unwrap();
    }
    for (command, code, told) in [
        ("export run/frames.points --to kitti --out full", 2, "not empty"),
        ("export run/frames.points --to kitti --out small.toml", 2, "small.toml"),
        ("export run/frames.points --to kitti --scene other/scene.scene --out set", 1, "its radar is not"),
        ("export run/frames.rdm --to raddet --scene run/frames.rdm --out set", 1, "rdm"),
        ("export run/frames.points --to csv --scene run/scene.scene --out set", 2, "--scene is for sets"),
        ("export run/frames.points --to raddet --out set", 1, "kitti, nuscenes"),
        ("import mixed --scene small.toml --out set.points", 1, "all end alike"),
        ("import full --scene small.toml --out set.points", 1, "no file in it ends in .bin or .pcd"),
        ("import mixed/b.pcd --scene small.toml --out set.points", 1, "b.pcd: it ends within its head"),
        ("import cut.mat --scene small.toml --out set.cube", 1, "cut.mat: it is no little-endian MAT-file"),
    ] {
        let output = place.try_run(command);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "{command}: {error}");
        assert!(error.contains(told), "{command}: {error}");
        let left = ["set", "set.points", "set.cube", ".set.wayside.part", ".full.wayside.part"];
        assert!(left.iter().all(|name| !place.path(name).exists()), "{command}");
    }
    assert_eq!(place.bytes("full/mine.txt"), b"mine");
}
