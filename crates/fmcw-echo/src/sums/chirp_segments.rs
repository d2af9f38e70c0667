//! Segments of a chirp: the number of parabolas needed for phase and amplitude to stay within 1e-7 of exact.

use crate::sums::closest_approach::MovingLeg;
use artifact::Radar;
use artifact::paths::Path;
use artifact::units::SPEED_OF_LIGHT_MPS;
use std::f64::consts::TAU;

/// Maximum error of a parabola, in phase (rad) and in amplitude relative to the path's greatest in the band:
/// −140 dB.
const REMAINDER: f64 = 1e-7;

/// Number of samples in one segment, as needed by the worst of the paths. Traffic at 20 m and beyond needs no
/// segmentation.
///
/// The parabola through three equidistant instants errs by max|x‴|·(T/2)³/(9√3) for a chirp of length T; a
/// third of the length reduces this by 27. The bound does not include the antenna pattern's own curvature.
pub(crate) fn samples_per_segment(radar: &Radar, paths: &[&Path]) -> usize {
    let worst = paths.iter().map(|path| third_derivative(radar, path)).fold(0.0, f64::max);
    let remainder = worst / (8.0 * 9.0 * 3.0_f64.sqrt());
    let segments = (remainder / REMAINDER).cbrt().ceil().max(1.0);
    // Three samples lie on some parabola.
    ((f64::from(radar.waveform.samples) / segments).ceil() as usize).max(3)
}

/// Bound on |x‴|·T³ over phase in rad and relative amplitude.
///
/// A leg of length L whose point moves at v and is accelerated by a has |L̈| ≤ v²/L + a and |L⃛| ≤
/// 3(v/L)(v²/L + a). With e = vT/L and b = aT²/L, for phase 2π(f₀τ + μtτ − …): 2π(f·τ⃛ + 3μτ̈)T³ ≤ 2π·Σ(3fe +
/// 3μT)(e² + b)L/c. For 1/(L₁L₂) relative to itself: second derivative ≤ 3(Σe)², third ≤ 15(Σe)³; times an
/// amplitude that is linear over the band and changes by at most twice its greatest value: 18(Σe)² + 15(Σe)³,
/// with √(e² + b) for e.
fn third_derivative(radar: &Radar, path: &Path) -> f64 {
    let waveform = &radar.waveform;
    let chirp_s = f64::from(waveform.samples) / waveform.sample_rate_hz;
    let sweep_hz = waveform.bandwidth_hz().abs();
    let highest_hz = waveform.start_frequency_hz + sweep_hz;
    let (mut phase, mut sum) = (0.0, 0.0);
    for leg in MovingLeg::of(radar, path) {
        let length_m = leg.nearest(radar).1;
        let e = leg.speed_mps(radar) * chirp_s / length_m;
        let bend = e * e + leg.acceleration_mps2() * chirp_s * chirp_s / length_m;
        phase += TAU * 3.0 * bend * (highest_hz * e + sweep_hz) * length_m / SPEED_OF_LIGHT_MPS;
        sum += bend.sqrt();
    }
    phase + sum * sum * (18.0 + 15.0 * sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex64;
    use radar::aperture::Preset;
    use radar::paper;

    fn samples_for(range_m: f64, speed_mps: f64) -> usize {
        let radar = paper::radar([0.0, 0.0, 6.0], paper::waveform(256, 128), Preset::OneByOne.elements());
        let path = Path::of_point([0.0, range_m, 6.0], [speed_mps, 0.0, 0.0], [[Complex64::ONE; 2]; 2]);
        samples_per_segment(&radar, &[&path])
    }

    #[test]
    fn traffic_needs_one_parabola_a_chirp_and_near_fast_points_more() {
        assert_eq!(samples_for(25.0, 0.0), 256);
        assert_eq!(samples_for(25.0, 15.0), 256);
        // e = 1.25e-3: phase 2.9e-4, amplitude 1.1e-4, over 124.7 · 1e-7: 32, its cube root 3.2, four
        // segments.
        assert_eq!(samples_for(2.0, 50.0), 64);
        assert_eq!(samples_for(0.004, 3e3), 3);
    }
}
