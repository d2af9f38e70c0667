//! X6: the echo is linear in its paths.

use crate::setting::*;
use artifact::cube::CubeFrame;
use artifact::paths::Path;
use artifact::radar::{Multiplexing, Radar};
use artifact::settings::Noise;
use fmcw_echo::direct_sum::DirectSum;
use num_complex::Complex64;

fn small_radar() -> Radar {
    let waveform = artifact::Waveform { chirps: 4, ..experiment(1) };
    radar(waveform, &presets()[1], Multiplexing::Simultaneous)
}

fn cube(paths: Vec<Path>) -> CubeFrame {
    let radar = small_radar();
    let noise = Noise::Figure { noise_figure_db: 12.0, temperature_k: 290.0 };
    synthesized(&header(radar, noise), 5, &frame(paths)).unwrap()
}

fn noise_free(paths: &[Path]) -> Vec<Complex64> {
    let radar = small_radar();
    DirectSum::new(&radar, radar.waveform.centre_frequency_hz(), paths).cube()
}

#[test]
fn x6_the_echo_of_two_lists_is_the_sum_of_their_echoes() {
    let paths = random_paths(21, 40);
    for split in [1, 7, 20, 39] {
        let (first, second) = paths.split_at(split);
        let sum: Vec<Complex64> =
            noise_free(first).iter().zip(noise_free(second)).map(|(a, b)| a + b).collect();
        // A path's own samples do not depend on its neighbours; only the order of 40 additions differs:
        // 40·2⁻⁵³, −287 dB, and 20 dB for cancellation.
        assert!(error_db(&noise_free(&paths), &sum) < -267.0);
    }
}

#[test]
fn x6_amplitudes_scaled_scale_every_sample_conjugated() {
    let paths = random_paths(22, 40);
    let factor = Complex64::new(0.8, -1.7);
    let scaled: Vec<Path> = paths
        .iter()
        .map(|p| Path {
            amplitude_m: p.amplitude_m.map(|row| row.map(|a| a * factor)),
            slope_m_per_hz: p.slope_m_per_hz.map(|row| row.map(|a| a * factor)),
            ..*p
        })
        .collect();
    let expected: Vec<Complex64> = noise_free(&paths).iter().map(|x| x * factor.conj()).collect();
    // Rounding of 256 steps of the amplitude's recurrence and of 40 sums, each 2⁻⁵³: below 3e-14 even if they
    // all add.
    assert!(error_db(&noise_free(&scaled), &expected) < -260.0);
}

#[test]
fn x6_a_path_of_zero_amplitude_changes_no_byte() {
    let paths = random_paths(23, 21);
    let silent = Path {
        amplitude_m: [[Complex64::ZERO; 2]; 2],
        slope_m_per_hz: [[Complex64::ZERO; 2]; 2],
        ..paths[3]
    };
    // Heard in every polarization but the array's vv.
    let mut elsewhere = paths[4];
    (elsewhere.amplitude_m[0][0], elsewhere.slope_m_per_hz[0][0]) = (Complex64::ZERO, Complex64::ZERO);
    let expected = cube(paths.clone());
    for place in [0, 1, 10, 21] {
        for extra in [silent, elsewhere] {
            let mut more = paths.clone();
            more.insert(place, extra);
            assert!(cube(more) == expected, "at {place}");
        }
    }
}
