//! S2: noise alone passes the detector at the rate asked for, in every zone of the map.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::alarm_rates::{self, DETECTORS, Zones, assert_weighed, counted, noise_power_map, weighed};
use crate::common::*;
use artifact::cube::CubeHeader;
use artifact::radar::{Multiplexing, Sampling};
use artifact::settings::{Detector, Window};
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

/// Both studies fill their own part of the page.
const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/validation/false-alarms.md");
const REAL_HEADING: &str = "\n## Real samples\n";

#[test]
#[ignore = "minutes of processor time: writes the first part of docs/validation/false-alarms.md"]
fn study_of_false_alarms_of_all_detectors() {
    let page = std::fs::read_to_string(PAGE).unwrap();
    let rest = page.split_once("\n## ").map(|(_, rest)| format!("\n## {rest}")).unwrap();
    // One channel down to 1e-4: 10⁴ alarms in the 240 cells of the corners.
    let study = [
        (Window::Rect, 1, [10_000, 50_000, 420_000], 12_000),
        (Window::Hann, 1, [10_000, 50_000, 420_000], 12_000),
        (Window::Rect, 12, [2_000, 10_000, 0], 1_000),
        (Window::Hann, 12, [2_000, 10_000, 0], 1_500),
        (Window::Rect, 192, [0; 3], 100),
        (Window::Hann, 192, [0; 3], 200),
    ];
    let table = table_of(Sampling::Complex, &study);
    std::fs::write(PAGE, format!("{PAGE_HEAD}{table}{rest}")).unwrap();
}

#[test]
#[ignore = "minutes of processor time: writes the second part of docs/validation/false-alarms.md"]
fn study_of_false_alarms_of_real_samples() {
    // 10⁴ alarms in the 96 cells next to range 0 and to half the sample rate down to 1e-3, at 1e-4 in the 300
    // of either edge.
    let study = [
        (Window::Rect, 1, [11_000, 105_000, 420_000], 8_000),
        (Window::Hann, 1, [11_000, 105_000, 420_000], 8_000),
        (Window::Rect, 12, [2_000, 10_000, 0], 1_500),
        (Window::Hann, 12, [2_000, 10_000, 0], 2_000),
        (Window::Hann, 192, [0; 3], 200),
    ];
    let table = table_of(Sampling::Real, &study);
    let page = std::fs::read_to_string(PAGE).unwrap();
    let (before, after) = page.split_once(REAL_HEADING).unwrap_or_else(|| page.split_once("\n## ").unwrap());
    let rest = after.split_once("\n## ").map_or(after, |(_, rest)| rest);
    std::fs::write(PAGE, format!("{before}{REAL_HEADING}{REAL_HEAD}{table}\n## {rest}")).unwrap();
}

/// Windows, channels, maps to count in at 1e-2, 1e-3 and 1e-4, and maps to weigh.
fn table_of(sampling: Sampling, study: &[(Window, u32, [u64; 3], u64)]) -> String {
    let percent: u64 =
        std::env::var("FALSE_ALARM_MAPS_PERCENT").map_or(100, |percent| percent.parse().unwrap());
    let mut page = String::new();
    for (window, channels, counted_maps, weighed_maps) in study {
        let header = alarm_rates::noise_header(sampling, *window, *channels);
        if page.is_empty() {
            let names = Zones::of(&header).names;
            page = format!(
                "| detector | window | channels | asked | how | {} |\n|---|---|---|---|---|",
                names.join(" | ")
            );
            page.push_str(&format!("{}\n", "---|".repeat(names.len())));
        }
        let mut add = |name: &str, rate: f64, how: &str, shown: Vec<String>| {
            let row =
                format!("| {name} | {window:?} | {channels} | {rate:e} | {how} | {} |\n", shown.join(" | "));
            print!("{row}");
            page.push_str(&row);
        };
        for (rate, maps) in [1e-2, 1e-3, 1e-4].into_iter().zip(counted_maps).filter(|(_, maps)| **maps > 0) {
            let found = counted(&header, rate, maps * percent / 100);
            for ((name, _), of_zones) in DETECTORS.iter().zip(found) {
                let show = |(alarms, cells): (u64, u64)| {
                    format!("{:.3} ({alarms})", alarms as f64 / (cells as f64 * rate))
                };
                add(name, rate, "counted", of_zones.into_iter().map(show).collect());
            }
        }
        let rates = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];
        for (name, detector) in DETECTORS {
            // The smaller mean of a thin half now and then is very small, and few maps then make most of the
            // rate.
            let more = if detector == Detector::SoCfar && *channels == 1 { 8 } else { 1 };
            let of_rates = weighed(&header, detector, &rates, more * weighed_maps * percent / 100);
            for (rate, of_zones) in rates.iter().zip(of_rates) {
                let show = |(got, error): (f64, f64)| format!("{got:.3} ± {error:.3}");
                add(name, *rate, "weighed", of_zones.into_iter().map(show).collect());
            }
        }
    }
    page
}

const PAGE_HEAD: &str = "# False alarms: got over asked

Complex white noise in maps of 32 × 32 cells, guard [2, 2], training [4, 8], complex samples. Range edges are the ten
cells at either end of the range axis, corners those of them whose training cells wrap over the Doppler axis.

- counted: alarms over cells and rate (number of alarms).
- weighed: mean over cells of P(cell under test > threshold), given the training cells as drawn, which is exact because
  no window here correlates cells more than two apart; ± is the standard error over maps.

`cargo test --release -p dsp --test detection -- --ignored --nocapture` writes both tables of this page; `FALSE_ALARM_MAPS_PERCENT`
scales the number of maps.

";

const REAL_HEAD: &str = "
Noise of real samples, 64 to a chirp: 32 range cells, the rest of the setting as above, by the same command. Of real samples the cell
at (−m, −k) is the conjugate of that at (m, k): near range 0 and near the end, half the sample rate, the training cells of rows about zero and about
the fastest velocity have their own images among them and are fewer independent ones. Cells that their own image makes non-circular (range 0; with
Hann also the next one and the last) are not tested, but they are training cells of others. Near and far edge are the tested cells of
the first and of the last ten, corners those of them whose training cells wrap over the Doppler axis; next to 0 and next to end are the
first and the last three tested cells of every row, and of the first three those within two rows of zero or the fastest velocity have a column of their own.

";
