//! Several echoes in one cell: how near two may be, how often one is made two, and how exact they are.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use crate::pair_trials::{RANGE_M, over_bound_db, pair, random, resolved, snapshot};
use dsp::angle::{Direction, VirtualArray};
use dsp::sources;
use num_complex::Complex64;
use rayon::prelude::*;

#[test]
fn two_echoes_half_a_beam_apart_are_two_in_azimuth_and_in_elevation() {
    for (name, elements, axis) in [
        ("3x4 azimuth", elements_3x4(), 0),
        ("6x8 azimuth", elements_6x8(), 0),
        ("6x8 elevation", elements_6x8(), 1),
    ] {
        let [ours, fft] = resolved(&header(256, 64, elements), 30.0, axis, 0.5, 100);
        println!("{name}: two told apart at half a beam, 30 dB a channel: {ours} of trials, by FFT {fft}");
        assert!(ours > 0.9, "{name}: {ours}");
        assert!(ours > fft + 0.2, "{name}: FFT {fft}");
    }
}

#[test]
fn directions_of_two_echoes_reach_their_cramer_rao_bound() {
    for (name, elements, axis, beams) in
        [("3x4", elements_3x4(), 0, 0.8), ("6x8 elevation", elements_6x8(), 1, 0.8)]
    {
        let got_db = over_bound_db(&header(256, 64, elements), 30.0, axis, beams, 200);
        println!("{name}: two at {beams} beams, 30 dB a channel: {got_db:.2} dB over the bound");
        // 200 pairs of errors stray by 4.34·√(2/400) = 0.31 dB.
        assert!(got_db.abs() < 1.0 + 0.9, "{name}: {got_db}");
    }
}

#[test]
fn one_echo_stays_one_at_the_rate_that_was_asked_for() {
    let elements = [("3x4", elements_3x4()), ("6x8", elements_6x8())];
    for (name, elements) in elements {
        let array = VirtualArray::new(&header(256, 64, elements));
        let splits = (0..1000_u64).into_par_iter().filter(|seed| {
            let mut random = random(*seed);
            let truth = pair(&array, 5.0 + 5.0 * (seed % 8) as f64, 0, 0.0, &mut random)[..1].to_vec();
            let values = snapshot(&array, &truth, &mut random);
            sources(&array, &values, RANGE_M, 1.0).len() > 1
        });
        let splits = splits.count();
        println!("{name}: {splits} of 1000 made two");
        // 0.1 expected of 1e-4; the rate's estimate M·t·e^{−t} is good to a factor of a few: three would be
        // 3e-3.
        assert!(splits < 3, "{name}: {splits}");
    }
}

/// At 60 dB and more over a channel's noise the channels of an echo differ by more than noise: each sees it
/// at its own range, and so on its own place of the range lobe.
#[test]
fn a_lone_echo_is_one_in_every_cell_however_strong() {
    use artifact::settings::Angle;
    use dsp::Receiver;
    for (name, elements) in [("3x4", elements_3x4()), ("6x8", elements_6x8()), ("12x16", elements_12x16())] {
        let mut header = header(256, 32, elements);
        header.noise = NOISE_12_DB;
        header.dsp.angle = Angle::MaximumLikelihood;
        let receiver = Receiver::new(&header).unwrap();
        let cell_m = header.radar.waveform.range_resolution_m();
        for (part, right) in [(0.0, 0.3), (0.25, -0.45), (0.5, 0.45), (-0.4, -0.2)] {
            let (range_m, right): (f64, f64) = ((80.0 + part) * cell_m, right);
            let at_m = [range_m * right, range_m * (1.0 - right * right).sqrt(), 6.0];
            let points =
                receiver.process(&cube(&header, &[target(at_m, [0.0; 3], 3e4)], 1)).unwrap().1.points;
            let place = |point: &artifact::points::Point| (point.range_m, point.radial_velocity_mps);
            println!("{name}, {part}, {right}: {} points, {:.1} dB", points.len(), points[0].snr_db);
            assert!(points[0].snr_db > 65.0);
            for (i, point) in points.iter().enumerate() {
                let is_alone = points[..i].iter().all(|other| place(other) != place(point));
                assert!(is_alone, "{name}, {part}, {right}: {point:#?}");
            }
        }
    }
}

#[test]
fn without_noise_three_echoes_are_found_where_they_are() {
    let array = VirtualArray::new(&header(256, 64, elements_3x4()));
    let echoes = [(-0.3, 1.0), (0.1, 0.7), (0.25, 0.4)]
        .map(|(right, size)| (Direction { right, up: None }, Complex64::from_polar(1e5 * size, 7.0 * right)));
    let found = sources(&array, &snapshot(&array, &echoes, &mut random(1)), RANGE_M, 1.0);
    assert_eq!(found.len(), 3, "{found:?}");
    for ((truth, _), source) in echoes.iter().zip(&found) {
        // Noise 80 dB down over 12 channels: 1e-5 of u.
        assert!((truth.right - source.direction.right).abs() < 1e-4, "{truth:?}, {source:?}");
    }
}

#[test]
fn two_vehicles_side_by_side_in_one_cell_are_two_objects() {
    use artifact::settings::Angle;
    use dsp::Receiver;
    let mut header = header(256, 64, elements_3x4());
    header.noise = NOISE_12_DB;
    // Lanes 1 and 2, the same range and radial velocity: 3.6 m apart at 40 m are 0.09 of u, half a beam.
    let at = |x: f64| target([x, (40f64 * 40.0 - x * x).sqrt(), 6.0], [0.0; 3], 30.0);
    let pair = [at(2.0), at(5.6)];
    let map = Receiver::new(&header).unwrap().range_doppler(&cube(&header, &pair, 3)).unwrap();
    header.dsp.angle = Angle::MaximumLikelihood;
    let objects = Receiver::new(&header).unwrap().detect(&map).unwrap().objects;
    assert_eq!(objects.len(), 2, "{objects:?}");
    let mut across: Vec<f64> = objects.iter().map(|o| o.position_m[0]).collect();
    across.sort_by(f64::total_cmp);
    println!("asked 2.0 and 5.6 m across, got {across:.2?}");
    // 20 dB and more over the noise of a channel: a twentieth of a beam, 0.3 m.
    assert!((across[0] - 2.0).abs() < 0.3 && (across[1] - 5.6).abs() < 0.3, "{across:?}");
}
