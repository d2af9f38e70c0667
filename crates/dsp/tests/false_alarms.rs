//! S2: noise alone passes the detector at the rate asked for, in every zone of the map.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use artifact::cube::CubeHeader;
use artifact::radar::Multiplexing;
use artifact::settings::Window;
use common::*;
use dsp::cfar::DETECTED;
use dsp::range_doppler;
use rayon::prelude::*;

const RATE: f64 = 1e-3;
const ZONES: [&str; 4] = ["interior", "range edges", "doppler edges", "corners"];

/// False alarms over those asked for, per zone, of as many 32 × 32 maps as give 10⁶ cells in the smallest zone.
fn alarms(header: &CubeHeader) -> [f64; 4] {
    let half = [0, 1].map(|i: usize| (header.dsp.guard_cells[i] + header.dsp.training_cells[i]) as usize);
    let [_, rows, columns] = artifact::rdm::shape(header);
    let zone = |cell: usize| {
        let at_edge = |at: usize, half: usize, cells: usize| at < half || at + half >= cells;
        usize::from(at_edge(cell % columns, half[1], columns)) + 2 * usize::from(at_edge(cell / columns, half[0], rows))
    };
    let mut cells = [0_u64; 4];
    (0..rows * columns).for_each(|cell| cells[zone(cell)] += 1);
    let maps = 1_000_000_u64.div_ceil(*cells.iter().min().unwrap());
    let counts: Vec<[u64; 4]> = (0..maps)
        .into_par_iter()
        .map(|seed| {
            let map = range_doppler(header, &cube(header, &[], seed)).unwrap();
            assert_eq!(map.cells, (rows * columns) as u64);
            let mut counts = [0; 4];
            map.mask.iter().enumerate().filter(|(_, m)| **m == DETECTED).for_each(|(cell, _)| counts[zone(cell)] += 1);
            counts
        })
        .collect();
    [0, 1, 2, 3].map(|z: usize| {
        counts.iter().map(|c| c[z]).sum::<u64>() as f64 / ((maps * cells[z]) as f64 * header.dsp.false_alarm_rate)
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
    let mut header = noise_header(Window::Hann, [2, 2], [vec![[0.0, 0.0], [2.0, 0.0], [4.0, 0.0]], vec![[0.0, 0.0]]]);
    header.radar.array.multiplexing = Multiplexing::Ddm;
    // Only the best of M folds may alarm; the upper side is what is promised.
    assert_band("ddm", alarms(&header), 0.3, 1.3);
}
