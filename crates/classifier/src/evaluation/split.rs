//! Split of a dataset by scenes.

use artifact::dataset::Split;
use artifact::seed;
use rand::{SeedableRng, seq::SliceRandom};
use rand_chacha::ChaCha8Rng;

/// Splits of five scenes, 3 : 1 : 1; the paper's 600 : 200 : 320 of 1120 images is 54 : 18 : 28 %.
const BLOCK: [Split; 5] = [Split::Train, Split::Train, Split::Train, Split::Validation, Split::Test];

/// The split of a scene by its number: of every five successive scenes (0 to 4, 5 to 9, …) three are for
/// training, one for validation and one for the test, in an order drawn from `seed`. So any prefix of a
/// growing dataset keeps its proportions and its splits.
pub fn split_of_scene(scene: u64, seed: u64) -> Split {
    let places = BLOCK.len() as u64;
    let mut order = BLOCK;
    order.shuffle(&mut ChaCha8Rng::from_seed(seed::key(seed, "classifier/split", &[scene / places])));
    order[(scene % places) as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_every_five_scenes_three_train_one_validates_and_one_tests() {
        for block in 0..200 {
            let mut splits: Vec<Split> = (5 * block..5 * block + 5).map(|s| split_of_scene(s, 3)).collect();
            splits.sort();
            assert_eq!(splits, BLOCK);
        }
    }

    #[test]
    fn the_place_of_the_test_scene_in_its_block_is_drawn_evenly_and_depends_on_the_seed() {
        let blocks = 1000;
        let test_scenes = |seed| (0..5 * blocks).filter(move |s| split_of_scene(*s, seed) == Split::Test);
        for place in 0..5 {
            let count = test_scenes(1).filter(|s| s % 5 == place).count() as f64;
            // Binomial with mean 200 and deviation √(1000 · 0.2 · 0.8) = 12.6; five deviations.
            assert!((count - 200.0).abs() < 63.0, "place {place}: {count}");
        }
        assert!(test_scenes(1).ne(test_scenes(2)));
    }
}
