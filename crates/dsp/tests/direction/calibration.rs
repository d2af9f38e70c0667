//! Arrays of erring elements, before and after their calibration on a reflector.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use crate::erring_elements::{calibrated, compared, errors, map, radar};
use dsp::{DspError, Receiver};
use num_complex::Complex64;
use std::f64::consts::TAU;

#[test]
fn a_calibrated_array_of_erring_elements_is_as_good_as_an_ideal_one() {
    for (name, elements, draws) in [("3x4", elements_3x4(), 24), ("12x16", elements_12x16(), 3)] {
        let [ideal, erring, calibrated] = compared(elements, draws);
        println!(
            "{name}: ideal {ideal:.4?}, 3 dB and 30° {erring:.4?}, calibrated {calibrated:.4?} (beams rms, dB)"
        );
        // The reflector is 25 dB over a channel's noise in four frames and more: 2° and 0.3 dB of a channel,
        // a fifteenth of what was.
        assert!(calibrated[0] < 0.2 * erring[0] && (calibrated[1] - ideal[1]).abs() < 0.7, "{name}");
        assert!(erring[1] > ideal[1] + 2.0, "{name}: errors raise sidelobes");
    }
}

/// Frames know their errors but for a common phase. Errors that add up to nothing, or nearly so, have no
/// phase of their sum to be turned by: two channels in opposition, and a ring. Frames turned by what the
/// noise gives instead may add up to nothing themselves.
#[test]
fn the_mean_of_frames_is_true_where_errors_add_up_to_nothing() {
    let ring = (0..12).map(|i| Complex64::cis(TAU * f64::from(i) / 12.0)).collect();
    for errors in [vec![Complex64::ONE, -Complex64::ONE], ring] {
        let frame = |index: u32| -> Vec<Complex64> {
            let noise = Complex64::from_polar(1e-3, 2.4 * f64::from(index));
            let common = Complex64::cis(TAU * f64::from(index) / 4.0);
            let noisy = |(i, error): (usize, &Complex64)| common * (error + noise * ((i % 2) as f64 - 0.3));
            errors.iter().enumerate().map(noisy).collect()
        };
        let mean = dsp::mean_errors(&(0..4).map(frame).collect::<Vec<_>>());
        let turn = (mean[0] / errors[0]).arg();
        for (mean, error) in mean.iter().zip(&errors) {
            let apart = (mean / Complex64::cis(turn) - error).norm();
            assert!(apart < 3e-3, "{mean} of {error}, noise of 1e-3");
        }
    }
}

#[test]
fn points_of_a_calibrated_array_stand_in_their_direction() {
    let header = radar(elements_3x4());
    let errors = errors(&header, 7);
    let known = calibrated(&header, &errors, 7);
    // At the assumed height: without elevation rows the azimuth follows from it.
    let target = target([-4.0, 12.0, 0.75], [0.0; 3], 100.0);
    let points = Receiver::new(&known).unwrap().detect(&map(&known, &errors, &target, 9)).unwrap().points;
    let missed = points[0].azimuth_rad - (-4.0_f64).atan2(12.0);
    println!("off by {missed:.4} rad of a beam of 0.17");
    assert!(missed.abs() < 0.01);
}

#[test]
fn calibrations_that_do_not_fit_and_reflectors_that_are_not_there_are_refused() {
    let header = radar(elements_3x4());
    let ideal = vec![Complex64::ONE; 12];
    let reflector = target([1.0, 12.0, 5.0], [0.0; 3], 100.0);
    let map = map(&header, &ideal, &reflector, 1);
    assert!(matches!(
        Receiver::new(&header).and_then(|receiver| receiver.channel_errors(&map, [0.0, 70.0, 6.0])),
        Err(DspError::ReflectorRange { .. })
    ));
    assert!(matches!(
        Receiver::new(&header).and_then(|receiver| receiver.channel_errors(&map, [0.0, f64::NAN, 6.0])),
        Err(DspError::ReflectorRange { .. })
    ));
    assert!(matches!(
        Receiver::new(&header).and_then(|receiver| receiver.channel_errors(&map, [0.0, 6.0, 6.0])),
        Err(DspError::WeakReflector { .. })
    ));
    let mut short = header;
    short.dsp.calibration = vec![Complex64::ONE; 11];
    assert_eq!(
        Receiver::new(&short).and_then(|receiver| receiver.detect(&map)),
        Err(DspError::Calibration { expected: 12, found: 11 })
    );
}
