//! Two-dimensional cell-averaging CFAR with the false-alarm rate asked for in every cell.
//!
//! Doppler wraps, range does not: near the first and last range cell the training region is cut, and each cell uses its
//! own number of training cells (with the middle's number the rate is 28 times too high at range cell 0). Windows
//! correlate neighbouring cells in two ways, both put right per range cell:
//!
//! - Training cells are fewer independent ones. A mean of N cells with power correlations κ_ij = |ρ_ij|² has the variance
//!   of N_eff = N²/Σκ_ij independent ones (Hann on both axes: 248 → 72), and α is that of N_eff.
//! - The cell under test leaks into its own estimate where the guard is narrower than the window's main lobe. Given its
//!   power y, the training mean is c·y + (1 − c)·(noise), c = Σκ_0i/N, so y > α·mean holds where
//!   y > α(1−c)/(1−αc)·(noise): solved for α, it is α′/(1 − c + α′c) with α′ of the independent case.

use crate::axes::checked_shape;
use crate::cfar_threshold::threshold_factor;
use crate::doppler_division::band_cycles;
use crate::window::{noise_correlation, taper};
use crate::{Axis, DspError};
use artifact::cube::CubeHeader;
use artifact::radar::Multiplexing;
use artifact::settings::Detector;
use rayon::prelude::*;

/// Mask of a cell that no threshold was made for.
pub const UNTESTED: u8 = 0;
/// Mask of a tested cell below its threshold.
pub const TESTED: u8 = 1;
/// Mask of a cell above its threshold.
pub const DETECTED: u8 = 2;

/// A detector for all frames of one radar.
pub struct CaCfar {
    chirps: usize,
    samples: usize,
    guard: [usize; 2],
    outer: [usize; 2],
    /// Of each range cell: threshold over the *sum* of its training cells, and their number.
    factors: Vec<(f64, f64)>,
}

impl CaCfar {
    /// Thresholds that a cube's header asks for.
    pub fn new(header: &CubeHeader) -> Result<Self, DspError> {
        let [channels, chirps, samples] = checked_shape(header)?;
        let Detector::CaCfar = header.dsp.detector;
        let rate = header.dsp.false_alarm_rate;
        if !(rate > 0.0 && rate < 1.0) {
            return Err(DspError::FalseAlarmRate(rate));
        }
        let (guard, outer) = regions(header, [chirps, samples])?;
        let correlation = Correlation::new(header, outer)?;
        let zone = |column: usize| {
            let region = |half: usize| [half.min(column), half.min(samples - 1 - column)];
            let (cells, leak, effective) = correlation.training(guard, outer, region(guard[1]), region(outer[1]));
            let independent = threshold_factor(effective, channels, rate);
            (independent / (1.0 - leak + independent * leak) / cells, cells)
        };
        let interior = (samples > 2 * outer[1]).then(|| zone(outer[1]));
        let factors = (0..samples)
            .map(|column| match interior {
                Some(factor) if column >= outer[1] && column + outer[1] < samples => factor,
                _ => zone(column),
            })
            .collect();
        Ok(Self { chirps, samples, guard, outer, factors })
    }

    /// Mask `[doppler, range]` of a power map; `floor` is added to the noise estimate (0 where there is noise).
    pub fn mask(&self, power: &[f64], floor: f64) -> Vec<u8> {
        let table = SummedArea::new(power, self.samples);
        let row = |row: usize| -> Vec<u8> {
            let state = |column: usize| {
                let (factor, cells) = self.factors[column];
                let training =
                    (self.sum(&table, row, column, self.outer) - self.sum(&table, row, column, self.guard)).max(0.0);
                let threshold = factor * (training + floor * cells);
                if power[row * self.samples + column] > threshold { DETECTED } else { TESTED }
            };
            (0..self.samples).map(state).collect()
        };
        (0..self.chirps).into_par_iter().flat_map_iter(row).collect()
    }

    /// Power in the region of these half sizes around a cell.
    fn sum(&self, table: &SummedArea, row: usize, column: usize, half: [usize; 2]) -> f64 {
        let columns = column.saturating_sub(half[1])..(column + half[1] + 1).min(self.samples);
        let (first, length) = (row + self.chirps - half[0], 2 * half[0] + 1);
        let first = first % self.chirps;
        let end = first + length;
        if end <= self.chirps {
            table.sum(first..end, columns)
        } else {
            table.sum(first..self.chirps, columns.clone()) + table.sum(0..end - self.chirps, columns)
        }
    }
}

/// Half sizes [doppler, range] of the guard region and of the whole, if they fit the map.
fn regions(header: &CubeHeader, cells: [usize; 2]) -> Result<([usize; 2], [usize; 2]), DspError> {
    if header.dsp.training_cells == [0, 0] {
        return Err(DspError::NoTrainingCells);
    }
    let mut outer = [0; 2];
    for (i, axis) in [Axis::Doppler, Axis::Range].into_iter().enumerate() {
        let half = u64::from(header.dsp.guard_cells[i]) + u64::from(header.dsp.training_cells[i]);
        let needed = 2 * half + 1;
        if needed > cells[i] as u64 {
            return Err(DspError::CfarWindow { axis, needed, cells: cells[i] });
        }
        outer[i] = half as usize;
    }
    Ok((header.dsp.guard_cells.map(|g| g as usize), outer))
}

/// Power correlation κ of noise cells over their distance, [doppler, range]; cells correlate as the product.
struct Correlation {
    axes: [Vec<f64>; 2],
}

impl Correlation {
    fn new(header: &CubeHeader, outer: [usize; 2]) -> Result<Self, DspError> {
        let waveform = &header.radar.waveform;
        let doppler = taper(header.dsp.doppler_window, waveform.chirps as usize)?;
        let range = taper(header.dsp.range_window, waveform.samples as usize)?;
        Ok(Self {
            axes: [
                (0..=2 * outer[0]).map(|lag| doppler_correlation(header, &doppler, lag as f64)).collect(),
                (0..=2 * outer[1]).map(|lag| noise_correlation(&range, lag as f64)).collect(),
            ],
        })
    }

    /// Number of training cells, the share c of the cell under test in their mean, and N_eff.
    ///
    /// The region is a rectangle without a rectangle, so its sums of κ are products of sums along the axes.
    fn training(
        &self,
        guard: [usize; 2],
        outer: [usize; 2],
        guard_range: [usize; 2],
        outer_range: [usize; 2],
    ) -> (f64, f64, f64) {
        let (whole, hole) = ([[outer[0]; 2], outer_range], [[guard[0]; 2], guard_range]);
        let pairs = |a: [[usize; 2]; 2], b: [[usize; 2]; 2]| -> f64 {
            (0..2).map(|axis| pair_sum(&self.axes[axis], a[axis], b[axis])).product()
        };
        let size = |a: [[usize; 2]; 2]| -> f64 { a.iter().map(|[l, r]| (l + r + 1) as f64).product() };
        let cells = size(whole) - size(hole);
        let centre = [[0; 2]; 2];
        let leak = (pairs(whole, centre) - pairs(hole, centre)) / cells;
        let among = pairs(whole, whole) - 2.0 * pairs(whole, hole) + pairs(hole, hole);
        (cells, leak.max(0.0), (cells * cells / among).min(cells))
    }
}

/// With Doppler division a summed cell holds bands of one receiver, i/M apart: cells correlate where bands meet.
fn doppler_correlation(header: &CubeHeader, taper: &[f64], lag: f64) -> f64 {
    if header.radar.array.multiplexing != Multiplexing::Ddm {
        return noise_correlation(taper, lag);
    }
    let transmitters = header.radar.array.tx_m.len() as i64;
    let band_rows = band_cycles(header, 1) * taper.len() as f64;
    let weighted = |shift: i64| {
        let pairs = (transmitters - shift.abs()) as f64 / transmitters as f64;
        pairs * noise_correlation(taper, lag + shift as f64 * band_rows)
    };
    (1 - transmitters..transmitters).map(weighted).sum()
}

/// Σκ(i − j) over i in −a..=a', j in −b..=b'.
fn pair_sum(correlation: &[f64], a: [usize; 2], b: [usize; 2]) -> f64 {
    let interval = |[left, right]: [usize; 2]| -(left as i64)..=right as i64;
    interval(a).map(|i| interval(b).map(|j| correlation[i.abs_diff(j) as usize]).sum::<f64>()).sum()
}

/// Sums over rectangles in four look-ups (Crow, SIGGRAPH 1984).
struct SummedArea {
    width: usize,
    sums: Vec<f64>,
}

impl SummedArea {
    fn new(power: &[f64], columns: usize) -> Self {
        let width = columns + 1;
        let mut sums = vec![0.0; width];
        for (row, values) in power.chunks_exact(columns).enumerate() {
            sums.push(0.0);
            let mut along = 0.0;
            for (column, value) in values.iter().enumerate() {
                along += value;
                let above = sums[row * width + column + 1];
                sums.push(above + along);
            }
        }
        Self { width, sums }
    }

    fn sum(&self, rows: std::ops::Range<usize>, columns: std::ops::Range<usize>) -> f64 {
        let at = |row: usize, column: usize| self.sums[row * self.width + column];
        at(rows.end, columns.end) - at(rows.start, columns.end) - at(rows.end, columns.start)
            + at(rows.start, columns.start)
    }
}
