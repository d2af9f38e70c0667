//! Statements of a run on itself: accuracy asked and reached, what was found, and what made the false
//! objects; the same in `summary.json`, on the console and in the report.

#![allow(
    clippy::unwrap_used,
    reason = "a test fails by panicking; clippy knows only functions marked as tests"
)]

use crate::common::{SMALL_SCENE, Workplace};
use serde_json::Value;
use std::fmt::Write as _;

fn write(place: &Workplace, name: &str, text: &str) {
    std::fs::write(place.path(name), text).unwrap();
}

/// Cells of 0.24 m × 0.5 m/s, first reflections at −10 dB.
fn head(array: &str, rest: &str) -> String {
    format!(
        "name = \"told\"\n[radar.waveform]\nsamples = 256\nchirps = 64\n[radar.array]\npreset = \"{array}\"\n\
         [noise]\nnoise_figure_db = 12.0\n[fidelity]\n{rest}\n"
    )
}

fn items(list: &Value) -> &[Value] {
    list.as_array().map_or(&[], Vec::as_slice)
}

#[test]
fn a_second_run_of_the_library_writes_the_same_folder_again() {
    let place = Workplace::new();
    let run = |scene: &str| {
        let settings =
            wayside::Settings { cache: None, ..wayside::Settings::of(place.path(scene), place.path("out")) };
        wayside::run(&settings).map(drop)
    };
    run("small.toml").unwrap();
    let shorter =
        std::fs::read_to_string(place.path("small.toml")).unwrap().replace("frames = 2", "frames = 1");
    write(&place, "shorter.toml", &shorter);
    run("shorter.toml").unwrap();
    assert_eq!(place.summary("out/summary.json")["frames"].as_array().unwrap().len(), 1);
}

#[test]
fn a_summary_is_read_as_it_was_handed_out_and_keys_of_later_versions_are_passed_over() {
    let place = Workplace::new();
    let settings = wayside::Settings {
        cache: None,
        ..wayside::Settings::of(place.path("small.toml"), place.path("out"))
    };
    let outcome = wayside::run(&settings).unwrap();
    let summary = outcome.summary().unwrap();
    assert_eq!(wayside::Summary::read(&place.path("out/summary.json")).unwrap(), *summary);
    let reflector = &summary.frames[1].targets[1];
    assert_eq!((reflector.id.as_str(), reflector.found), ("reflector", Some(true)));
    let estimate = reflector.estimate.unwrap();
    assert!((estimate.range_m - reflector.truth.compared_range_m()).abs() < 0.5, "{estimate:?}");
    let mut later = place.summary("out/summary.json");
    later["frames"][0]["targets"][0]["of_later_versions"] = "unknown".into();
    write(&place, "later.json", &later.to_string());
    assert_eq!(wayside::Summary::read(&place.path("later.json")).unwrap(), *summary);
    let refused = wayside::Summary::read(&place.path("small.toml")).unwrap_err().to_string();
    assert!(refused.contains("small.toml: "), "{refused}");
}

#[test]
fn a_run_hands_out_the_points_and_tracks_that_it_wrote_and_may_be_repeated() {
    let place = Workplace::new();
    let settings = |dry_run: bool| wayside::Settings {
        cache: None,
        dry_run,
        ..wayside::Settings::of(place.path("small.toml"), place.path("out"))
    };
    let outcome = wayside::run(&settings(false)).unwrap();
    let (points, tracks) = (outcome.points().unwrap(), outcome.tracks().unwrap());
    assert_eq!(points.iter().map(|frame| frame.index).collect::<Vec<_>>(), [0, 1]);
    assert_eq!(tracks.iter().map(|frame| frame.index).collect::<Vec<_>>(), [0, 1]);
    let reflector = outcome.summary().unwrap().frames[1].targets[1].estimate.unwrap();
    assert!(points[1].objects.iter().any(|object| object.range_m.to_bits() == reflector.range_m.to_bits()));
    assert_eq!(outcome.radars()[0].folder(), place.path("out"));
    // Files that were read back are no inputs, which a run in this process would refuse to replace.
    wayside::run(&settings(false)).unwrap();
    std::fs::remove_file(place.path("out/frames.points")).unwrap();
    let gone = outcome.points().unwrap_err().to_string();
    assert!(gone.contains("frames.points"), "{gone}");
    assert!(wayside::run(&settings(true)).unwrap().points().unwrap().is_empty());
}

#[test]
fn an_accuracy_that_was_not_reached_is_said_with_what_limits_it_and_what_would_help() {
    let place = Workplace::new();
    // Drawn points stand for a trihedral, at an error larger than the echo itself.
    write(&place, "small.toml", &format!("{SMALL_SCENE}\n[fidelity]\ndetail = \"statistical\"\n"));
    let told = place.run("run small.toml --out out --quiet");
    let summary = place.summary("out/summary.json");
    for frame in items(&summary["frames"]) {
        let accuracy = &frame["accuracy"];
        assert_eq!(
            (&accuracy["met"], &accuracy["limited_by"]),
            (&false.into(), &"detail".into()),
            "{accuracy}"
        );
        assert_eq!(accuracy["reached_db"], frame["error_db"]["total"]);
        assert!((accuracy["asked_db"].as_f64().unwrap() + 20.0).abs() < 1e-9, "{accuracy}");
        assert!(accuracy["reached_db"].as_f64().unwrap() > -20.0, "{accuracy}");
        assert!(accuracy["advice"].as_str().unwrap().contains("detail = \"paths\""), "{accuracy}");
    }
    let paths = place.run("paths small.toml --out a.paths --quiet");
    let echo = place.run("echo small.toml --out a.cube --quiet");
    for said in [&told, &paths, &echo] {
        assert!(said.contains("−20.0 dB asked: NOT REACHED (detail"), "{said}");
        assert!(said.contains("What would help: detail = \"paths\" in [fidelity]."), "{said}");
    }
    write(&place, "small.toml", SMALL_SCENE);
    let told = place.run("run small.toml --out out --quiet");
    assert!(told.contains("−20.0 dB asked: reached") && !told.contains("NOT REACHED"), "{told}");
    let advice = &place.summary("out/summary.json")["frames"][0]["accuracy"]["advice"];
    assert!(!advice.as_str().unwrap_or_default().contains("Limited by"), "{advice}");
}

#[test]
fn small_parts_that_are_drawn_are_told() {
    let place = Workplace::new();
    let scene = SMALL_SCENE.replace("frames = 2", "frames = 1").replace("corner.obj", "motorcycle-street");
    write(&place, "small.toml", &scene);
    assert!(!place.run("run small.toml --out out --quiet").contains("small parts drawn"));
    let share_db =
        || place.summary("out/summary.json")["frames"][0]["model_error_db"]["small_parts"].as_f64();
    assert_eq!(share_db(), None);
    write(&place, "small.toml", &format!("{scene}\n[model]\ndetail = \"statistical\"\n"));
    let told = place.run("run small.toml --out out --quiet");
    assert!(told.contains("small parts drawn at random: "), "{told}");
    assert!(share_db().unwrap().abs() < 30.0);
}

/// A van catches up with a bus: what three bounces send between them ends at outlines that slide by about two
/// cycles while the frame lasts, so at both of its ends little seems to change. No cells are small enough.
#[test]
fn ways_between_bodies_whose_outlines_slide_by_whole_cycles_are_followed() {
    let place = Workplace::new();
    let vehicle = |id: &str, model: &str, seed: u64, [x, y]: [f64; 2], yaw: f64, [vx, vy]: [f64; 2]| {
        format!(
            "[[target]]\nkind = \"mesh\"\nid = \"{id}\"\nmodel = \"{model}\"\nvehicle_seed = {seed}\n\
             position_m = [{x}, {y}, 0.0]\nyaw_deg = {yaw}\nvelocity_mps = [{vx}, {vy}, 0.0]\n"
        )
    };
    let scene = [
        "name = \"pair\"\nframes = 1\n[radar]\nposition_m = [0.0, 0.0, 5.141145842819826]\n[noise]\n\
         noise_figure_db = 12.0\n[fidelity]\nbounces = 3\naccuracy_db = -10\n"
            .to_string(),
        vehicle("truck-1", "truck-van", 420, [1.900757, 49.225254], -89.963248, [0.007104, -11.0745]),
        vehicle("bus-1", "bus-school", 776, [5.969147, 38.898523], -87.24693, [0.139205, -2.894853]),
    ];
    write(&place, "pair.toml", &scene.concat());
    let told = place.run("paths pair.toml --out a.paths --quiet --memory-limit 1024");
    println!("{told}");
    assert!(told.contains("−10.0 dB asked: reached"), "{told}");
}

#[test]
fn a_part_that_is_no_error_is_null_and_is_said_nowhere() {
    let place = Workplace::new();
    let (head, reflector) = SMALL_SCENE.split_once("[[target]]").unwrap();
    let (_, point) = reflector.split_once("[[target]]").unwrap();
    write(&place, "small.toml", &format!("{head}[[target]]{point}"));
    let told = place.run("run small.toml --out out --quiet");
    assert!(told.contains("−20.0 dB asked: reached (") && !told.contains("−300.0 dB"), "{told}");
    assert!(!told.contains("left out by the model"), "a point leaves nothing out: {told}");
    let frame = &place.summary("out/summary.json")["frames"][0];
    for (of, part) in
        [("model_error_db", "bounces"), ("model_error_db", "nodes"), ("error_db", "integration")]
    {
        assert_eq!(frame[of][part], Value::Null, "{part}");
    }
    let page = String::from_utf8(place.bytes("out/report.html")).unwrap();
    assert!(!page.contains("−300.0") && !page.contains("model: nodes"), "a row of no error");
}

#[test]
fn a_road_that_outweighs_what_was_computed_is_advised_with_its_key() {
    let place = Workplace::new();
    let scene = "name = \"front\"\n[noise]\nnoise_figure_db = 12.0\n[fidelity]\naccuracy_db = -10\n[[target]]\n\
                 kind = \"mesh\"\nid = \"bus\"\nmodel = \"bus-city\"\nlane = 3\ny_m = 40.0\n\
                 velocity_mps = [0.0, -6.5, 0.0]\n";
    let told_of = |road: &str| {
        write(&place, "front.toml", &format!("{scene}{road}"));
        let told = place.run("run front.toml --out out --quiet");
        let frame = place.summary("out/summary.json")["frames"][0].clone();
        (told, frame["model_error_db"]["road"].as_f64())
    };
    const ADVICE: &str = "what the road reflects outweighs the computed echo: [road] with its mirror adds it";
    let (told, road_db) = told_of("");
    assert!(road_db.unwrap() > 0.0 && told.contains(ADVICE), "{road_db:?}: {told}");
    let (told, road_db) = told_of("[road]\n");
    assert!(road_db.is_none() && !told.contains("outweighs"), "{road_db:?}: {told}");
}

#[test]
fn that_tables_leave_shading_out_is_said_where_there_are_two_bodies() {
    let place = Workplace::new();
    let told_of = |scene: &str, echo: &str| {
        write(&place, "small.toml", &format!("{scene}\n[fidelity]\necho = \"{echo}\"\n"));
        let told = place.run("run small.toml --out out --quiet");
        let model = place.summary("out/summary.json")["frames"][0]["model_error_db"].clone();
        assert_eq!(model.get("shading"), Some(&Value::Null), "it is not estimated: {model}");
        let page = String::from_utf8(place.bytes("out/report.html")).unwrap();
        [
            told.contains("shading between bodies, which is not estimated"),
            page.contains("describe each body alone"),
        ]
    };
    assert_eq!(told_of(SMALL_SCENE, "rcs-table"), [true; 2]);
    assert_eq!(told_of(SMALL_SCENE, "paths"), [false; 2]);
    let (lone, _) = SMALL_SCENE.rsplit_once("[[target]]").unwrap();
    assert_eq!(told_of(lone, "rcs-table"), [false; 2]);
}

#[test]
fn a_run_says_which_accuracy_is_of_use_and_what_its_own_is_for() {
    let place = Workplace::new();
    let scene = |asked: &str| format!("{SMALL_SCENE}\n[fidelity]\n{asked}\n");
    let run = |asked: &str| {
        write(&place, "small.toml", &scene(asked));
        let told = place.run("run small.toml --out out --quiet");
        (told, place.summary("out/summary.json")["frames"][0].clone())
    };
    let (fine, frame) = run("accuracy_db = -60.0");
    let of_method = ["nodes", "bounces", "far_field"].map(|name| frame["model_error_db"][name].as_f64());
    let largest_db = of_method.into_iter().flatten().fold(f64::NEG_INFINITY, f64::max);
    let accuracy = &frame["accuracy"];
    assert_eq!((accuracy["of_use_db"].as_f64(), &accuracy["for"]), (Some(largest_db), &Value::Null));
    assert!(largest_db > -60.0 && fine.contains("accuracy_db below that buys nothing."), "{fine}");
    let (for_class, frame) = run("for = \"class\"");
    let needed_db = artifact::goal::Goal::Class.accuracy().db();
    assert_eq!(frame["accuracy"]["for"], "class");
    assert!((frame["accuracy"]["asked_db"].as_f64().unwrap() - needed_db).abs() < 1e-9, "{frame}");
    assert!(for_class.contains(" dB asked for \"class\": "), "{for_class}");
}

#[test]
fn a_table_says_whether_its_accuracy_was_reached() {
    let place = Workplace::new();
    let told = place.run("rcs corner.obj --freq-ghz 77 --az-deg 10:40:3 --el-deg 20 --out s.npy --quiet");
    let accuracy = &place.summary("s.json")["accuracy"];
    let verdict =
        if accuracy["met"] == true { "−40.0 dB asked: reached" } else { "−40.0 dB asked: NOT REACHED" };
    assert!(told.contains(verdict), "{told}\n{accuracy}");
    assert!((accuracy["asked_db"].as_f64().unwrap() + 40.0).abs() < 1e-9, "{accuracy}");
}

/// The front of the bus is what answers, 6 m before its middle.
#[test]
fn a_bus_seen_from_the_front_is_found_in_the_summary_on_the_console_and_in_the_report_alike() {
    let place = Workplace::new();
    let bus = "[[target]]\nkind = \"mesh\"\nid = \"bus-1\"\nmodel = \"bus-city\"\nlane = 1\ny_m = 50.0\n\
               velocity_mps = [0.0, -6.5, 0.0]\n";
    write(&place, "bus.toml", &(head("3x4", "accuracy_db = -10.0\nbounces = 1") + bus));
    let told = place.run("run bus.toml --out out --quiet");
    let summary = place.summary("out/summary.json");
    let (frame, metrics) = (&summary["frames"][0], &summary["metrics"]["objects"]);
    let target = &frame["targets"][0];
    let behind_m = target["truth"]["y_m"].as_f64().unwrap() - target["estimate"]["y_m"].as_f64().unwrap();
    assert!(behind_m > 5.0, "its front is found: {target}");
    let false_ones = items(&frame["false_objects"]).len();
    assert_eq!(
        (&metrics["found"], &metrics["missed"], &metrics["false"]),
        (&1.into(), &0.into(), &false_ones.into())
    );
    assert!(told.contains(&format!("1 of 1 targets found, 0 missed, {false_ones} false")), "{told}");
    assert!(metrics["localisation_rms_m"].as_f64().unwrap() < 1.0, "from its outline: {metrics}");
}

const RADAR: [f64; 3] = [0.0, 0.0, 6.0];

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = a.iter().map(|x| x * x).sum::<f64>().sqrt();
    a.map(|x| x / length)
}

fn from_to(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    unit([0, 1, 2].map(|i: usize| b[i] - a[i]))
}

/// A square plate of a metre at a place, facing along a normal, as a body of its own at rest.
fn plate(place: &Workplace, heading: &str, id: &str, at_m: [f64; 3], normal: [f64; 3]) -> String {
    let left = unit([-normal[1], normal[0], 0.0]);
    let up = [0, 1, 2].map(|i: usize| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        normal[j] * left[k] - normal[k] * left[j]
    });
    let mut mesh = String::new();
    for (a, b) in [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)] {
        let [x, y, z] = [0, 1, 2].map(|i: usize| a * left[i] + b * up[i]);
        writeln!(mesh, "v {x:.9} {y:.9} {z:.9}").unwrap();
    }
    write(place, &format!("{id}.obj"), &(mesh + "f 1 2 3\nf 1 3 4\n"));
    let [x, y, z] = at_m;
    let kind = if heading == "target" { "kind = \"mesh\"\n" } else { "" };
    format!(
        "[[{heading}]]\n{kind}id = \"{id}\"\nmodel = \"{id}.obj\"\nposition_m = [{x:.6}, {y:.6}, {z:.6}]\nyaw_deg = 0.0\n"
    )
}

/// Two plates turned so that a wave runs from the radar over both and back, and a third, no target, that
/// faces the radar.
fn street(place: &Workplace, array: &str) -> String {
    let [left, right, facing] = [[-6.0, 40.0, 2.0], [6.0, 40.0, 2.0], [2.0, 25.0, 6.0]];
    let over = |own: [f64; 3], other: [f64; 3]| {
        let [to_radar, to_other] = [RADAR, other].map(|p| from_to(own, p));
        unit([0, 1, 2].map(|i: usize| to_radar[i] + to_other[i]))
    };
    let bodies = [
        plate(place, "target", "left", left, over(left, right)),
        plate(place, "target", "right", right, over(right, left)),
        plate(place, "clutter", "sign-1", facing, from_to(facing, RADAR)),
    ];
    head(array, "bounces = 2") + &bodies.concat()
}

#[test]
fn false_objects_are_told_with_the_bodies_and_bounces_that_made_them() {
    let place = Workplace::new();
    write(&place, "street.toml", &street(&place, "3x4"));
    let told = place.run("run street.toml --out out --quiet");
    let summary = place.summary("out/summary.json");
    let objects = items(&summary["frames"][0]["false_objects"]);
    let of = |cause: &str| objects.iter().find(|object| object["cause"] == cause).unwrap_or(&Value::Null);
    let ghost = of("ghost");
    assert_eq!(
        (&ghost["bodies"], &ghost["bounces"]),
        (&serde_json::json!(["left", "right"]), &2.into()),
        "{told}"
    );
    // Half the way radar, left, right, radar: √(6² + 40² + 4²) + 6 m.
    assert!((ghost["range_m"].as_f64().unwrap() - 46.64).abs() < 0.24, "{ghost}");
    assert!(ghost["ghost_share"].as_f64().unwrap() > 0.9, "{ghost}");
    assert_eq!(of("clutter")["bodies"], serde_json::json!(["sign-1"]), "{told}");
    assert!(
        told.contains("ghost by left and right, 2 bounces") && told.contains("clutter: sign-1"),
        "{told}"
    );
    assert_eq!(summary["metrics"]["objects"]["false"], objects.len());
}

/// One transmitter sees every departure alike.
#[test]
fn an_array_that_cannot_tell_ghosts_says_null_and_not_zero() {
    let place = Workplace::new();
    write(&place, "street.toml", &street(&place, "1x4"));
    place.run("run street.toml --out out --quiet");
    let summary = place.summary("out/summary.json");
    let objects = items(&summary["frames"][0]["false_objects"]);
    assert!(!objects.is_empty());
    assert!(objects.iter().all(|object| object["ghost_share"].is_null()), "{objects:#?}");
}

/// Maximum unambiguous velocity λ/4T is 8.6 m/s.
#[test]
fn a_target_whose_velocity_is_aliased_is_said_to_be_and_makes_the_map_abnormal() {
    let place = Workplace::new();
    for (speed, aliased) in [(-3.0, false), (-13.0, true)] {
        let text = SMALL_SCENE.replace("[0.0, -3.0, 0.0]", &format!("[0.0, {speed:.1}, 0.0]"));
        let text = text.replace("chirps = 16", "chirps = 16\nidle_us = 100.0");
        write(&place, "small.toml", &text);
        let told = place.run("run small.toml --out out --quiet");
        let frame = &place.summary("out/summary.json")["frames"][0];
        assert_eq!(frame["targets"][0]["velocity_aliased"], aliased, "{frame}");
        assert_eq!(frame["targets"][1]["velocity_aliased"], false);
        assert_eq!(frame["rdm_state"], if aliased { "abnormal" } else { "normal" });
        assert_eq!(told.contains("velocity aliased"), aliased, "{told}");
        assert!(!told.contains("normal"), "reserved for Table 2: {told}");
    }
}

/// Phases are parts of what this run took on processors, whatever the clock on the wall says.
#[test]
fn seconds_of_a_table_are_processor_seconds_with_their_total() {
    let place = Workplace::new();
    place.run("rcs corner.obj --freq-ghz 76:77:16 --az-deg 0:80:9 --el-deg 20 --out s.npy --quiet");
    let seconds = &place.summary("s.json")["seconds"];
    let of = |name: &str| seconds[name].as_f64().unwrap();
    let phases: f64 = ["load", "build", "trace", "integrate", "check"].map(of).iter().sum();
    match seconds["counted"].as_str() {
        // What a thread worked is told anew at every tick of the system, 10 ms at most.
        Some("processor") => assert!(phases <= of("processor_total") + 0.02, "{seconds}"),
        _ => assert!(seconds["counted"] == "clock" && seconds["processor_total"].is_null(), "{seconds}"),
    }
}

#[test]
fn an_array_that_tells_no_azimuth_finds_by_range_and_velocity_and_says_so() {
    let place = Workplace::new();
    let target = "[[target]]\nkind = \"point\"\nid = \"reflector\"\nrcs_m2 = 50.0\n\
                  position_m = [6.0, 30.0, 0.5]\nvelocity_mps = [0.0, -3.0, 0.0]\n\
                  [intersection]\nlane_centres_m = [0.0, 6.0]\n";
    for (array, lane) in [("1x1", None), ("3x4", Some(2))] {
        write(&place, "one.toml", &format!("{}{target}", head(array, "bounces = 1")));
        let said = place.run("run one.toml --out out");
        assert_eq!(said.contains("tells no azimuth"), array == "1x1", "{said}");
        let summary = wayside::Summary::read(&place.path("out/summary.json")).unwrap();
        let target = &summary.frames[0].targets[0];
        assert_eq!((target.found, target.truth.lane), (Some(true), Some(2)), "{array}");
        assert_eq!(target.estimate.unwrap().lane, lane, "{array}");
        assert!(summary.frames[0].false_objects.is_empty(), "{array}");
    }
}

/// A strong reflector alone at 30 m, before a radar of which more is told.
fn of_a_point(more: &str) -> String {
    let point = "kind = \"point\"\nid = \"post\"\nrcs_m2 = 1000.0\nposition_m = [2.0, 30.0, 1.0]\n";
    format!("{}[[target]]\n{point}{more}", head("1x4", ""))
}

#[test]
fn objects_that_another_radar_or_the_converter_makes_are_not_told_as_noise() {
    let place = Workplace::new();
    let same_slope = "[[radar.interferer]]\nposition_m = [0.0, 80.0, 6.0]\neirp_dbm = 30.0\n";
    let clipped = "[radar.receiver]\nadc_bits = 8\nfull_scale_dbm = -90.0\n";
    for (more, cause, told) in [
        (same_slope, "interference", ": interference by another radar"),
        (clipped, "receiver", ": receiver: ADC or phase noise"),
    ] {
        write(&place, "disturbed.toml", &of_a_point(more));
        let lines = place.run("run disturbed.toml --out out --no-cache --quiet");
        let summary = place.summary("out/summary.json");
        let false_ones = items(&summary["frames"][0]["false_objects"]);
        let strong = || false_ones.iter().filter(|object| object["snr_db"].as_f64() > Some(15.0));
        assert!(strong().any(|object| object["cause"] == cause), "{lines}");
        assert!(strong().all(|object| object["cause"] != "noise"), "{lines}");
        assert!(lines.contains(told), "{lines}");
        let page = String::from_utf8(place.bytes("out/report.html")).unwrap();
        assert!(page.contains(&told[2..]), "{more}");
    }
}

#[test]
fn bodies_of_one_bounce_say_that_higher_orders_are_not_estimated() {
    let place = Workplace::new();
    for (bounces, is_said) in [(1, true), (2, false)] {
        write(&place, "small.toml", &format!("{SMALL_SCENE}[fidelity]\nbounces = {bounces}\n"));
        let told = place.run("run small.toml --out out --no-cache --quiet");
        let frame = &place.summary("out/summary.json")["frames"][0];
        assert_eq!(frame["bounces"], bounces);
        assert_eq!(frame["model_error_db"]["bounces"].is_null(), is_said);
        let page = String::from_utf8(place.bytes("out/report.html")).unwrap();
        for text in [&told, &page] {
            assert_eq!(text.contains("not estimated (one order alone)"), is_said, "{told}");
        }
    }
}
