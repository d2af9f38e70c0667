//! Remainder of the phases that time, Doppler and code division put on the transmitters' echoes of a moving
//! target.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::common::*;
use artifact::cube::CubeHeader;
use artifact::radar::Multiplexing;
use artifact::settings::Window;
use dsp::angle::VirtualArray;
use dsp::{Receiver, power_map};
use num_complex::Complex64;

/// Values of all channels in the target's cell, freed of the turns of its true velocity.
fn snapshot(header: &CubeHeader, target: &Target) -> Vec<Complex64> {
    let map = Receiver::new(header).unwrap().range_doppler(&cube(header, &[*target], 1)).unwrap();
    let power = power_map(header, &map).unwrap();
    let (cell, _) =
        power.indexed_iter().fold(((0, 0), 0.0), |best, (at, p)| if *p > best.1 { (at, *p) } else { best });
    // The chirps' phases turn at f_c − μτ, not at f_c (third term of eq. 13): 4e-5 of the velocity.
    let waveform = &header.radar.waveform;
    let (range_m, velocity_mps, _) = truth(header, target);
    let delayed = waveform.slope_hz_per_s * 2.0 * range_m / artifact::units::SPEED_OF_LIGHT_MPS;
    let shown_mps = velocity_mps * (1.0 - delayed / waveform.centre_frequency_hz());
    VirtualArray::new(header).snapshot(&map, [cell.0, cell.1], shown_mps)
}

/// Largest difference of phase between two snapshots, one common phase taken out.
fn phase_apart(a: &[Complex64], b: &[Complex64]) -> f64 {
    let common: Complex64 = a.iter().zip(b).map(|(a, b)| a * b.conj()).sum();
    a.iter().zip(b).map(|(a, b)| (a * b.conj() * common.conj()).arg().abs()).fold(0.0, f64::max)
}

fn radar(multiplexing: Multiplexing) -> CubeHeader {
    let mut header = header(256, 128, elements_3x4());
    header.radar.array.multiplexing = multiplexing;
    // What one transmitter's echo leaks into another's band is then below 1e-7.
    (header.dsp.range_window, header.dsp.doppler_window) =
        (Window::Chebyshev(140.0), Window::Chebyshev(140.0));
    header
}

/// Moving along the line of sight: a tangential speed turns the direction between slots, which no Doppler
/// tells.
fn radial(velocity_mps: f64) -> Target {
    radial_from(32.1, velocity_mps)
}

/// A target that moves along the line of sight, from this range on.
fn radial_from(range_m: f64, velocity_mps: f64) -> Target {
    let direction = [0.2, 0.96_f64, -(1.0_f64 - 0.2 * 0.2 - 0.96 * 0.96).sqrt()];
    target(
        [0, 1, 2].map(|i: usize| [0.0, 0.0, 6.0][i] + range_m * direction[i]),
        direction.map(|d| d * velocity_mps),
        1.0,
    )
}

/// The velocities are those of Doppler cells' centres. Beside these a cell of a target that migrates through
/// range cells weighs the chirps of each transmitter a little differently: 4e-4 rad at −27 m/s, half a cell
/// off and 2.6 range cells a frame; that is the map's, not the compensation's.
#[test]
fn transmitters_in_turn_are_in_phase_to_1e_6_rad_once_the_velocity_is_known() {
    for cells in [-50.0, -13.0, 3.0, 31.0, 128.0 + 31.0] {
        let (shown_mps, apart) = against_ideal(Multiplexing::Tdm, cells, 32.1);
        println!("tdm, {shown_mps:.2} m/s: asked 1e-6 rad, got {apart:.1e}");
        assert!(apart < 1e-6, "{shown_mps} m/s: {apart:e}");
    }
}

/// Transmitters agree at rest to 1e-6 rad. A target that moves on between slots changes its strength in a
/// cell, by the slope of the range lobe and as 1/R², and so much of it passes between the transmitters.
#[test]
fn transmitters_told_apart_by_codes_are_in_phase_to_what_an_echo_changes_in_strength_from_slot_to_slot() {
    for cells in [0.0, -50.0, 31.0, 128.0 + 31.0, -256.0 - 7.0] {
        let header = radar(Multiplexing::Bpm);
        let (velocity_mps, waveform) =
            (cells * header.radar.velocity_resolution_mps(), &header.radar.waveform);
        let coupling_m = velocity_mps * waveform.centre_frequency_hz() / waveform.slope_hz_per_s;
        // Cell 132; a chirp's own middle is where its range is measured.
        let half_chirp_s = 0.5 * f64::from(waveform.samples) / waveform.sample_rate_hz;
        let passed_m =
            velocity_mps * (header.radar.frame_middle_s() + half_chirp_s - 0.5 * waveform.chirp_interval_s);
        let centred_m = 132.0 * waveform.range_resolution_m() - coupling_m - passed_m;
        let (shown_mps, apart) = against_ideal(Multiplexing::Bpm, cells, centred_m);
        // The outer slots are 1.5 from the block's middle. The lobe falls as e^{−0.76δ²} (140 dB at 4.6
        // cells), 1.52δ per cell at δ, and the elements see the point at ±1.1 mm of range.
        let slots_m = 1.5 * velocity_mps.abs() * waveform.chirp_interval_s;
        let cell_m = waveform.range_resolution_m();
        let limit = |aside_cells: f64| 1e-6 + slots_m * (2.0 / 32.0 + 1.52 * aside_cells / cell_m);
        let limits = [limit(1.1e-3 / cell_m), limit(0.5)];
        let (_, beside) = against_ideal(Multiplexing::Bpm, cells, centred_m + 0.5 * cell_m);
        println!(
            "bpm, {shown_mps:.2} m/s: {apart:.1e} rad in a range cell's middle, {beside:.1e} at its edge; limits {:.1e}, {:.1e}",
            limits[0], limits[1]
        );
        assert!(apart < limits[0] && beside < limits[1], "{shown_mps} m/s: {apart:e}, {beside:e}");
    }
}

/// A velocity and the largest difference of phase from ideal transmitters that repeat as often.
fn against_ideal(multiplexing: Multiplexing, cells: f64, first_range_m: f64) -> (f64, f64) {
    let shared = radar(multiplexing);
    let mut together = radar(Multiplexing::Simultaneous);
    together.radar.waveform.chirp_interval_s = shared.radar.repetition_interval_s();
    let shown_mps = cells * shared.radar.velocity_resolution_mps();
    let range_m = truth(&shared, &radial_from(first_range_m, shown_mps)).0;
    let delayed = 2.0 * shared.radar.waveform.slope_hz_per_s * range_m / artifact::units::SPEED_OF_LIGHT_MPS;
    let target =
        radial_from(first_range_m, shown_mps / (1.0 - delayed / shared.radar.waveform.centre_frequency_hz()));
    (shown_mps, phase_apart(&snapshot(&shared, &target), &snapshot(&together, &target)))
}

#[test]
fn transmitters_told_apart_by_doppler_are_in_phase_to_1e_6_rad() {
    for velocity in [-14.3, -4.1, 0.7, 10.0] {
        let [ddm, together] = [Multiplexing::Ddm, Multiplexing::Simultaneous].map(radar);
        let apart = phase_apart(&snapshot(&ddm, &radial(velocity)), &snapshot(&together, &radial(velocity)));
        println!("ddm, {velocity} m/s: asked 1e-6 rad, got {apart:.1e}");
        assert!(apart < 1e-6, "{velocity} m/s: {apart:e}");
    }
}
