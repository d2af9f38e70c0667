//! S2: noise alone passes the detector at the rate asked for, in every zone of the map.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::alarm_rates::{self, DETECTORS, assert_weighed, counted_in_bands, noise_power_map};
use crate::common::*;
use artifact::cube::CubeHeader;
use artifact::radar::{Multiplexing, Sampling};
use artifact::settings::Window;
use dsp::Receiver;
use dsp::cfar::{Cfar, DETECTED};
use rayon::prelude::*;

const RATE: f64 = 1e-3;
const ZONES: [&str; 4] = ["interior", "range edges", "doppler edges", "corners"];

/// False alarms over those asked for, per zone, of as many 32 × 32 maps as give 10⁶ cells in the smallest
/// zone.
fn alarms(header: &CubeHeader) -> [f64; 4] {
    let half = [0, 1].map(|i: usize| (header.dsp.guard_cells[i] + header.dsp.training_cells[i]) as usize);
    let [_, rows, columns] = artifact::rdm::shape(header);
    let zone = |cell: usize| {
        let at_edge = |at: usize, half: usize, cells: usize| at < half || at + half >= cells;
        usize::from(at_edge(cell % columns, half[1], columns))
            + 2 * usize::from(at_edge(cell / columns, half[0], rows))
    };
    let mut cells = [0_u64; 4];
    (0..rows * columns).for_each(|cell| cells[zone(cell)] += 1);
    let maps = 1_000_000_u64.div_ceil(*cells.iter().min().unwrap());
    let receiver = Receiver::new(header).unwrap();
    let counts: Vec<[u64; 4]> = (0..maps)
        .into_par_iter()
        .map(|seed| {
            let map = receiver.range_doppler(&cube(header, &[], seed)).unwrap();
            assert_eq!(map.cells, (rows * columns) as u64);
            let mut counts = [0; 4];
            map.mask
                .iter()
                .enumerate()
                .filter(|(_, m)| **m == DETECTED)
                .for_each(|(cell, _)| counts[zone(cell)] += 1);
            counts
        })
        .collect();
    [0, 1, 2, 3].map(|z: usize| {
        counts.iter().map(|c| c[z]).sum::<u64>() as f64
            / ((maps * cells[z]) as f64 * header.dsp.false_alarm_rate)
    })
}

fn noise_header(window: Window, guard: [u32; 2], elements: [Vec<[f64; 2]>; 2]) -> CubeHeader {
    let mut header = header(32, 32, elements);
    header.noise = NOISE_12_DB;
    header.dsp.false_alarm_rate = RATE;
    header.dsp.guard_cells = guard;
    header.dsp.range_window = window;
    header.dsp.doppler_window = window;
    header
}

fn assert_band(what: &str, got: [f64; 4], low: f64, high: f64) {
    println!("{what}: {got:.3?}");
    for (zone, ratio) in ZONES.iter().zip(got) {
        assert!((low..=high).contains(&ratio), "{what}, {zone}: {ratio} of the rate asked for");
    }
}

#[test]
fn s2_without_windows_the_false_alarm_rate_is_the_one_asked_for_in_every_zone() {
    // 1000 alarms expected in the smallest zone: 3.2 % standard deviation, the band is three of them.
    assert_band("rect", alarms(&noise_header(Window::Rect, [2, 2], elements_1x1())), 0.9, 1.1);
}

#[test]
fn s2_with_hann_windows_the_correlated_cells_are_accounted_for_in_every_zone() {
    assert_band("hann", alarms(&noise_header(Window::Hann, [2, 2], elements_1x1())), 0.8, 1.3);
}

#[test]
fn s2_without_guard_cells_the_cell_in_its_own_estimate_is_accounted_for() {
    assert_band("hann, no guard", alarms(&noise_header(Window::Hann, [0, 0], elements_1x1())), 0.8, 1.3);
}

#[test]
fn s2_wide_windows_and_narrow_guards_keep_the_rate() {
    let wide = noise_header(Window::Chebyshev(80.0), [1, 1], elements_1x1());
    assert_band("chebyshev, guard 1", alarms(&wide), 0.8, 1.3);
}

#[test]
fn s2_the_sum_of_channels_keeps_the_rate() {
    let four = [vec![[0.0, 0.0]], (0..4).map(|i| [f64::from(i), 0.0]).collect()];
    assert_band("hann, 4 channels", alarms(&noise_header(Window::Hann, [2, 2], four)), 0.8, 1.3);
}

#[test]
fn s2_doppler_division_alarms_no_more_than_asked() {
    let mut header =
        noise_header(Window::Hann, [2, 2], [vec![[0.0, 0.0], [2.0, 0.0], [4.0, 0.0]], vec![[0.0, 0.0]]]);
    header.radar.array.multiplexing = Multiplexing::Ddm;
    // Only the best of M folds may alarm; the upper side is what is promised.
    assert_band("ddm", alarms(&header), 0.3, 1.3);
}

#[test]
fn all_detectors_keep_the_rate_at_every_range_edge_and_corner() {
    // Zones of 12 × 32, 20 × 20 and 20 × 12 cells; the scatter of these maps is printed and allowed for
    // twice.
    for (window, channels, maps) in [(Window::Rect, 1, 150), (Window::Hann, 1, 150), (Window::Hann, 12, 40)] {
        assert_weighed(
            &alarm_rates::noise_header(Sampling::Complex, window, channels),
            &[1e-2, 1e-3, 1e-4],
            maps,
        );
    }
}

#[test]
fn one_dimensional_training_keeps_the_rate_on_either_axis() {
    for (guard, training) in [([0, 2], [0, 8]), ([2, 0], [8, 0])] {
        for window in [Window::Rect, Window::Hann] {
            let mut header = alarm_rates::noise_header(Sampling::Complex, window, 4);
            (header.dsp.guard_cells, header.dsp.training_cells) = (guard, training);
            assert_weighed(&header, &[1e-2, 1e-3], 150);
        }
    }
}

#[test]
fn masks_are_those_of_estimates_made_cell_by_cell() {
    for (name, detector) in DETECTORS {
        for (guard, training) in [([2, 2], [4, 8]), ([0, 2], [0, 6]), ([2, 0], [6, 0]), ([0, 0], [3, 3])] {
            let mut header = alarm_rates::noise_header(Sampling::Complex, Window::Hann, 1);
            (header.dsp.guard_cells, header.dsp.training_cells) = (guard, training);
            (header.dsp.detector, header.dsp.false_alarm_rate) = (detector, 1e-2);
            let (cfar, power) = (Cfar::new(&header).unwrap(), noise_power_map(&header, 7));
            for floor in [0.0, 0.5] {
                let mask = cfar.mask(&power, floor);
                let slow = cfar.estimates(&power).into_iter().enumerate();
                let mut found = 0;
                for (cell, estimate) in slow {
                    let passes = power[cell] > cfar.factor([cell / 32, cell % 32]) * (estimate + floor);
                    assert_eq!(
                        mask[cell] == DETECTED,
                        passes,
                        "{name}, {training:?}, floor {floor}, cell {cell}"
                    );
                    found += usize::from(passes);
                }
                assert!(floor > 0.0 || found > 0, "{name} finds nothing to compare");
            }
        }
    }
}

#[test]
fn s2_narrow_bands_of_doppler_division_keep_the_rate() {
    // 2,048 alarms expected of each, which come in lumps of as many as there are bands: 8 % of scatter.
    for (transmitters, chirps) in [(3, 16), (6, 32), (6, 16), (12, 64), (12, 16)] {
        let header = alarm_rates::header_of_bands(transmitters, chirps);
        for ((name, _), found) in DETECTORS.iter().zip(counted_in_bands(&header, RATE, 32_000)) {
            let (alarms, cells) = found;
            let got = alarms as f64 / (RATE * cells as f64);
            println!("{name}, {transmitters} transmitters, {chirps} chirps: {got:.3} of the rate asked for");
            assert!((0.75..1.25).contains(&got), "{name}, {transmitters}, {chirps}: {got}");
        }
    }
}
