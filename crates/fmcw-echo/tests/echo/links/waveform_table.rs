//! X1: Table 2 of the paper follows from the waveform.

use crate::setting::*;
use artifact::units::SPEED_OF_LIGHT_MPS;

#[test]
fn x1_bandwidth_resolution_spans_and_beat_bins_are_those_of_table_2() {
    let bandwidth_hz = [0.625e9, 0.9375e9, 1.25e9];
    let resolution_m = [0.23983, 0.15989, 0.11992];
    let velocity_max_mps = [16.1570, 11.3819, 8.7774];
    let beat_bin_at_40_m = [166.782, 250.173, 333.564];
    for i in 0..3 {
        let radar = single_channel(experiment(i + 1));
        let waveform = &radar.waveform;
        let bin = 2.0 * 40.0 / SPEED_OF_LIGHT_MPS * waveform.slope_hz_per_s / waveform.sample_rate_hz
            * f64::from(waveform.samples);
        // Half of the last digit given.
        assert!((waveform.bandwidth_hz() - bandwidth_hz[i]).abs() < 1.0);
        assert!((waveform.range_resolution_m() - resolution_m[i]).abs() < 5e-6);
        assert!((radar.velocity_max_mps() - velocity_max_mps[i]).abs() < 5e-5);
        assert!((waveform.range_max_m() - 61.397).abs() < 5e-4);
        assert!((bin - beat_bin_at_40_m[i]).abs() < 5e-4);
    }
}
