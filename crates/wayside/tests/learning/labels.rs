//! Points with their true origin, and tracks with their metrics, through the whole chain.

#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::Workplace;
use std::collections::BTreeMap;

/// A floor and a wall of a metre, open towards the front; and the wall alone.
const DIHEDRAL: &str = "v 0 -0.5 0\nv 1 -0.5 0\nv 1 0.5 0\nv 0 0.5 0\nv 0 -0.5 1\nv 0 0.5 1\nf 1 2 3\nf 1 3 4\nf 1 4 6\nf 1 6 5\n";
const WALL: &str = "v 0 -0.5 -0.5\nv 0 0.5 -0.5\nv 0 0.5 0.5\nv 0 -0.5 0.5\nf 1 2 3\nf 1 3 4\n";

/// Cells of 0.96 m × 0.6 m/s; each target at a range of its own, the wall as high as the radar.
fn scene(frames: u32) -> String {
    let body = |id: &str, class: &str, y: f64, z: f64, rest: &str| {
        format!(
            "[[target]]\nkind = \"mesh\"\nid = \"{id}\"\nclass = \"{class}\"\nmodel = \"{id}.obj\"\n\
             position_m = [0.0, {y:.1}, {z:.1}]\nvelocity_mps = [0.0, {rest}, 0.0]\nyaw_deg = -90.0\n"
        )
    };
    format!(
        "name = \"labels\"\nframes = {frames}\n[radar.waveform]\nsamples = 64\nchirps = 64\n[radar.array]\npreset = \"1x4\"\n\
         [noise]\nnoise_figure_db = 12.0\n[dsp]\nfalse_alarm_rate = 1e-3\n[fidelity]\naccuracy_db = -20.0\nbounces = 2\n\
         {}{}[[target]]\nkind = \"point\"\nid = \"reflector\"\nrcs_m2 = 30.0\nposition_m = [2.0, 20.0, 1.0]\n\
         velocity_mps = [0.0, 0.0, 0.0]\n",
        body("dihedral", "car", 40.0, 0.0, "-4.0"),
        body("wall", "bus", 30.0, 6.0, "0.0"),
    )
}

fn place(frames: u32) -> Workplace {
    let place = Workplace::new();
    std::fs::write(place.path("dihedral.obj"), DIHEDRAL).unwrap();
    std::fs::write(place.path("wall.obj"), WALL).unwrap();
    std::fs::write(place.path("labels.toml"), scene(frames)).unwrap();
    place.run("run labels.toml --out out --quiet");
    place
}

/// Rows of a table by the names of their columns.
fn table(place: &Workplace, artifact: &str) -> Vec<BTreeMap<String, String>> {
    place.run(&format!("export out/{artifact} --to csv --out table.csv"));
    let text = String::from_utf8(place.bytes("table.csv")).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let head = lines.next().unwrap();
    lines.map(|row| head.iter().cloned().zip(row).collect()).collect()
}

#[test]
fn points_are_labelled_with_target_class_and_bounce_order() {
    let place = place(1);
    let rows = table(&place, "frames.points");
    let number = |row: &BTreeMap<String, String>, key: &str| row[key].parse::<f64>().unwrap();
    let range_of = |y: f64, up: f64| f64::hypot(y, up);
    for (id, class, order, range_m) in [
        // Floor and wall send back what falls on both, whatever its elevation; a wall at right angles one
        // bounce; a point none.
        ("dihedral", "car", "2", range_of(40.0, 6.0)),
        ("wall", "bus", "1", 30.0),
        ("reflector", "", "0", range_of(20.1, 5.0)),
    ] {
        let near = rows.iter().filter(|row| (number(row, "range_m") - range_m).abs() < 1.5);
        let strongest = near.max_by(|a, b| number(a, "snr_db").total_cmp(&number(b, "snr_db"))).unwrap();
        println!("{id}: {strongest:?}");
        let got = ["true_target", "true_class", "true_order"].map(|key| strongest[key].as_str());
        assert_eq!(got, [id, class, order]);
        // First bounces of floor and wall, 8.5° off their mirror directions, are 20 dB and more below.
        assert!(number(strongest, "true_share") > 0.98, "{strongest:?}");
    }
    // 4,096 cells at 1e-3: some points are of noise, which lies on no target's range and has no origin.
    let is_far = |row: &&BTreeMap<String, String>| {
        [40.4, 30.0, 20.7].iter().all(|r| (number(row, "range_m") - r).abs() > 10.0)
    };
    assert!(rows.iter().filter(is_far).all(|row| row["true_target"].is_empty()));
}

#[test]
fn a_run_of_many_frames_has_tracks_with_metrics_and_identities() {
    let place = place(12);
    let summary = place.summary("out/summary.json");
    let metrics = &summary["metrics"];
    println!("{metrics:#}");
    let last = &summary["frames"][11]["tracks"];
    let targets: Vec<&str> = last.as_array().unwrap().iter().filter_map(|t| t["target"].as_str()).collect();
    for id in ["dihedral", "wall", "reflector"] {
        assert!(targets.contains(&id), "{id} has a track: {last:#}");
    }
    assert_eq!(metrics["identities"]["switches"], 0);
    assert_eq!(metrics["identities"]["purity"], 1.0);
    // Believed from the third of twelve frames on: ten of twelve frames for three bodies, were the detector
    // never to miss.
    assert!(metrics["tracks"]["found"].as_u64().unwrap() <= 30);
    assert!(metrics["tracks"]["found"].as_u64().unwrap() >= 27, "{metrics:#}");
    let rows = table(&place, "frames.tracks");
    assert!(rows.iter().any(|row| row["state"] == "confirmed"));
    let text = String::from_utf8(place.bytes("out/report.html")).unwrap();
    assert!(text.contains("GOSPA"));
}

/// A point a third beyond the range that the waveform tells, and one on top of a wheel that drives: their
/// echoes stand where neither body is, and are theirs all the same.
#[test]
fn echoes_that_fold_in_range_and_those_of_a_rim_have_their_targets() {
    for (sampling, far_m) in [("complex", 80.0), ("real", 45.0)] {
        let place = Workplace::new();
        let scene = format!(
            "name = \"folded\"\n[radar]\nposition_m = [0.0, 0.0, 1.0]\n[radar.waveform]\nchirps = 64\n\
             [radar.receiver]\nsampling = \"{sampling}\"\n[radar.array]\npreset = \"3x4\"\n[noise]\nnoise_figure_db = 12.0\n[dsp]\nassumed_height_m = 1.0\n\
             [[target]]\nkind = \"point\"\nid = \"far\"\nrcs_m2 = 200.0\nposition_m = [5.0, {far_m:.1}, 1.0]\n\
             velocity_mps = [0.0, -5.0, 0.0]\n\
             [[target]]\nkind = \"point\"\nid = \"rim\"\nrcs_m2 = 20.0\nposition_m = [0.0, 25.0, 0.33]\n\
             velocity_mps = [0.0, -6.0, 0.0]\nwheel_radius_m = 0.33\nwheel_angle_deg = 90.0\n"
        );
        std::fs::write(place.path("folded.toml"), scene).unwrap();
        place.run("run folded.toml --out out --quiet");
        let rows = table(&place, "frames.points");
        let strong = rows.iter().filter(|row| row["snr_db"].parse::<f64>().unwrap() > 15.0);
        let mut known: BTreeMap<&str, usize> = BTreeMap::new();
        strong.for_each(|row| *known.entry(row["true_target"].as_str()).or_default() += 1);
        println!("{sampling}: {known:?}");
        assert!(known.len() == 2 && known.contains_key("far") && known.contains_key("rim"), "{known:?}");
        let summary = place.summary("out/summary.json");
        let rim = &summary["frames"][0]["targets"][1];
        assert_eq!(rim["found"], true, "{rim}");
        let error =
            |key: &str| (rim["estimate"][key].as_f64().unwrap() - rim["truth"][key].as_f64().unwrap()).abs();
        assert!(error("range_m") < 0.05 && error("radial_velocity_mps") < 0.05, "{rim}");
    }
}
