//! The road's own backscatter against the radar equation's integral over the ground.

use crate::setting::*;
use artifact::Waveform;
use artifact::paths::Path;
use artifact::radar::{Multiplexing, Pattern, Radar};
use artifact::scene::Backscatter;
use artifact::units::power_from_db;
use fmcw_echo::{fast_sum, ground};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

const GAMMA: Backscatter = Backscatter { gamma: 0.01 };
const HEIGHT_M: f64 = 6.0;

/// One chirp on one channel, 6 m above the ground.
fn one_chirp() -> Radar {
    single_channel(Waveform { chirps: 1, ..experiment(1) })
}

/// Some range bins of one chirp, Hann window.
fn bins(radar: &Radar, seed: u64, band: Range<usize>) -> Vec<Complex64> {
    let paths = ground::paths(radar, &GAMMA, seed).unwrap();
    let samples = fast_sum::cube(radar, radar.waveform.centre_frequency_hz(), &paths, asked());
    let windowed: Vec<Complex64> = samples.iter().zip(hann(samples.len())).map(|(x, w)| x * w).collect();
    let n = windowed.len() as f64;
    let bin = |k: usize| {
        let turned = windowed.iter().enumerate();
        turned.map(|(i, x)| x * Complex64::from_polar(1.0, -TAU * (k * i) as f64 / n)).sum()
    };
    band.map(bin).collect()
}

fn hann(length: usize) -> impl Iterator<Item = f64> {
    (0..length).map(move |i| 0.5 - 0.5 * (TAU * i as f64 / length as f64).cos())
}

/// Power of the window's transform so many bins off its middle.
fn response(off: f64, length: usize) -> f64 {
    hann(length)
        .enumerate()
        .map(|(i, w)| w * Complex64::from_polar(1.0, TAU * off * i as f64 / length as f64))
        .sum::<Complex64>()
        .norm_sqr()
}

/// Received power by slant range, dP/dR = P_t G² λ²/(4π)³ · σ⁰ · πR/R⁴ over the half plane, σ⁰ = γh/R.
fn power_per_metre(radar: &Radar, range_m: f64) -> f64 {
    let link = radar.link.transmit_power_w * power_from_db(radar.link.antenna_gain_db).powi(2);
    let wavelength_m = radar.waveform.wavelength_m();
    let sigma0 = GAMMA.gamma * HEIGHT_M / range_m;
    link * wavelength_m.powi(2) / (4.0 * PI).powi(3) * sigma0 * PI * range_m / range_m.powi(4)
}

/// Mean power of bins: the integral over slant range, midpoints of a tenth of a cell.
fn asked_powers(radar: &Radar, band: Range<usize>) -> Vec<f64> {
    const STEPS: usize = 10;
    let (cell_m, length) = (radar.waveform.range_resolution_m(), radar.waveform.samples as usize);
    let step_m = cell_m / STEPS as f64;
    let steps = ((radar.waveform.range_max_m() - HEIGHT_M) / step_m) as usize;
    let power = |i: usize| power_per_metre(radar, HEIGHT_M + (i as f64 + 0.5) * step_m) * step_m;
    let powers: Vec<f64> = (0..steps).map(power).collect();
    // A bin's distance from a midpoint depends on bin·STEPS − i alone.
    let first =
        band.start as f64 - (HEIGHT_M / cell_m + 0.5 / STEPS as f64) - (steps - 1) as f64 / STEPS as f64;
    let responses: Vec<f64> =
        (0..steps + STEPS * band.len()).map(|d| response(first + d as f64 / STEPS as f64, length)).collect();
    let of_bin = |k: usize| {
        let shares = powers.iter().enumerate().map(|(i, power)| power * responses[k * STEPS + steps - 1 - i]);
        shares.sum()
    };
    (0..band.len()).map(of_bin).collect()
}

const SEEDS: u64 = 80;

/// Powers of one cell are exponential: standard error 1 over the root of the number of independent ones. With
/// a Hann window every second bin counts as one (Σ|ρ|² over neighbours is 1.94).
#[test]
fn mean_power_per_range_is_that_of_the_radar_equation_and_amplitudes_are_rayleighs() {
    let radar = one_chirp();
    let all = 28..250;
    let asked = asked_powers(&radar, all.clone());
    let draws: Vec<Vec<Complex64>> = (0..SEEDS).map(|seed| bins(&radar, seed, all.clone())).collect();
    for band in [28..40, 40..60, 60..100, 100..150, 150..200, 200..250] {
        let ratio = |bins: &Vec<Complex64>, k: usize| bins[k - all.start].norm_sqr() / asked[k - all.start];
        let ratios: Vec<f64> = draws.iter().flat_map(|bins| band.clone().map(|k| ratio(bins, k))).collect();
        let count = ratios.len() as f64;
        let error = (1.94 / count).sqrt();
        let mean = ratios.iter().sum::<f64>() / count;
        println!("bins {band:?}: got {mean:.4} of the power asked, standard error {error:.4}");
        assert!((mean - 1.0).abs() < 4.0 * error, "bins {band:?}: {mean}, standard error {error}");
        // Exponential: P(power > x·mean) = e^(−x).
        for x in [0.1_f64, 0.693, 2.0, 4.0] {
            let (asked, got) = ((-x).exp(), ratios.iter().filter(|r| **r > x).count() as f64 / count);
            let error = (1.94 * asked * (1.0 - asked) / count).sqrt();
            println!("  above {x} times the mean: asked {asked:.4}, got {got:.4}, standard error {error:.4}");
            assert!((got - asked).abs() < 4.0 * error, "bins {band:?}, above {x}: asked {asked}, got {got}");
        }
    }
}

/// Σ over patches of their RCS is ∫σ⁰dA = γ·h·π·(R_max − h); of n exponential powers with a standard error of
/// 1/√n.
#[test]
fn patches_fill_the_half_plane_before_the_array_with_the_cross_section_of_its_area() {
    let mut radar = radar(experiment(1), &presets()[2], Multiplexing::Simultaneous);
    (radar.boresight_az_rad, radar.position_m) = (2.0, [30.0, -7.0, 4.0]);
    let draws: Vec<Vec<Path>> = (0..20).map(|seed| ground::paths(&radar, &GAMMA, seed).unwrap()).collect();
    assert!(draws.iter().all(|paths| paths.len() == ground::patches(&radar)));
    let (count, patches) = (draws.len() as f64, draws[0].len());
    let asked = GAMMA.gamma * 4.0 * PI * (radar.waveform.range_max_m() - 4.0);
    for pol in [0, 1] {
        let got = draws.iter().flatten().map(|p| p.amplitude_m[pol][pol].norm_sqr()).sum::<f64>() / count;
        let error = asked / (patches as f64 * count).sqrt();
        println!("asked {asked:.4} m², got {got:.4} m², standard error {error:.4}, {patches} patches");
        assert!((got - asked).abs() < 4.0 * error);
    }
    for path in &draws[0] {
        let [x, y, z] = path.apparent_tx_m;
        let range_m = ((x - 30.0).powi(2) + (y + 7.0).powi(2) + 16.0).sqrt();
        let ahead_m = (x - 30.0) * 2.0_f64.sin() + (y + 7.0) * 2.0_f64.cos();
        assert!(z == 0.0 && (4.0..=radar.waveform.range_max_m()).contains(&range_m), "{path:?}");
        assert!(
            ahead_m >= -1e-9 && path.apparent_tx_mps == [0.0; 3] && path.target == artifact::paths::GROUND,
            "{path:?}"
        );
    }
}

#[test]
fn a_pattern_weighs_the_ground_as_it_does_targets() {
    let isotropic = one_chirp();
    let mut cosine = isotropic.clone();
    cosine.array.pattern = Pattern::Cosine { exponent: 1.0 };
    // All of the ground at 45° to 61 m is a few degrees below the horizon: ∫cos⁴φ dφ over the half plane is
    // 3/8 of it.
    let band = 200..250;
    let power = |radar: &Radar| -> f64 {
        (0..SEEDS)
            .map(|seed| bins(radar, seed, band.clone()).iter().map(Complex64::norm_sqr).sum::<f64>())
            .sum()
    };
    let depression = HEIGHT_M / (225.0 * isotropic.waveform.range_resolution_m());
    let (asked, got) = (0.375 * (1.0 - depression * depression).powi(2), power(&cosine) / power(&isotropic));
    // The same draws in both: what is left is how unevenly the patches of a ring weigh, less than the draws
    // themselves would.
    let error = (1.94 / (SEEDS as f64 * 50.0)).sqrt();
    println!("asked {asked:.4}, got {got:.4}, standard error below {error:.4}");
    assert!((got - asked).abs() < 4.0 * error * asked);
}

/// A single element with a horn of ±3.4° at half of the two-way power.
#[test]
fn cells_of_a_narrow_pattern_are_rayleighs_too() {
    let mut radar = one_chirp();
    radar.array.pattern = Pattern::Cosine { exponent: 100.0 };
    radar.boresight_el_rad = -0.2;
    let band = 60..150;
    let draws: Vec<Vec<f64>> = (0..SEEDS)
        .map(|seed| bins(&radar, seed, band.clone()).iter().map(Complex64::norm_sqr).collect())
        .collect();
    let count = draws.len() as f64;
    let of_bin = |bin: usize, power: i32| draws.iter().map(|draw| draw[bin].powi(power)).sum::<f64>() / count;
    let bins = band.len();
    let contrast = (0..bins).map(|bin| of_bin(bin, 2) / of_bin(bin, 1).powi(2)).sum::<f64>() / bins as f64;
    // ⟨I²⟩/⟨I⟩² of an exponential distribution; from a few patches it was 3.3.
    println!("⟨I²⟩/⟨I⟩² {contrast:.3}");
    assert!((contrast - 2.0).abs() < 0.15, "{contrast}");
}

#[test]
fn the_ground_is_the_same_on_any_number_of_threads_and_another_with_another_seed() {
    let radar = radar(experiment(1), &presets()[1], Multiplexing::Tdm);
    let on = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| ground::paths(&radar, &GAMMA, seed).unwrap())
    };
    let one = on(1, 3);
    assert!(one == on(2, 3) && one == on(7, 3));
    assert!(one != on(1, 4));
}

#[test]
fn a_radar_on_the_ground_sees_none_of_it_and_too_fine_a_ground_is_refused() {
    let mut low = one_chirp();
    low.position_m[2] = 0.0;
    assert!(ground::paths(&low, &GAMMA, 1).unwrap().is_empty());
    let mut fine =
        radar(Waveform { samples: 1 << 15, ..experiment(1) }, &presets()[4], Multiplexing::Simultaneous);
    fine.waveform.sample_rate_hz *= 100.0;
    let patches = ground::patches(&fine);
    let refused = fmcw_echo::EchoError::GroundTooFine { patches, limit: 1 << 22 };
    assert_eq!(ground::paths(&fine, &GAMMA, 1).unwrap_err(), refused);
}
