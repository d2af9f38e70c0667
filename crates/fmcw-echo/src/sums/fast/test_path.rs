//! A path that the tests of this folder share.

use artifact::paths::{Curve, Facet, MAX_ORDER, Path};
use num_complex::Complex64;

/// A reflection at a place that moves, there and back the same way.
pub(super) fn path_by(at_m: [f64; 3], velocity_mps: [f64; 3]) -> Path {
    Path {
        target: 0,
        order: 1,
        apparent_tx_m: at_m,
        apparent_tx_mps: velocity_mps,
        apparent_rx_m: at_m,
        apparent_rx_mps: velocity_mps,
        amplitude_m: [[Complex64::ONE; 2]; 2],
        slope_m_per_hz: [[Complex64::ZERO; 2]; 2],
        facets: [Facet::default(); MAX_ORDER],
        curve: Curve::default(),
    }
}
