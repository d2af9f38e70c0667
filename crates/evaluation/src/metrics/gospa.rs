//! Generalised optimal sub-pattern assignment of truths and estimates: Rahmathullah, García-Fernández,
//! Svensson, *Generalized optimal sub-pattern assignment metric*, FUSION 2017, with α = 2 and p = 2.
//!
//! d² = min over assignments of Σ d(x, y)² + c²/2·(number of unassigned truths and estimates). With α = 2 it
//! splits into localisation, missed and false (their proposition 1), which is why it is preferred to OSPA.
//! Between places d is their distance, and the whole is a metric; between a body and an object it is that to
//! the nearest part of the body, which is not a metric (all places of one body have distance zero from it),
//! and the sum is only an error.

use ndarray::{Array2, ArrayView2};
use radar::assignment::assignment;

/// The parts of d².
#[derive(Debug, Clone, PartialEq)]
pub struct Gospa {
    /// Σ d² over assigned pairs, m².
    pub localisation_m2: f64,
    /// Truths without an estimate.
    pub missed: usize,
    /// Estimates without a truth.
    pub false_ones: usize,
    /// Index of each truth's estimate, in the order of the truths.
    pub chosen: Vec<Option<usize>>,
    cutoff_m: f64,
}

impl Gospa {
    /// The GOSPA distance, m.
    pub fn distance_m(&self) -> f64 {
        let left_over = (self.missed + self.false_ones) as f64;
        (self.localisation_m2 + 0.5 * self.cutoff_m.powi(2) * left_over).sqrt()
    }

    /// Removes unassigned truths and estimates that do not count: truths by their indices, estimates by their
    /// number.
    pub fn without(self, truths: &[usize], estimates: usize) -> Self {
        let chosen = self.chosen.into_iter().enumerate().filter(|(truth, _)| !truths.contains(truth));
        Self {
            chosen: chosen.map(|(_, estimate)| estimate).collect(),
            missed: self.missed - truths.len(),
            false_ones: self.false_ones - estimates,
            ..self
        }
    }
}

/// Cost by rank in the order of strength, in which estimates are given: of two equally good ones the earlier
/// is chosen. The cost per rank, a square millimetre in a million, is far below the accuracy of any place.
const RANK_M2: f64 = 1e-12;

/// GOSPA of squared distances, m², `[truth, estimate]`; pairs further apart than the cut-off c are not
/// assigned.
pub fn gospa(squares_m2: ArrayView2<f64>, cutoff_m: f64) -> Gospa {
    gospa_by_costs(squares_m2, squares_m2, cutoff_m)
}

/// GOSPA of the pairs with the least sum of costs, m², among those within the cut-off; other terms of the
/// costs are not part of the metric.
pub(crate) fn gospa_by_costs(squares_m2: ArrayView2<f64>, costs_m2: ArrayView2<f64>, cutoff_m: f64) -> Gospa {
    let (truths, estimates) = squares_m2.dim();
    // An unassigned truth costs c²/2, and leaves an estimate unassigned for another c²/2.
    let left_over_m2 = cutoff_m.powi(2);
    let is_pair = |at: (usize, usize)| squares_m2[at] < left_over_m2;
    let ranked = Array2::from_shape_fn((truths, estimates), |at| {
        if is_pair(at) { costs_m2[at] + RANK_M2 * at.1 as f64 } else { f64::INFINITY }
    });
    let pairs = squares_m2.indexed_iter().filter(|(at, _)| is_pair(*at));
    let dearest_m2 = pairs.map(|(at, square_m2)| costs_m2[at] - square_m2).fold(0.0, f64::max);
    let chosen = assignment(ranked.view(), left_over_m2 + dearest_m2);
    let pairs = chosen.iter().enumerate().filter_map(|(t, e)| Some((t, (*e)?)));
    let (count, sum) = pairs.fold((0, 0.0), |(count, sum), pair| (count + 1, sum + squares_m2[pair]));
    Gospa { localisation_m2: sum, missed: truths - count, false_ones: estimates - count, chosen, cutoff_m }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::distances::squares_m2;
    use glam::DVec2;

    fn of_places(truths: &[DVec2], estimates: &[DVec2], cutoff_m: f64) -> Gospa {
        gospa(squares_m2(truths, estimates).view(), cutoff_m)
    }

    #[test]
    fn of_two_estimates_that_are_no_distance_away_the_stronger_is_taken() {
        let none = Array2::zeros((1, 3));
        assert_eq!(gospa(none.view(), 3.0).chosen, [Some(0)]);
    }

    fn places(list: &[[f64; 2]]) -> Vec<DVec2> {
        list.iter().map(|p| DVec2::from(*p)).collect()
    }

    #[test]
    fn distances_missed_and_false_ones_add_up_as_in_the_closed_form() {
        let truths = places(&[[0.0, 0.0], [10.0, 0.0], [20.0, 0.0]]);
        let got = of_places(&truths, &places(&[[20.0, 4.0], [0.0, 3.0]]), 5.0);
        assert_eq!((got.localisation_m2, got.missed, got.false_ones), (25.0, 1, 0));
        assert_eq!(got.chosen, [Some(1), None, Some(0)]);
        // √(9 + 16 + 25/2).
        assert!((got.distance_m() - 37.5_f64.sqrt()).abs() < 1e-12);
        // Beyond the cut-off a pair is one missed and one false.
        let apart = of_places(&truths[..1], &places(&[[5.1, 0.0]]), 5.0);
        assert_eq!((apart.missed, apart.false_ones, apart.distance_m()), (1, 1, 5.0));
    }

    #[test]
    fn it_is_a_metric() {
        let sets = [
            places(&[]),
            places(&[[0.0, 0.0]]),
            places(&[[1.0, 1.0], [4.0, -2.0]]),
            places(&[[0.5, 0.0], [4.0, 0.0], [9.0, 9.0]]),
            places(&[[9.0, 8.0], [1.0, 0.5]]),
        ];
        let d = |a: usize, b: usize| of_places(&sets[a], &sets[b], 5.0).distance_m();
        for a in 0..sets.len() {
            assert_eq!(d(a, a), 0.0);
            for b in 0..sets.len() {
                assert!((d(a, b) - d(b, a)).abs() < 1e-12, "{a} {b}");
                for c in 0..sets.len() {
                    assert!(d(a, c) <= d(a, b) + d(b, c) + 1e-12, "{a} {b} {c}");
                }
            }
        }
    }

    #[test]
    fn the_best_assignment_is_taken_not_the_nearest_pairs() {
        // Nearest first would pair 2 with 3 and leave 0 and 6.
        let got = of_places(&places(&[[0.0, 0.0], [3.0, 0.0]]), &places(&[[2.0, 0.0], [6.0, 0.0]]), 5.0);
        assert_eq!((got.chosen, got.localisation_m2), (vec![Some(0), Some(1)], 13.0));
    }
}
