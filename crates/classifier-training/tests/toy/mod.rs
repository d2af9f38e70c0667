//! A toy dataset: one bright rectangle in noise, its size told by the class.

#![allow(dead_code, reason = "each test file takes what it needs")]

use artifact::dataset::{Crop, CropFormat, Sample};
use artifact::seed;
use artifact::settings::Class;
use artifact::signature::{Signature, SignatureCell};
use classifier::split_of_scene;
use classifier_training::{Augmentation, Schedule, TrainSettings};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

pub(crate) const SIDE: usize = 48;

pub(crate) const FORMAT: CropFormat = CropFormat {
    side: SIDE as u32,
    range_span_m: 24.0,
    velocity_span_mps: 8.0,
    floor_db: 0.0,
    ceiling_db: 50.0,
};

/// Rows and columns of the rectangle of each class.
const EXTENTS: [[usize; 2]; 4] = [[3, 10], [4, 30], [12, 22], [2, 3]];

pub(crate) const SETTINGS: TrainSettings = TrainSettings {
    input_side: 24,
    channels: [4, 8, 8],
    batch: 16,
    iterations: 120,
    learning_rate: 0.01,
    schedule: Schedule::Cosine { warm_up: 10 },
    weight_decay: 0.0,
    augmentation: Augmentation { range_shift_m: 1.0, velocity_shift_mps: 0.3, gain_db: 2.0, noise_db: 0.5 },
};

/// Four samples a scene, one of each class.
pub(crate) fn samples(count: u64) -> Vec<Sample> {
    (0..count).map(sample).collect()
}

pub(crate) fn sample(number: u64) -> Sample {
    let class = number as usize % 4;
    let mut generator = ChaCha8Rng::from_seed(seed::key(11, "toy", &[number]));
    let mut pixels: Vec<u8> = (0..SIDE * SIDE).map(|_| generator.random_range(0..80)).collect();
    let [rows, columns] = EXTENTS[class];
    let row = generator.random_range(0..SIDE - rows);
    let column = generator.random_range(0..SIDE - columns);
    for r in row..row + rows {
        for c in column..column + columns {
            pixels[r * SIDE + c] = generator.random_range(170..255);
        }
    }
    let scene = number / 4;
    Sample {
        id: format!("{scene}/{class}"),
        signature: signature(columns, &mut generator),
        crop: Some(Crop { pixels, range_m: 40.0, radial_velocity_mps: 0.0 }),
        class: Some(Class::ALL[class]),
        model: format!("rectangle-{class}"),
        variant: 0,
        scene,
        target: 0,
        frame: 0,
        split: split_of_scene(scene, 1),
        range_m: 40.0,
        radial_velocity_mps: 0.0,
        lane: Some(2),
        seed: scene,
    }
}

/// Signature as long as the rectangle, in noise.
fn signature(columns: usize, generator: &mut ChaCha8Rng) -> Signature {
    let level_db = |cell: usize| if cell < columns { 30.0 } else { 0.0 } + generator.random_range(0.0..3.0);
    let cells =
        (0..SIDE).map(level_db).map(|level_db| SignatureCell { level_db, ..SignatureCell::default() });
    Signature { range_m: 40.0, cell_m: 0.12, points: 1, cells: cells.collect(), ..Signature::default() }
}
