//! Formulas, direct sum and fast sum of the same paths on one radar.

use crate::setting::*;
use artifact::{Accuracy, Radar};
use fmcw_echo::direct_sum::DirectSum;
use fmcw_echo::{fast_sum, reference};

/// Four paths anywhere by direct sum and formulas; a body of 300 by direct and fast sum, −20 to −100 dB
/// asked.
pub(crate) fn the_three_sums_agree(radar: &Radar, what: &str, seed: u64) {
    let (f_c, few) = (radar.waveform.centre_frequency_hz(), random_paths(seed, 4));
    let name = format!("{:?}, {what}", radar.array.multiplexing);
    let direct = error_db(&DirectSum::new(radar, f_c, &few).cube(), &reference::cube(radar, f_c, &few));
    // 1e-7 of a path's phase and amplitude.
    assert!(direct < -130.0, "{name}: direct sum {direct:.1} dB");
    let body = body(seed + 1, 300, [5.75, 40.0, 0.7], [0.0, -10.0, 0.0]);
    let exact = DirectSum::new(radar, f_c, &body).cube();
    for asked_db in [-20.0, -60.0, -100.0] {
        let got = error_db(&fast_sum::cube(radar, f_c, &body, Accuracy::from_db(asked_db)), &exact);
        println!("{name}: asked {asked_db} dB, got {got:.1} dB");
        assert!(got <= asked_db, "{name}: asked {asked_db}, got {got:.1}");
    }
}
