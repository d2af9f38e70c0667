//! Type of features, and statistics of weighted values that several rooms use.

/// Names and values of features: dB and dBsm, m, or shares.
pub type Features = Vec<(&'static str, f64)>;

/// Cross section that represents none, dBsm: below the weakest visible cell at 25 m.
pub(crate) const NONE_DBSM: f64 = -30.0;

/// Mean and standard deviation of weighted values; zero without weight.
pub(crate) fn moments(values: impl Iterator<Item = (f64, f64)> + Clone) -> [f64; 2] {
    let total: f64 = values.clone().map(|(weight, _)| weight).sum();
    if total <= 0.0 {
        return [0.0; 2];
    }
    let mean = values.clone().map(|(weight, value)| weight * value).sum::<f64>() / total;
    let variance = values.map(|(weight, value)| weight * (value - mean).powi(2)).sum::<f64>() / total;
    [mean, variance.sqrt()]
}

/// Difference between the least and the greatest value; 0 without any.
pub(crate) fn span(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let (least, most) =
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max));
    if most >= least { most - least } else { 0.0 }
}
