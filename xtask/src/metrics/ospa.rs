//! Optimal sub-pattern assignment of two sets of places: Schuhmacher, Vo, Vo, IEEE Trans. Signal Processing 56 (2008) 3447,
//! with p = 2.
//!
//! d² = (min over assignments of Σ min(|x − y|, c)² + c²·difference of their numbers)/(larger number): a mean error per body in
//! which a missing one counts c.

use dsp::assignment::assignment;
use glam::DVec2;
use ndarray::Array2;

/// Between 0 and the cut-off; 0 of two empty sets.
pub(crate) fn ospa_m(truths: &[DVec2], estimates: &[DVec2], cutoff_m: f64) -> f64 {
    let (fewer, more) = if truths.len() <= estimates.len() { (truths, estimates) } else { (estimates, truths) };
    if more.is_empty() {
        return 0.0;
    }
    let cutoff_m2 = cutoff_m.powi(2);
    let costs =
        Array2::from_shape_fn((fewer.len(), more.len()), |(i, j)| fewer[i].distance_squared(more[j]).min(cutoff_m2));
    // Every one of the fewer has a partner: to stay free costs more than all pairs together.
    let chosen = assignment(costs.view(), cutoff_m2 * (more.len() + 1) as f64);
    let pairs: f64 = chosen.iter().enumerate().filter_map(|(i, j)| Some(costs[(i, (*j)?)])).sum();
    let left_over = (more.len() - fewer.len()) as f64;
    ((pairs + cutoff_m2 * left_over) / more.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_closed_form_of_hand_made_sets() {
        let at = |x: f64| DVec2::new(x, 0.0);
        // Schuhmacher, Vo, Vo, eq. (3): one pair 3 m apart; one of two missing; a pair beyond the cut-off; nothing.
        assert_eq!(ospa_m(&[at(0.0)], &[at(3.0)], 5.0), 3.0);
        let missing = ospa_m(&[at(0.0), at(30.0)], &[at(3.0)], 5.0);
        assert!((missing - ((9.0 + 25.0) / 2.0_f64).sqrt()).abs() < 1e-12);
        assert_eq!(ospa_m(&[at(0.0)], &[at(50.0)], 5.0), 5.0);
        assert_eq!(ospa_m(&[], &[at(50.0)], 5.0), 5.0);
        assert_eq!(ospa_m(&[], &[], 5.0), 0.0);
    }
}
