//! Lanes: the paper's where a scene says nothing, none beside recorded traffic.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

use artifact::settings::Lanes;
use scene::{Meshes, ReadOptions};

const FCD: &str = "<fcd-export><timestep time=\"0\"/></fcd-export>";

fn read(text: &str) -> Result<Lanes, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("t.fcd.xml"), FCD).unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, format!("name = \"lanes\"\n{text}\n")).unwrap();
    let options = ReadOptions { model: None, radar: None, meshes: Meshes::Whole };
    let root = format!("{}/", folder.path().display());
    scene::read(&file, &options).map(|scene| scene.dsp.road).map_err(|e| e.to_string().replace(&root, ""))
}

const TRAFFIC: &str = "[traffic]\nfcd = \"t.fcd.xml\"\n";
#[test]
fn beside_recorded_traffic_there_are_no_lanes_that_nobody_said() {
    let none = read(TRAFFIC).unwrap();
    assert!(none.lanes.is_empty());
    assert_eq!(none.at([2.0, 40.0, 0.0]), None, "the paper's lane 1");
    let said = read(&format!("[intersection]\nlane_width_m = 3.5\n{TRAFFIC}")).unwrap();
    assert_eq!((said.lanes.len(), said.at([2.0, 40.0, 0.0])), (3, Some(1)));
    assert_eq!(read("").unwrap().at([5.75, 40.0, 0.0]), Some(2), "a scene without a recording has the paper's");
}

/// Without lanes the way across is across the line of sight.
#[test]
fn without_lanes_the_road_runs_where_the_radar_looks() {
    let radar = "[radar]\nposition_m = [10.0, 20.0, 6.0]\nboresight_az_deg = 90.0\n";
    let road = read(&format!("{radar}{TRAFFIC}")).unwrap();
    let [across_m, along_m] = road.across_along_m([40.0, 20.0, 0.0]);
    assert!(across_m.abs() < 1e-12 && (along_m - 30.0).abs() < 1e-12, "{across_m} {along_m}");
}

#[test]
fn a_target_cannot_stand_in_a_lane_that_there_is_not() {
    let target = "[[target]]\nkind = \"point\"\nid = \"p\"\nrcs_m2 = 1.0\nlane = 2\ny_m = 40.0\n";
    let refused = read(&format!("{TRAFFIC}{target}")).unwrap_err();
    assert!(refused.contains("lane 2 does not exist: the scene has no lanes"), "{refused}");
}
