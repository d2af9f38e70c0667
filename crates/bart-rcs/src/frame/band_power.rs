//! Power of a table of paths over the band of a radar.

use crate::frame::path_plan::Plan;
use crate::frame::path_sum::element_over_band;
use artifact::paths::Path;

/// Middles of equal parts of the sampled sweep.
pub(crate) fn frequencies_hz(centre_hz: f64, bandwidth_hz: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| centre_hz + bandwidth_hz * ((i as f64 + 0.5) / count as f64 - 0.5)).collect()
}

/// Mean over frequency of |S(paths)|², as the radar sees it.
pub(crate) fn mean_power(paths: &[Path], plan: &Plan<'_>, seconds: f64, frequencies_hz: &[f64]) -> f64 {
    let view = plan.view(seconds);
    let seen =
        element_over_band(paths, &view, plan.header.radar.array.polarization.indices(), frequencies_hz);
    seen.iter().map(|s| s.norm_sqr()).sum::<f64>() / frequencies_hz.len() as f64
}

/// Mean power of the sum over the band at the frame's ends and middle.
pub(crate) fn power_over_frame(paths: &[Path], plan: &Plan<'_>) -> f64 {
    const FREQUENCIES: usize = 24;
    let frequencies = frequencies_hz(plan.band.centre_hz, plan.band.bandwidth_hz, FREQUENCIES);
    let moments = [0.0, plan.middle_s, 2.0 * plan.middle_s];
    let of = moments.map(|t| mean_power(paths, plan, t, &frequencies));
    of.iter().sum::<f64>() / of.len() as f64
}
