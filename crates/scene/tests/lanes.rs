//! Lanes: the paper's where a scene of one's own says nothing, none beside recorded traffic, those of the
//! network that was recorded.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

use artifact::settings::Lanes;
use scene::ReadOptions;
use std::path::{Path, PathBuf};

const FCD: &str = "<fcd-export><timestep time=\"0\"/></fcd-export>";

/// Two edges of two lanes, a footpath, a way through the junction that lies across them, and a lane out of
/// view.
const NET: &str = "<?xml version=\"1.0\"?>
<net version=\"1.20\">
 <edge id=\":c_0\" function=\"internal\"><lane id=\":c_0_0\" index=\"0\" shape=\"2,30 2,-4\" width=\"3.75\"/></edge>
 <edge id=\"n_in\" from=\"n\" to=\"c\">
  <lane id=\"n_in_0\" index=\"0\" speed=\"13.89\" length=\"70\" width=\"3.75\" shape=\"2.00,100.00 2.00,30.00\"/>
  <lane id=\"n_in_1\" index=\"1\" speed=\"13.89\" length=\"70\" width=\"3.75\" shape=\"5.75,100.00,0.5 5.75,30.00,0.5\"/>
 </edge>
 <edge id=\"bend\" from=\"a\" to=\"b\">
  <lane id=\"walk\" index=\"0\" allow=\"pedestrian\" shape=\"-9,0 -9,50\" width=\"2\"/>
  <lane id=\"bend_1\" index=\"1\" shape=\"-20,10 -10,10 -10,20 -10,20\"/>
 </edge>
 <edge id=\"far\"><lane id=\"far_0\" index=\"0\" shape=\"900,900 1000,900\"/></edge>
</net>";

fn read(net: &str, text: &str) -> Result<Lanes, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("t.fcd.xml"), FCD).unwrap();
    std::fs::write(folder.path().join("t.net.xml"), net).unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, format!("name = \"lanes\"\n{text}\n")).unwrap();
    let options = ReadOptions::whole();
    let root = format!("{}/", folder.path().display());
    scene::read(&file, &options).map(|scene| scene.dsp.road).map_err(|e| e.to_string().replace(&root, ""))
}

const TRAFFIC: &str = "[traffic]\nfcd = \"t.fcd.xml\"\n";
const WITH_NET: &str = "[traffic]\nfcd = \"t.fcd.xml\"\nnet = \"t.net.xml\"\n";

#[test]
fn beside_recorded_traffic_there_are_no_lanes_that_nobody_said() {
    let none = read(NET, TRAFFIC).unwrap();
    assert!(none.lanes.is_empty() && none.courses.is_empty());
    assert_eq!(none.at([2.0, 40.0, 0.0]), None, "the paper's lane 1");
    let said = read(NET, &format!("[intersection]\nlane_width_m = 3.5\n{TRAFFIC}")).unwrap();
    assert_eq!((said.lanes.len(), said.at([2.0, 40.0, 0.0])), (3, Some(1)));
    assert_eq!(
        read(NET, "").unwrap().at([5.75, 40.0, 0.0]),
        Some(2),
        "a scene without a recording has the paper's"
    );
}

/// A road without lanes has its across direction across the line of sight.
#[test]
fn without_lanes_the_road_runs_where_the_radar_looks() {
    let radar = "[radar]\nposition_m = [10.0, 20.0, 6.0]\nboresight_az_deg = 90.0\n";
    let road = read(NET, &format!("{radar}{TRAFFIC}")).unwrap();
    let [across_m, along_m] = road.across_along_m([40.0, 20.0, 0.0]);
    assert!(across_m.abs() < 1e-12 && (along_m - 30.0).abs() < 1e-12, "{across_m} {along_m}");
}

#[test]
fn a_road_without_lanes_runs_as_its_scene_says() {
    let without =
        "[intersection]\nlane_centres_m = []\nlane_azimuth_deg = 30.0\nlane_origin_m = [5.0, 7.0]\n";
    let road = read(NET, without).unwrap();
    assert_eq!((road.lanes.len(), road.origin_m), (0, [5.0, 7.0]));
    assert!((road.azimuth_rad.to_degrees() - 30.0).abs() < 1e-12);
    let own = "[radar.intersection]\nlane_azimuth_deg = 40.0\n";
    let road = read(NET, &format!("{own}{without}")).unwrap();
    assert!((road.azimuth_rad.to_degrees() - 40.0).abs() < 1e-12 && road.origin_m == [5.0, 7.0]);
    let taken_away = "[radar]\nboresight_az_deg = 90.0\n[radar.intersection]\nlane_centres_m = []\n";
    let road = read(NET, &format!("{taken_away}[intersection]\nlane_azimuth_deg = 30.0\n")).unwrap();
    assert!((road.azimuth_rad.to_degrees() - 90.0).abs() < 1e-12, "along the boresight");
}

#[test]
fn lanes_of_one_radar_are_as_wide_as_the_scene_says() {
    let own = "[radar.intersection]\nlane_centres_m = [0.0]\n";
    let scenes = "[intersection]\nlane_width_m = 5.0\nlane_centres_m = []\n";
    assert_eq!(read(NET, &format!("{own}{scenes}")).unwrap().lanes[0].width_m, 5.0);
}

#[test]
fn a_target_cannot_stand_in_a_lane_that_there_is_not() {
    let target = "[[target]]\nkind = \"point\"\nid = \"p\"\nrcs_m2 = 1.0\nlane = 2\ny_m = 40.0\n";
    let refused = read(NET, &format!("{TRAFFIC}{target}")).unwrap_err();
    assert!(refused.contains("lane 2 does not exist: the scene has no lanes"), "{refused}");
}

#[test]
fn lanes_of_a_network_have_its_shapes_widths_and_names() {
    let road = read(NET, WITH_NET).unwrap();
    let told: Vec<_> = road.courses.iter().map(|c| (c.number, c.name.as_str(), c.width_m)).collect();
    // SUMO's own width where the lane has none; numbered in the order of the file.
    assert_eq!(told, [(1, "n_in_0", 3.75), (2, "n_in_1", 3.75), (3, "bend_1", 3.2)]);
    let at = |x: f64, y: f64| road.at([x, y, 0.75]);
    assert_eq!(
        (at(2.0, 40.0), at(3.8, 40.0), at(3.95, 40.0), at(7.7, 40.0)),
        (Some(1), Some(1), Some(2), None)
    );
    // Before a lane's beginning and behind its end there is none; a bend has no gap at its corner, inside or
    // outside.
    assert_eq!((at(2.0, 29.9), at(2.0, 100.1), at(-20.1, 10.0)), (None, None, None));
    assert_eq!((at(-9.0, 9.0), at(-10.5, 10.5), at(-11.7, 15.0)), (Some(3), Some(3), None));
    assert_eq!((at(-10.0, 19.9), at(-10.0, 20.1)), (Some(3), None), "the last part has no length");
}

#[test]
fn a_lane_of_a_network_ends_where_its_last_part_ends_however_short_that_is() {
    let lane =
        "<edge id=\"a\"><lane id=\"a_0\" index=\"0\" shape=\"10,100 10,50.2 10,50\" width=\"3.2\"/></edge>";
    let road = read(&format!("<net version=\"1.20\">{lane}</net>"), WITH_NET).unwrap();
    let at = |y: f64| road.at([10.0, y, 0.75]);
    assert_eq!((at(100.1), at(99.9), at(50.1), at(49.9), at(49.0)), (None, Some(1), Some(1), None, None));
}

#[test]
fn a_network_and_an_intersection_exclude_one_another() {
    let refused = read(NET, &format!("[intersection]\nlane_width_m = 3.5\n{WITH_NET}")).unwrap_err();
    assert!(refused.contains("`net` and `[intersection]` exclude one another"), "{refused}");
}

#[test]
fn a_broken_network_is_refused_with_line_and_rule() {
    let nested = format!("<net>{}", "<edge>".repeat(100_000));
    let many = format!("<net>{}</net>", "<edge><lane id=\"a\" shape=\"0,1 0,2\"/></edge>".repeat(256));
    for (net, asked) in [
        ("", "t.net.xml:1: the file ends before </net>"),
        ("<fcd-export/>", "t.net.xml:1: the first element is <fcd-export>; networks begin with <net>"),
        ("<net>\n<edge>\n", "t.net.xml:3: the file ends before </net>"),
        (
            "<net><edge><lane id=\"a\"/></edge></net>",
            "t.net.xml:1: <lane id=\"a\">: attribute `shape` is missing",
        ),
        ("<net><lane id=\"a\" shape=\"1,2\"/></net>", "`shape` is `1,2`; it must be two places x,y or more"),
        ("<net><lane id=\"a\" shape=\"1,2 1,2\"/></net>", "`shape` is `1,2 1,2`"),
        ("<net><lane id=\"a\" shape=\"1,2 nan,3\"/></net>", "`shape` is `1,2 nan,3`"),
        ("<net><lane id=\"a\" shape=\"1,2 1e6,3\"/></net>", "m within ±1e5"),
        (
            "<net>\n<lane id=\"a\" width=\"-1\" shape=\"1,2 1,3\"/></net>",
            "t.net.xml:2: <lane id=\"a\">: `width` is `-1`",
        ),
        (nested.as_str(), "elements lie within one another more than 64 deep"),
        (
            "<net><edge><lane id=\"a\" shape=\"900,900 990,900\"/></edge></net>",
            "none of its 1 lanes comes within 61.4 m",
        ),
        ("<net/>", "none of its 0 lanes"),
        (many.as_str(), "more than 255 lanes are in view: see less far by `view_range_m`"),
    ] {
        let refused = read(net, WITH_NET).unwrap_err();
        assert!(refused.contains(asked), "{refused}\n{asked}");
    }
}

/// A junction recorded with SUMO 1.28: its southbound lanes are those of Table 1.
#[test]
fn the_network_of_a_recorded_junction_has_the_lanes_that_its_readme_tells() {
    let beside = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared")).to_owned();
    let root = std::env::var_os("WAYSIDE_SHARED").map_or(beside, PathBuf::from);
    let Ok(net) = std::fs::read_to_string(root.join("sumo/junction4.net.xml")) else {
        println!("skipped: the recording is not here");
        return;
    };
    let road = read(&net, WITH_NET).unwrap();
    let name_at = |x: f64, y: f64| {
        let number = road.at([x, y, 0.0])?;
        road.courses.iter().find(|c| c.number == number).map(|c| c.name.as_str())
    };
    for (x, name) in [(2.0, "n_in_0"), (5.75, "n_in_1"), (9.5, "n_in_2")] {
        assert_eq!(name_at(x, 40.0), Some(name));
    }
    assert_eq!(name_at(-20.0, 9.375), Some("w_in_2"), "where w_n.1 waits");
    assert_eq!(name_at(11.375, 11.25), None, "within the junction");
    assert!(road.courses.iter().all(|c| c.width_m == 3.75));
}
