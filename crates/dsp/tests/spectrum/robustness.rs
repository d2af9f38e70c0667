//! Bad input ends in an error that names it; odd shapes work; bytes do not depend on threads.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use artifact::cube::{CubeFrame, CubeHeader, SampleUnit};
use artifact::dataset::CropFormat;
use artifact::radar::Multiplexing;
use artifact::settings::{Noise, Window};
use dsp::{Axis, DspError, PAPER_CROP, Receiver, power_map, rdm_grayscale};
use num_complex::Complex32;
use proptest::prelude::*;

fn small() -> (CubeHeader, CubeFrame) {
    let mut header = header(32, 16, elements_3x4());
    header.noise = NOISE_12_DB;
    header.dsp.training_cells = [3, 6];
    let frame = cube(&header, &[target([1.0, 4.0, 5.0], [0.0, -2.0, 0.0], 1.0)], 1);
    (header, frame)
}

#[test]
fn a_nan_or_infinite_sample_is_named() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let (header, mut frame) = small();
        frame.samples[(3 * 16 + 5) * 32 + 7].im = bad;
        let asked = DspError::SampleNotFinite { channel: 3, chirp: 5, sample: 7 };
        assert_eq!(mapped(&header, &frame).unwrap_err(), asked);
    }
}

#[test]
fn samples_too_large_for_single_precision_maps_are_named() {
    let (header, mut frame) = small();
    frame.samples.fill(Complex32::new(f32::MAX, 0.0));
    assert!(matches!(mapped(&header, &frame).unwrap_err(), DspError::ValueNotFinite { .. }));
}

/// Powers are taken in double precision: of single precision's smallest normal amplitude it is 1e-76.
#[test]
fn samples_whose_squares_single_precision_does_not_hold_show_the_same_cells() {
    let (header, frame) = small();
    let seen = mapped(&header, &frame).unwrap();
    assert!(seen.detections > 0);
    // 2⁻⁵⁰ is exact, and leaves amplitudes of 1e-23.
    let samples = frame.samples.iter().map(|sample| sample * 2.0_f32.powi(-50)).collect();
    let faint = mapped(&header, &CubeFrame { samples, ..frame }).unwrap();
    assert_eq!(faint.mask, seen.mask);
    let power = power_map(&header, &faint).unwrap();
    assert!(power.iter().any(|power| *power > 0.0));
}

#[test]
fn a_value_of_a_map_that_is_no_number_is_named_by_frame_and_cell() {
    let (header, mut frame) = small();
    frame.index = 7;
    let receiver = Receiver::new(&header).unwrap();
    let mut map = receiver.range_doppler(&frame).unwrap();
    map.values[(3 * 16 + 5) * 32 + 9].im = f32::NAN;
    let refused = receiver.detect(&map).unwrap_err();
    assert_eq!(refused, DspError::ValueNotFinite { frame: 7, channel: 3, doppler: 5, range: 9 });
    let told = "frame 7: channel 3, Doppler cell 5, range cell 9 of the map is not finite";
    assert_eq!(refused.to_string(), told);
}

#[test]
fn a_frame_of_the_wrong_length_is_refused_with_both_lengths() {
    let (header, mut frame) = small();
    frame.samples.pop();
    let asked = DspError::SampleCount { expected: 12 * 16 * 32, found: 12 * 16 * 32 - 1 };
    assert_eq!(mapped(&header, &frame).unwrap_err(), asked);
    frame.samples.clear();
    assert!(mapped(&header, &frame).is_err());
}

#[test]
fn maps_that_do_not_fit_their_header_are_refused_everywhere() {
    let (header, frame) = small();
    let receiver = Receiver::new(&header).unwrap();
    let good = receiver.range_doppler(&frame).unwrap();
    let object = receiver.detect(&good).unwrap().objects[0];
    let (mut short, mut unmasked, mut bad) = (good.clone(), good.clone(), good.clone());
    short.values.pop();
    unmasked.mask.clear();
    bad.values[4].re = f32::NAN;
    for map in [short, unmasked, bad] {
        assert!(Receiver::new(&header).and_then(|receiver| receiver.detect(&map)).is_err());
        assert!(power_map(&header, &map).is_err());
        assert!(rdm_grayscale(&header, &map).is_err());
        assert!(cropped(&header, &map, &object, &PAPER_CROP).is_err());
    }
}

#[test]
fn cfar_windows_larger_than_the_map_are_refused_with_the_axis() {
    let (mut header, frame) = small();
    header.dsp.training_cells = [6, 6];
    let asked = DspError::CfarWindow { axis: Axis::Doppler, needed: 17, cells: 16 };
    assert_eq!(mapped(&header, &frame).unwrap_err(), asked);
    header.dsp.training_cells = [3, u32::MAX];
    header.dsp.guard_cells = [2, u32::MAX];
    assert!(matches!(mapped(&header, &frame), Err(DspError::CfarWindow { axis: Axis::Range, .. })));
    header.dsp.training_cells = [0, 0];
    assert_eq!(mapped(&header, &frame).unwrap_err(), DspError::NoTrainingCells);
}

#[test]
fn settings_that_mean_nothing_are_refused() {
    for rate in [0.0, 1.0, -1e-3, 2.0, f64::NAN] {
        let (mut header, frame) = small();
        header.dsp.false_alarm_rate = rate;
        assert!(matches!(mapped(&header, &frame), Err(DspError::FalseAlarmRate(_))));
    }
    let (mut header, frame) = small();
    header.dsp.range_window = Window::Chebyshev(-3.0);
    assert_eq!(mapped(&header, &frame).unwrap_err(), DspError::Sidelobes(-3.0));
}

#[test]
fn radars_without_axes_are_refused() {
    let broken: [fn(&mut CubeHeader); 9] = [
        |h| h.radar.waveform.slope_hz_per_s = 0.0,
        |h| h.radar.waveform.sample_rate_hz = f64::NAN,
        |h| h.radar.waveform.chirp_interval_s = f64::INFINITY,
        |h| h.radar.array.tx_m.clear(),
        |h| h.radar.array.rx_m.clear(),
        |h| h.radar.array.rx_m[0][1] = f64::NAN,
        |h| h.radar.waveform.samples = 0,
        |h| h.radar.waveform.chirps = 0,
        |h| (h.radar.waveform.samples, h.radar.waveform.chirps) = (u32::MAX, u32::MAX),
    ];
    for breaking in broken {
        let (mut header, frame) = small();
        breaking(&mut header);
        assert!(mapped(&header, &frame).is_err());
    }
}

#[test]
fn a_single_chirp_or_sample_is_a_map_when_the_detector_stays_on_the_other_axis() {
    for (samples, chirps, guard, training) in [(64, 1, [0, 2], [0, 6]), (1, 64, [2, 0], [6, 0])] {
        let mut header = header(samples, chirps, elements_3x4());
        header.dsp.guard_cells = [2, 2];
        header.dsp.training_cells = [4, 8];
        let frame = cube(&header, &[target([0.0, 5.0, 6.0], [0.0, -3.0, 0.0], 1.0)], 1);
        assert!(matches!(mapped(&header, &frame), Err(DspError::CfarWindow { .. })));
        header.dsp.guard_cells = guard;
        header.dsp.training_cells = training;
        let receiver = Receiver::new(&header).unwrap();
        let map = receiver.range_doppler(&frame).unwrap();
        assert!(!receiver.detect(&map).unwrap().points.is_empty());
    }
}

#[test]
fn odd_sizes_put_zero_velocity_at_half_rounded_down() {
    let mut header = header(101, 33, elements_1x1());
    header.dsp.training_cells = [4, 8];
    let map = Receiver::new(&header)
        .unwrap()
        .range_doppler(&cube(&header, &[target([0.0, 12.0, 6.0], [0.0; 3], 1.0)], 1))
        .unwrap();
    let power = power_map(&header, &map).unwrap();
    let (peak, _) =
        power.indexed_iter().fold(((0, 0), 0.0), |b, (at, p)| if *p > b.1 { (at, *p) } else { b });
    assert_eq!(peak.0, 16);
    assert_eq!(dsp::velocity_axis_mps(&header)[16], 0.0);
}

#[test]
fn a_falling_slope_makes_the_same_map_axes() {
    let mut header = header(256, 64, elements_3x4());
    header.radar.waveform.slope_hz_per_s *= -1.0;
    header.radar.waveform.start_frequency_hz += 0.625e9;
    place_elements(&mut header.radar);
    let target = target([5.75, 30.3, 0.75], [0.0, -5.0, 0.0], 10.0);
    let object = Receiver::new(&header).unwrap().process(&cube(&header, &[target], 1)).unwrap().1.objects[0];
    let (range_m, radial_mps, position_m) = truth(&header, &target);
    assert!(
        (object.range_m - range_m).abs() < 0.02 && (object.radial_velocity_mps - radial_mps).abs() < 5e-3
    );
    assert!((object.position_m[0] - position_m[0]).abs() < 5e-3);
}

#[test]
fn a_cube_of_zeros_has_no_detection_and_a_black_picture() {
    for noise in [Noise::Absent, NOISE_12_DB] {
        let (mut header, mut frame) = small();
        header.noise = noise;
        frame.samples.fill(Complex32::ZERO);
        let receiver = Receiver::new(&header).unwrap();
        let map = receiver.range_doppler(&frame).unwrap();
        assert_eq!((map.detections, map.cells), (0, 16 * 32));
        assert!(receiver.detect(&map).unwrap().points.is_empty());
        assert!(rdm_grayscale(&header, &map).unwrap().iter().all(|p| *p == 0));
    }
}

#[test]
fn a_noise_free_map_says_what_floor_it_took() {
    let (mut header, _) = small();
    let target = target([1.0, 4.0, 5.0], [0.0, -2.0, 0.0], 1.0);
    header.noise = Noise::Absent;
    let map = Receiver::new(&header).unwrap().range_doppler(&cube(&header, &[target], 1)).unwrap();
    let peak = power_map(&header, &map).unwrap().iter().copied().fold(0.0, f64::max);
    assert!((map.assumed_floor.unwrap() / peak - 1e-6).abs() < 1e-12);
    header.noise = NOISE_12_DB;
    assert_eq!(
        Receiver::new(&header).unwrap().range_doppler(&cube(&header, &[target], 1)).unwrap().assumed_floor,
        None
    );
}

/// A scene that says nothing of noise is taken for noise-free: a recording made by it never is.
#[test]
fn samples_that_a_converter_counted_have_noise_whatever_their_scene_says() {
    let (mut header, frame) = small();
    let mapped = |header: &CubeHeader| Receiver::new(header).unwrap().range_doppler(&frame).unwrap();
    let told = mapped(&header);
    header.noise = Noise::Absent;
    assert!(mapped(&header).assumed_floor.is_some() && !dsp::has_noise(&header));
    for unit in [SampleUnit::Steps, SampleUnit::FullScale(32768.0)] {
        header.unit = unit;
        let map = mapped(&header);
        assert!(dsp::has_noise(&header) && map == told, "{unit:?}");
    }
}

#[test]
fn the_same_cube_gives_the_same_bytes_on_one_and_two_threads() {
    for multiplexing in [Multiplexing::Simultaneous, Multiplexing::Tdm, Multiplexing::Ddm, Multiplexing::Bpm]
    {
        let mut header = header(128, 64, elements_3x4());
        header.noise = NOISE_12_DB;
        header.radar.array.multiplexing = multiplexing;
        let frame = cube(&header, &vehicle([5.75, 20.0], [5.0, 2.0, 1.8], -2.0, 1), 1);
        let work = || {
            let receiver = Receiver::new(&header).unwrap();
            let map = receiver.range_doppler(&frame).unwrap();
            let points = receiver.detect(&map).unwrap();
            let crop = cropped(&header, &map, &points.objects[0], &PAPER_CROP).unwrap();
            (map, points, crop)
        };
        let on =
            |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(work);
        assert_eq!(on(1), on(2));
    }
}

#[test]
fn one_to_192_channels_are_processed() {
    for elements in [elements_1x1(), elements_3x4(), elements_6x8(), elements_12x16()] {
        let mut header = header(64, 16, elements);
        header.dsp.training_cells = [4, 8];
        let frame = cube(&header, &[target([1.0, 9.0, 4.0], [0.0, -2.0, 0.0], 1.0)], 1);
        assert_eq!(Receiver::new(&header).unwrap().process(&frame).unwrap().1.objects.len(), 1);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    #[test]
    fn any_small_cube_is_processed_or_refused_and_never_panics(
        (samples, chirps) in (0_u32..20, 0_u32..20),
        (guard, training) in ([0_u32..4, 0_u32..4], [0_u32..6, 0_u32..6]),
        mode in 0_usize..4,
        scale in prop::sample::select(vec![0.0_f32, 1e-38, 1.0, 1e30]),
        rate in 1e-9_f64..0.999,
    ) {
        let mut header = header(samples.max(1), chirps.max(1), elements_3x4());
        (header.radar.waveform.samples, header.radar.waveform.chirps) = (samples, chirps);
        (header.dsp.guard_cells, header.dsp.training_cells) = (guard, training);
        header.dsp.false_alarm_rate = rate;
        header.noise = if samples % 2 == 0 { Noise::Absent } else { NOISE_12_DB };
        let modes = [Multiplexing::Simultaneous, Multiplexing::Tdm, Multiplexing::Ddm, Multiplexing::Bpm];
        header.radar.array.multiplexing = modes[mode];
        let length = header.shape().iter().product::<usize>();
        let wave = |i: usize| Complex32::from_polar(scale, (i * i % 97) as f32);
        let samples = (0..length).map(wave).collect();
        let frame = CubeFrame { index: 0, time_s: 0.0, samples, error: Default::default() };
        if let Ok(map) = mapped(&header, &frame) {
            let receiver = Receiver::new(&header).unwrap();
            let points = receiver.detect(&map).unwrap();
            for point in &points.points {
                prop_assert!(point.position_m.iter().all(|x| x.is_finite()) && point.snr_db.is_finite());
            }
            for object in &points.objects {
                let format = CropFormat { side: 16, ..PAPER_CROP };
                prop_assert!(cropped(&header, &map, object, &format).is_ok());
            }
        }
    }
}
