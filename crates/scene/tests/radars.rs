//! Several radars in one scene file.

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too; clippy knows only marked functions")]

use scene::ReadOptions;
use std::path::{Path, PathBuf};

const TWO: &str = r#"name = "crossing"
[radar]
boresight_el_deg = -8.0
[radar.waveform]
chirps = 64
[intersection]
lane_width_m = 3.5
lane_centres_m = [2.0, 6.0]
[[radars]]
id = "north"
[[radars]]
id = "east"
position_m = [-11.0, 11.0, 5.0]
boresight_az_deg = 90.0
[radars.waveform]
idle_us = 20.0
[radars.intersection]
lane_origin_m = [-11.0, 11.0]
lane_azimuth_deg = 90.0
[[target]]
kind = "point"
id = "reflector"
rcs_m2 = 1.0
lane = 2
y_m = 30.0
"#;

fn file(folder: &Path, text: &str) -> PathBuf {
    let file = folder.join("scene.toml");
    std::fs::write(&file, text).unwrap();
    file
}

fn options(radar: Option<&str>) -> ReadOptions {
    ReadOptions { radar: radar.map(str::to_owned), ..ReadOptions::whole() }
}

fn complaint(text: &str, radar: Option<&str>) -> String {
    let folder = tempfile::tempdir().unwrap();
    let errors = scene::read(&file(folder.path(), text), &options(radar)).unwrap_err().to_string();
    errors.replace(&format!("{}/", folder.path().display()), "")
}

#[test]
fn each_radar_has_what_its_entry_says_and_else_what_radar_says() {
    let folder = tempfile::tempdir().unwrap();
    let file = file(folder.path(), TWO);
    assert_eq!(scene::radars(&file).unwrap(), ["north", "east"]);
    let [north, east] = ["north", "east"].map(|id| scene::read(&file, &options(Some(id))).unwrap());
    assert_eq!((north.name.as_str(), east.name.as_str()), ("crossing/north", "crossing/east"));
    assert_eq!((north.radar.position_m, east.radar.position_m), ([0.0, 0.0, 6.0], [-11.0, 11.0, 5.0]));
    assert_eq!(east.radar.boresight_az_rad.to_degrees(), 90.0);
    for scene in [&north, &east] {
        assert_eq!(scene.radar.boresight_el_rad.to_degrees(), -8.0);
        assert_eq!(scene.radar.waveform.chirps, 64);
        // Targets are the scene's, whichever radar looks at them.
        assert_eq!(scene.targets[0].start.position_m, [6.0, 30.0, 0.0]);
        assert_eq!(
            scene.dsp.road.lanes.iter().map(|l| (l.centre_m, l.width_m)).collect::<Vec<_>>(),
            [(2.0, 3.5), (6.0, 3.5)]
        );
    }
    assert!(
        (east.radar.waveform.chirp_interval_s - north.radar.waveform.chirp_interval_s - 10e-6).abs() < 1e-12
    );
    // Lane 1 of the east, 40 m along it.
    let [x_m, y_m] = east.dsp.road.world_m([2.0, 40.0]);
    assert!((x_m - 29.0).abs() < 1e-12 && (y_m - 9.0).abs() < 1e-12, "{x_m} {y_m}");
    assert_eq!(east.dsp.road.at([x_m, y_m, 0.75]), Some(1));
    assert_eq!(north.dsp.road.at([x_m, y_m, 0.75]), None);
}

#[test]
fn a_scene_of_several_radars_is_read_through_one_of_them() {
    let many = "scene.toml:9:1: the scene has several radars, and is read as one of them has it: `north`, \
                `east`; choose one by --radar, in a study and in Python by `radar`";
    assert_eq!(complaint(TWO, None), many);
    assert_eq!(
        complaint(TWO, Some("west")),
        "scene.toml:9:1: there is no radar `west`; there are `north`, `east`"
    );
    let alone = "scene.toml:1:1: there is no radar `west`; the only one is that of [radar], without a name";
    assert_eq!(complaint("name = \"one\"\n", Some("west")), alone);
}

#[test]
fn what_is_wrong_with_an_entry_is_told_in_its_line() {
    let wrong = TWO
        .replace("idle_us = 20.0", "idle_us = -20.0")
        .replace("boresight_az_deg = 90.0", "boresite = 90.0");
    let told = complaint(&wrong, Some("east"));
    assert!(told.contains("scene.toml:14:1: radar `east`: unknown key `boresite`"), "{told}");
    assert_eq!(told.matches("`boresite`").count(), 1, "{told}");
    assert!(told.contains("scene.toml:16:11: [radar.waveform]: `idle_us`"), "{told}");
    let twice = complaint(&TWO.replace("id = \"east\"", "id = \"north\""), Some("north"));
    assert!(twice.contains("radar `north`") && twice.contains("line 9"), "{twice}");
    let nameless = complaint(&TWO.replace("id = \"east\"\n", ""), Some("north"));
    assert!(nameless.contains("radar `#2`: ") && nameless.contains("`id`"), "{nameless}");
}
