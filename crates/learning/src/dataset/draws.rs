//! Random draws of each scene before any mesh is made: its vehicles and its radar.

use crate::dataset::recipe::Recipe;
use artifact::settings::Class;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::ops::Range;

/// Share of the scenes with a queue in which it stands; in the others it moves slowly.
const STANDING_SHARE: f64 = 0.5;
/// Greatest speed of a moving queue, m/s.
const ROLLING_MPS: f64 = 0.5;

/// A scene before it is computed.
pub(super) struct DrawnScene {
    pub(super) number: u64,
    /// Index of its base scene.
    pub(super) base: usize,
    pub(super) vehicles: Vec<Vehicle>,
    /// Drive of the first vehicle, if the scene has no queue.
    pub(super) first: Drive,
    /// Common speed of all vehicles in a queue.
    pub(super) queue_mps: Option<f64>,
    /// Height of the radar; `None`: that of the base scene.
    pub(super) radar_height_m: Option<f64>,
    pub(super) tilt_rad: Option<f64>,
    pub(super) extra_noise_db: f64,
    /// Whether its small parts are drawn, although the base scene may not ask for it.
    pub(super) is_statistical: bool,
}

/// A body to place.
pub(super) struct Vehicle {
    pub(super) class: Class,
    /// Index among the class's models.
    pub(super) model: usize,
    pub(super) variant: u64,
    /// Deviation from the lane's direction, counter-clockwise.
    pub(super) yaw_rad: f64,
    /// Offset from the lane's middle across the road, m.
    pub(super) offset_m: f64,
}

/// Lane, slant range and speed of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Drive {
    pub(super) lane: u8,
    pub(super) range_m: f64,
    pub(super) speed_mps: f64,
}

/// Kind of a scene, of which all scenes have similar errors: its base scene, whether its small parts are
/// drawn, and the class of a single vehicle, `None` for several.
pub(super) type Kind = (usize, bool, Option<Class>);

impl DrawnScene {
    pub(super) fn kind(&self) -> Kind {
        let alone = match self.vehicles.as_slice() {
            [vehicle] => Some(vehicle.class),
            _ => None,
        };
        (self.base, self.is_statistical, alone)
    }
}

/// Number of scenes of a recipe.
pub(super) fn count(recipe: &Recipe) -> u64 {
    u64::from(recipe.document.scenes_per_class) * recipe.models.len() as u64
}

/// Draws the scenes of these numbers; classes alternate, so that any beginning is balanced.
pub(super) fn draw(recipe: &Recipe, scenes: Range<u64>) -> Vec<DrawnScene> {
    let classes: Vec<(Class, usize)> =
        recipe.models.iter().map(|(class, models)| (*class, models.len())).collect();
    let one = |number: u64| {
        let (round, turn) = (number / classes.len() as u64, number % classes.len() as u64);
        let (class, models) = classes[turn as usize];
        draw_one(recipe, number, class, (round % models as u64) as usize)
    };
    scenes.map(one).collect()
}

fn draw_one(recipe: &Recipe, number: u64, class: Class, model: usize) -> DrawnScene {
    let document = &recipe.document;
    let mut random = stream(recipe, "dataset/scene", &[number]);
    let variant = random.random_range(0..document.vehicle_seeds);
    let first = drive(recipe, &mut random);
    let mut random = stream(recipe, "dataset/radar", &[number]);
    let base = random.random_range(0..recipe.bases.len());
    let [height, tilt, noise] = std::array::from_fn(|_| random.random());
    let mut random = stream(recipe, "dataset/traffic", &[number]);
    let [least, most] = document.vehicles_per_scene;
    let count = random.random_range(least..=most);
    let queues = random.random::<f64>() < document.queue_share;
    let rolling_mps =
        if random.random::<f64>() < STANDING_SHARE { 0.0 } else { ROLLING_MPS * random.random::<f64>() };
    let mut vehicles = vec![vehicle(recipe, number, 0, (class, model, variant))];
    for target in 1..u64::from(count) {
        let drawn = any_model(recipe, &mut random);
        vehicles.push(vehicle(recipe, number, target, drawn));
    }
    DrawnScene {
        number,
        base,
        vehicles,
        first,
        queue_mps: queues.then_some(rolling_mps),
        radar_height_m: document.radar_height_m.map(|span| within(span, height)),
        tilt_rad: document.tilt_deg.map(|span| within(span, tilt).to_radians()),
        extra_noise_db: within(document.extra_noise_db, noise),
        is_statistical: stream(recipe, "dataset/small parts", &[number]).random::<f64>()
            < document.statistical_share,
    }
}

pub(super) fn drive(recipe: &Recipe, random: &mut ChaCha8Rng) -> Drive {
    let document = &recipe.document;
    Drive {
        lane: document.lanes[random.random_range(0..document.lanes.len())],
        range_m: within(document.range_m, random.random()),
        speed_mps: within(document.speed_mps, random.random()),
    }
}

/// Draws a class, all with equal probability, then one of its models and a variant.
fn any_model(recipe: &Recipe, random: &mut ChaCha8Rng) -> (Class, usize, u64) {
    let number = random.random_range(0..recipe.models.len());
    let variant = random.random_range(0..recipe.document.vehicle_seeds);
    let share: f64 = random.random();
    let (class, models) =
        recipe.models.iter().nth(number).map_or((Class::Car, 0), |(class, of)| (*class, of.len()));
    (class, (share * models as f64) as usize, variant)
}

fn vehicle(
    recipe: &Recipe,
    number: u64,
    target: u64,
    (class, model, variant): (Class, usize, u64),
) -> Vehicle {
    let mut random = stream(recipe, "dataset/pose", &[number, target]);
    let [yaw, offset] = std::array::from_fn(|_| random.random());
    Vehicle {
        class,
        model,
        variant: if recipe.models[&class][model].has_variants() { variant } else { 0 },
        yaw_rad: within(recipe.document.yaw_deg, yaw).to_radians(),
        offset_m: within(recipe.document.offset_m, offset),
    }
}

/// Random numbers for one purpose in a scene or for one of its vehicles.
pub(super) fn stream(recipe: &Recipe, of: &str, index: &[u64]) -> ChaCha8Rng {
    ChaCha8Rng::from_seed(artifact::seed::key(recipe.seed, of, index))
}

/// Seed of a scene's noise, derived from that of its recipe: neighbouring recipes share none.
pub(super) fn noise_seed(of_recipe: u64, scene: u64) -> u64 {
    artifact::seed::number(of_recipe, "dataset/noise", &[scene])
}

pub(super) fn within([low, high]: [f64; 2], share: f64) -> f64 {
    low + (high - low) * share
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_of_neighbouring_recipes_have_no_noise_in_common() {
        let all = (0..100).flat_map(|seed| (0..100).map(move |scene| noise_seed(seed, scene)));
        assert_eq!(all.collect::<std::collections::BTreeSet<u64>>().len(), 10_000);
    }
}
