//! The intermediate-frequency (beat) signal of a delayed chirp: eq. (13) of the paper.

use artifact::radar::Waveform;

/// Phase of an IF sample in cycles, f₀τ + μtτ − ½μτ², `t` seconds into the sampled sweep, for an echo delayed
/// by `tau` seconds (eq. 13).
pub fn if_cycles(waveform: &Waveform, t: f64, tau: f64) -> f64 {
    let (f0, mu) = (waveform.start_frequency_hz, waveform.slope_hz_per_s);
    f0 * tau + mu * t * tau - 0.5 * mu * tau * tau
}

/// Phase in the middle of the sampled sweep, in cycles: f_cτ − ½μτ².
pub fn mid_sweep_cycles(waveform: &Waveform, tau: f64) -> f64 {
    waveform.centre_frequency_hz() * tau - 0.5 * waveform.slope_hz_per_s * tau * tau
}

/// Range–Doppler coupling: the beat frequency of a receding target is f_c·τ̇ higher, so it appears this much
/// farther away (61.9 mm at 10 m/s and 12.5 MHz/µs; `docs/conventions.md`, eq. 13 of the paper).
pub fn coupling_m(waveform: &Waveform, velocity_mps: f64) -> f64 {
    velocity_mps * waveform.centre_frequency_hz() / waveform.slope_hz_per_s
}

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::radar::Sampling;
    use artifact::units::SPEED_OF_LIGHT_MPS;

    /// The time derivative of the phase is the beat frequency μτ, and a velocity of one metre a second shifts
    /// the apparent range by the coupling.
    #[test]
    fn the_beat_frequency_is_slope_times_delay_and_shifts_with_velocity() {
        let waveform = Waveform {
            start_frequency_hz: 77e9,
            slope_hz_per_s: 12.5e12,
            sample_rate_hz: 5.12e6,
            sampling: Sampling::Complex,
            samples: 256,
            chirp_interval_s: 60e-6,
            chirps: 1,
        };
        let (range_m, sweep_s) = (40.0, 50e-6);
        let delay_s = |velocity_mps: f64, t: f64| {
            2.0 * (range_m + velocity_mps * (t - 0.5 * sweep_s)) / SPEED_OF_LIGHT_MPS
        };
        let beat_hz = |velocity_mps: f64| {
            let at = |t: f64| if_cycles(&waveform, t, delay_s(velocity_mps, t));
            (at(sweep_s) - at(0.0)) / sweep_s
        };
        let shown_m = |hz: f64| 0.5 * SPEED_OF_LIGHT_MPS * hz / waveform.slope_hz_per_s;
        assert!((shown_m(beat_hz(0.0)) - range_m).abs() < 1e-6);
        let tau = delay_s(0.0, 0.0);
        let apart = mid_sweep_cycles(&waveform, tau) - if_cycles(&waveform, 0.5 * sweep_s, tau);
        // Relative to 2e4 cycles.
        assert!(apart.abs() < 1e-10, "{apart}");
        // A delay after the sweep's centre lowers the frequency by μτ: 3 MHz of 77 GHz.
        let shift_m = shown_m(beat_hz(10.0)) - shown_m(beat_hz(0.0));
        assert!((shift_m / coupling_m(&waveform, 10.0) - 1.0).abs() < 1e-4, "{shift_m}");
    }
}
