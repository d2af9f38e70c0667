//! Rates at which noise alone passes the detectors, by zone of the map.
#![allow(unreachable_pub, reason = "shared by tests and studies")]
#![allow(dead_code, reason = "each uses its own part")]
#![allow(clippy::unwrap_used, reason = "what cannot be measured ends the test or the study")]

use super::common::*;
use artifact::cube::CubeHeader;
use artifact::radar::{Multiplexing, Sampling};
use artifact::settings::{Detector, Window};
use dsp::RangeDoppler;
use dsp::cfar::{Cfar, DETECTED, UNTESTED};
use dsp::gamma_tail;
use rayon::prelude::*;

pub const DETECTORS: [(&str, Detector); 4] = [
    ("ca-cfar", Detector::CaCfar),
    ("go-cfar", Detector::GoCfar),
    ("so-cfar", Detector::SoCfar),
    ("os-cfar", Detector::OsCfar),
];

/// Maps of 32 × 32 cells, guard [2, 2], training [4, 8].
pub fn noise_header(sampling: Sampling, window: Window, channels: u32) -> CubeHeader {
    let samples = if sampling == Sampling::Real { 64 } else { 32 };
    let receivers = (0..channels).map(|i| [f64::from(i), 0.0]).collect();
    let mut header = header(samples, 32, [vec![[0.0, 0.0]], receivers]);
    header.radar.waveform.sampling = sampling;
    header.noise = NOISE_12_DB;
    header.dsp.false_alarm_rate = 1e-3;
    (header.dsp.guard_cells, header.dsp.training_cells) = ([2, 2], [4, 8]);
    (header.dsp.range_window, header.dsp.doppler_window) = (window, window);
    header
}

/// Noise summed over the channels in units of one channel's mean, `[doppler, range]`.
pub fn noise_power_map(header: &CubeHeader, seed: u64) -> Vec<f64> {
    let transform = RangeDoppler::<f64>::new(header).unwrap();
    let [channels, chirps, samples] = header.shape();
    let energy = |window: Window, length: usize| -> f64 {
        dsp::window::taper(window, length).unwrap().iter().map(|w| w * w).sum()
    };
    let is_real = header.radar.waveform.sampling == Sampling::Real;
    let unit = noise_variance(header)
        * energy(header.dsp.doppler_window, chirps)
        * energy(header.dsp.range_window, samples)
        / if is_real { 2.0 } else { 1.0 };
    let mut noise = cube(header, &[], seed);
    if is_real {
        noise.samples.iter_mut().for_each(|sample| sample.im = 0.0);
    }
    let mut power = vec![0.0; chirps * header.radar.waveform.range_cells()];
    for channel in 0..channels {
        let cells = chirps * samples;
        let map = transform.channel(&noise.samples[channel * cells..][..cells], 0.0);
        power.iter_mut().zip(map).for_each(|(sum, value)| *sum += value.norm_sqr() / unit);
    }
    power
}

/// Parts of a map, which may overlap.
pub struct Zones {
    pub names: Vec<&'static str>,
    /// Zones of each cell; none where it is not tested.
    of_cells: Vec<Vec<usize>>,
    /// Cells of each.
    sizes: Vec<u64>,
}

impl Zones {
    pub fn of(header: &CubeHeader) -> Self {
        let [_, rows, columns] = artifact::rdm::shape(header);
        let half = [0, 1].map(|i: usize| (header.dsp.guard_cells[i] + header.dsp.training_cells[i]) as usize);
        let mask = Cfar::new(header).unwrap().mask(&vec![1.0; rows * columns], 0.0);
        let first = mask.iter().position(|state| *state != UNTESTED).unwrap();
        let last = mask[..columns].iter().rposition(|state| *state != UNTESTED).unwrap();
        let wraps = |row: usize| row < half[0] || row + half[0] >= rows;
        // Rows from zero and from the fastest velocity.
        let from_image = |row: usize| row.min(row.abs_diff(rows / 2)).min(rows - row);
        type In<'a> = Box<dyn Fn(usize, usize) -> bool + 'a>;
        let near = |_: usize, column: usize| column < half[1];
        let far = |_: usize, column: usize| column + half[1] >= columns;
        let edge = move |row: usize, column: usize| near(row, column) || far(row, column);
        let interior: In<'_> = Box::new(move |row, column| !edge(row, column));
        let zones: Vec<(&'static str, In<'_>)> = match header.radar.waveform.sampling {
            Sampling::Complex => vec![
                ("interior", interior),
                ("range edges", Box::new(move |row, column| edge(row, column) && !wraps(row))),
                ("corners", Box::new(move |row, column| edge(row, column) && wraps(row))),
            ],
            Sampling::Real => vec![
                ("interior", interior),
                ("near edge", Box::new(near)),
                ("near corners", Box::new(move |row, column| near(row, column) && wraps(row))),
                ("next to 0", Box::new(move |_, column| column < first + 3)),
                ("0, image rows", Box::new(move |row, column| column < first + 3 && from_image(row) <= 2)),
                ("far edge", Box::new(far)),
                ("far corners", Box::new(move |row, column| far(row, column) && wraps(row))),
                ("next to end", Box::new(move |_, column| column + 3 > last)),
            ],
        };
        let of_cell = |cell: usize| -> Vec<usize> {
            let inside =
                |zone: &usize| mask[cell] != UNTESTED && zones[*zone].1(cell / columns, cell % columns);
            (0..zones.len()).filter(inside).collect()
        };
        let of_cells: Vec<Vec<usize>> = (0..rows * columns).map(of_cell).collect();
        let size = |zone: usize| of_cells.iter().filter(|of| of.contains(&zone)).count() as u64;
        let sizes = (0..zones.len()).map(size).collect();
        Self { names: zones.iter().map(|(name, _)| *name).collect(), of_cells, sizes }
    }
}

fn cfar(header: &CubeHeader, detector: Detector, rate: f64) -> Cfar {
    let mut header = header.clone();
    (header.dsp.detector, header.dsp.false_alarm_rate) = (detector, rate);
    Cfar::new(&header).unwrap()
}

/// Per rate and zone: rate got over rate asked, and its standard error.
///
/// The cell under test is independent of its training cells (no window here reaches over two guard cells), so
/// its chance to pass is known once these are drawn: P(G(M) > threshold). Its mean is what weighted alarms of
/// a scaled cell under test (importance sampling) tend to, with less scatter than any scale leaves.
pub fn weighed(header: &CubeHeader, detector: Detector, rates: &[f64], maps: u64) -> Vec<Vec<(f64, f64)>> {
    let zones = Zones::of(header);
    let by_rate: Vec<Cfar> = rates.iter().map(|rate| cfar(header, detector, *rate)).collect();
    let columns = header.radar.waveform.range_cells();
    let of_map = |seed: u64| -> Vec<Vec<f64>> {
        let estimates = by_rate[0].estimates(&noise_power_map(header, seed));
        let of_rate = |(cfar, rate): (&Cfar, &f64)| {
            let mut sums = vec![0.0; zones.sizes.len()];
            for (cell, estimate) in
                estimates.iter().enumerate().filter(|(cell, _)| !zones.of_cells[*cell].is_empty())
            {
                let factor = cfar.factor([cell / columns, cell % columns]);
                let chance = gamma_tail(header.shape()[0], factor * estimate) / rate;
                zones.of_cells[cell]
                    .iter()
                    .for_each(|zone| sums[*zone] += chance / zones.sizes[*zone] as f64);
            }
            sums
        };
        by_rate.iter().zip(rates).map(of_rate).collect()
    };
    let drawn: Vec<_> = (0..maps).into_par_iter().map(of_map).collect();
    let summary = |r: usize, zone: usize| {
        let mean = drawn.iter().map(|map| map[r][zone]).sum::<f64>() / maps as f64;
        let spread = drawn.iter().map(|map| (map[r][zone] - mean).powi(2)).sum::<f64>();
        (mean, spread.sqrt() / maps as f64)
    };
    (0..rates.len()).map(|r| (0..zones.sizes.len()).map(|zone| summary(r, zone)).collect()).collect()
}

/// Alarms counted in noise, per detector and zone: alarms, and cells tested.
pub fn counted(header: &CubeHeader, rate: f64, maps: u64) -> Vec<Vec<(u64, u64)>> {
    let zones = Zones::of(header);
    let detectors = DETECTORS.map(|(_, detector)| cfar(header, detector, rate));
    let of_map = |seed: u64| -> Vec<Vec<u64>> {
        let power = noise_power_map(header, seed);
        let of_detector = |cfar: &Cfar| {
            let mut found = vec![0; zones.sizes.len()];
            let mask = cfar.mask(&power, 0.0);
            let alarms = mask.iter().enumerate().filter(|(_, state)| **state == DETECTED);
            alarms.for_each(|(cell, _)| zones.of_cells[cell].iter().for_each(|zone| found[*zone] += 1));
            found
        };
        detectors.iter().map(of_detector).collect()
    };
    let mut all = vec![vec![0; zones.sizes.len()]; detectors.len()];
    // In runs, so that a million maps need no memory.
    for first in (0..maps).step_by(10_000) {
        let drawn: Vec<_> = (first..maps.min(first + 10_000)).into_par_iter().map(of_map).collect();
        for (sum, found) in drawn.iter().flat_map(|map| map.iter().enumerate()) {
            all[sum].iter_mut().zip(found).for_each(|(sum, found)| *sum += found);
        }
    }
    let with_cells =
        |found: Vec<u64>| found.into_iter().zip(&zones.sizes).map(|(n, size)| (n, size * maps)).collect();
    all.into_iter().map(with_cells).collect()
}

/// Maps of as many rows as chirps, 64 range cells, four receivers, Hann windows, guard [2, 2], training
/// [4, 8], of transmitters that Doppler division tells apart.
pub fn header_of_bands(transmitters: u32, chirps: u32) -> CubeHeader {
    let tx = (0..transmitters).map(|i| [4.0 * f64::from(i), 0.0]).collect();
    let mut header = header(64, chirps, [tx, (0..4).map(|i| [f64::from(i), 0.0]).collect()]);
    header.noise = NOISE_12_DB;
    header.radar.array.multiplexing = Multiplexing::Ddm;
    (header.dsp.guard_cells, header.dsp.training_cells) = ([2, 2], [4, 8]);
    header
}

/// Noise under Doppler division, summed over the bands of all transmitters and over the receivers.
fn power_of_bands(header: &CubeHeader, seed: u64) -> Vec<f64> {
    let transform = RangeDoppler::<f64>::new(header).unwrap();
    let [receivers, chirps, samples] = header.shape();
    let (noise, cells) = (cube(header, &[], seed).samples, chirps * samples);
    let transmitters = header.radar.array.tx_m.len();
    let mut power = vec![0.0; cells];
    for (receiver, transmitter) in (0..receivers).flat_map(|rx| (0..transmitters).map(move |tx| (rx, tx))) {
        let turns = transmitter as f64 / (transmitters + 1) as f64;
        let map = transform.channel(&noise[receiver * cells..][..cells], turns);
        power.iter_mut().zip(map).for_each(|(sum, value)| *sum += value.norm_sqr());
    }
    power
}

/// Alarms counted in noise under Doppler division before its folds are told, per detector: alarms, and cells
/// tested in about so many rows.
pub fn counted_in_bands(header: &CubeHeader, rate: f64, rows: u64) -> Vec<(u64, u64)> {
    let detectors = DETECTORS.map(|(_, detector)| cfar(header, detector, rate));
    let [_, chirps, samples] = header.shape();
    let maps = rows / chirps as u64;
    let of_map = |seed: u64| {
        let power = power_of_bands(header, seed);
        detectors
            .each_ref()
            .map(|cfar| cfar.mask(&power, 0.0).iter().filter(|state| **state == DETECTED).count() as u64)
    };
    let added = |a: [u64; 4], b: [u64; 4]| std::array::from_fn(|i| a[i] + b[i]);
    let drawn: Vec<[u64; 4]> = (0..maps).into_par_iter().map(of_map).collect();
    let found = drawn.into_iter().fold([0; 4], added);
    found.map(|alarms| (alarms, maps * (chirps * samples) as u64)).to_vec()
}

/// A failure names the setting; tolerance: a tenth, and twice the scatter of these maps.
pub fn assert_weighed(header: &CubeHeader, rates: &[f64], maps: u64) {
    let zones = Zones::of(header);
    for (name, detector) in DETECTORS {
        for (rate, of_zones) in rates.iter().zip(weighed(header, detector, rates, maps)) {
            let dsp = &header.dsp;
            let what = format!("{:?}, {} channels, {name}", dsp.range_window, header.shape()[0]);
            println!("{what}, training {:?}, asked {rate:e}: {of_zones:.3?}", dsp.training_cells);
            for (zone, (got, error)) in zones.names.iter().zip(of_zones).filter(|(_, (got, _))| *got > 0.0) {
                assert!((got - 1.0).abs() < 0.1 + 2.0 * error, "{what}, {zone}: {got} of {rate:e}");
            }
        }
    }
}
