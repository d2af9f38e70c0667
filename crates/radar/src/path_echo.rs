//! Echo of one path, as an IF sample has it.

use crate::beat::mid_sweep_cycles;
use crate::link::link_amplitude;
use crate::path_kinematics::{legs, mean_share};
use artifact::paths::Path;
use artifact::radar::Radar;
use artifact::units::SPEED_OF_LIGHT_MPS;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// IF value of a path's echo in the middle of frame and sweep at the array's centre, √W.
pub fn echo_value(radar: &Radar, path: &Path) -> Complex64 {
    let [there, back] = legs(radar, path);
    let delay_s = (there.length_m + back.length_m) / SPEED_OF_LIGHT_MPS;
    let cycles = mid_sweep_cycles(&radar.waveform, delay_s);
    let (receive, transmit) = radar.array.polarization.indices();
    let strength = path.amplitude_m[receive][transmit].conj() / (there.length_m * back.length_m);
    mean_share(radar, path)
        * link_amplitude(radar)
        * strength
        * Complex64::from_polar(1.0, TAU * cycles.fract())
}
