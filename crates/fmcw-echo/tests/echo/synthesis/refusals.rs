//! Every broken input ends in an error that names it.

use crate::setting::*;
use artifact::cube::CubeHeader;
use artifact::paths::{ArraySide, ArraySpan, Path, Span};
use artifact::settings::Noise;
use fmcw_echo::EchoError;
use num_complex::Complex64;

fn sound_header() -> CubeHeader {
    header(single_channel(artifact::Waveform { chirps: 2, ..experiment(1) }), Noise::Absent)
}

fn refusal(header: &CubeHeader, paths: Vec<Path>) -> EchoError {
    synthesized(header, 1, &frame(paths)).unwrap_err()
}

fn refusal_of_path(change: impl Fn(&mut Path)) -> EchoError {
    let mut path = point([2.0, 40.0, 1.0], [0.0, -10.0, 0.0], 1.0);
    change(&mut path);
    refusal(&sound_header(), vec![point([2.0, 30.0, 1.0], [0.0; 3], 1.0), path])
}

#[test]
fn numbers_of_a_path_that_are_not_finite_are_refused() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let refusals = [
            refusal_of_path(|p| p.apparent_tx_m[1] = bad),
            refusal_of_path(|p| p.apparent_rx_m[0] = bad),
            refusal_of_path(|p| p.apparent_tx_mps[2] = bad),
            refusal_of_path(|p| p.apparent_rx_mps[2] = bad),
            refusal_of_path(|p| p.amplitude_m[0][0] = Complex64::new(0.0, bad)),
            refusal_of_path(|p| p.slope_m_per_hz[1][0] = Complex64::new(bad, 0.0)),
        ];
        for refused in refusals {
            assert!(matches!(refused, EchoError::NonFinitePath { frame: 0, path: 1, .. }), "{refused}");
        }
    }
}

#[test]
fn a_path_that_stands_for_no_moment_of_its_frame_is_refused() {
    let sound = Span { first_s: 0.0, step_s: 1e-3, moments: 5, moment: 4 };
    let broken = [
        Span { moment: 5, ..sound },
        Span { moments: 0, moment: 0, ..sound },
        Span { step_s: 0.0, ..sound },
        Span { step_s: f64::NAN, ..sound },
        Span { first_s: f64::INFINITY, ..sound },
    ];
    for span in broken {
        let refused = refusal_of_path(|p| p.curve.span = Some(span));
        assert!(matches!(refused, EchoError::NoSuchMoment { frame: 0, path: 1, .. }), "{refused}");
    }
}

#[test]
fn a_path_that_stands_for_no_place_of_the_array_is_refused() {
    let (x, none) = ([1.0, 0.0, 0.0], [0.0; 3]);
    let sound = ArraySpan { transmit: x, receive: none, first_m: -0.1, step_m: 0.02, places: 9, place: 8 };
    let broken = [
        ArraySpan { place: 9, ..sound },
        ArraySpan { places: 0, place: 0, ..sound },
        ArraySpan { step_m: 0.0, ..sound },
        ArraySpan { first_m: f64::NAN, ..sound },
        ArraySpan { transmit: [f64::NAN, 0.0, 0.0], ..sound },
        ArraySpan { receive: [0.0, 1e300, 0.0], ..sound },
    ];
    for span in broken {
        let refused = refusal_of_path(|p| p.curve.array_span = Some(span));
        assert!(matches!(refused, EchoError::NoSuchPlace { frame: 0, path: 1, .. }), "{refused}");
    }
}

#[test]
fn a_path_that_stands_for_no_side_of_the_array_is_refused() {
    let x = [1.0, 0.0, 0.0];
    let sound = ArraySide { transmit: x, receive: [-1.0, 0.0, 0.0], from_m: 0.0 };
    let broken = [
        ArraySide { from_m: f64::NAN, ..sound },
        ArraySide { transmit: [0.0, f64::NAN, 0.0], ..sound },
        ArraySide { receive: [0.0, 0.0, 1e300], ..sound },
    ];
    for side in broken {
        let refused = refusal_of_path(|p| p.curve.array_side = Some(side));
        assert!(matches!(refused, EchoError::NoSuchSide { frame: 0, path: 1, .. }), "{refused}");
    }
}

#[test]
fn a_path_through_an_antenna_is_refused_also_when_it_only_passes() {
    let at_rest = refusal_of_path(|p| p.apparent_tx_m = [0.0, 0.0, 6.0]);
    assert!(
        matches!(at_rest, EchoError::PathThroughAntenna { path: 1, element: "transmit", index: 0, .. }),
        "{at_rest}"
    );
    let passing = refusal_of_path(|p| {
        (p.apparent_rx_m, p.apparent_rx_mps) = ([0.0, 0.001, 6.0], [0.0, -20.0, 0.0]);
    });
    assert!(matches!(passing, EchoError::PathThroughAntenna { element: "receive", .. }), "{passing}");
}

#[test]
fn speeds_beyond_the_parabola_are_refused() {
    let refused = refusal_of_path(|p| p.apparent_rx_mps = [0.0, 3.1e3, 0.0]);
    assert!(matches!(refused, EchoError::TooFast { path: 1, .. }), "{refused}");
}

#[test]
fn samples_beyond_f32_are_refused() {
    let refused = refusal_of_path(|p| p.amplitude_m[0][0] = Complex64::from(1e200));
    assert!(
        matches!(refused, EchoError::SampleOverflow { channel: 0, chirp: 0, sample: 0, .. }),
        "{refused}"
    );
}

#[test]
fn radars_without_samples_or_elements_are_refused() {
    let broken = |change: &dyn Fn(&mut CubeHeader)| {
        let mut header = sound_header();
        change(&mut header);
        refusal(&header, vec![])
    };
    let waveform = |e: &EchoError| matches!(e, EchoError::Waveform { .. });
    assert!(waveform(&broken(&|h| h.radar.waveform.samples = 0)));
    assert!(waveform(&broken(&|h| h.radar.waveform.chirps = 0)));
    assert!(waveform(&broken(&|h| h.radar.waveform.chirp_interval_s = 49e-6)));
    assert!(waveform(&broken(&|h| h.radar.waveform.sample_rate_hz = f64::NAN)));
    assert!(waveform(&broken(&|h| h.radar.waveform.slope_hz_per_s = f64::INFINITY)));
    assert!(waveform(&broken(&|h| h.radar.waveform.slope_hz_per_s = -1e18)));
    assert!(matches!(broken(&|h| h.radar.array.tx_m.clear()), EchoError::NoElements { transmitters: 0, .. }));
    assert!(matches!(broken(&|h| h.radar.array.rx_m[0][2] = f64::NAN), EchoError::NonFiniteRadar { .. }));
    assert!(matches!(broken(&|h| h.radar.link.transmit_power_w = -1.0), EchoError::NonFiniteRadar { .. }));
    assert!(matches!(
        broken(&|h| h.noise = Noise::SnrDb(f64::NAN)),
        EchoError::Noise { quantity: "snr_db", .. }
    ));
}

#[test]
fn a_cube_larger_than_a_record_is_refused_before_it_is_allocated() {
    let mut header = sound_header();
    (header.radar.waveform.samples, header.radar.waveform.chirps) = (u32::MAX, u32::MAX);
    header.radar.waveform.chirp_interval_s = 1e3;
    let refused = refusal(&header, vec![]);
    assert!(matches!(refused, EchoError::CubeTooLarge { bytes, .. } if bytes > 1 << 66), "{refused}");
}
