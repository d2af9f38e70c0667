//! Conditions of a sighting, from the truth beside its shard: signal-to-noise ratio, range, aspect, other
//! vehicles, line of sight, radar.

use crate::dataset::lines;
use crate::dataset::scene_line::{EstimateLine, SceneLine, VehicleLine};
use classifier::TrackKey;
use glam::DVec2;
use pipeline::host::dataset_folders::{DatasetFolder, lines_file};
use pipeline::host::failure::Failure;
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

/// Name and value of every condition of a track, in the order of the table.
pub(super) type Conditions = Vec<(&'static str, Bin)>;
/// Index among the values of a condition, and the value in words.
pub(super) type Bin = (usize, String);

/// Upper ends of the bins, dB and metres.
const SNR_DB: [f64; 6] = [10.0, 15.0, 20.0, 25.0, 30.0, 35.0];
const NOISE_DB: [f64; 4] = [0.0, 10.0, 20.0, 30.0];
const RANGE_M: [f64; 4] = [20.0, 30.0, 40.0, 50.0];
const HEIGHT_M: [f64; 2] = [5.0, 6.0];
const TILT_DEG: [f64; 2] = [-8.0, -4.0];
/// Angles between the vehicle's heading and the direction from it to the radar.
const ASPECT_DEG: [f64; 4] = [20.0, 70.0, 110.0, 160.0];

/// Conditions of tracks.
pub(super) type TrackConditions = BTreeMap<TrackKey, Conditions>;

/// Conditions of every detected vehicle in its first frame; none for shards without lines.
///
/// # Errors
/// A line is damaged: file, line and rule.
pub(super) fn conditions(folders: &[DatasetFolder]) -> Result<TrackConditions, Failure> {
    let mut all = BTreeMap::new();
    for (number, folder) in folders.iter().enumerate() {
        for file in folder.shards.iter().map(|shard| lines_file(shard)).filter(|file| file.exists()) {
            lines::read(&file)?.iter().for_each(|scene| of_scene(number, scene, &mut all));
        }
    }
    Ok(all)
}

/// Conditions of a vehicle without a line.
pub(super) fn unknown() -> Conditions {
    vec![("line beside the shard", (0, "none".into()))]
}

fn of_scene(dataset: usize, scene: &SceneLine, all: &mut BTreeMap<TrackKey, Conditions>) {
    let Some(number) = scene.scene else { return };
    let stand = Standpoint::of(scene);
    for vehicles in scene.frames.iter().map(|frame| &frame.vehicles) {
        let company = vehicles.len();
        for (vehicle, estimate) in vehicles.iter().filter_map(|of| Some((of, of.estimate.as_ref()?))) {
            let is_behind = vehicles.iter().any(|other| stand.stands_before(other, vehicle));
            let sight = if is_behind { (1, "behind another".into()) } else { (0, "free".into()) };
            all.entry((dataset, number, vehicle.target))
                .or_insert_with(|| of_vehicle(scene, company, sight, vehicle, estimate));
        }
    }
}

/// Place of a scene's radar on the ground, and the direction along its lanes, to which vehicles' angles
/// refer; the origin and +y for lines of earlier versions, which lack them.
struct Standpoint {
    radar_m: DVec2,
    lanes_azimuth_rad: f64,
}

impl Standpoint {
    fn of(scene: &SceneLine) -> Self {
        let [x_m, y_m] = [scene.radar_x_m, scene.radar_y_m].map(|place_m| place_m.unwrap_or(0.0));
        Self { radar_m: DVec2::new(x_m, y_m), lanes_azimuth_rad: scene.lanes_azimuth_rad() }
    }

    /// Vector from the radar to a vehicle's middle.
    fn way_m(&self, vehicle: &VehicleLine) -> DVec2 {
        DVec2::new(number(vehicle.x_m), number(vehicle.y_m)) - self.radar_m
    }

    /// Whether another vehicle's middle is nearer, and less than a body's width off the line from the radar
    /// to this one's.
    fn stands_before(&self, other: &VehicleLine, vehicle: &VehicleLine) -> bool {
        const WIDTH_M: f64 = 2.0;
        let [own, its] = [vehicle, other].map(|of| self.way_m(of));
        let direction = own.normalize_or_zero();
        its.length() < own.length() && its.dot(direction) > 0.0 && its.perp_dot(direction).abs() < WIDTH_M
    }

    /// Aspect angle: 0 shows the front, 180 the rear.
    fn aspect_deg(&self, vehicle: &VehicleLine) -> f64 {
        let yaw_rad = number(vehicle.yaw_deg).to_radians() - self.lanes_azimuth_rad - FRAC_PI_2;
        let way_m = self.way_m(vehicle);
        let cosine = -way_m.dot(DVec2::from_angle(yaw_rad)) / way_m.length();
        cosine.clamp(-1.0, 1.0).acos().to_degrees()
    }
}

fn number(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::NAN)
}

fn of_vehicle(
    scene: &SceneLine,
    company: usize,
    sight: Bin,
    vehicle: &VehicleLine,
    estimate: &EstimateLine,
) -> Conditions {
    let queue = if scene.is_queue { "in a queue" } else { "driving" };
    vec![
        ("SNR, dB", bin(number(estimate.snr_db), &SNR_DB)),
        ("noise added, dB", bin(number(scene.extra_noise_db), &NOISE_DB)),
        ("range, m", bin(number(vehicle.range_m), &RANGE_M)),
        ("aspect, °", bin(Standpoint::of(scene).aspect_deg(vehicle), &ASPECT_DEG)),
        ("vehicles of the scene", (company, company.to_string())),
        ("line of sight", sight),
        ("traffic", (0, queue.into())),
        ("small parts", (0, scene.detail.as_deref().unwrap_or("of the mesh").into())),
        ("height of the radar, m", bin(number(scene.radar_height_m), &HEIGHT_M)),
        ("tilt, °", bin(number(scene.tilt_deg), &TILT_DEG)),
        ("radar", (0, scene.base.as_deref().unwrap_or("–").trim_end_matches(".toml").into())),
    ]
}

/// Bin of a value; upper ends belong to their bins, so that zero noise has a bin of its own.
fn bin(value: f64, ends: &[f64]) -> Bin {
    if value.is_nan() {
        return (ends.len() + 1, "–".into());
    }
    match ends.iter().position(|end| value <= *end) {
        Some(0) => (0, format!("to {}", ends[0])),
        Some(at) => (at, format!("{} to {}", ends[at - 1], ends[at])),
        None => (ends.len(), format!("over {}", ends[ends.len() - 1])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vehicle(x_m: f64, y_m: f64, yaw_deg: f64) -> VehicleLine {
        VehicleLine { x_m: Some(x_m), y_m: Some(y_m), yaw_deg: Some(yaw_deg), ..VehicleLine::default() }
    }

    #[test]
    fn a_vehicle_that_comes_shows_its_front_and_one_that_leaves_its_rear() {
        let aspect_deg = |vehicle: &VehicleLine| Standpoint::of(&SceneLine::default()).aspect_deg(vehicle);
        let at = |yaw_deg: f64| aspect_deg(&vehicle(0.0, 40.0, yaw_deg));
        assert!(at(0.0) < 1e-6 && (at(180.0) - 180.0).abs() < 1e-5 && (at(-90.0) - 90.0).abs() < 1e-9);
        assert!((aspect_deg(&vehicle(40.0, 40.0, 0.0)) - 45.0).abs() < 1e-9);
    }

    #[test]
    fn aspects_and_lines_of_sight_are_those_from_the_radar_by_the_way_along_its_lanes() {
        // Lanes towards +x, the radar 20 m along one of them: its vehicles drive towards −x.
        let scene = SceneLine {
            radar_x_m: Some(20.0),
            radar_y_m: Some(10.0),
            lanes_azimuth_deg: Some(90.0),
            ..SceneLine::default()
        };
        let stand = Standpoint::of(&scene);
        let at = |x_m: f64, yaw_deg: f64| vehicle(x_m, 10.0, yaw_deg);
        let aspects = [at(50.0, 0.0), at(50.0, 180.0), at(0.0, 0.0), at(50.0, 90.0)];
        let expected = [0.0, 180.0, 180.0, 90.0];
        for (vehicle, expected) in aspects.iter().zip(expected) {
            // The arc cosine of a rounded one is off by 1e-6°.
            assert!((stand.aspect_deg(vehicle) - expected).abs() < 1e-5, "{vehicle:?}");
        }
        assert!(stand.stands_before(&at(30.0, 0.0), &at(50.0, 0.0)));
        assert!(!stand.stands_before(&at(0.0, 0.0), &at(50.0, 0.0)), "on the radar's other side");
    }

    #[test]
    fn a_nearer_vehicle_less_than_a_width_off_the_line_of_sight_stands_before_another() {
        let stands_before =
            |a: &VehicleLine, b: &VehicleLine| Standpoint::of(&SceneLine::default()).stands_before(a, b);
        let at = |x_m: f64, y_m: f64| vehicle(x_m, y_m, 0.0);
        assert!(
            stands_before(&at(2.0, 30.0), &at(2.0, 40.0)) && !stands_before(&at(2.0, 40.0), &at(2.0, 30.0))
        );
        assert!(!stands_before(&at(5.75, 30.0), &at(2.0, 40.0)), "in the next lane");
        assert!(!stands_before(&at(-2.0, -30.0), &at(2.0, 40.0)), "on the radar's other side");
        let itself = at(2.0, 30.0);
        assert!(!stands_before(&itself, &itself));
    }

    #[test]
    fn ends_belong_to_the_bin_below() {
        let words = [0.0, 0.1, 10.0, 31.0].map(|db| bin(db, &NOISE_DB).1);
        assert_eq!(words, ["to 0", "0 to 10", "0 to 10", "over 30"]);
        assert_eq!(bin(f64::NAN, &RANGE_M).1, "–");
    }
}
