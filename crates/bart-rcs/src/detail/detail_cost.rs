//! Costs of levels of detail in processor seconds: measured on one machine, so that the same scene takes the
//! same level on every machine with any number of threads. Measurements: docs/validation/levels-of-detail.md.

use artifact::Radar;

/// Cost of the sum over paths one by one, per path and sample of the cube.
const ONE_BY_ONE_S: f64 = 1.1e-9;
/// Cost of transforms, per sample of the cube: several instants of two-dimensional transforms on grids four
/// times as large.
const TRANSFORMS_S: f64 = 4e-8;
/// Cost of a path's values and its spreading to the grids, per pair of elements.
const VALUES_S: f64 = 2e-7;
/// Number of paths of one target from which transforms are used, at −60 dB.
const TRANSFORMED: usize = 40;
/// Cost per path of assigning it to a cell and comparing the tables, over all attempts.
const MERGING_S: f64 = 5.5e-6;
/// Cost of fitting centres: a fixed part, and a part per path with twelve pairs of elements, including
/// comparison of the tables, over all attempts.
const FITTING_LEAST_S: f64 = 3e-3;
const FITTING_S: f64 = 7e-6;
/// Numbers of pairs of elements from which an array is sampled; wider arrays use more, up to 64.
const FITTING_PAIRS: [f64; 2] = [12.0, 64.0];

/// Cost of the echo of one target's paths.
pub(crate) fn echo_s(radar: &Radar, paths: usize) -> f64 {
    let waveform = &radar.waveform;
    let pairs = radar.virtual_channels() as f64;
    let samples = pairs * f64::from(waveform.chirps) * f64::from(waveform.samples);
    let count = paths as f64;
    if paths < TRANSFORMED {
        count * samples * ONE_BY_ONE_S
    } else {
        samples * TRANSFORMS_S + count * pairs * VALUES_S
    }
}

/// Cost of merging one target's paths.
pub(crate) fn merging_s(paths: usize) -> f64 {
    MERGING_S * paths as f64
}

/// Cost of finding scattering centres of one target's paths.
pub(crate) fn centres_s(radar: &Radar, paths: usize) -> f64 {
    let [usual, most] = FITTING_PAIRS;
    let wider = (radar.virtual_channels() as f64).clamp(usual, most) / usual;
    FITTING_LEAST_S + FITTING_S * wider * paths as f64
}
