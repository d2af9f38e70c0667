//! Scenes of a seed: one to three vehicles, the project's own and real ones, in three lanes, with three
//! arrays, some with clutter; and frames of recorded traffic.

use crate::project::{project_root, shared};
use crate::random_scenes::{SceneRng, VehicleModel, clutter, radar, traffic};
use std::fmt::Write as _;

/// Real vehicles of `../shared/vehicles`, of all classes and with 300 to 80,000 triangles.
const REAL_VEHICLES: [VehicleModel<'static>; 12] = [
    ("gazebo_prius", "car"),
    ("modern_hatchback", "car"),
    ("jeep_cherokee_suv", "car"),
    ("smarts_minibus", "bus"),
    ("paz_bus", "bus"),
    ("town_bus", "bus"),
    ("smarts_moving_truck", "truck"),
    ("chrono_box_truck_6x4", "truck"),
    ("man_kat1_5t", "truck"),
    ("smarts_motorcycle", "motorcycle"),
    ("vespa", "motorcycle"),
    ("harley_72", "motorcycle"),
];

/// Share of scenes that are frames of traffic, and of scenes with clutter.
const OF_TRAFFIC: f64 = 0.1;
const WITH_CLUTTER: f64 = 0.2;

/// A scene with its requested accuracy.
pub(super) struct RandomScene {
    pub(super) name: String,
    pub(super) text: String,
    pub(super) asked_db: f64,
}

/// Scene `number` of a seed with this accuracy; `None` if its vehicle is a missing real one.
pub(super) fn scene(seed: u64, number: u64, asked_db: f64) -> Option<RandomScene> {
    let mut rng = SceneRng::new(seed, "validation/planner", number);
    let name = format!("planned-{seed}-{number:03}");
    let mut text = format!("name = \"{name}\"\n");
    if rng.chance(OF_TRAFFIC) {
        traffic(&mut rng, &project_root(), "", &mut text);
        return Some(RandomScene { name, text, asked_db: asked_db.max(-15.0) });
    }
    radar(&mut rng, &mut text);
    // The finest accuracies are requested only for a single vehicle: the truth of three takes hours.
    let count = if asked_db < -25.0 { 1 } else { rng.choose(&[1, 1, 2, 2, 3]) };
    for lane in 1..=count {
        vehicle(&mut rng, lane, &mut text)?;
    }
    if rng.chance(WITH_CLUTTER) {
        clutter(&mut rng, &mut text);
    }
    Some(RandomScene { name, text, asked_db })
}

/// Adds a vehicle that approaches within 15° of its lane; a quarter of them are at rest.
fn vehicle(rng: &mut SceneRng, lane: u32, text: &mut String) -> Option<()> {
    let (own, (real, of_real)) = (rng.own_vehicle(), rng.choose(&REAL_VEHICLES));
    let file = shared().join(format!("vehicles/{real}.glb"));
    let is_real = rng.chance(0.4);
    let (model, class) = if is_real { (file.to_str()?, of_real) } else { own };
    let (y_m, yaw_deg) = (rng.between(12.0, 80.0), rng.between(-105.0, -75.0));
    let mps = if rng.chance(0.25) { 0.0 } else { rng.between(-12.0, 0.0) };
    let _ = write!(
        text,
        "[[target]]\nkind = \"mesh\"\nid = \"body-{lane}\"\nclass = \"{class}\"\nmodel = {model:?}\nlane = {lane}\n\
         y_m = {y_m:.2}\nvelocity_mps = [0.0, {mps:.2}, 0.0]\nyaw_deg = {yaw_deg:.1}\n"
    );
    (!is_real || file.exists()).then_some(())
}
