//! Cramér–Rao bound of an isolated point echo: the minimum standard error of any unbiased estimate.
//!
//! A tone of unknown amplitude and phase over N regular samples has var(cycles per sample) ≥ 6/(4π²·γ·N(N² −
//! 1)), γ the power ratio of one sample (Rife and Boorstyn, IEEE Trans. IT 20 (1974) 591, eq. 16; Kay,
//! Fundamentals of Statistical Signal Processing (1993), example 3.14). Over samples × chirps × elements the
//! phase is a sum of one term per axis, whose central moments do not mix, so the bounds of the three axes
//! hold independently, each with the signal-to-noise ratio of all values together. `docs/physics.md` §8
//! counts it per cell of one channel: γ·N_s·N_c.

use artifact::Radar;

/// Minimum standard errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CramerRaoBound {
    /// Standard error of the range at mid-frame, including the velocity's contribution through range–Doppler
    /// coupling.
    pub range_m: f64,
    /// Standard error of the radial velocity.
    pub velocity_mps: f64,
    /// Standard errors of the direction cosines along right and up; infinite if the array has no extent.
    pub cosines: [f64; 2],
}

/// Bound for a signal-to-noise power ratio per cell of one channel's unwindowed map, for simultaneous
/// transmitters.
pub fn cramer_rao(radar: &Radar, snr_per_cell: f64) -> CramerRaoBound {
    let waveform = &radar.waveform;
    let snr = snr_per_cell * radar.virtual_channels() as f64;
    let cells = |count: u32| {
        let squared = f64::from(count).powi(2);
        (6.0 * squared / ((squared - 1.0) * snr)).sqrt() / std::f64::consts::TAU
    };
    let velocity_mps = radar.velocity_resolution_mps() * cells(waveform.chirps);
    let shown_m = waveform.range_resolution_m() * cells(waveform.samples);
    let coupled_m = velocity_mps * waveform.centre_frequency_hz() / waveform.slope_hz_per_s;
    CramerRaoBound { range_m: shown_m.hypot(coupled_m), velocity_mps, cosines: cosines(radar, snr) }
}

/// Bounds of the direction cosines: the inverse of 2·SNR·(2π/λ)²·M₂, M₂ the 2 × 2 central second moments of
/// the virtual elements (Kay (1993), example 3.15, for any array).
fn cosines(radar: &Radar, snr: f64) -> [f64; 2] {
    let array = &radar.array;
    let places: Vec<[f64; 2]> = (array.tx_half_wavelengths.iter())
        .flat_map(|t| {
            array.rx_half_wavelengths.iter().map(move |r| [0, 1].map(|axis: usize| 0.5 * (t[axis] + r[axis])))
        })
        .collect();
    let count = places.len() as f64;
    let mean = [0, 1].map(|axis: usize| places.iter().map(|p| p[axis]).sum::<f64>() / count);
    let moment =
        |a: usize, b: usize| places.iter().map(|p| (p[a] - mean[a]) * (p[b] - mean[b])).sum::<f64>() / count;
    let [along, across, mixed] = [moment(0, 0), moment(1, 1), moment(0, 1)];
    let information = 2.0 * snr * std::f64::consts::TAU.powi(2);
    let left = |own: f64, other: f64| if other > 0.0 { own - mixed * mixed / other } else { own };
    [left(along, across), left(across, along)].map(|moment| (information * moment.max(0.0)).sqrt().recip())
}

#[cfg(test)]
mod tests {
    /// 12 half-wavelength elements: var(u) = 6/(π²·SNR·M(M² − 1)), SNR per element (Kay (1993), eq. 3.43 at
    /// broadside).
    #[test]
    fn a_filled_rows_bound_is_the_textbooks() {
        let elements: Vec<f64> = (0..12).map(|i| 0.5 * f64::from(i)).collect();
        let mean = elements.iter().sum::<f64>() / 12.0;
        let moment = elements.iter().map(|p| (p - mean).powi(2)).sum::<f64>() / 12.0;
        let ours = (2.0 * 12.0 * 100.0 * std::f64::consts::TAU.powi(2) * moment).recip();
        let textbook = 6.0 / (std::f64::consts::PI.powi(2) * 100.0 * 12.0 * 143.0);
        assert!((ours / textbook - 1.0).abs() < 1e-12, "{ours} against {textbook}");
    }
}
