//! What is left of the phases that time and Doppler division put on the transmitters' echoes of a moving target.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use artifact::cube::CubeHeader;
use artifact::radar::Multiplexing;
use artifact::settings::Window;
use common::*;
use dsp::angle::VirtualArray;
use dsp::{power_map, range_doppler};
use num_complex::Complex64;

/// Values of all channels in the target's cell, freed of the turns of its true velocity.
fn snapshot(header: &CubeHeader, target: &Target) -> Vec<Complex64> {
    let map = range_doppler(header, &cube(header, &[*target], 1)).unwrap();
    let power = power_map(header, &map).unwrap();
    let (cell, _) = power.indexed_iter().fold(((0, 0), 0.0), |best, (at, p)| if *p > best.1 { (at, *p) } else { best });
    // The chirps' phases turn at f_c − μτ, not at f_c (third term of eq. 13): 4e-5 of the velocity.
    let waveform = &header.radar.waveform;
    let (range_m, velocity_mps, _) = truth(header, target);
    let delayed = waveform.slope_hz_per_s * 2.0 * range_m / artifact::units::SPEED_OF_LIGHT_MPS;
    let shown_mps = velocity_mps * (1.0 - delayed / waveform.centre_frequency_hz());
    VirtualArray::new(header).snapshot(header, &map, [cell.0, cell.1], shown_mps)
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
    (header.dsp.range_window, header.dsp.doppler_window) = (Window::Chebyshev(140.0), Window::Chebyshev(140.0));
    header
}

/// Moving along the line of sight: a tangential speed turns the direction between slots, which no Doppler tells.
fn radial(velocity_mps: f64) -> Target {
    let direction = [0.2, 0.96_f64, -(1.0_f64 - 0.2 * 0.2 - 0.96 * 0.96).sqrt()];
    target([0, 1, 2].map(|i: usize| [0.0, 0.0, 6.0][i] + 32.1 * direction[i]), direction.map(|d| d * velocity_mps), 1.0)
}

/// On a Doppler cell's centre. Beside it a cell of a target that migrates through range cells weighs the chirps of each transmitter a
/// little differently: 4e-4 rad at −27 m/s, half a cell off and 2.6 range cells a frame; that is the map's, not the compensation's.
#[test]
fn transmitters_in_turn_are_in_phase_to_1e_6_rad_once_the_velocity_is_known() {
    for cells in [-50.0, -13.0, 3.0, 31.0, 128.0 + 31.0] {
        let tdm = radar(Multiplexing::Tdm);
        let mut together = radar(Multiplexing::Simultaneous);
        together.radar.waveform.chirp_interval_s = tdm.radar.repetition_interval_s();
        let shown_mps = cells * tdm.radar.velocity_resolution_mps();
        let range_m = truth(&tdm, &radial(shown_mps)).0;
        let delayed = 2.0 * tdm.radar.waveform.slope_hz_per_s * range_m / artifact::units::SPEED_OF_LIGHT_MPS;
        let target = radial(shown_mps / (1.0 - delayed / tdm.radar.waveform.centre_frequency_hz()));
        let apart = phase_apart(&snapshot(&tdm, &target), &snapshot(&together, &target));
        println!("tdm, {shown_mps:.2} m/s: asked 1e-6 rad, got {apart:.1e}");
        assert!(apart < 1e-6, "{shown_mps} m/s: {apart:e}");
    }
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
