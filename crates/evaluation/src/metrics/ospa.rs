//! Optimal sub-pattern assignment of truths and estimates: Schuhmacher, Vo, Vo, IEEE Trans. Signal Processing
//! 56 (2008) 3447, with p = 2.
//!
//! d² = (min over assignments of Σ min(d(x, y), c)² + c²·difference of their numbers)/(larger number): a mean
//! error per body in which a missing body counts c.

use ndarray::ArrayView2;
use radar::assignment::assignment;

/// OSPA of squared distances, m², `[truth, estimate]`: between 0 and the cut-off, m; 0 for two empty sets.
pub fn ospa_m(squares_m2: ArrayView2<f64>, cutoff_m: f64) -> f64 {
    let fewer_first =
        if squares_m2.nrows() <= squares_m2.ncols() { squares_m2 } else { squares_m2.reversed_axes() };
    let (fewer, more) = fewer_first.dim();
    if more == 0 {
        return 0.0;
    }
    let cutoff_m2 = cutoff_m.powi(2);
    let costs = fewer_first.mapv(|square| square.min(cutoff_m2));
    // Each member of the smaller set is assigned: leaving one out costs more than all pairs together.
    let chosen = assignment(costs.view(), cutoff_m2 * (more + 1) as f64);
    let pairs: f64 = chosen.iter().enumerate().filter_map(|(i, j)| Some(costs[(i, (*j)?)])).sum();
    ((pairs + cutoff_m2 * (more - fewer) as f64) / more as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::distances::squares_m2;
    use glam::DVec2;

    fn of_places(truths: &[DVec2], estimates: &[DVec2], cutoff_m: f64) -> f64 {
        ospa_m(squares_m2(truths, estimates).view(), cutoff_m)
    }

    #[test]
    fn it_is_the_closed_form_of_hand_made_sets() {
        let at = |x: f64| DVec2::new(x, 0.0);
        // Schuhmacher, Vo, Vo, eq. (3): one pair 3 m apart; one of two missing; a pair beyond the cut-off;
        // nothing.
        assert_eq!(of_places(&[at(0.0)], &[at(3.0)], 5.0), 3.0);
        let missing = of_places(&[at(0.0), at(30.0)], &[at(3.0)], 5.0);
        assert!((missing - ((9.0 + 25.0) / 2.0_f64).sqrt()).abs() < 1e-12);
        assert_eq!(of_places(&[at(0.0)], &[at(50.0)], 5.0), 5.0);
        assert_eq!(of_places(&[], &[at(50.0)], 5.0), 5.0);
        assert_eq!(of_places(&[], &[], 5.0), 0.0);
    }
}
