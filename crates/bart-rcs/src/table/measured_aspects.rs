//! Choice of the aspects of a table at which the error of the integrals is measured, and the resulting error
//! of the whole table.
//!
//! A table's level is that of its strong aspects, and so is most of its error: for a lorry at four azimuths
//! the flash of its side errs by −16 dB of the table's level, the other three by −24 to −28 dB. A table of up
//! to [`ALL_UP_TO`] aspects is measured completely. In a larger one the strong aspects are drawn
//! systematically with probabilities proportional to their powers (Hansen and Hurwitz, Ann. Math. Statist. 14
//! (1943) 333): those that contain the centres of equal parts of the table's power. Two of the others are
//! measured in addition. The error of all others is taken as the larger of two: the same share of their power
//! as for the strong ones, and as much per aspect as for those two.
//!
//! Errors of the model cost more. They are measured at aspects drawn regardless of power, and are relative to
//! the power of the whole table.

use crate::bodies::world::World;
use crate::joins::band::INTERPOLATION_ERROR;
use crate::table::aspect::Scattering;
use artifact::units::amplitude_ratio;

/// Number of aspects up to which all are measured.
pub(crate) const ALL_UP_TO: usize = 8;
/// Number of parts of the power from whose centres strong aspects are drawn.
const PARTS: usize = 4;
/// Number of other aspects drawn.
const OTHERS: usize = 2;
/// Factor on the mean of their error powers: for exponential distributions the mean of two is below a third
/// of the true one in one of seven cases.
const OF_TWO: f64 = 3.0;

/// Indices of the measured aspects, ascending; in a small table all are strong.
pub(crate) struct MeasuredAspects {
    strong: Vec<usize>,
    others: Vec<usize>,
}

impl MeasuredAspects {
    fn by(powers: &[f64]) -> Self {
        if powers.len() <= ALL_UP_TO {
            return Self { strong: (0..powers.len()).collect(), others: vec![] };
        }
        let total: f64 = powers.iter().sum();
        let holder = |part: usize| {
            let mut left = total * (part as f64 + 0.5) / PARTS as f64;
            powers.iter().position(|power| {
                left -= power;
                left < 0.0
            })
        };
        let mut strong: Vec<usize> = (0..PARTS).filter_map(holder).collect();
        strong.dedup();
        let rest: Vec<usize> = (0..powers.len()).filter(|index| !strong.contains(index)).collect();
        let mut others: Vec<usize> =
            (1..=OTHERS).filter_map(|k| rest.get(k * rest.len() / (OTHERS + 1)).copied()).collect();
        others.dedup();
        Self { strong, others }
    }

    /// Draws the aspects of a table.
    pub(crate) fn of(table: &[Scattering]) -> Self {
        Self::by(&table.iter().map(Scattering::mean_power).collect::<Vec<_>>())
    }

    /// Indices of all of them.
    pub(crate) fn all(&self) -> impl Iterator<Item = usize> {
        self.strong.iter().chain(&self.others).copied()
    }

    /// Error power of a whole table.
    fn error_power(&self, table: &[Scattering]) -> f64 {
        let sum = |of: &[usize], value: &dyn Fn(&Scattering) -> f64| {
            of.iter().map(|i| value(&table[*i])).sum::<f64>()
        };
        let error = |s: &Scattering| s.error_power.unwrap_or(0.0);
        let [strong, strong_power] = [sum(&self.strong, &error), sum(&self.strong, &Scattering::mean_power)];
        let rest_power = table.iter().map(Scattering::mean_power).sum::<f64>() - strong_power;
        let as_strong = amplitude_ratio(strong, strong_power).powi(2) * rest_power.max(0.0);
        let rest = (table.len() - self.strong.len()) as f64;
        let as_others = rest * OF_TWO * sum(&self.others, &error) / self.others.len().max(1) as f64;
        strong + as_strong.max(as_others)
    }
}

/// Number of aspects of a table at which the node rule is compared with the other one, and the first omitted
/// order is computed: all, or one of each of at least half as many parts. The spread is a ratio of powers
/// over them: 32 aspects with independent phases determine it to 1/√32, 0.8 dB.
const COMPARED_ASPECTS: usize = 64;

/// Indices of the aspects at which errors of the model are measured, ascending.
pub(crate) fn compared_aspects(aspects: usize) -> Vec<usize> {
    let to_a_part = aspects.div_ceil(COMPARED_ASPECTS).max(1);
    drawn_from_parts(aspects, aspects.div_ceil(to_a_part), "bart-rcs/compared-aspects")
}

/// Indices of random aspects, one from each of equal parts of a table, so that a body's symmetries are not
/// met every time; always the same for the same purpose.
pub(crate) fn drawn_from_parts(aspects: usize, parts: usize, purpose: &str) -> Vec<usize> {
    let first = |part: usize| part * aspects / parts;
    let drawn = |part: usize| {
        let size = (first(part + 1) - first(part)).max(1) as u64;
        first(part) + (artifact::seed::number(1, purpose, &[part as u64]) % size) as usize
    };
    (0..parts).map(drawn).collect()
}

/// Error of the whole table over ‖S‖, from the error power at the aspects where it was measured; `None` if it
/// was measured nowhere.
pub(crate) fn error_of_sample(
    table: &[Scattering],
    power: impl Fn(&Scattering) -> Option<f64>,
) -> Option<f64> {
    /// Least power of the whole over that of its error: where nothing scatters, edges that are left out
    /// are all there is, and an error of 300 dB says so.
    const LEAST_WHOLE: f64 = 1e-30;
    let measured: Vec<f64> = table.iter().filter_map(power).collect();
    let aspects_over_measured = table.len() as f64 / measured.len() as f64;
    let whole: f64 = table.iter().map(Scattering::mean_power).sum();
    let error_power = aspects_over_measured * measured.iter().sum::<f64>();
    (!measured.is_empty()).then(|| amplitude_ratio(error_power, whole.max(LEAST_WHOLE * error_power)))
}

/// Indices of the strongest aspects of a table, at most `most`, ascending.
pub(crate) fn strongest(table: &[Scattering], most: usize) -> Vec<usize> {
    let mut numbers: Vec<usize> = (0..table.len()).collect();
    numbers.sort_by(|a, b| table[*b].mean_power().total_cmp(&table[*a].mean_power()));
    numbers.truncate(most);
    numbers.sort_unstable();
    numbers
}

/// Error of the integrals of a table over ‖S‖; rounding in the far field, where the closed form is exact to
/// 1e-12.
pub(crate) fn measured_error(table: &[Scattering]) -> f64 {
    const ROUNDING: f64 = 1e-12;
    let error_power = MeasuredAspects::of(table).error_power(table);
    amplitude_ratio(error_power, table.iter().map(Scattering::mean_power).sum()).max(ROUNDING)
}

/// Error allowed for integrals over a band with layers, whose reflection depends on frequency: their weights
/// are evaluated at few frequencies, to a third of this share of the bound of the integrals, which allows for
/// a wave three times as strong without the layers.
pub(crate) fn interpolation_error(world: &World, frequencies: usize, bound: f64) -> f64 {
    const FEWEST_FREQUENCIES: usize = 3;
    let is_interpolated = world.is_dispersive() && frequencies >= FEWEST_FREQUENCIES;
    if is_interpolated { INTERPOLATION_ERROR * bound } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(powers: &[f64]) -> [Vec<usize>; 2] {
        let drawn = MeasuredAspects::by(powers);
        [drawn.strong, drawn.others]
    }

    #[test]
    fn every_aspect_of_a_small_table_is_compared_and_of_a_large_one_few_of_a_symmetry() {
        assert_eq!(compared_aspects(0), []);
        for aspects in [1, 63, 64] {
            assert_eq!(compared_aspects(aspects), (0..aspects).collect::<Vec<_>>());
        }
        for aspects in [65, 129, 361, 721, 5000] {
            let compared = compared_aspects(aspects);
            assert!((33..=64).contains(&compared.len()) && compared.is_sorted(), "{compared:?}");
            assert!(compared.iter().all(|index| *index < aspects));
        }
        // Of the circle in steps of a degree, broadside and end-on are five of 361 and at most their share
        // and two more of what is drawn.
        let flashes = compared_aspects(361).into_iter().filter(|index| index % 90 == 0).count();
        assert!(flashes <= 2, "{flashes}");
    }

    #[test]
    fn strong_aspects_are_drawn_and_two_of_the_others() {
        assert_eq!(drawn(&[1.0; 16]), [vec![2, 6, 10, 14], vec![5, 11]]);
        let mut flash = [1.0; 16];
        flash[5] = 1000.0;
        assert_eq!(drawn(&flash), [vec![5], vec![6, 11]]);
        flash[5] = 15.0;
        // Parts of 30/4: their centres lie at 3.75, 11.25, 18.75 and 26.25 of 0 … 5 | 5 … 20 | 20 … 30.
        assert_eq!(drawn(&flash), [vec![3, 5, 12], vec![6, 10]]);
        assert_eq!(drawn(&[1.0, 1000.0, 0.0]), [vec![0, 1, 2], vec![]]);
        for dark in [0.0, f64::NAN] {
            assert_eq!(drawn(&[dark; 16]), [vec![], vec![5, 10]]);
        }
    }
}
