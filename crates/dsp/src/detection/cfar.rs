//! Two-dimensional CFAR with the requested false-alarm rate in every cell: CA, GO, SO and OS.
//!
//! Doppler wraps, range does not: near the first and last range cell the training region is cut, and each
//! cell uses its own number of training cells (with the number in the middle the rate is 28 times too high at
//! range cell 0). The noise estimates are:
//!
//! - `ca-cfar`: the mean of all training cells;
//! - `go-cfar`, `so-cfar`: the greater or smaller mean of two halves, the rectangles before and behind the
//!   guard in range over all Doppler cells of the region (above and below it if training cells lie along
//!   Doppler alone). If the map's edge leaves one half, it is that half's mean;
//! - `os-cfar`: the cell of rank ¾N (Rohling, IEEE T-AES 19 (1983) 608).
//!
//! For real samples the cells around range 0 and the last ones are not tested, because noise is not circular
//! there. On the rows around zero and the highest velocity, training cells there have fewer independent ones,
//! since their own images lie among them (`correlated_cells.rs`).
//!
//! Windows correlate neighbouring cells, with two effects, both corrected per cell:
//!
//! - Training cells are equivalent to fewer independent ones (`correlated_cells.rs`, `noise_estimate.rs`).
//! - The cell under test leaks into its own estimate where the guard is narrower than the window's main lobe.
//!   Given its power y, the training mean is c·y + (1 − c)·(noise), c = Σκ_0i/N, so y > α·mean holds where y
//!   > α(1−c)/(1−αc)·(noise): solved for α, it is α′/(1 − c + α′c) with α′ of the independent case.

use crate::detection::cell_means::LookUp;
use crate::detection::cell_power::CellPower;
use crate::detection::cfar_threshold::threshold_factor;
use crate::detection::correlated_cells::{Correlation, Rectangle, Region};
use crate::detection::images::Images;
use crate::detection::noise_estimate::{ca_factor, correlated_os_factor, go_factor, os_factor, so_factor};
use crate::error::{Axis, DspError};
use crate::numerics::summed_area_table::BoxSums;
use crate::spectrum::shapes::Shapes;
use crate::spectrum::window::{noise_correlation, taper};
use artifact::cube::CubeHeader;
use artifact::radar::Sampling;
use artifact::settings::{Detector, DspSettings, FALSE_ALARM_RATES};
use rayon::prelude::*;

/// Mask value of a cell without a threshold.
pub const UNTESTED: u8 = 0;
/// Mask value of a tested cell below its threshold.
pub(crate) const TESTED: u8 = 1;
/// Mask value of a cell above its threshold.
pub const DETECTED: u8 = 2;

/// Rows per work item of a thread, each starting with freshly computed sums.
const ROWS: usize = 32;

/// A detector for all frames of one radar.
pub struct Cfar {
    chirps: usize,
    samples: usize,
    detector: Detector,
    zones: Zones,
    /// Whether each range cell is tested: its noise is circular, and it is not nearer than requested.
    tested: Vec<bool>,
}

/// Zones of all cells.
#[derive(Debug)]
struct Zones {
    /// Zones by kind of row, then by range cell.
    of_kind: Vec<Vec<Zone>>,
    /// Kind of each row.
    kinds: Vec<usize>,
    /// Row ranges of all rectangles used for noise estimates.
    heights: Vec<[i64; 2]>,
}

impl Zones {
    #[inline]
    fn at(&self, row: usize, column: usize) -> &Zone {
        &self.of_kind[self.kinds[row]][column]
    }
}

/// Training cells of a cell, and its threshold relative to their noise.
#[derive(Debug, Clone)]
struct Zone {
    /// One region, or two halves.
    regions: Vec<Region>,
    /// Look-ups of the first and the last of the regions.
    look_ups: [LookUp; 2],
    /// Factor on the mean, the chosen mean, or the cell of this rank.
    factor: f64,
    /// Rank of the compared cell, counted from 1.
    rank: usize,
}

impl Cfar {
    /// Thresholds for the settings of a cube's header.
    pub fn new(header: &CubeHeader) -> Result<Self, DspError> {
        let [_, chirps, samples] = Shapes::of(header)?.map;
        let rate = header.dsp.false_alarm_rate;
        if !FALSE_ALARM_RATES.contains(&rate) {
            return Err(DspError::FalseAlarmRate(rate));
        }
        let nearest = header.dsp.nearest_m / header.radar.waveform.range_resolution_m();
        let mut tested = circular_columns(header, samples)?;
        tested.iter_mut().enumerate().for_each(|(column, tested)| *tested &= column as f64 >= nearest);
        Ok(Self { chirps, samples, detector: header.dsp.detector, zones: zones(header)?, tested })
    }

    /// Mask `[doppler, range]` of a power map; `floor` is added to the noise estimate (0 if there is noise).
    pub fn mask(&self, power: &[f64], floor: f64) -> Vec<u8> {
        match self.detector {
            Detector::OsCfar => {
                let usual = typical(power);
                let above: Vec<f64> = power.par_iter().map(|x| f64::from(u8::from(*x >= usual))).collect();
                self.by_rows(&above, |sums, zone, [row, column]| {
                    // y > α(x_k + floor) holds if at least k cells lie below y/α − floor.
                    let level = power[row * self.samples + column] / zone.factor - floor;
                    !(level <= usual && zone.lie_above(sums))
                        && self.passes_ordered(power, level, row, column)
                })
            }
            Detector::CaCfar => self.by_means(power, floor, |sums, [ring, _]| ring.mean(sums)),
            Detector::GoCfar => self.by_means(power, floor, |sums, [a, b]| a.mean(sums).max(b.mean(sums))),
            Detector::SoCfar => self.by_means(power, floor, |sums, [a, b]| a.mean(sums).min(b.mean(sums))),
        }
    }

    /// Noise estimate of every cell of a power map, computed cell by cell: a slow form of what [`Self::mask`]
    /// uses implicitly.
    pub fn estimates(&self, power: &[f64]) -> Vec<f64> {
        let estimate = |cell: usize| {
            let (row, column) = (cell / self.samples, cell % self.samples);
            let zone = self.zones.at(row, column);
            let of = |region: &Region| {
                let mut cells = self.training_cells(power, row, column, region);
                match self.detector {
                    Detector::OsCfar => *cells.select_nth_unstable_by(zone.rank - 1, f64::total_cmp).1,
                    _ => cells.iter().sum::<f64>() / cells.len() as f64,
                }
            };
            self.chosen(zone.regions.iter().map(of))
        };
        (0..power.len()).into_par_iter().map(estimate).collect()
    }

    /// Factor of a cell [doppler, range]: threshold over noise estimate.
    pub fn factor(&self, [row, column]: [usize; 2]) -> f64 {
        self.zones.at(row, column).factor
    }

    /// Estimate from one region, or the greater or smaller of two.
    fn chosen(&self, estimates: impl Iterator<Item = f64>) -> f64 {
        match self.detector {
            Detector::SoCfar => estimates.fold(f64::INFINITY, f64::min),
            _ => estimates.fold(0.0, f64::max),
        }
    }

    fn training_cells(&self, power: &[f64], row: usize, column: usize, region: &Region) -> Vec<f64> {
        let inside = |at: [i64; 2], [rows, columns]: &Rectangle| {
            (rows[0]..=rows[1]).contains(&at[0]) && (columns[0]..=columns[1]).contains(&at[1])
        };
        let [rows, columns] = region.whole;
        let offsets =
            (rows[0]..=rows[1]).flat_map(|row| (columns[0]..=columns[1]).map(move |column| [row, column]));
        let training = offsets.filter(|at| !region.hole.as_ref().is_some_and(|hole| inside(*at, hole)));
        training
            .map(|at| {
                let row = (row as i64 + at[0]).rem_euclid(self.chirps as i64) as usize;
                power[row * self.samples + (column as i64 + at[1]) as usize]
            })
            .collect()
    }

    /// Marks every cell above its factor times the mean of its training cells.
    fn by_means(
        &self,
        power: &[f64],
        floor: f64,
        mean: impl Fn(&BoxSums<'_>, &[LookUp; 2]) -> f64 + Sync,
    ) -> Vec<u8> {
        self.by_rows(power, |sums, zone, [row, column]| {
            power[row * self.samples + column] > zone.factor * (mean(sums, &zone.look_ups) + floor)
        })
    }

    /// Marks every cell from sums over rectangles of a map.
    fn by_rows(
        &self,
        map: &[f64],
        passes: impl Fn(&BoxSums<'_>, &Zone, [usize; 2]) -> bool + Sync,
    ) -> Vec<u8> {
        let mut mask = vec![UNTESTED; map.len()];
        mask.par_chunks_mut(ROWS * self.samples).enumerate().for_each(|(run, mask)| {
            let first = run * ROWS;
            let mut sums = BoxSums::at_row(map, self.samples, &self.zones.heights, first);
            for (row, mask) in (first..).zip(mask.chunks_mut(self.samples)) {
                let zones = &self.zones.of_kind[self.zones.kinds[row]];
                for (column, ((state, zone), tested)) in
                    mask.iter_mut().zip(zones).zip(&self.tested).enumerate()
                {
                    if *tested {
                        *state = if passes(&sums, zone, [row, column]) { DETECTED } else { TESTED };
                    }
                }
                sums.slide_from(row);
            }
        });
        mask
    }

    /// Ordered-statistic test by counting: no sorting, and the count ends once N − k + 1 cells lie above the
    /// level.
    fn passes_ordered(&self, power: &[f64], level: f64, row: usize, column: usize) -> bool {
        let zone = self.zones.at(row, column);
        let region = &zone.regions[0];
        let [doppler, range] = region.whole;
        let mut may_lie_above = region.cells() - zone.rank;
        let mut at = (row as i64 + doppler[0]).rem_euclid(self.chirps as i64) as usize;
        for offset in doppler[0]..=doppler[1] {
            let cells = &power[at * self.samples..(at + 1) * self.samples];
            let above = |span: [i64; 2]| {
                let place = |offset: i64| (column as i64 + offset) as usize;
                let span = cells.get(place(span[0])..place(span[1] + 1)).unwrap_or_default();
                span.iter().map(|x| usize::from(*x >= level)).sum::<usize>()
            };
            let count = match &region.hole {
                Some([rows, columns]) if (rows[0]..=rows[1]).contains(&offset) => {
                    above([range[0], columns[0] - 1]) + above([columns[1] + 1, range[1]])
                }
                _ => above(range),
            };
            if count > may_lie_above {
                return false;
            }
            may_lie_above -= count;
            at = if at + 1 == self.chirps { 0 } else { at + 1 };
        }
        true
    }
}

impl Zone {
    /// Whether at least N − k + 1 training cells are counted, in sums of ones and zeros: then no level up to
    /// theirs passes, which in noise settles almost every cell.
    #[inline]
    fn lie_above(&self, counts: &BoxSums<'_>) -> bool {
        let ring = &self.look_ups[0];
        ring.sum(counts) > ring.cells() - self.rank as f64 + 0.5
    }
}

/// Tested columns: all for complex samples. For real samples x the spectrum at 0 and at half the sample rate
/// is real, and its noise has longer tails than the thresholds assume; windows carry that to adjacent cells.
/// There |E[X²]| is |Σw²e^{−j4πnk/N}| over Σw², negligible below a hundredth.
fn circular_columns(header: &CubeHeader, columns: usize) -> Result<Vec<bool>, DspError> {
    let waveform = &header.radar.waveform;
    if waveform.sampling == Sampling::Complex {
        return Ok(vec![true; columns]);
    }
    let range = taper(header.dsp.range_window, waveform.samples as usize)?;
    Ok((0..columns).map(|column| noise_correlation(&range, 2.0 * column as f64) < 1e-4).collect())
}

/// Approximate median of a map from every 13th cell; no mask depends on its value.
fn typical(power: &[f64]) -> f64 {
    let mut some: Vec<f64> = power.iter().copied().step_by(13).collect();
    let middle = some.len() / 2;
    if some.is_empty() { 0.0 } else { *some.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

/// Zones of all cells: cells equally far from both ends of the range axis, and from their images, share their
/// thresholds.
fn zones(header: &CubeHeader) -> Result<Zones, DspError> {
    let (settings, [channels, chirps, samples]) = (&header.dsp, Shapes::of(header)?.map);
    let (guard, outer) = regions(settings, [chirps, samples])?;
    let correlation = Correlation::new(header, outer)?;
    let images = Images::new(header, outer);
    let place = |row_image: Option<i64>, column: usize| {
        let reach = [column.min(outer[1]), (samples - 1 - column).min(outer[1])];
        let regions = |image| training_regions(settings, [guard, outer], reach, image);
        let image = row_image.and_then(|row| Some([row, images.of_column(column)?]));
        (reach, image.filter(|_| regions(image).iter().any(|region| correlation.meets_image(region))))
    };
    let places: Vec<Vec<_>> =
        images.kinds.iter().map(|row| (0..samples).map(|column| place(*row, column)).collect()).collect();
    let mut different = places.concat();
    different.sort_unstable();
    different.dedup();
    let cell = correlation.cell_power(channels);
    let zones: Vec<(Vec<Region>, f64, usize)> = different
        .par_iter()
        .map(|(reach, image)| {
            let mut regions = training_regions(settings, [guard, outer], *reach, *image);
            regions.iter_mut().for_each(|r| r.image = r.image.filter(|_| correlation.meets_image(r)));
            let (factor, rank) = threshold(settings, &correlation, &regions, &cell);
            (regions, factor, rank)
        })
        .collect();
    let heights = heights(zones.iter().flat_map(|(regions, ..)| regions));
    let zone = |(column, place): (usize, &_)| {
        let (regions, factor, rank) = zones[different.binary_search(place).unwrap_or_default()].clone();
        let look_up = |region: usize| LookUp::of(&regions[region], column, &heights);
        Zone { look_ups: [look_up(0), look_up(regions.len() - 1)], regions, factor, rank }
    };
    let of_kind = places.iter().map(|places| places.iter().enumerate().map(zone).collect()).collect();
    Ok(Zones { of_kind, kinds: images.of_rows, heights })
}

/// Row ranges of all rectangles used for noise estimates.
fn heights<'a>(regions: impl Iterator<Item = &'a Region>) -> Vec<[i64; 2]> {
    let rows = regions.flat_map(|region| [Some(region.whole[0]), region.hole.map(|hole| hole[0])]);
    let mut heights: Vec<[i64; 2]> = rows.flatten().collect();
    heights.sort_unstable();
    heights.dedup();
    heights
}

/// Training regions, the ring of CA and OS or the non-empty halves of GO and SO, for this many range cells on
/// both sides and this offset of the image of the cell under test.
fn training_regions(
    settings: &DspSettings,
    [guard, outer]: [[usize; 2]; 2],
    reach: [usize; 2],
    image: Option<[i64; 2]>,
) -> Vec<Region> {
    let sides = |back: usize, ahead: usize| [-(back as i64), ahead as i64];
    let whole = [sides(outer[0], outer[0]), sides(reach[0], reach[1])];
    let near = |half: usize| half.min(guard[1]);
    let hole = [sides(guard[0], guard[0]), sides(near(reach[0]), near(reach[1]))];
    match settings.detector {
        Detector::CaCfar | Detector::OsCfar => vec![Region { whole, hole: Some(hole), image }],
        Detector::GoCfar | Detector::SoCfar => {
            let axis = usize::from(settings.training_cells[1] > 0);
            let (mut before, mut behind) = (whole, whole);
            before[axis][1] = hole[axis][0] - 1;
            behind[axis][0] = hole[axis][1] + 1;
            let halves = [before, behind].map(|whole| Region { whole, hole: None, image });
            halves.into_iter().filter(|half| half.cells() > 0).collect()
        }
    }
}

/// Threshold factor, and rank of the compared cell.
fn threshold(
    settings: &DspSettings,
    correlation: &Correlation,
    regions: &[Region],
    cell: &CellPower,
) -> (f64, usize) {
    let (rate, channels) = (settings.false_alarm_rate, cell.channels());
    let cells: usize = regions.iter().map(Region::cells).sum();
    let rank = ((OS_RANK * cells as f64).round() as usize).clamp(1, cells);
    let mean = |region: &Region| correlation.mean_power(region, channels);
    let half = |region: &Region| correlation.rectangle_power(region, channels);
    let is_white = correlation.is_white() && regions.iter().all(|region| region.image.is_none());
    let independent = match (settings.detector, regions) {
        (Detector::OsCfar, [ring, ..]) if is_white => os_factor(ring.cells(), rank, cell, rate),
        (Detector::OsCfar, [ring, ..]) => correlated_os_factor(correlation, ring, rank, cell, rate),
        (Detector::GoCfar, [a, b]) => go_factor([&half(a), &half(b)], cell, rate),
        (Detector::SoCfar, [a, b]) => so_factor([&half(a), &half(b)], cell, rate),
        _ if is_white => threshold_factor(cells as f64, channels, rate),
        _ => ca_factor(&regions.iter().flat_map(mean).collect::<Vec<_>>(), cell, rate),
    };
    let leak: f64 =
        regions.iter().map(|r| correlation.leak(r) * r.cells() as f64).sum::<f64>() / cells as f64;
    (independent / (1.0 - leak + independent * leak), rank)
}

/// Rank relative to the number of cells: Rohling (1983) finds the least loss in noise, with room for targets,
/// near ¾.
const OS_RANK: f64 = 0.75;

/// Half sizes [doppler, range] of the guard region and of the whole region, if they fit the map.
fn regions(settings: &DspSettings, cells: [usize; 2]) -> Result<([usize; 2], [usize; 2]), DspError> {
    if settings.training_cells == [0, 0] {
        return Err(DspError::NoTrainingCells);
    }
    let mut outer = [0; 2];
    for (i, axis) in [Axis::Doppler, Axis::Range].into_iter().enumerate() {
        let half = u64::from(settings.guard_cells[i]) + u64::from(settings.training_cells[i]);
        let needed = 2 * half + 1;
        if needed > cells[i] as u64 {
            return Err(DspError::CfarWindow { axis, needed, cells: cells[i] });
        }
        outer[i] = half as usize;
    }
    Ok((settings.guard_cells.map(|g| g as usize), outer))
}
