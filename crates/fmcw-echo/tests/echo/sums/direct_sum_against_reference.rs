//! The direct sum is the formula of interface.md, sample by sample: ≤ −100 dB asked, what is got is printed.

use crate::setting::*;
use artifact::radar::{Multiplexing, Pattern, Polarization, Radar};
use fmcw_echo::{direct_sum::DirectSum, reference};

/// −100 dB is asked; no path may err by more than 1e-7 of its phase and 1e-7 of its amplitude (−137 dB
/// together), and 20 random paths do not cancel by more than 7 dB over a whole cube.
const ASKED_DB: f64 = -130.0;

fn error_over_whole_cube_db(radar: &Radar, seed: u64, paths: usize) -> f64 {
    let f_c = radar.waveform.centre_frequency_hz();
    let paths = random_paths(seed, paths);
    error_db(&DirectSum::new(radar, f_c, &paths).cube(), &reference::cube(radar, f_c, &paths))
}

/// The waveform with fewer chirps, the frame as long: intervals grow instead.
fn thinned(number: usize, chirps: u32) -> artifact::Waveform {
    let whole = experiment(number);
    let interval = whole.chirp_interval_s * f64::from(whole.chirps / chirps);
    artifact::Waveform { chirps, chirp_interval_s: interval, ..whole }
}

#[test]
fn every_sample_of_a_whole_cube_agrees_for_every_experiment() {
    for number in [1, 2, 3] {
        let radar = radar(experiment(number), &presets()[1], Multiplexing::Simultaneous);
        let radar = Radar { waveform: thinned(number, 16), ..radar };
        let db = error_over_whole_cube_db(&radar, 11, 21);
        println!("experiment {number}: {db:.1} dB");
        assert!(db < ASKED_DB, "experiment {number}: {db}");
    }
}

#[test]
fn every_preset_and_multiplexing_agrees() {
    for layout in presets() {
        for multiplexing in
            [Multiplexing::Simultaneous, Multiplexing::Tdm, Multiplexing::Ddm, Multiplexing::Bpm]
        {
            let radar = radar(thinned(1, 2), &layout, multiplexing);
            let db = error_over_whole_cube_db(&radar, 12, 5);
            println!("{} {multiplexing:?}: {db:.1} dB", layout.name);
            assert!(db < ASKED_DB, "{} {multiplexing:?}: {db}", layout.name);
        }
    }
}

#[test]
fn every_polarization_and_a_cosine_pattern_agree() {
    for polarization in [Polarization::Vv, Polarization::Hh, Polarization::Vh, Polarization::Hv] {
        let mut radar = radar(thinned(1, 4), &presets()[1], Multiplexing::Simultaneous);
        radar.array.polarization = polarization;
        radar.array.pattern = Pattern::Cosine { exponent: 1.7 };
        (radar.boresight_az_rad, radar.boresight_el_rad) = (0.1, -0.2);
        let db = error_over_whole_cube_db(&radar, 13, 9);
        println!("{polarization:?}: {db:.1} dB");
        assert!(db < ASKED_DB, "{polarization:?}: {db}");
    }
}

#[test]
fn odd_and_tiny_cubes_agree() {
    for (samples, paths) in [(1, 1), (2, 3), (3, 8), (31, 17)] {
        let mut waveform = experiment(1);
        (waveform.samples, waveform.chirps) = (samples, 3);
        let db = error_over_whole_cube_db(&single_channel(waveform), 14, paths);
        assert!(db < ASKED_DB, "{samples} samples, {paths} paths: {db}");
    }
}

#[test]
fn long_chirps_do_not_wear_the_recurrence_out() {
    // 4096 samples in the same 50 µs: the error of the second difference grows with N²/2·ε = 2e-9 rad.
    let mut waveform = experiment(1);
    (waveform.samples, waveform.sample_rate_hz, waveform.chirps) = (4096, 5.12e6 * 16.0, 4);
    let db = error_over_whole_cube_db(&single_channel(waveform), 15, 9);
    println!("4096 samples: {db:.1} dB");
    assert!(db < ASKED_DB, "{db}");
}

#[test]
fn no_path_errs_by_more_than_1e_7_however_near_or_fast() {
    let mut worst_db = f64::NEG_INFINITY;
    for case in 0..400 {
        let share = |cases: u32, below: f64, above: f64| {
            below * (above / below).powf(f64::from(case / cases % 5) / 4.0)
        };
        let (range_m, speed_mps) = (share(1, 0.05, 100.0), share(5, 0.1, 2000.0));
        let mut waveform = artifact::Waveform { chirps: 2, ..experiment(1) };
        (waveform.samples, waveform.slope_hz_per_s) =
            ([64, 256, 700, 2048][case as usize / 25 % 4], share(100, 1e12, 3e13));
        waveform.chirp_interval_s = f64::from(waveform.samples) / waveform.sample_rate_hz + 10e-6;
        let radar = single_channel(waveform);
        // Across, along and aslant; the amplitude turns round within the band.
        let aslant = [0.8, 0.6 * (f64::from(case % 3) - 1.0), 0.0].map(|x| x * speed_mps);
        let mut path = point([0.3 * range_m, range_m, 6.0], aslant, 1.0);
        path.slope_m_per_hz[0][0] = num_complex::Complex64::new(-1.9, 0.7) / radar.waveform.bandwidth_hz();
        let f_c = radar.waveform.centre_frequency_hz();
        let error =
            error_db(&DirectSum::new(&radar, f_c, &[path]).cube(), &reference::cube(&radar, f_c, &[path]));
        if error > worst_db {
            println!("{error:.1} dB: {range_m} m, {speed_mps} m/s, {} samples", waveform.samples);
        }
        worst_db = worst_db.max(error);
    }
    println!("worst of 400: {worst_db:.1} dB");
    // 1e-7 of phase and of amplitude each; the amplitude's is of its greatest value in the band, 1.4 of the
    // rms here.
    assert!(worst_db < -135.0, "{worst_db}");
}
