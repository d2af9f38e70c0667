//! Recorded traffic: read as it comes, refused with line and rule, placed where the recording says.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

#[path = "../examples/junction/driving.rs"]
mod driving;

use artifact::scene::{SceneHeader, TargetKind};
use artifact::settings::Class;
use flate2::Compression;
use flate2::write::GzEncoder;
use glam::{DVec2, DVec3};
use scene::traffic::fcd::{FcdReader, FcdStep, FcdVehicle, RecordedVelocity};
use scene::traffic::interpolation::{Interval, LANE_CHANGE_S, StepKind as Kind};
use scene::{ReadOptions, frame_view, snapshot};
use std::fmt::Write as _;
use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};

const WHOLE: ReadOptions = ReadOptions::whole();

/// A sheet of 4 × 2 m: a body whose front is 2 m before its origin.
const SHEET: &str = "v 0 0 0\nv 4 0 0.5\nv 4 2 0.5\nv 0 2 0\nf 1 2 3 4\n";

/// Id, x, y, angle, speed of a vehicle of type `car`.
type Row<'a> = (&'a str, f64, f64, f64, f64);
/// Time and vehicles.
type Step<'a> = (f64, &'a [Row<'a>]);

fn fcd(steps: &[Step<'_>]) -> String {
    let mut text = String::from("<?xml version=\"1.0\"?>\n<fcd-export>\n");
    for (time, vehicles) in steps {
        let _ = writeln!(text, "<timestep time=\"{time}\">");
        for (id, x, y, angle, speed) in *vehicles {
            let _ = writeln!(
                text,
                "<vehicle id=\"{id}\" x=\"{x}\" y=\"{y}\" angle=\"{angle}\" type=\"car\" speed=\"{speed}\"/>"
            );
        }
        text += "</timestep>\n";
    }
    text + "</fcd-export>\n"
}

/// A scene with that recording and more keys of `[traffic]`; its errors are told as people see them.
fn read_bytes(recording: &[u8], head: &str, keys: &str) -> Result<SceneHeader, String> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(folder.path().join("t.fcd.xml"), recording).unwrap();
    std::fs::write(folder.path().join("sheet.obj"), SHEET).unwrap();
    let text = format!("name = \"test\"\n{head}\n[traffic]\nfcd = \"t.fcd.xml\"\n{keys}\n");
    std::fs::write(&file, text).unwrap();
    let root = format!("{}/", folder.path().display());
    scene::read(&file, &WHOLE).map_err(|errors| errors.to_string().replace(&root, ""))
}

const CAR: &str = "models = { car = { model = \"sheet.obj\", class = \"car\" } }";

fn read(recording: &str, head: &str) -> SceneHeader {
    read_bytes(recording.as_bytes(), head, CAR).unwrap_or_else(|errors| panic!("{errors}"))
}

fn packed(text: &str) -> Vec<u8> {
    let mut packer = GzEncoder::new(vec![], Compression::fast());
    packer.write_all(text.as_bytes()).unwrap();
    packer.finish().unwrap()
}

#[test]
fn a_recorded_vehicle_stands_half_its_length_behind_its_bumper_and_moves_as_the_next_step_says() {
    let recording = fcd(&[
        (10.0, &[("a", 5.75, 40.0, 180.0, 9.0)]),
        (10.1, &[("a", 5.75, 39.0, 180.0, 10.0)]),
        (10.2, &[("a", 5.75, 37.9, 180.0, 11.0)]),
    ]);
    let scene = read(&recording, "frame_interval_s = 0.05");
    assert_eq!(scene.frames, 5);
    let expected = [(42.0, -9.0), (41.5, -10.0), (41.0, -10.0), (40.45, -11.0), (39.9, -11.0)];
    for (index, (y_m, vy_mps)) in (0..).zip(expected) {
        let pose = snapshot(&scene, index).poses[0];
        // Roundings of metres, at most 100 of them, and of steps of 0.1 s.
        assert!(
            (DVec3::from(pose.position_m) - DVec3::new(5.75, y_m, 0.0)).length() < 1e-12,
            "{index}: {pose:?}"
        );
        assert!(
            (DVec3::from(pose.velocity_mps) - DVec3::new(0.0, vy_mps, 0.0)).length() < 1e-9,
            "{index}: {pose:?}"
        );
        assert!((pose.yaw_rad + std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    }
    let view = frame_view(&scene, 2);
    assert_eq!(view.targets[0].id, "a");
    assert!(matches!(view.targets[0].kind, TargetKind::Mesh { class: Some(Class::Car), mesh: 0, .. }));
    assert_eq!(view.targets[0].start, snapshot(&scene, 2).poses[0]);
}

#[test]
fn packed_and_plain_recordings_are_one() {
    let recording = fcd(&[(0.0, &[("a", 2.0, 30.0, 180.0, 9.0)]), (0.1, &[("a", 2.0, 29.1, 180.0, 9.0)])]);
    let plain = read(&recording, "");
    assert_eq!(read_bytes(&packed(&recording), "", CAR).unwrap(), plain);
    // Two members, as `cat a.gz b.gz` makes them.
    let (first, second) = recording.split_at(recording.len() / 2);
    assert_eq!(read_bytes(&[packed(first), packed(second)].concat(), "", CAR).unwrap(), plain);
}

#[test]
fn frames_fill_the_time_asked_for_and_no_more() {
    let steps: Vec<Step<'_>> =
        (0..50).map(|i| (f64::from(i) / 10.0, &[("a", 2.0, 30.0, 180.0, 0.0)][..])).collect();
    let recording = fcd(&steps);
    let frames = |head: &str, keys: &str| {
        read_bytes(recording.as_bytes(), head, &format!("{CAR}\n{keys}")).map(|scene| scene.frames)
    };
    assert_eq!(frames("", ""), Ok(50));
    assert_eq!(frames("", "begin_s = 1.0\nend_s = 1.9"), Ok(10));
    assert_eq!(frames("frames = 3", "begin_s = 1.0"), Ok(3));
    assert_eq!(frames("frame_interval_s = 0.25", ""), Ok(20));
    for (head, keys) in [
        ("frames = 51", ""),
        ("frames = 12", "begin_s = 1.0\nend_s = 2.0"),
        ("", "begin_s = -0.1"),
        ("", "end_s = 5.0"),
        ("", "begin_s = 5.0"),
        ("frames = 1", "begin_s = -2.0\nend_s = -1.0"),
    ] {
        let refused = frames(head, keys).unwrap_err();
        assert!(refused.contains("the recording runs from 0 s to 4.9 s"), "{head} {keys}: {refused}");
    }
    let told = frames("", "end_s = -1.0").unwrap_err();
    let span = "`end_s` is -1 s, before the recording begins: the recording runs from 0 s to 4.9 s";
    assert!(told.starts_with("scene.toml:6:9: [traffic]: t.fcd.xml") && told.contains(span), "{told}");
    let told = frames("frames = 12", "begin_s = 1.0\nend_s = 2.0").unwrap_err();
    assert!(told.contains("12 frames from 1 s on reach to 2.100000 s, beyond `end_s`, 2 s"), "{told}");
    assert!(frames("", "begin_s = 2.0\nend_s = 1.0").unwrap_err().contains("`end_s` is 1, before `begin_s`"));
}

#[test]
fn a_name_of_a_megabyte_is_not_repeated_in_the_error() {
    let sound = fcd(&[(0.0, &[("a", 2.0, 30.0, 180.0, 9.0)]), (0.1, &[("a", 2.0, 29.1, 180.0, 9.0)])]);
    let broken = sound.replace("</fcd-export>", &format!("</fcd-expor{}>", " x".repeat(500_000)));
    let told = read_bytes(broken.as_bytes(), "", CAR).unwrap_err();
    assert!(
        told.contains("expected `</fcd-export>`, but `</fcd-expor") && told.len() < 1000,
        "{} bytes",
        told.len()
    );
}

#[test]
fn a_broken_recording_is_refused_with_line_and_rule() {
    let sound = fcd(&[(0.0, &[("a", 2.0, 30.0, 180.0, 9.0)]), (0.1, &[("a", 2.0, 29.1, 180.0, 9.0)])]);
    let edited = |from: &str, to: &str| sound.replacen(from, to, 1);
    let cases = [
        (String::new(), "1: there is no XML element in it"),
        ("hello".into(), "1: there is no XML element in it"),
        ("<routes></routes>".into(), "1: the first element is <routes>"),
        (edited("</timestep>", "</vehicle>"), "5: not valid XML"),
        (sound.replace("</fcd-export>", ""), "10: the file ends before </fcd-export>"),
        (edited(" x=\"2\"", ""), "4: <vehicle id=\"a\">: attribute `x` is missing"),
        (edited(" id=\"a\"", ""), "4: <vehicle>: attribute `id` is missing"),
        (edited(" type=\"car\"", ""), "4: <vehicle id=\"a\">: attribute `type` is missing"),
        (edited("y=\"30\"", "y=\"NaN\""), "4: <vehicle id=\"a\">: `y` is `NaN`; it must be m within ±1e5"),
        (edited("y=\"30\"", "y=\"3e9\""), "`y` is `3e9`"),
        (edited("angle=\"180\"", "angle=\"north\""), "`angle` is `north`; it must be degrees"),
        (edited("speed=\"9\"", "speed=\"-1\""), "`speed` is `-1`; it must be m/s from 0 to 340"),
        (edited("time=\"0.1\"", "time=\"0.0\""), "6: the step's time 0 s does not come after 0 s"),
        (edited("time=\"0.1\"", "time=\"inf\""), "6: <timestep>: `time` is `inf`"),
        (edited(" time=\"0.1\"", ""), "6: <timestep>: attribute `time` is missing"),
        (
            edited("type=\"car\"", "type=\"bicycle\""),
            "4: type `bicycle` of vehicle `a` is not in `models` of [traffic]",
        ),
        (sound.replace("id=\"a\"", "id=\"a,b\""), "4: the id `a,b` holds a comma"),
        (edited("<timestep time=\"0\">\n", ""), "3: <vehicle> outside a <timestep>"),
        ("<fcd-export></fcd-export>".into(), "1: there is no <timestep> in it"),
        (format!("<fcd-export>{}", "x".repeat(3 << 20)), "more than 1048576 bytes without an element"),
        (
            fcd(&[(0.0, &[("a", 2.0, 30.0, 0.0, 9.0), ("a", 2.0, 31.0, 0.0, 9.0)])]),
            "5: vehicle `a` is there twice",
        ),
    ];
    for (text, rule) in cases {
        let told = read_bytes(text.as_bytes(), "", CAR).unwrap_err();
        assert!(
            told.contains(&format!("t.fcd.xml:{rule}")) || told.contains(rule),
            "asked for `{rule}`, got `{told}`"
        );
        assert!(told.starts_with("scene.toml:4:7: [traffic]: t.fcd.xml:"), "{told}");
    }
    let whole = packed(&sound);
    for length in [11, whole.len() / 2, whole.len() - 1] {
        let told = read_bytes(&whole[..length], "", CAR).unwrap_err();
        assert!(
            told.contains("the gzip file is damaged or cut off"),
            "{length} of {} bytes: {told}",
            whole.len()
        );
    }
}

#[test]
fn models_are_told_by_name_list_or_table_and_wrong_ones_at_their_place() {
    let recording = fcd(&[(0.0, &[("a", 2.0, 30.0, 180.0, 9.0), ("b", 2.0, 40.0, 180.0, 9.0)])]);
    let model_of = |keys: &str| {
        let scene = read_bytes(recording.as_bytes(), "", keys).unwrap_or_else(|errors| panic!("{errors}"));
        let kind = |target: &artifact::scene::Target| match &target.kind {
            TargetKind::Mesh { model, .. } => model.clone(),
            TargetKind::Point { .. } => panic!("a vehicle is no point"),
        };
        frame_view(&scene, 0).targets.iter().map(kind).collect::<Vec<_>>()
    };
    assert_eq!(model_of(""), ["car-sedan"; 2]);
    assert_eq!(model_of("models = { car = \"car-suv\" }"), ["car-suv"; 2]);
    assert_eq!(model_of("models = { car = { model = \"sheet.obj\" } }"), ["sheet.obj"; 2]);
    let drawn = model_of("models = { car = [\"car-suv\", \"car-hatchback\"] }");
    assert!(drawn.iter().all(|name| ["car-suv", "car-hatchback"].contains(&name.as_str())), "{drawn:?}");
    for (keys, rule) in [
        ("models = { car = \"car-sv\" }", "5:18: [traffic.models]: model `car-sv` is neither"),
        ("models = { car = 3 }", "5:18: [traffic.models]: `model` must be a text or a list of texts"),
        ("models = { car = { class = \"car\" } }", "[traffic.models]: key `model` is missing"),
        (
            "models = { car = { model = \"car-suv\", clas = \"car\" } }",
            "unknown key `clas`; the nearest is `class`",
        ),
        ("models = \"car-suv\"", "`models` must be a table"),
        ("fdc = 1", "unknown key `fdc`"),
        ("view_range_m = 0", "`view_range_m` must be a number above 0"),
        ("view_nearest_m = -1", "`view_nearest_m` must be a number from 0 to 100000"),
    ] {
        let told = read_bytes(recording.as_bytes(), "", keys).unwrap_err();
        assert!(told.contains(rule), "asked for `{rule}`, got `{told}`");
    }
}

#[test]
fn a_misspelt_name_of_models_is_refused_where_its_type_would_have_the_default_model() {
    let of_kind = |kind: &str, name: &str| {
        let recording =
            fcd(&[(0.0, &[("a", 2.0, 30.0, 180.0, 9.0)])]).replace("\"car\"", &format!("\"{kind}\""));
        read_bytes(recording.as_bytes(), "", &format!("models = {{ {name} = \"bus-mini\" }}"))
    };
    for (kind, name) in [("passenger", "pasenger"), ("car", "cars"), ("truck", "turck"), ("bus", "buss")] {
        let told = of_kind(kind, name).err().unwrap();
        let expected = format!("type `{kind}` of vehicle `a` has the default model, and `{name}`, which");
        assert!(told.contains(&expected), "{told}");
    }
    // Types of other recordings.
    for (kind, name) in [("car", "cab"), ("truck", "truck2"), ("passenger", "lorry"), ("bus", "bus")] {
        assert!(of_kind(kind, name).is_ok(), "{kind} {name}");
    }
}

/// Velocity is the exact derivative of the position: a difference quotient over ±h of a cubic errs by
/// h²·|x‴|/6, here less than 1e-8·(12·3.75/4³) + rounding 1e-12/1e-4.
#[test]
fn velocity_is_the_derivative_of_position_in_turns_and_lane_changes() {
    let at = |x: f64, y: f64, angle_deg: f64, speed_mps: f64| FcdVehicle {
        angle_deg,
        ..driving([x, y, 0.0], speed_mps)
    };
    let last_mps = 10.0 * 0.08_f64.hypot(1.0);
    let path = [
        at(2.0, 50.0, 180.0, 10.0),
        at(2.0, 49.0, 180.0, 10.0),
        at(5.75, 48.0, 180.0, 10.0),
        at(5.75, 47.0, 175.0, 10.0),
        at(5.83, 46.0, 170.0, last_mps),
    ];
    let mut interval = Interval::default();
    let mut last_m: Option<DVec3> = None;
    for (i, vehicle) in path.iter().enumerate() {
        interval.advance(FcdStep { time_s: 0.1 * i as f64, line: 1, vehicles: vec![vehicle.clone()] });
        if i == 0 {
            continue;
        }
        let pose = |t: f64| interval.bumper(vehicle, 0.1 * (i as f64 - 1.0) + t).unwrap().pose(2.0);
        for t in [0.01, 0.05, 0.09] {
            let [early, now, late] = [pose(t - 1e-4), pose(t), pose(t + 1e-4)];
            let quotient = (DVec3::from(late.position_m) - DVec3::from(early.position_m)) / 2e-4;
            let error = (quotient - DVec3::from(now.velocity_mps)).length();
            assert!(error < 1e-6, "step {i} at {t}: {quotient} against {:?}", now.velocity_mps);
        }
        let start_m = DVec3::from(pose(1e-9).position_m);
        assert!(
            last_m.is_none_or(|last| last.distance(start_m) < 1e-6),
            "step {i} begins where the last ended"
        );
        last_m = Some(pose(0.1).position_m.into());
    }
    assert!(
        (last_m.unwrap().x - 2.0).abs() < 0.5,
        "0.3 s into a lane change of {LANE_CHANGE_S} s: {last_m:?}"
    );
}

/// Ground truth of 100 messages a second: a way of 8 cm is short beside what SUMO rounds, yet exact.
#[test]
fn a_velocity_told_whole_keeps_its_direction_and_one_that_is_not_told_is_that_of_the_way() {
    let drift = [1.0, -8.0, 0.5];
    let still = RecordedVelocity::AlongHeading { speed_mps: 0.0 };
    let told = [RecordedVelocity::Vector { velocity_mps: drift }, RecordedVelocity::Unknown, still];
    for (velocity, way_mps, expected) in [
        (told[0], drift, drift),
        (told[1], drift, drift),
        (told[1], [0.0, -1.0, 0.0], [0.0, -1.0, 0.0]),
        // SUMO's own, whose places are rounded: a way of a centimetre is none.
        (told[2], [0.0, -1.0, 0.0], [0.0; 3]),
    ] {
        let mut interval = Interval::default();
        let at = |step: f64| {
            let front_m = (DVec3::new(2.0, 50.0, 0.75) + DVec3::from(way_mps) * 0.01 * step).into();
            FcdVehicle { id: "4".into(), kind: "car".into(), front_m, angle_deg: 180.0, velocity, line: 1 }
        };
        for step in [0.0, 1.0] {
            interval.advance(FcdStep { time_s: 0.01 * step, line: 1, vehicles: vec![at(step)] });
        }
        let pose = interval.bumper(&at(1.0), 0.004).unwrap().pose(0.0);
        let error_mps = DVec3::from(pose.velocity_mps).distance(expected.into());
        assert!(error_mps < 1e-9, "{velocity:?} on a way of {way_mps:?} m/s: {:?}", pose.velocity_mps);
    }
}

/// A car that drives towards −y.
fn driving(front_m: [f64; 3], speed_mps: f64) -> FcdVehicle {
    let velocity = RecordedVelocity::AlongHeading { speed_mps };
    FcdVehicle { id: "a".into(), kind: "car".into(), front_m, angle_deg: 180.0, velocity, line: 1 }
}

#[test]
fn a_lane_change_ends_in_its_lane_and_a_teleport_leaves_a_gap() {
    let mut steps: Vec<FcdStep> = (0..=60)
        .map(|i| {
            let x = if i < 10 { 2.0 } else { 5.75 };
            let vehicle = driving([x, 50.0 - f64::from(i), 0.0], 10.0);
            FcdStep { time_s: 0.1 * f64::from(i), line: 1, vehicles: vec![vehicle] }
        })
        .collect();
    steps[60].vehicles[0].front_m[1] = -300.0;
    let mut interval = Interval::default();
    let mut x_m = vec![];
    for step in &steps {
        interval.advance(step.clone());
        x_m.extend(interval.bumper(&step.vehicles[0], step.time_s).map(|b| b.front_m.x));
    }
    assert_eq!((x_m[9], x_m[50], x_m[59]), (2.0, 5.75, 5.75));
    assert!((x_m[29] - 3.875).abs() < 1e-9, "half way in half the time: {}", x_m[29]);
    assert!(
        x_m.windows(2)
            .all(|pair| pair[0] <= pair[1] && pair[1] - pair[0] <= 0.1 * 1.5 * 3.75 / LANE_CHANGE_S)
    );
    let vehicle = &steps[60].vehicles[0];
    assert_eq!(interval.bumper(vehicle, 5.95), None);
    assert_eq!(interval.bumper(vehicle, 6.0).unwrap().front_m.y, -300.0);
    // 0.7 + 53 times 0.1 is rounded to just before it.
    assert_eq!(interval.bumper(vehicle, 6.0_f64.next_down()).unwrap().front_m.y, -300.0);
}

/// Steps of a second and more: x(t) = 2 m + 3.75 m·(3s² − 2s³), s = (t − t₀)/4 s, from the step before the
/// jump on, whichever step the moment lies in.
#[test]
fn a_lane_change_takes_its_time_however_long_the_steps_are() {
    for (step_s, before_s) in [(1.0, 1.0), (1.5, 1.5), (2.0, 2.0), (3.0, 0.0)] {
        let steps = (0..=8).map(|i| {
            let time_s = step_s * f64::from(i);
            let x = if time_s <= before_s { 2.0 } else { 5.75 };
            let vehicle = driving([x, 50.0 - 5.0 * time_s, 0.0], 5.0);
            FcdStep { time_s, line: 1, vehicles: vec![vehicle] }
        });
        let mut interval = Interval::default();
        for (i, step) in steps.enumerate() {
            interval.advance(step.clone());
            for time_s in (1..=10).map(|k| step.time_s - step_s * (1.0 - 0.1 * f64::from(k))) {
                let bumper = interval.bumper(&step.vehicles[0], time_s);
                let Some(bumper) = bumper.filter(|_| i > 0) else { continue };
                let s = ((time_s - before_s) / LANE_CHANGE_S).clamp(0.0, 1.0);
                let x_m = 2.0 + 3.75 * (3.0 - 2.0 * s) * s * s;
                let error_m = (bumper.front_m.x - x_m).abs();
                assert!(error_m < 1e-9, "steps of {step_s} s, {time_s} s: {} of {x_m} m", bumper.front_m.x);
            }
        }
    }
}

#[test]
fn rounded_positions_leave_the_told_speed() {
    let recording = fcd(&[(0.0, &[("a", 2.0, 40.0, 180.0, 9.46)]), (0.1, &[("a", 2.0, 39.06, 180.0, 9.46)])]);
    let scene = read(&recording, "");
    let mps = snapshot(&scene, 1).poses[0].velocity_mps;
    assert!(
        (DVec3::from(mps) - DVec3::new(0.0, -9.46, 0.0)).length() < 1e-12,
        "the way says 9.4 m/s: {mps:?}"
    );
}

/// The project's own traffic is what its generator makes, and nobody drives through another.
#[test]
fn the_junction_of_the_fixtures_is_made_by_its_generator_without_a_collision() {
    let text = driving::floating_car_data(1);
    let file = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/junction.fcd.xml.gz"));
    let mut kept = String::new();
    flate2::read::GzDecoder::new(std::fs::File::open(file).unwrap()).read_to_string(&mut kept).unwrap();
    assert!(kept == text, "make it anew: cargo run --release -p scene --example junction");
    let mut reader = FcdReader::open(file).unwrap();
    let (mut steps, mut closest_m, mut standing) = (0, f64::INFINITY, 0);
    while let Some(step) = reader.next_step().unwrap() {
        steps += 1;
        standing += step.vehicles.iter().filter(|vehicle| vehicle.velocity.speed_mps() < 0.1).count();
        for (i, a) in step.vehicles.iter().enumerate() {
            let gaps = step.vehicles[i + 1..].iter().map(|b| gap_m(a, b));
            closest_m = gaps.fold(closest_m, f64::min);
        }
    }
    println!("{steps} steps, {standing} standing vehicles, closest {closest_m:.2} m");
    assert!(steps == 600 && standing > 600 && closest_m > 0.5, "{steps}, {standing}, {closest_m}");
}

/// Between the middle lines of two bodies of nominal length, less the half widths of two buses (2.5 m).
fn gap_m(a: &FcdVehicle, b: &FcdVehicle) -> f64 {
    let line = |v: &FcdVehicle| {
        let length_m = match v.kind.as_str() {
            "bus" => 12.0,
            "truck" => 8.0,
            "car" => 4.7,
            _ => 2.1,
        };
        let front = DVec2::new(v.front_m[0], v.front_m[1]);
        let ahead = DVec2::from_angle((90.0 - v.angle_deg).to_radians());
        (0..=24).map(move |i| front - ahead * (length_m * f64::from(i) / 24.0))
    };
    let across = |p: DVec2, q: DVec2| p.distance(q);
    let nearest = line(a).flat_map(|p| line(b).map(move |q| across(p, q))).fold(f64::INFINITY, f64::min);
    // One behind the other needs no half widths.
    let apart = (b.angle_deg - a.angle_deg).to_radians().sin().abs();
    nearest - 2.5 * apart
}

/// A hundred thousand vehicles behind the radar and beyond its range: what is kept is what a file without
/// them gives.
#[test]
fn what_is_out_of_view_is_not_kept_however_much_it_is() {
    let seen = "<vehicle id=\"a\" x=\"2\" y=\"30\" angle=\"180\" type=\"car\" speed=\"9\"/>\n";
    let recording = |others: usize| {
        let mut packer = GzEncoder::new(vec![], Compression::fast());
        packer.write_all(b"<fcd-export>\n").unwrap();
        for step in 0..50 {
            writeln!(packer, "<timestep time=\"{}\">", f64::from(step) / 10.0).unwrap();
            for other in others * step as usize / 50..others * (step as usize + 1) / 50 {
                let y = if other.is_multiple_of(2) { -20.0 } else { 90.0 };
                let rest = "angle=\"0\" type=\"car\" speed=\"0\"";
                writeln!(packer, "<vehicle id=\"o{other}\" x=\"{}\" y=\"{y}\" {rest}/>", other % 1000)
                    .unwrap();
            }
            packer.write_all(seen.as_bytes()).unwrap();
            packer.write_all(b"</timestep>\n").unwrap();
        }
        packer.write_all(b"</fcd-export>\n").unwrap();
        packer.finish().unwrap()
    };
    let [alone, among] = [0, 100_000].map(|others| read_bytes(&recording(others), "", CAR).unwrap());
    assert_eq!(alone.traffic.as_ref().unwrap().vehicles.len(), 1);
    assert_eq!(alone, among);
}

/// Path of a recording made with SUMO, if it is there.
fn shared(name: &str) -> Option<PathBuf> {
    let beside = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared")).to_owned();
    let root = std::env::var_os("WAYSIDE_SHARED").map_or(beside, PathBuf::from);
    let file = root.join("sumo").join(name);
    if !file.is_file() {
        println!("skipped: {} is not here", file.display());
    }
    file.is_file().then_some(file)
}

/// Rows and steps as their README says; it counts 22 lane changes on the junction's roads, and 4 more are
/// driven on the lanes inside it.
#[test]
fn recordings_made_with_sumo_are_read_as_their_readme_says() {
    for (name, steps, rows, slow, jumps) in
        [("approach3.fcd.xml", 600, 12605, 0, 13), ("junction4.fcd.xml.gz", 600, 35590, 10085, 26)]
    {
        let Some(file) = shared(name) else { return };
        let mut reader = FcdReader::open(&file).unwrap();
        let mut got = (0, 0, 0, 0);
        let mut before = FcdStep::default();
        while let Some(step) = reader.next_step().unwrap() {
            got.0 += 1;
            got.1 += step.vehicles.len();
            got.2 += step.vehicles.iter().filter(|v| v.velocity.speed_mps() < 0.1).count();
            let earlier = |v: &FcdVehicle| before.vehicles.iter().find(|b| b.id == v.id);
            got.3 += step
                .vehicles
                .iter()
                .filter(|v| {
                    earlier(v).is_some_and(|b| matches!(Kind::between(b, v, 0.1), Kind::LaneChange { .. }))
                })
                .count();
            before = step;
        }
        assert_eq!(got, (steps, rows, slow, jumps), "{name}");
    }
}

/// A scene of the recording from `begin_s` on, in which bodies have their type's length: their front is at
/// the bumper.
fn sumo_scene(name: &str, begin_s: f64) -> Option<SceneHeader> {
    let file = shared(name)?;
    let folder = tempfile::tempdir().unwrap();
    for (kind, length) in [("car", 4.6), ("bus", 12.0), ("truck", 8.5), ("motorcycle", 2.2)] {
        let sheet = format!("v 0 0 0\nv {length} 0 1\nv {length} 1 1\nv 0 1 0\nf 1 2 3 4\n");
        std::fs::write(folder.path().join(format!("{kind}.obj")), sheet).unwrap();
    }
    let scene = folder.path().join("scene.toml");
    let models =
        "car = \"car.obj\", bus = \"bus.obj\", truck = \"truck.obj\", motorcycle = \"motorcycle.obj\"";
    let view = "view_range_m = 500\nview_half_angle_deg = 180";
    let keys = format!("begin_s = {begin_s}\n{view}\nmodels = {{ {models} }}");
    let text = format!("name = \"sumo\"\nframes = 1\n[traffic]\nfcd = \"{}\"\n{keys}\n", file.display());
    std::fs::write(&scene, text).unwrap();
    Some(scene::read(&scene, &WHOLE).unwrap_or_else(|errors| panic!("{errors}")))
}

#[test]
fn positions_of_the_recordings_are_those_checked_by_hand() {
    for (name, begin_s, id, centre) in [
        ("approach3.fcd.xml", 30.0, "flow.0", [5.750, -52.795]),
        ("approach3.fcd.xml", 30.0, "flow.10", [5.750, 52.826]),
        ("junction4.fcd.xml.gz", 80.8, "w_n.1", [-9.126, 9.375]),
        ("junction4.fcd.xml.gz", 75.0, "n_e.1", [9.5, 30.144 + 4.25]),
    ] {
        let Some(scene) = sumo_scene(name, begin_s) else { return };
        let view = frame_view(&scene, 0);
        let target = view.targets.iter().find(|target| target.id == id).unwrap();
        let [x, y, z] = target.start.position_m;
        // The file has millimetres.
        assert!(
            DVec2::new(x, y).distance(DVec2::from(centre)) < 5e-4 && z == 0.0,
            "{id}: {:?}",
            target.start
        );
    }
    let Some(scene) = sumo_scene("approach3.fcd.xml", 30.0) else { return };
    let view = frame_view(&scene, 0);
    let pose = view.targets.iter().find(|target| target.id == "flow.10").unwrap().start;
    let (bumper, radar) =
        (DVec3::from(pose.position_m) - DVec3::new(0.0, 2.3, 0.0), DVec3::new(0.0, 0.0, 6.0));
    let away = bumper - radar;
    assert!((away.length() - 51.205).abs() < 5e-4);
    assert!((DVec3::from(pose.velocity_mps).dot(away) / away.length() + 15.313).abs() < 5e-4);
}

#[test]
fn a_recording_that_costs_more_than_it_says_is_refused_at_its_line() {
    let car = |id: &str, kind: &str| {
        format!("<vehicle id=\"{id}\" x=\"2\" y=\"40\" angle=\"180\" type=\"{kind}\" speed=\"3\"/>")
    };
    let step = |time: &str, inside: &str| format!("<timestep time=\"{time}\">\n{inside}\n</timestep>\n");
    let recording = |inside: &str| format!("<fcd-export>\n{inside}</fcd-export>\n");
    let attributes: String = (0..300).map(|i| format!(" a{i}=\"\"")).collect();
    let cases = [
        (recording(&"<a>".repeat(1 << 20)), "2: elements lie within one another more than 64 deep"),
        (recording(&format!("<timestep{attributes}/>")), "an element has more than 256 attributes"),
        (recording(&step("0", &car(&"x".repeat(300), "car"))), "3: `id` has more than 256 bytes"),
        (recording(&step("0", &car("a", &"x".repeat(300)))), "3: `type` has more than 256 bytes"),
        (
            recording(&(step("0", &car("a", "car")) + &step("1e9", &car("a", "car")))),
            "5: from 0 s on, every 0.1 s, it holds more than 1000000 frames",
        ),
        (
            recording(
                &(step("0", &(car("a", "tram") + &car("b", "car")))
                    + &step("0.1", &(car("c", "ship") + &car("d", "tram")))),
            ),
            "3: type `tram` of vehicle `a`, type `ship` of vehicle `c` (line 6) are not in `models` of [traffic]; known are",
        ),
    ];
    for (text, expected) in cases {
        let told = read_bytes(text.as_bytes(), "", CAR).unwrap_err();
        assert!(told.contains(expected), "{expected}: {}", told.chars().take(400).collect::<String>());
    }
}

#[cfg(unix)]
#[test]
fn a_recording_that_is_no_plain_file_is_refused_before_it_is_opened() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path().join("t.fcd.xml");
    assert!(std::process::Command::new("mkfifo").arg(&at).status().unwrap().success());
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, "name = \"t\"\n[traffic]\nfcd = \"t.fcd.xml\"\n").unwrap();
    let errors = scene::read(&file, &WHOLE).unwrap_err();
    assert!(
        errors.is_system() && errors.to_string().contains("it is a FIFO, and plain files alone are read"),
        "{errors}"
    );
}
