//! Distances between truths and estimates.

use glam::DVec2;
use ndarray::Array2;

/// Squared distances between places, `[truth, estimate]`.
pub(crate) fn squares_m2(truths: &[DVec2], estimates: &[DVec2]) -> Array2<f64> {
    Array2::from_shape_fn((truths.len(), estimates.len()), |(t, e)| truths[t].distance_squared(estimates[e]))
}
