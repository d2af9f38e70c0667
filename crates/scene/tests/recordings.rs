//! Recordings as simulators write them on other settings: long steps, teleports, types that change, degrees.

#![allow(clippy::unwrap_used, reason = "a test ends where it meets what it did not expect")]

use artifact::scene::{SceneHeader, TargetKind};
use scene::traffic::fcd::{FcdStep, FcdVehicle, RecordedVelocity};
use scene::traffic::interpolation::Interval;
use scene::{ReadOptions, frame_view, snapshot};
use std::fmt::Write as _;

/// Time, type, x, y, angle and speed of the one vehicle.
type Row<'a> = (f64, &'a str, f64, f64, f64, f64);

fn read(rows: &[Row<'_>], keys: &str) -> Result<SceneHeader, String> {
    let folder = tempfile::tempdir().unwrap();
    let mut recording = String::from("<fcd-export>\n");
    for (time, kind, x, y, angle, speed) in rows {
        let _ = writeln!(
            recording,
            "<timestep time=\"{time}\"><vehicle id=\"a\" x=\"{x}\" y=\"{y}\" angle=\"{angle}\" \
             type=\"{kind}\" speed=\"{speed}\"/></timestep>"
        );
    }
    std::fs::write(folder.path().join("t.fcd.xml"), recording + "</fcd-export>\n").unwrap();
    let file = folder.path().join("scene.toml");
    let text = format!("name = \"test\"\nframe_interval_s = 0.5\n[traffic]\nfcd = \"t.fcd.xml\"\n{keys}\n");
    std::fs::write(&file, text).unwrap();
    let options = ReadOptions::whole();
    scene::read(&file, &options).map_err(|errors| errors.to_string())
}

fn interval(a: FcdVehicle, b: FcdVehicle, step_s: f64) -> Interval {
    let mut interval = Interval::default();
    for (time_s, vehicle) in [(0.0, a), (step_s, b)] {
        interval.advance(FcdStep { time_s, line: 1, vehicles: vec![vehicle] });
    }
    interval
}

fn vehicle([x, y]: [f64; 2], angle_deg: f64) -> FcdVehicle {
    let (id, kind) = ("a".to_owned(), "car".to_owned());
    FcdVehicle {
        id,
        kind,
        front_m: [x, y, 0.0],
        angle_deg,
        velocity: RecordedVelocity::AlongHeading { speed_mps: 10.0 },
        line: 1,
    }
}

/// A vehicle that SUMO puts elsewhere was driven there as a lane change, 35.7 m off half a second later.
#[test]
fn a_teleport_to_the_side_is_no_lane_change() {
    for (aside_m, step_s) in [(38.0, 0.1), (38.0, 1.0), (7.0, 1.0), (-7.0, 0.5)] {
        let (from, to) = ([2.0, 50.0], [2.0 + aside_m, 50.0 - 10.0 * step_s]);
        let mut interval = interval(vehicle(from, 180.0), vehicle(to, 180.0), step_s);
        assert_eq!(interval.bumper(&vehicle(to, 180.0), 0.5 * step_s), None, "{aside_m} m");
        let next = vehicle([to[0], to[1] - 10.0 * step_s], 180.0);
        interval.advance(FcdStep { time_s: 2.0 * step_s, line: 1, vehicles: vec![next.clone()] });
        let bumper = interval.bumper(&next, 1.5 * step_s).unwrap();
        assert!((bumper.front_m.x - to[0]).abs() < 1e-9, "{aside_m} m: {}", bumper.front_m.x);
    }
}

/// A vehicle that turns right around a corner of two straight lanes within a step is where the recording has
/// it; a lane change in the same time is still driven.
#[test]
fn a_turn_within_a_long_step_is_no_lane_change() {
    let corner = interval(vehicle([0.0, 0.0], 0.0), vehicle([4.0, 5.0], 80.0), 1.0);
    let bumper = corner.bumper(&vehicle([4.0, 5.0], 80.0), 1.0).unwrap();
    assert!((bumper.front_m.x - 4.0).abs() < 1e-9 && (bumper.front_m.y - 5.0).abs() < 1e-9, "{bumper:?}");
    // Along the first lane, and then all at once.
    let late = interval(vehicle([0.0, 0.0], 0.0), vehicle([0.5, 10.0], 60.0), 1.0);
    let bumper = late.bumper(&vehicle([0.5, 10.0], 60.0), 1.0).unwrap();
    assert!((bumper.front_m.x - 0.5).abs() < 1e-9 && (bumper.front_m.y - 10.0).abs() < 1e-9, "{bumper:?}");
    let change = interval(vehicle([0.0, 0.0], 0.0), vehicle([3.5, 10.0], 5.0), 1.0);
    let bumper = change.bumper(&vehicle([3.5, 10.0], 5.0), 1.0).unwrap();
    assert!(bumper.front_m.x < 1.5, "the lane change has begun: {bumper:?}");
}

/// Its body was that of the first type, placed half a length of the other behind its bumper.
#[test]
fn a_vehicle_whose_type_is_changed_stays_what_it_was() {
    let rows = [
        (0.0, "car", 2.0, 40.0, 180.0, 0.0),
        (0.5, "car", 2.0, 40.0, 180.0, 0.0),
        (1.0, "bus", 2.0, 40.0, 180.0, 0.0),
    ];
    let scene = read(&rows, "").unwrap();
    let places = [0, 1, 2].map(|index| snapshot(&scene, index).poses[0].position_m);
    assert_eq!(places, [places[0]; 3]);
}

#[test]
fn a_type_is_looked_up_whole_before_it_is_cut_at_its_sign() {
    let rows = [(0.0, "my@car", 2.0, 40.0, 180.0, 9.0)];
    let model = |keys: &str| {
        let scene = read(&rows, keys)?;
        match &frame_view(&scene, 0).targets[0].kind {
            TargetKind::Mesh { model, .. } => Ok(model.clone()),
            TargetKind::Point { .. } => Err("a point".to_owned()),
        }
    };
    assert_eq!(model("models = { \"my@car\" = \"car-suv\" }").unwrap(), "car-suv");
    assert_eq!(model("models = { my = \"bus-city\" }").unwrap(), "bus-city");
}

/// `Car` for the recording's `car` had no effect: the default stood in its place.
#[test]
fn a_type_written_in_other_capitals_is_told() {
    let told = read(&[(0.0, "car", 2.0, 40.0, 180.0, 9.0)], "models = { Car = \"car-suv\" }").unwrap_err();
    assert!(told.contains("type `car` of vehicle `a` is not in `models`") && told.contains("Car"), "{told}");
}

#[test]
fn coordinates_in_degrees_are_refused() {
    let rows: Vec<Row> = (0..8)
        .map(|i| (0.5 * f64::from(i), "car", 11.58 + 3.5e-5 * f64::from(i), 50.44, 90.0, 10.0))
        .collect();
    let told = read(&rows, "").unwrap_err();
    assert!(told.contains("drive 35 m by their speeds") && told.contains("degrees"), "{told}");
}
