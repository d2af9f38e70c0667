//! What stands about in a street, and the road itself, through the whole chain: seen, never compared with.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking; clippy knows only functions marked as tests")]

mod common;

use common::Workplace;
use serde_json::Value;

/// A small radar over a road that sends back of itself; a reflector at 30 m, a pole in the middle of the lane beside it, at 20 m.
fn scene(noise: &str, road: &str) -> String {
    format!(
        "name = \"street\"\nframes = 2\n[radar.waveform]\nsamples = 64\nchirps = 16\n[radar.array]\npreset = \"1x4\"\n{noise}\
         [dsp]\ntraining_cells = [3, 6]\n{road}[[target]]\nkind = \"point\"\nid = \"reflector\"\nrcs_m2 = 10.0\nposition_m = [2.0, 30.0, 1.0]\n\
         velocity_mps = [0.0, 0.0, 0.0]\n[[clutter]]\nid = \"mast\"\nmodel = \"pole\"\nheight_m = 8.0\nposition_m = [5.75, 20.0, 0.0]\n"
    )
}

const NOISE: &str = "[noise]\nnoise_figure_db = 12.0\n";
const FLOOR: &str = "[road]\nmirror = \"off\"\nbackscatter = \"floor\"\n";

fn place(noise: &str, road: &str) -> Workplace {
    let place = Workplace::new();
    std::fs::write(place.path("street.toml"), scene(noise, road)).unwrap();
    place
}

fn ids(list: &Value) -> Vec<&str> {
    list.as_array().unwrap().iter().map(|body| body["id"].as_str().unwrap()).collect()
}

/// A pole higher than the radar shows where it is seen square on, at the radar's height: √(5.75² + 20²) = 20.81 m, less its radius.
#[test]
fn a_pole_is_seen_and_labelled_and_is_no_target() {
    let place = place(NOISE, "");
    place.run("run street.toml --out out --quiet");
    let summary = place.summary("out/summary.json");
    for frame in summary["frames"].as_array().unwrap() {
        assert_eq!((ids(&frame["targets"]), ids(&frame["clutter"])), (vec!["reflector"], vec!["mast"]));
        let nearest_m = frame["clutter"][0]["nearest_range_m"].as_f64().unwrap();
        println!("nearest range asked 20.75 m, got {nearest_m:.3} m");
        assert!((nearest_m - 20.753).abs() < 0.002, "{nearest_m}");
        assert!(!frame["targets"][0]["estimate"].is_null());
    }
    // What is found of the pole is false, whoever asks for vehicles.
    assert_eq!(summary["metrics"]["objects"]["found"], 2);
    assert!(summary["metrics"]["objects"]["false"].as_u64().unwrap() >= 2, "{}", summary["metrics"]["objects"]);
    place.run("export out/frames.points --to csv --out points.csv");
    let table = String::from_utf8(place.bytes("points.csv")).unwrap();
    assert!(table.lines().any(|line| line.contains("mast")), "{table}");
}

#[test]
fn the_floor_is_the_same_in_every_frame_and_on_any_number_of_threads() {
    let place = place("", FLOOR);
    place.run("run street.toml --out one --threads 1 --no-cache --quiet");
    place.run("run street.toml --out two --threads 2 --no-cache --quiet");
    assert_eq!(place.bytes("one/frames.cube"), place.bytes("two/frames.cube"));
    place.run("export one/frames.cube --to npy --out cube.npy");
    let values = place.bytes("cube.npy");
    // A header of a multiple of 64 bytes, then two frames that stand still, without noise.
    let frame_bytes = 4 * 16 * 64 * 8;
    let (first, second) = values[values.len() - 2 * frame_bytes..].split_at(frame_bytes);
    assert!(first == second);
}

#[test]
fn a_floor_raises_the_cells_before_the_radar_and_hides_no_strong_target() {
    let quiet = place(NOISE, "");
    quiet.run("run street.toml --out out --quiet");
    std::fs::write(quiet.path("floor.toml"), scene(NOISE, FLOOR)).unwrap();
    quiet.run("run floor.toml --out floor --quiet");
    let points = |name: &str| quiet.summary(name)["frames"][0]["points"].as_u64().unwrap();
    println!("{} points without, {} with a floor", points("out/summary.json"), points("floor/summary.json"));
    assert!(!quiet.summary("floor/summary.json")["frames"][0]["targets"][0]["estimate"].is_null());
    assert_ne!(quiet.bytes("out/frames.cube"), quiet.bytes("floor/frames.cube"));
    let paths = |name: &str| quiet.summary(name)["frames"][0]["paths"].clone();
    assert_eq!(paths("out/summary.json"), paths("floor/summary.json"), "the floor is in no .paths");
}
