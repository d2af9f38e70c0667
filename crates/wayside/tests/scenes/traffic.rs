//! Recorded traffic through the chain: a queue in which vehicles hide others, and the same bytes however many
//! frames are computed side by side.
#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::Workplace;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// A small radar, first reflections at −10 dB, and a recording that stands still for two steps.
fn scene(name: &str) -> String {
    format!(
        "name = \"{name}\"\n[radar.waveform]\nsamples = 64\nchirps = 16\nslope_mhz_per_us = 6.25\n\
         [radar.array]\npreset = \"1x4\"\n[noise]\nnoise_figure_db = 12.0\n[dsp]\ntraining_cells = [3, 6]\n\
         [fidelity]\naccuracy_db = -10.0\nbounces = 1\n[traffic]\nfcd = \"{name}.fcd.xml\"\n"
    )
}

/// Vehicles (id, type, x, y of the front bumper) towards the radar at a speed, for so many steps.
fn recording(vehicles: &[(&str, &str, f64, f64)], speed_mps: f64, steps: u32) -> String {
    let mut text = String::from("<fcd-export>\n");
    for step in 0..steps {
        let time_s = f64::from(step) * 0.1;
        let _ = writeln!(text, "<timestep time=\"{time_s:.2}\">");
        for (id, kind, x, y) in vehicles {
            let (y, rest) =
                (y - speed_mps * time_s, format!("angle=\"180\" type=\"{kind}\" speed=\"{speed_mps}\""));
            let _ = writeln!(text, "<vehicle id=\"{id}\" x=\"{x}\" y=\"{y:.3}\" {rest}/>");
        }
        text += "</timestep>\n";
    }
    text + "</fcd-export>\n"
}

fn write(place: &Workplace, name: &str, recording: &str) {
    std::fs::write(place.path(&format!("{name}.toml")), scene(name)).unwrap();
    std::fs::write(place.path(&format!("{name}.fcd.xml")), recording).unwrap();
}

/// Two motorcycles abreast.
const TWO_RIDERS: [(&str, &str, f64, f64); 2] =
    [("a", "motorcycle", 2.0, 30.0), ("b", "motorcycle", 5.75, 33.0)];

/// [`write`] of a scene whose errors are measured in every so many frames.
fn write_measured_every(place: &Workplace, name: &str, every: u32, recording: &str) {
    write(place, name, recording);
    let scene = scene(name).replace("bounces = 1", &format!("bounces = 1\nmeasured_every = {every}"));
    std::fs::write(place.path(&format!("{name}.toml")), scene).unwrap();
}

/// Frame in which the errors of each frame were measured.
fn measured_in(summary: &Value) -> Vec<u64> {
    let frames = summary["frames"].as_array().unwrap();
    frames.iter().map(|frame| frame["error_measured_in"].as_u64().unwrap()).collect()
}

/// Power of the paths of each vehicle over both ways, Σ |a|²/(range)⁴, by id; in the order of ids.
fn power_of_vehicles(place: &Workplace, name: &str) -> BTreeMap<String, f64> {
    place.run(&format!("paths {name}.toml --out {name}.paths --quiet"));
    place.run(&format!("export {name}.paths --to csv --out {name}.csv --quiet"));
    let table = String::from_utf8(place.bytes(&format!("{name}.csv"))).unwrap();
    let mut lines = table.lines();
    let head: Vec<&str> = lines.next().unwrap().split(',').collect();
    let column = |name: &str| head.iter().position(|h| *h == name).unwrap();
    let [target, pol, re, im, delay] = ["target", "pol", "re_m", "im_m", "delay_s"].map(column);
    let mut powers = BTreeMap::new();
    for row in lines.map(|line| line.split(',').collect::<Vec<&str>>()).filter(|row| row[pol] == "vv") {
        let number = |i: usize| row[i].parse::<f64>().unwrap();
        let power = number(re).hypot(number(im)).powi(2) / (0.5 * 299_792_458.0 * number(delay)).powi(4);
        *powers.entry(row[target].to_owned()).or_insert(0.0) += power;
    }
    powers
}

/// Three lanes at 60 m, the radar 6 m up. A line of sight over the rear edge of a bus (3.0 m high, 12 m long,
/// its front at 60 m) falls by (6 − 3)/72 m a metre: 2 m behind it, it is 2.9 m high and 7 m behind 2.7 m: a
/// car of 1.5 m behind it in the lane before the radar is in its shadow wholly. One behind a car is seen over
/// its roof, and the foremost are untouched by those behind.
#[test]
fn in_a_queue_of_three_lanes_a_bus_hides_the_car_behind_it_and_a_car_only_a_part() {
    let place = Workplace::new();
    let front = [("bus-1", "bus", 2.0, 60.0), ("car-1", "car", 5.75, 60.0), ("truck-1", "truck", 9.5, 60.0)];
    let behind =
        [("car-2", "car", 2.0, 74.0), ("car-3", "car", 5.75, 67.0), ("moto-1", "motorcycle", 9.7, 70.5)];
    let queue: Vec<_> = front.iter().chain(&behind).copied().collect();
    write(&place, "queue", &recording(&queue, 0.0, 1));
    write(&place, "front", &recording(&front, 0.0, 1));
    write(&place, "behind", &recording(&behind, 0.0, 1));
    let [queue, front, behind] = ["queue", "front", "behind"].map(|name| power_of_vehicles(&place, name));
    let of = |powers: &BTreeMap<String, f64>, id: &str| powers.get(id).copied().unwrap_or(0.0);
    for (id, alone) in front.iter().chain(&behind) {
        let loss_db = 10.0 * (of(&queue, id) / alone).log10();
        println!("{id}: {loss_db:.1} dB in the queue");
    }
    assert_eq!(of(&queue, "car-2"), 0.0, "in the bus's shadow");
    assert!(of(&behind, "car-2") > 0.0, "it is seen without the bus");
    let partly = of(&queue, "car-3") / of(&behind, "car-3");
    // Σ |a|² knows the cells that a frame was cut into, not only what is lit: a tenth of it, as below, is no
    // shadow yet.
    assert!(partly > 0.0 && partly < 0.9, "a part of it is hidden, and not all: {partly}");
    for id in ["bus-1", "truck-1"] {
        // Each tells its cells apart at −10 dB: what the same paths' sum may differ by.
        let ratio = of(&queue, id) / of(&front, id);
        assert!((ratio - 1.0).abs() < 0.1, "{id} stands before all others: {ratio}");
    }
}

#[test]
fn frames_side_by_side_have_the_bytes_of_frames_one_by_one() {
    let place = Workplace::new();
    write(&place, "drive", &recording(&TWO_RIDERS, 8.0, 5));
    for threads in [1, 3] {
        place.run(&format!("run drive.toml --out t{threads} --threads {threads} --no-cache --quiet"));
    }
    for artifact in ["scene.scene", "frames.paths", "frames.cube", "frames.rdm", "frames.points"] {
        assert_eq!(
            place.bytes(&format!("t1/{artifact}")),
            place.bytes(&format!("t3/{artifact}")),
            "{artifact}"
        );
    }
    let summary = place.summary("t3/summary.json");
    assert_eq!(summary["frames"].as_array().unwrap().len(), 5);
    let ids = summary["frames"][4]["targets"].as_array().unwrap().iter().map(|t| t["id"].as_str().unwrap());
    assert_eq!(ids.collect::<Vec<_>>(), ["a", "b"]);
}

/// A frame between measured ones is the measured one where nothing moves, found in a cache or not.
#[test]
fn frames_of_bodies_at_rest_are_the_measured_one_with_a_cache_and_without() {
    let place = Workplace::new();
    write_measured_every(&place, "queue", 2, &recording(&TWO_RIDERS, 0.0, 4));
    place.run("run queue.toml --out without --no-cache --quiet");
    place.run("run queue.toml --out with --quiet");
    place.run("paths queue.toml --out alone.paths --quiet");
    for other in ["with/frames.paths", "alone.paths"] {
        assert_eq!(place.bytes("without/frames.paths"), place.bytes(other), "{other}");
    }
    for out in ["with", "without"] {
        let summary = place.summary(&format!("{out}/summary.json"));
        assert_eq!(measured_in(&summary), [0, 1, 2, 3], "{out}");
    }
}

/// Frames between those measured with `measured_every = 3` take over their errors, and whatever was computed
/// first, with a cache, without one, or one frame alone, they are the same.
#[test]
fn frames_between_measured_ones_tell_whose_error_they_have_and_have_the_same_bytes_in_any_order() {
    let place = Workplace::new();
    write_measured_every(&place, "drive", 3, &recording(&TWO_RIDERS, 8.0, 5));
    place.run("run drive.toml --out together --threads 3 --no-cache --quiet");
    place.run("paths drive.toml --out alone.paths --quiet");
    place.run("run drive.toml --out cached --threads 1 --quiet");
    place.run("run drive.toml --out again --threads 1 --quiet");
    for other in ["alone.paths", "cached/frames.paths", "again/frames.paths"] {
        assert_eq!(place.bytes("together/frames.paths"), place.bytes(other), "{other}");
    }
    let summary = place.summary("together/summary.json");
    let frames = summary["frames"].as_array().unwrap();
    let measured_in = measured_in(&summary);
    assert_eq!(measured_in, [0, 0, 0, 3, 3]);
    for (frame, measured_in) in frames.iter().zip(&measured_in) {
        assert_eq!(frame["error_db"]["freezing"], frames[*measured_in as usize]["error_db"]["freezing"]);
    }
    assert_ne!(
        frames[0]["error_db"]["freezing"], frames[3]["error_db"]["freezing"],
        "each is measured itself"
    );
}

/// Second of two recordings: it has more vehicles out of view and goes on for longer; frames that both have
/// are found in the cache.
#[test]
fn a_longer_recording_leaves_the_frames_that_it_had_in_the_cache() {
    let place = Workplace::new();
    write(&place, "drive", &recording(&[("a", "motorcycle", 2.0, 30.0)], 8.0, 2));
    place.run("run drive.toml --out a --quiet");
    let more = recording(&[("a", "motorcycle", 2.0, 30.0), ("far", "bus", 2.0, 400.0)], 8.0, 3);
    write(&place, "drive", &more);
    let told = place.run("run drive.toml --out b --explain --quiet");
    assert!(told.contains("frame 0 bart_rcs: cached") && told.contains("frame 1 bart_rcs: cached"), "{told}");
    assert!(told.contains("frame 2 bart_rcs: runs"), "{told}");
}
