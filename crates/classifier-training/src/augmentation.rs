//! Random variation of training crops: where the target lies in the crop, how strong it is, how its level
//! flickers.
//!
//! The paper widens its dataset by translation, rotation and noise of images. A rotation has no meaning in
//! axes of metres and metres per second; a change of level has one (aspect, link budget), so it stands in its
//! place.

use artifact::dataset::CropFormat;
use artifact::seed;
use artifact::units::{db_from_power, power_from_db};
use classifier::ClassifierError;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Amount by which a training crop is varied; zero everywhere leaves it as it is.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Augmentation {
    /// Largest shift along range, either way; uniform.
    pub range_shift_m: f64,
    /// Largest shift along velocity, either way; uniform.
    pub velocity_shift_mps: f64,
    /// Largest gain of the target over the noise, either way; uniform in dB.
    pub gain_db: f64,
    /// Standard deviation of the level of each pooled pixel; normal in dB.
    pub noise_db: f64,
}

impl Augmentation {
    /// No variation.
    pub const NONE: Self = Self { range_shift_m: 0.0, velocity_shift_mps: 0.0, gain_db: 0.0, noise_db: 0.0 };

    pub(crate) fn check(&self) -> Result<(), ClassifierError> {
        let limits = [
            ("range_shift_m", self.range_shift_m),
            ("velocity_shift_mps", self.velocity_shift_mps),
            ("gain_db", self.gain_db),
            ("noise_db", self.noise_db),
        ];
        match limits.into_iter().find(|(_, limit)| !(0.0..=100.0).contains(limit)) {
            Some((setting, found)) => Err(ClassifierError::Setting { setting, rule: "from 0 to 100", found }),
            None => Ok(()),
        }
    }
}

/// One varied copy of a pooled crop `[side, side]`; `key` names the copy, so that no two are varied alike and
/// the same key always gives the same copy.
pub(crate) fn augmented(
    pooled: &[u8],
    format: &CropFormat,
    augmentation: &Augmentation,
    key: VariationKey,
) -> Vec<u8> {
    let mut generator = ChaCha8Rng::from_seed(seed::key(key.seed, "classifier/augmentation", &[key.example]));
    let side = pooled.len().isqrt();
    let mut draw = |limit: f64| limit * generator.random_range(-1.0..=1.0);
    let columns = draw(augmentation.range_shift_m) / format.range_span_m * side as f64;
    let rows = draw(augmentation.velocity_shift_mps) / format.velocity_span_mps * side as f64;
    let gain = power_from_db(draw(augmentation.gain_db));
    let levels = gained_levels(format, gain);
    let mut copy = shifted(pooled, side, [rows.round() as isize, columns.round() as isize]);
    copy.iter_mut().for_each(|p| *p = levels[usize::from(*p)]);
    flicker(&mut copy, augmentation.noise_db * levels_per_db(format), &mut generator);
    copy
}

/// Names one draw: the n-th example that training takes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct VariationKey {
    pub(crate) seed: u64,
    pub(crate) example: u64,
}

fn levels_per_db(format: &CropFormat) -> f64 {
    255.0 / (format.ceiling_db - format.floor_db)
}

/// Grey level that every level becomes when the target's power is multiplied by `gain` and the noise
/// (power 1) is not.
fn gained_levels(format: &CropFormat, gain: f64) -> [u8; 256] {
    std::array::from_fn(|grey| {
        let power = power_from_db(format.floor_db + grey as f64 / levels_per_db(format));
        let gained = if power > 1.0 { 1.0 + gain * (power - 1.0) } else { power };
        ((db_from_power(gained) - format.floor_db) * levels_per_db(format)).round() as u8
    })
}

/// Moves the image by whole pixels; what comes in at a border is the image mirrored there, so that noise
/// stays noise.
fn shifted(pooled: &[u8], side: usize, by: [isize; 2]) -> Vec<u8> {
    let source = |at: usize, by: isize| mirrored(at as isize - by, side as isize) as usize;
    (0..side * side).map(|p| pooled[source(p / side, by[0]) * side + source(p % side, by[1])]).collect()
}

fn mirrored(at: isize, side: isize) -> isize {
    let folded = at.rem_euclid(2 * side);
    folded.min(2 * side - 1 - folded)
}

fn flicker(pixels: &mut [u8], deviation_levels: f64, generator: &mut impl Rng) {
    if deviation_levels <= 0.0 {
        return;
    }
    for pixel in pixels {
        let normal: f64 = StandardNormal.sample(generator);
        *pixel = (f64::from(*pixel) + deviation_levels * normal).round() as u8; // `as` clamps to 0..=255
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FORMAT: CropFormat =
        CropFormat { side: 64, range_span_m: 32.0, velocity_span_mps: 8.0, floor_db: -5.0, ceiling_db: 46.0 };
    const KEY: VariationKey = VariationKey { seed: 5, example: 8 };

    #[test]
    fn no_variation_leaves_the_crop_as_it_is() {
        let crop: Vec<u8> = (0..64 * 64).map(|p| (p % 256) as u8).collect();
        assert_eq!(augmented(&crop, &FORMAT, &Augmentation::NONE, KEY), crop);
    }

    #[test]
    fn a_shift_moves_the_target_by_at_most_the_limit_and_mirrors_at_the_border() {
        let mut crop = vec![0; 64 * 64];
        crop[32 * 64 + 32] = 255;
        let augmentation = Augmentation { range_shift_m: 2.0, velocity_shift_mps: 0.5, ..Augmentation::NONE };
        let mut places = std::collections::BTreeSet::new();
        for example in 0..500 {
            let copy = augmented(&crop, &FORMAT, &augmentation, VariationKey { seed: 1, example });
            let at = copy.iter().position(|p| *p == 255).unwrap();
            places.insert((at / 64, at % 64));
        }
        // 2 m and 0.5 m/s are 4 pixels each: 9 x 9 places, each missed by 500 draws with probability below
        // e⁻¹·⁵ at the corners (a quarter of the inner ones' chance); 40 places are certain beyond doubt.
        assert!(places.iter().all(|(r, c)| r.abs_diff(32) <= 4 && c.abs_diff(32) <= 4));
        assert!(places.len() > 40);
        assert_eq!(shifted(&[1, 2, 3, 4], 2, [0, 1]), [1, 1, 3, 3]);
    }

    #[test]
    fn a_gain_moves_strong_levels_by_its_decibels_and_leaves_noise_alone() {
        let levels = gained_levels(&FORMAT, power_from_db(6.0));
        assert_eq!(FORMAT.ceiling_db - FORMAT.floor_db, 51.0); // 5 grey levels a dB
        assert_eq!(levels[20], 20); // −1 dB: below the noise
        assert_eq!(levels[200], 230); // 35 dB becomes 41
        assert_eq!(levels[255], 255);
    }

    #[test]
    fn noise_has_the_deviation_asked_for() {
        let augmentation = Augmentation { noise_db: 2.0, ..Augmentation::NONE };
        let copy = augmented(&vec![128; 64 * 64], &FORMAT, &augmentation, KEY);
        let squares: f64 = copy.iter().map(|p| (f64::from(*p) - 128.0).powi(2)).sum();
        let deviation = (squares / copy.len() as f64).sqrt();
        // Ten levels; the estimate from 4096 pixels scatters by 10/√8192 = 0.11, five times that.
        assert!((deviation - 10.0).abs() < 0.55, "{deviation}");
    }
}
