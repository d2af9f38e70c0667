//! A dataset of four classes that takes no tracing: one bright rectangle a crop, its size told by the class.

use artifact::dataset::{Crop, CropFormat, Dataset, Sample, Split};
use artifact::settings::Class;
use artifact::signature::{Signature, SignatureCell};
use artifact::{Provenance, Writer};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::ops::Range;
use std::path::Path;

/// Rows and columns of a crop: as many as the network's input has, which is the least that it takes.
const SIDE: usize = 113;
/// Rows and columns of the rectangle of each class.
const EXTENTS: [[usize; 2]; 4] = [[8, 25], [10, 70], [28, 50], [5, 8]];

/// Writes a dataset of so many crops of each class, a shard for each class; every fourth scene validates,
/// every fifth tests.
pub(crate) fn write(folder: &Path, of_each_class: u64) {
    write_some(folder, 0..of_each_class);
}

/// The same of scenes of these numbers.
pub(crate) fn write_some(folder: &Path, numbers: Range<u64>) {
    let format = CropFormat {
        side: SIDE as u32,
        range_span_m: 24.0,
        velocity_span_mps: 8.0,
        floor_db: 0.0,
        ceiling_db: 50.0,
    };
    std::fs::create_dir_all(folder).unwrap();
    for class in 0..Class::ALL.len() {
        let file = folder.join(format!("shard-{class:04}.dataset"));
        let mut writer = Writer::<Dataset>::create(&file, &Provenance::default(), &format).unwrap();
        for number in numbers.clone() {
            writer.write(&sample(class, number)).unwrap();
        }
        writer.finish().unwrap();
    }
}

fn sample(class: usize, number: u64) -> Sample {
    let scene = 4 * number + class as u64;
    let split = match (number % 4, number % 5) {
        (3, _) => Split::Validation,
        (_, 4) => Split::Test,
        _ => Split::Train,
    };
    Sample {
        id: format!("scene-{scene}"),
        signature: signature(class),
        crop: Some(Crop { pixels: pixels(class, scene), range_m: 40.0, radial_velocity_mps: 0.0 }),
        class: Some(Class::ALL[class]),
        model: format!("rectangle-{class}"),
        variant: 0,
        scene,
        target: 0,
        frame: 0,
        split,
        range_m: 40.0,
        radial_velocity_mps: 0.0,
        lane: Some(2),
        seed: scene,
    }
}

/// Signature with as many cells as the class's rectangle has columns.
fn signature(class: usize) -> Signature {
    let [_, columns] = EXTENTS[class];
    let cell = SignatureCell { level_db: 30.0, ..SignatureCell::default() };
    Signature { range_m: 40.0, cell_m: 0.12, points: 1, cells: vec![cell; columns], ..Signature::default() }
}

fn pixels(class: usize, seed: u64) -> Vec<u8> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut pixels: Vec<u8> = (0..SIDE * SIDE).map(|_| random.random_range(0..80)).collect();
    let [rows, columns] = EXTENTS[class];
    let (row, column) = (random.random_range(0..SIDE - rows), random.random_range(0..SIDE - columns));
    for line in pixels.chunks_exact_mut(SIDE).skip(row).take(rows) {
        line[column..column + columns].iter_mut().for_each(|pixel| *pixel = random.random_range(170..255));
    }
    pixels
}
