//! Clutter that stands about in a street, and the road itself, through the whole chain: seen, never compared
//! with.

#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::Workplace;
use serde_json::Value;

/// A small radar over a road that sends back of itself; a reflector at 30 m, a pole in the middle of the lane
/// beside it, at 20 m.
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

/// A pole higher than the radar shows where it is seen square on, at the radar's height: √(5.75² + 20²) =
/// 20.81 m, less its radius.
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
    assert!(
        summary["metrics"]["objects"]["false"].as_u64().unwrap() >= 2,
        "{}",
        summary["metrics"]["objects"]
    );
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

/// Places the street with a car besides, at two of the small radar's Doppler cells of 5.4 m/s; a scene for
/// each value of `static`.
fn with_static() -> Workplace {
    let car = "[fidelity]\naccuracy_db = -10.0\nbounces = 1\n[[target]]\nkind = \"point\"\nid = \"car\"\nrcs_m2 = 10.0\n\
               position_m = [2.0, 40.0, 1.0]\nvelocity_mps = [0.0, -11.0, 0.0]\n";
    let place = Workplace::new();
    for word in ["keep", "mark", "remove"] {
        let text = scene(NOISE, "").replace("[dsp]\n", &format!("[dsp]\nstatic = \"{word}\"\n"));
        std::fs::write(place.path(&format!("{word}.toml")), text + car).unwrap();
    }
    place
}

fn of_target<'a>(frame: &'a Value, id: &str) -> &'a Value {
    frame["targets"].as_array().unwrap().iter().find(|target| target["id"] == id).unwrap()
}

#[test]
fn clutter_at_rest_is_counted_apart_where_it_is_marked_and_what_waits_is_found_all_the_same() {
    let place = with_static();
    let said = ["keep", "mark"].map(|word| place.run(&format!("run {word}.toml --out {word}")));
    assert!(said[0].contains("false objects are clutter: static = \"mark\""), "{}", said[0]);
    assert!(said[1].contains("at rest and of no target: ") && !said[1].contains("static ="), "{}", said[1]);
    let [kept, marked] = ["keep", "mark"].map(|word| place.summary(&format!("{word}/summary.json")));
    let count = |summary: &Value, key: &str| summary["metrics"]["objects"][key].as_u64().unwrap();
    assert!(count(&kept, "false") >= 2 && count(&kept, "stationary") == 0, "{}", kept["metrics"]["objects"]);
    // Every object of the one is there in the other: false or at rest.
    assert_eq!(count(&marked, "false") + count(&marked, "stationary"), count(&kept, "false"));
    assert!(count(&marked, "stationary") >= 2, "{}", marked["metrics"]["objects"]);
    for (before, after) in kept["frames"].as_array().unwrap().iter().zip(marked["frames"].as_array().unwrap())
    {
        let standing = after["stationary_objects"].as_array().unwrap();
        assert!(
            standing.iter().any(|object| object["cause"] == "clutter" && object["bodies"][0] == "mast"),
            "{after}"
        );
        assert!(
            after["false_objects"].as_array().unwrap().iter().all(|object| object["cause"] != "clutter"),
            "{after}"
        );
        for (id, rests) in [("reflector", true), ("car", false)] {
            let (old, new) = (of_target(before, id), of_target(after, id));
            assert_eq!(
                (&new["found"], &new["estimate"]["stationary"]),
                (&true.into(), &rests.into()),
                "{new}"
            );
            assert_eq!(
                (&old["estimate"]["range_m"], &old["estimate"]["stationary"]),
                (&new["estimate"]["range_m"], &Value::Null)
            );
        }
        assert!(before["stationary_points"].is_null() && after["stationary_points"].as_u64().unwrap() >= 2);
        assert_eq!(before["points"], after["points"]);
    }
    place.run("export mark/frames.points --to csv --out points.csv");
    let table = String::from_utf8(place.bytes("points.csv")).unwrap();
    let column = table.lines().next().unwrap().split(',').position(|name| name == "stationary").unwrap();
    let is_told = |word: &str| table.lines().any(|line| line.split(',').nth(column) == Some(word));
    assert!(is_told("yes") && is_told("no"), "{table}");
    let report = String::from_utf8(place.bytes("mark/report.html")).unwrap();
    assert!(report.contains("object at rest that is no body") && report.contains("point at rest"));
}

#[test]
fn what_was_removed_as_an_echo_at_rest_is_told_so_and_is_not_missed() {
    let place = with_static();
    let said = place.run("run remove.toml --out out");
    assert!(
        said.contains("1 removed as echoes at rest")
            && said.contains("removed as an echo at rest (static in [dsp])"),
        "{said}"
    );
    let summary = place.summary("out/summary.json");
    let objects = &summary["metrics"]["objects"];
    assert_eq!([&objects["found"], &objects["missed"], &objects["removed"]], [&2, &0, &2], "{objects}");
    for frame in summary["frames"].as_array().unwrap() {
        let [reflector, car] = ["reflector", "car"].map(|id| of_target(frame, id));
        assert_eq!(
            (&reflector["removed"], &reflector["found"], &reflector["estimate"]),
            (&true.into(), &Value::Null, &Value::Null)
        );
        assert_eq!((&car["removed"], &car["found"]), (&false.into(), &true.into()));
        assert!(
            frame["false_objects"].as_array().unwrap().iter().all(|object| object["cause"] != "clutter"),
            "{frame}"
        );
    }
}

/// A guard rail's cells are weak each and in phase with their neighbours: 18 of 1,900 were kept, as if phases
/// were independent, and −9.4 dB reached of the −10.5 asked for, however small the cells were. 27 leave
/// −13.5.
#[test]
fn weak_cells_of_a_rail_are_dropped_by_what_they_are_together() {
    let place = Workplace::new();
    let scene = "name = \"rail\"\n[radar]\nboresight_el_deg = -8.0\n[radar.waveform]\nchirps = 128\nsamples = 256\n\
         [radar.array]\npreset = \"1x4\"\n[noise]\nnoise_figure_db = 12.0\n\
         [fidelity]\naccuracy_db = -10.5\nbounces = 2\n[[clutter]]\nid = \"rail\"\n\
         model = \"guard-rail\"\nposition_m = [13.0, 18.85, 0.0]\nlength_m = 7.3\n";
    std::fs::write(place.path("rail.toml"), scene).unwrap();
    place.run("run rail.toml --out out --no-cache --quiet");
    let frame = &place.summary("out/summary.json")["frames"][0];
    let accuracy = &frame["accuracy"];
    assert_eq!(accuracy["met"], true, "{accuracy}");
    assert!(frame["paths"].as_u64().unwrap() < 500, "{frame}");
}
