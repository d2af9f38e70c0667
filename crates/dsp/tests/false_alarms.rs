//! S2: noise alone passes the detector at the rate asked for, in every zone of the map.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use artifact::cube::CubeHeader;
use artifact::radar::Multiplexing;
use artifact::settings::{Detector, Window};
use common::*;
use dsp::cfar::{Cfar, DETECTED};
use dsp::gamma_forms::gamma_tail;
use dsp::range_doppler;
use dsp::range_doppler::RangeDoppler;
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

const DETECTORS: [(&str, Detector); 4] = [
    ("ca-cfar", Detector::CaCfar),
    ("go-cfar", Detector::GoCfar),
    ("so-cfar", Detector::SoCfar),
    ("os-cfar", Detector::OsCfar),
];

fn channels_header(window: Window, channels: u32) -> CubeHeader {
    let receivers = (0..channels).map(|i| [f64::from(i), 0.0]).collect();
    noise_header(window, [2, 2], [vec![[0.0, 0.0]], receivers])
}

/// Noise summed over the channels in units of one channel's mean, `[doppler, range]`.
fn noise_power_map(header: &CubeHeader, seed: u64) -> Vec<f64> {
    let transform = RangeDoppler::<f64>::new(header).unwrap();
    let [channels, chirps, samples] = header.shape();
    let energy = |window: Window, length: usize| -> f64 {
        dsp::window::taper(window, length).unwrap().iter().map(|w| w * w).sum()
    };
    let unit =
        noise_variance(header) * energy(header.dsp.doppler_window, chirps) * energy(header.dsp.range_window, samples);
    let noise = cube(header, &[], seed);
    let mut power = vec![0.0; chirps * samples];
    for channel in 0..channels {
        let cells = chirps * samples;
        let map = transform.channel(&noise.samples[channel * cells..][..cells], 0.0);
        power.iter_mut().zip(map).for_each(|(sum, value)| *sum += value.norm_sqr() / unit);
    }
    power
}

/// Interior, range edges, corners of a map.
fn zone_of(header: &CubeHeader, cell: usize) -> usize {
    let half = [0, 1].map(|i: usize| (header.dsp.guard_cells[i] + header.dsp.training_cells[i]) as usize);
    let [_, rows, columns] = header.shape();
    let at_edge = |at: usize, half: usize, cells: usize| at < half || at + half >= cells;
    let corner = usize::from(at_edge(cell / columns, half[0], rows));
    if at_edge(cell % columns, half[1], columns) { 1 + corner } else { 0 }
}

/// Per detector, rate and zone: rate got over rate asked, and its standard error.
///
/// The cell under test is independent of its training cells (no window here reaches over two guard cells), so its chance
/// to pass is known once these are drawn: P(G(M) > threshold). Its mean is what weighted alarms of a scaled cell under
/// test (importance sampling) tend to, with less scatter than any scale leaves.
fn weighed(header: &CubeHeader, rates: &[f64], maps: u64) -> Vec<Vec<[(f64, f64); 3]>> {
    let cells = header.shape()[1] * header.shape()[2];
    let mut sizes = [0.0; 3];
    (0..cells).for_each(|cell| sizes[zone_of(header, cell)] += 1.0);
    let detector = |detector: Detector, rate: f64| {
        let mut header = header.clone();
        (header.dsp.detector, header.dsp.false_alarm_rate) = (detector, rate);
        Cfar::new(&header).unwrap()
    };
    let detectors: Vec<Vec<Cfar>> =
        DETECTORS.iter().map(|(_, d)| rates.iter().map(|rate| detector(*d, *rate)).collect()).collect();
    let of_map = |seed: u64| -> Vec<Vec<[f64; 3]>> {
        let power = noise_power_map(header, seed);
        let of_rate = |cfar: &Cfar, estimates: &[f64], rate: f64| {
            let mut sums = [0.0; 3];
            for (cell, estimate) in estimates.iter().enumerate() {
                let zone = zone_of(header, cell);
                let chance = gamma_tail(header.shape()[0], cfar.factor(cell % header.shape()[2]) * estimate);
                sums[zone] += chance / (rate * sizes[zone]);
            }
            sums
        };
        let of_detector = |by_rate: &Vec<Cfar>| {
            let estimates = by_rate[0].estimates(&power);
            by_rate.iter().zip(rates).map(|(cfar, rate)| of_rate(cfar, &estimates, *rate)).collect()
        };
        detectors.iter().map(of_detector).collect()
    };
    let drawn: Vec<_> = (0..maps).into_par_iter().map(of_map).collect();
    let summary = |d: usize, r: usize, zone: usize| {
        let mean = drawn.iter().map(|map| map[d][r][zone]).sum::<f64>() / maps as f64;
        let spread = drawn.iter().map(|map| (map[d][r][zone] - mean).powi(2)).sum::<f64>();
        (mean, spread.sqrt() / maps as f64)
    };
    (0..4).map(|d| (0..rates.len()).map(|r| [0, 1, 2].map(|zone| summary(d, r, zone))).collect()).collect()
}

#[test]
fn all_detectors_keep_the_rate_at_every_range_edge_and_corner() {
    // Zones of 12 × 32, 20 × 20 and 20 × 12 cells; the scatter of these maps is printed and allowed for twice.
    for (window, channels, maps) in [(Window::Rect, 1, 150), (Window::Hann, 1, 150), (Window::Hann, 12, 40)] {
        let rates = [1e-2, 1e-3, 1e-4];
        for ((name, _), by_rate) in DETECTORS.iter().zip(weighed(&channels_header(window, channels), &rates, maps)) {
            for (rate, zones) in rates.iter().zip(by_rate) {
                println!("{window:?}, {channels} channels, {name}, asked {rate:e}: {zones:.3?}");
                for (got, error) in zones {
                    assert!((got - 1.0).abs() < 0.1 + 2.0 * error, "{window:?}, {channels}, {name}, {rate:e}: {got}");
                }
            }
        }
    }
}

#[test]
fn one_dimensional_training_keeps_the_rate_on_either_axis() {
    for (guard, training) in [([0, 2], [0, 8]), ([2, 0], [8, 0])] {
        for window in [Window::Rect, Window::Hann] {
            let mut header = channels_header(window, 4);
            (header.dsp.guard_cells, header.dsp.training_cells) = (guard, training);
            let rates = [1e-2, 1e-3];
            for ((name, _), by_rate) in DETECTORS.iter().zip(weighed(&header, &rates, 150)) {
                for (rate, zones) in rates.iter().zip(by_rate) {
                    println!("{training:?}, {window:?}, {name}, asked {rate:e}: {zones:.3?}");
                    for (got, error) in zones.into_iter().filter(|(got, _)| *got > 0.0) {
                        assert!((got - 1.0).abs() < 0.1 + 2.0 * error, "{training:?}, {name}, {rate:e}: {got}");
                    }
                }
            }
        }
    }
}

#[test]
fn masks_are_those_of_estimates_made_cell_by_cell() {
    for (name, detector) in DETECTORS {
        for (guard, training) in [([2, 2], [4, 8]), ([0, 2], [0, 6]), ([2, 0], [6, 0]), ([0, 0], [3, 3])] {
            let mut header = channels_header(Window::Hann, 1);
            (header.dsp.guard_cells, header.dsp.training_cells) = (guard, training);
            (header.dsp.detector, header.dsp.false_alarm_rate) = (detector, 1e-2);
            let (cfar, power) = (Cfar::new(&header).unwrap(), noise_power_map(&header, 7));
            for floor in [0.0, 0.5] {
                let mask = cfar.mask(&power, floor);
                let slow = cfar.estimates(&power).into_iter().enumerate();
                let mut found = 0;
                for (cell, estimate) in slow {
                    let passes = power[cell] > cfar.factor(cell % 32) * (estimate + floor);
                    assert_eq!(mask[cell] == DETECTED, passes, "{name}, {training:?}, floor {floor}, cell {cell}");
                    found += usize::from(passes);
                }
                assert!(floor > 0.0 || found > 0, "{name} finds nothing to compare");
            }
        }
    }
}

/// Alarms counted in noise, per detector, rate and zone: alarms, and cells tested.
fn counted(header: &CubeHeader, rates: &[f64], maps: u64) -> Vec<Vec<[(u64, u64); 3]>> {
    let detector = |detector: Detector, rate: f64| {
        let mut header = header.clone();
        (header.dsp.detector, header.dsp.false_alarm_rate) = (detector, rate);
        Cfar::new(&header).unwrap()
    };
    let detectors: Vec<Cfar> =
        DETECTORS.iter().flat_map(|(_, d)| rates.iter().map(|rate| detector(*d, *rate))).collect();
    let of_map = |seed: u64| -> Vec<[(u64, u64); 3]> {
        let power = noise_power_map(header, seed);
        let of_detector = |cfar: &Cfar| {
            let mut found = [(0, 0); 3];
            for (cell, state) in cfar.mask(&power, 0.0).into_iter().enumerate() {
                let zone = zone_of(header, cell);
                found[zone].0 += u64::from(state == DETECTED);
                found[zone].1 += 1;
            }
            found
        };
        detectors.iter().map(of_detector).collect()
    };
    let add = |a: Vec<[(u64, u64); 3]>, b: Vec<[(u64, u64); 3]>| -> Vec<[(u64, u64); 3]> {
        let zone =
            |a: [(u64, u64); 3], b: [(u64, u64); 3]| [0, 1, 2].map(|z: usize| (a[z].0 + b[z].0, a[z].1 + b[z].1));
        a.into_iter().zip(b).map(|(a, b)| zone(a, b)).collect()
    };
    let by_map: Vec<_> = (0..maps).into_par_iter().map(of_map).collect();
    let all = by_map.into_iter().fold(vec![[(0, 0); 3]; detectors.len()], add);
    all.chunks_exact(rates.len()).map(<[_]>::to_vec).collect()
}

#[test]
#[ignore = "minutes of processor time: writes docs/validation/false-alarms.md"]
fn study_of_false_alarms_of_all_detectors() {
    let mut page = String::from(PAGE_HEAD);
    let study = [
        (Window::Rect, 1, 50_000, 12_000),
        (Window::Hann, 1, 50_000, 12_000),
        (Window::Rect, 12, 10_000, 1_000),
        (Window::Hann, 12, 10_000, 1_500),
        (Window::Rect, 192, 0, 100),
        (Window::Hann, 192, 0, 200),
    ];
    for (window, channels, counted_maps, weighed_maps) in study {
        let header = channels_header(window, channels);
        let scale = std::env::var("FALSE_ALARM_MAPS_PERCENT").map_or(100, |percent| percent.parse().unwrap());
        // One channel down to 1e-4: 10⁴ alarms in the 240 cells of the corners.
        let rare = if channels == 1 { 420_000 } else { 0 };
        for (rate, maps) in [(1e-2, counted_maps / 5), (1e-3, counted_maps), (1e-4, rare)] {
            for ((name, _), by_rate) in DETECTORS.iter().zip(counted(&header, &[rate], maps * scale / 100)) {
                let shown = by_rate[0]
                    .map(|(alarms, cells)| format!("{:.3} ({alarms})", alarms as f64 / (cells as f64 * rate)));
                if maps > 0 {
                    add_row(&mut page, window, channels, name, rate, "counted", &shown);
                }
            }
        }
        let rates = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];
        let weighed = weighed(&header, &rates, weighed_maps * scale / 100);
        for ((name, _), by_rate) in DETECTORS.iter().zip(weighed) {
            for (rate, zones) in rates.iter().zip(by_rate) {
                let shown = zones.map(|(got, error)| format!("{got:.3} ± {error:.3}"));
                add_row(&mut page, window, channels, name, *rate, "weighed", &shown);
            }
        }
        std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/validation/false-alarms.md"), &page).unwrap();
    }
}

fn add_row(page: &mut String, window: Window, channels: u32, name: &str, rate: f64, how: &str, shown: &[String; 3]) {
    let [interior, edges, corners] = shown;
    let row = format!("| {name} | {window:?} | {channels} | {rate:e} | {how} | {interior} | {edges} | {corners} |\n");
    print!("{row}");
    page.push_str(&row);
}

const PAGE_HEAD: &str = "# False alarms: got over asked

Complex white noise in maps of 32 × 32 cells, guard [2, 2], training [4, 8], complex samples. Range edges are the ten
cells at either end of the range axis, corners those of them whose training cells wrap over the Doppler axis.

- counted: alarms over cells and rate (number of alarms).
- weighed: mean over cells of P(cell under test > threshold), given the training cells as drawn, which is exact because
  no window here correlates cells more than two apart; ± is the standard error over maps.

`cargo test --release -p dsp --test false_alarms -- --ignored --nocapture` writes this page; `FALSE_ALARM_MAPS_PERCENT`
scales the number of maps.

| detector | window | channels | asked | how | interior | range edges | corners |
|---|---|---|---|---|---|---|---|
";
