//! Echo of one path as an IF sample.

use crate::aperture::{axes, pattern_amplitude};
use crate::beat::mid_sweep_cycles;
use crate::link::link_amplitude;
use crate::path_kinematics::{Leg, legs, mean_share};
use artifact::paths::Path;
use artifact::radar::Radar;
use artifact::units::SPEED_OF_LIGHT_MPS;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Product of both elements' gains along the legs of a path, relative to boresight.
pub fn gain_along(radar: &Radar, legs: &[Leg; 2]) -> f64 {
    let axes = axes(radar);
    legs.iter().map(|leg| pattern_amplitude(radar, &axes, leg.direction)).product()
}

/// IF value of a path's echo at mid-frame and mid-sweep for the array's centre, √W.
pub fn echo_value(radar: &Radar, path: &Path) -> Complex64 {
    let [there, back] = legs(radar, path);
    let delay_s = (there.length_m + back.length_m) / SPEED_OF_LIGHT_MPS;
    let cycles = mid_sweep_cycles(&radar.waveform, delay_s);
    let (receive, transmit) = radar.array.polarization.indices();
    let strength = path.amplitude_m[receive][transmit].conj() / (there.length_m * back.length_m);
    mean_share(radar, path)
        * (gain_along(radar, &[there, back]) * link_amplitude(radar))
        * strength
        * Complex64::from_polar(1.0, TAU * cycles.fract())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::aperture::Preset;
    use crate::paper;
    use artifact::pattern::Pattern;
    use glam::DVec3;

    /// Ghost that departs straight ahead and returns from 60° aside, where cos³ is an eighth.
    #[test]
    fn each_leg_of_an_echo_has_the_gain_of_its_own_direction() {
        let mut radar = paper::radar([0.0; 3], paper::waveform(64, 16), Preset::OneByOne.elements());
        let (sin, cos) = std::f64::consts::FRAC_PI_3.sin_cos();
        let path = Path {
            order: 2,
            apparent_tx_m: [0.0, 30.0, 0.0],
            apparent_rx_m: (20.0 * DVec3::new(sin, cos, 0.0)).to_array(),
            amplitude_m: [[Complex64::ONE; 2]; 2],
            ..Path::default()
        };
        let of_one = echo_value(&radar, &path);
        assert!((of_one.norm() * 600.0 / link_amplitude(&radar) - 1.0).abs() < 1e-12);
        radar.array.pattern = Pattern::Cosine { exponent: 3.0 };
        assert!((echo_value(&radar, &path) / of_one - 0.125).norm() < 1e-12);
    }
}
