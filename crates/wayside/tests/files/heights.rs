//! Heights that nobody measured are told as such wherever points go.
#![allow(clippy::unwrap_used, reason = "a helper of tests fails the test")]

use crate::common::{SMALL_SCENE, Workplace};

/// Points of a radar with this array.
fn points_of(array: &str) -> Workplace {
    let place = Workplace::new();
    std::fs::write(place.path("small.toml"), SMALL_SCENE.replace("1x4", array)).unwrap();
    place.run("echo small.toml --out a.cube --quiet");
    place.run("dsp a.cube --out . --quiet");
    place
}

/// Arrays without elevation rows and with them, whether heights are measured, and how sets tell it.
const ARRAYS: [(&str, &str, &str); 2] = [("1x4", "0", "assumed at 0.75 m"), ("6x8", "1", "measured")];

#[test]
fn clouds_have_a_field_that_says_whether_heights_are_measured() {
    for (array, measured, _) in ARRAYS {
        let place = points_of(array);
        for (format, head, end) in [
            ("pcd", "FIELDS x y z velocity snr frame object height_measured\n", "DATA ascii\n"),
            ("ply", "property uchar height_measured\n", "end_header\n"),
        ] {
            place.run(&format!("export a.points --to {format} --out a.{format}"));
            let text = String::from_utf8(place.bytes(&format!("a.{format}"))).unwrap();
            let (told, rows) = text.split_once(end).unwrap();
            assert!(told.contains(head), "{told}");
            let columns = head.split(' ').count() - 1;
            assert!(format != "pcd" || rows.lines().all(|row| row.split(' ').count() == columns), "{rows}");
            let is_told = |row: &str| row.rsplit(' ').next() == Some(measured);
            assert!(!rows.is_empty() && rows.lines().all(is_told), "{array} {format}: {rows}");
        }
    }
}

#[test]
fn sets_whose_clouds_have_no_room_for_it_tell_it_in_their_description() {
    for (array, _, heights) in ARRAYS {
        let place = points_of(array);
        for set in ["kitti", "nuscenes"] {
            place.run(&format!("export a.points --to {set} --out {set} --quiet"));
            assert_eq!(place.summary(&format!("{set}/set.json"))["heights"], heights, "{array} {set}");
        }
    }
}

#[test]
fn heights_of_a_set_are_read_as_its_description_tells_them() {
    for (array, measured, _) in ARRAYS {
        let place = points_of(array);
        for (set, clouds) in [("kitti", "training/velodyne"), ("nuscenes", "samples/RADAR_FRONT")] {
            place.run(&format!("export a.points --to {set} --out {set} --quiet"));
            place.run(&format!("import {set}/{clouds} --scene small.toml --out {set}.points --quiet"));
            place.run(&format!("export {set}.points --to csv --out {set}.csv --quiet"));
            let table = String::from_utf8(place.bytes(&format!("{set}.csv"))).unwrap();
            let height = if measured == "1" { "measured" } else { "assumed" };
            let mut rows = table.lines().skip(1).peekable();
            let is_told = |row: &str| row.rsplit(',').next() == Some(height);
            assert!(rows.peek().is_some() && rows.all(is_told), "{set}: {table}");
        }
    }
}

#[test]
fn an_export_of_points_says_that_their_heights_are_assumed() {
    for (array, measured, heights) in ARRAYS {
        let place = points_of(array);
        for format in ["pcd", "ply", "csv", "json", "kitti"] {
            let output = place.try_run(&format!("export a.points --to {format} --out out.{format}"));
            let said = String::from_utf8_lossy(&output.stderr);
            let note = format!("a.points: heights are {heights}, not measured");
            assert_eq!(said.contains(&note), measured == "0", "{array} {format}: {said}");
        }
    }
}

#[test]
fn a_cloud_that_tells_no_heights_is_said_to_have_assumed_ones_and_not_which() {
    let place = points_of("1x4");
    place.run("export a.points --to nuscenes --out set --quiet");
    place.run("import set/samples/RADAR_FRONT --scene small.toml --out b.points --quiet");
    place.run("export b.points --to kitti --out again --quiet");
    let heights = place.summary("again/set.json")["heights"].as_str().unwrap().to_owned();
    assert!(heights.starts_with("assumed"), "{heights}");
}
