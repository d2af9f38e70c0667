//! Scenes of a seed: one to three own vehicles in three lanes, 12 to 80 m away.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha12Rng;
use std::fmt::Write as _;

const VEHICLES: [&str; 8] = [
    "car-suv",
    "car-sedan",
    "car-hatchback",
    "bus-mini",
    "truck-box",
    "motorcycle-street",
    "motorcycle-scooter",
    "motorcycle-touring",
];

/// Text of scene `number` with so many vehicles at most.
pub(super) fn scene(seed: u64, number: u64, most: usize) -> String {
    let mut rng = ChaCha12Rng::from_seed(artifact::seed::key(seed, "validation/planner", &[number]));
    let preset = ["1x1", "3x4"][rng.random_range(0..2)];
    let mut text = format!(
        "name = \"planned-{seed}-{number:03}\"\n[radar]\nboresight_el_deg = -8.0\n[radar.waveform]\n\
         chirps = 64\n\
         [radar.array]\npreset = \"{preset}\"\n[noise]\nnoise_figure_db = 12.0\n"
    );
    let count = [1, 1, 2, 2, 3][rng.random_range(0..5)].min(most);
    for lane in 1..=count {
        let model = VEHICLES[rng.random_range(0..VEHICLES.len())];
        let (y_m, mps) = (rng.random_range(12.0..80.0), rng.random_range(-12.0..0.0));
        let yaw_deg = -90.0 + rng.random_range(-15.0..15.0);
        let _ = write!(
            text,
            "[[target]]\nkind = \"mesh\"\nid = \"body-{lane}\"\nclass = \"car\"\nmodel = \"{model}\"\n\
             lane = {lane}\n\
             y_m = {y_m:.2}\nvelocity_mps = [0.0, {mps:.2}, 0.0]\nyaw_deg = {yaw_deg:.1}\n"
        );
    }
    text
}
