//! Settings that the tests of this crate share, those in `tests/` with lanes.

use artifact::settings::{Angle, Detector, DspSettings, Lanes, Refine, StaticEchoes, Window};

/// The default reaches of clustering, Hann windows and cell averaging.
pub(crate) fn settings() -> DspSettings {
    DspSettings {
        range_window: Window::Hann,
        doppler_window: Window::Hann,
        detector: Detector::CaCfar,
        false_alarm_rate: 1e-5,
        guard_cells: [2, 2],
        training_cells: [4, 8],
        angle: Angle::Fft,
        refine: Refine::Off,
        calibration: vec![],
        static_echoes: StaticEchoes::Keep,
        nearest_m: 0.0,
        assumed_height_m: 0.75,
        cluster_range_m: 2.5,
        cluster_velocity_mps: 1.0,
        cluster_cross_m: 2.5,
        road: Lanes::default(),
    }
}
