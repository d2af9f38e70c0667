//! Elements and converters that are not ideal.

use crate::setting::*;
use crate::three_sums::the_three_sums_agree;
use artifact::Waveform;
use artifact::radar::{Adc, ElementError, Multiplexing, Radar};
use artifact::settings::Noise;
use fmcw_echo::EchoError;
use fmcw_echo::direct_sum::DirectSum;
use num_complex::Complex64;
use std::f64::consts::TAU;

fn error(gain_db: f64, phase_rad: f64, delay_s: f64) -> ElementError {
    ElementError { gain_db, phase_rad, delay_s }
}

fn flawed(multiplexing: Multiplexing, chirps: u32) -> Radar {
    let mut radar = radar(Waveform { chirps, ..experiment(1) }, &presets()[2], multiplexing);
    radar.hardware.tx = vec![error(0.0, 0.0, 0.0), error(1.5, -0.4, 40e-12), error(-2.0, 2.5, 700e-12)];
    radar.hardware.rx =
        (0..4).map(|i| error(f64::from(i) - 1.0, 0.3 * f64::from(i), 50e-12 * f64::from(i))).collect();
    radar
}

#[test]
fn an_element_error_is_its_gain_its_phase_and_the_length_of_its_line() {
    let radar = flawed(Multiplexing::Simultaneous, 1);
    let mut ideal = radar.clone();
    ideal.hardware = Default::default();
    let (f_c, still) = (radar.waveform.centre_frequency_hz(), [point([3.0, 30.0, 1.0], [0.0; 3], 1.0)]);
    let [got, without] = [&radar, &ideal].map(|radar| DirectSum::new(radar, f_c, &still).cube());
    let w = &radar.waveform;
    for channel in 0..12 {
        let (tx, rx) = (radar.hardware.tx[channel / 4], radar.hardware.rx[channel % 4]);
        let to = |element_m: [f64; 3]| {
            glam::DVec3::from_array(element_m).distance(glam::DVec3::new(3.0, 30.0, 1.0))
        };
        let tau = (to(radar.array.tx_m[channel / 4]) + to(radar.array.rx_m[channel % 4])) / 299_792_458.0;
        let line_s = tx.delay_s + rx.delay_s;
        for n in [0, 100, 255] {
            // f₀τ + μtτ − ½μτ² of τ + line, less that of τ.
            let t = n as f64 / w.sample_rate_hz;
            let cycles = (w.start_frequency_hz + w.slope_hz_per_s * (t - tau - 0.5 * line_s)) * line_s;
            let gain = 10.0_f64.powf((tx.gain_db + rx.gain_db) / 20.0);
            let expected = without[channel * 256 + n]
                * Complex64::from_polar(gain, tx.phase_rad + rx.phase_rad + TAU * cycles.fract());
            let missed = (got[channel * 256 + n] - expected).norm() / expected.norm();
            // Phases of 2e4 cycles in f64: 2π·2e4·2e-16, and as much in each of the recurrence's 256 steps.
            assert!(missed < 1e-8, "channel {channel}, sample {n}: {missed:e}");
        }
    }
}

#[test]
fn the_three_sums_agree_on_flawed_elements_under_every_multiplexing() {
    for multiplexing in [Multiplexing::Simultaneous, Multiplexing::Tdm, Multiplexing::Ddm, Multiplexing::Bpm]
    {
        let radar = flawed(multiplexing, 16);
        the_three_sums_agree(&radar, "flawed", 71);
    }
}

#[test]
fn a_converter_rounds_what_the_receiver_hears_noise_included() {
    let mut header =
        header(single_channel(experiment(1)), Noise::Figure { noise_figure_db: 12.0, temperature_k: 290.0 });
    let cube = |header: &artifact::cube::CubeHeader| {
        synthesized(header, 3, &frame(vec![point([0.0, 40.0, 6.0], [0.0; 3], 10.0)]))
    };
    let fine = cube(&header).unwrap().samples;
    let full_scale = f64::from(fine.iter().map(|x| x.re.abs().max(x.im.abs())).fold(0.0, f32::max)) * 0.5;
    header.radar.hardware.adc = Some(Adc { bits: 6, full_scale });
    let rounded = cube(&header).unwrap().samples;
    let code = full_scale / 32.0;
    for (rounded, fine) in rounded.iter().zip(&fine) {
        for (rounded, fine) in [(rounded.re, fine.re), (rounded.im, fine.im)] {
            let expected = f64::from(fine).clamp(-full_scale, full_scale - code);
            assert!(
                (f64::from(rounded) - expected).abs() <= 0.5 * code * (1.0 + 1e-6),
                "{rounded} of {fine}"
            );
        }
    }
    header.radar.hardware.adc = Some(Adc { bits: 0, full_scale });
    assert!(matches!(cube(&header), Err(EchoError::NonFiniteRadar { .. })));
}
