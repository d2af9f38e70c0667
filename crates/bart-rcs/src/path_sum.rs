//! Scattering amplitude from path records, by their definition.

use artifact::paths::{Amplitude, Path};
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Where and when paths are summed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathView {
    /// p_t.
    pub transmitter_m: DVec3,
    /// p_r.
    pub receiver_m: DVec3,
    /// Point that R_t and R_r lead to.
    pub origin_m: DVec3,
    /// After the frame's first sample.
    pub seconds: f64,
    /// f_c of the amplitudes and slopes.
    pub centre_frequency_hz: f64,
}

/// S = Σ a(f)·R_tR_r/(L₁L₂)·e^{−jk(L₁+L₂−R_t−R_r)} with a(f) = a + (f − f_c)·a′, metres, 2 × 2.
pub fn scattering_of_paths<'a>(
    paths: impl IntoIterator<Item = &'a Path>,
    view: &PathView,
    frequency_hz: f64,
) -> Amplitude {
    let mut total = Amplitude::default();
    for path in paths {
        let factor = view.factor(path, frequency_hz);
        for (p, row) in total.iter_mut().enumerate() {
            for (q, sum) in row.iter_mut().enumerate() {
                let slope = path.slope_m_per_hz[p][q] * (frequency_hz - view.centre_frequency_hz);
                *sum += (path.amplitude_m[p][q] + slope) * factor;
            }
        }
    }
    total
}

impl PathView {
    fn factor(&self, path: &Path, frequency_hz: f64) -> Complex64 {
        let place = |x: [f64; 3], v: [f64; 3]| DVec3::from_array(x) + self.seconds * DVec3::from_array(v);
        let l1 = place(path.apparent_tx_m, path.apparent_tx_mps).distance(self.transmitter_m);
        let l2 = place(path.apparent_rx_m, path.apparent_rx_mps).distance(self.receiver_m);
        let (r_t, r_r) = (self.origin_m.distance(self.transmitter_m), self.origin_m.distance(self.receiver_m));
        let wavenumber_per_m = TAU * frequency_hz / SPEED_OF_LIGHT_MPS;
        Complex64::from_polar(r_t * r_r / (l1 * l2), -wavenumber_per_m * (l1 + l2 - r_t - r_r))
    }
}
