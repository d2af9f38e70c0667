//! Retesting of cells that stronger echoes hide from the detector.
//!
//! A cell-averaging detector takes echoes among its training cells for noise: a car of 10 dB ten cells before
//! a bus of 33 dB stays below its threshold. Cells above the map's own noise are therefore compared again
//! with the mean of those training cells that lie outside the echoes found so far, at the threshold for the
//! remaining number of cells, and again with what that finds, until nothing is added (censored cell
//! averaging: Barboy, Lomes and Perkalski, IEE Proc. F 133 (1986) 176).

use crate::detection::cfar::{DETECTED, TESTED};
use crate::detection::cfar_threshold::threshold_factor;
use artifact::cube::CubeHeader;
use artifact::radar::Multiplexing;
use artifact::settings::Detector;
use ndarray::ArrayView2;
use std::collections::BTreeMap;

/// Minimum share of training cells whose mean estimates the local noise.
const LEAST_SHARE: f64 = 0.25;
/// Maximum number of passes; each finds echoes hidden by those of the pass before.
const MOST_PASSES: usize = 8;

/// Training cells of a radar's detector.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Censoring {
    /// Whether the detector compares with the greater of two halves.
    is_greatest_of: bool,
    /// Whether cells are retested at all.
    has_hidden: bool,
    /// Guard cells, [doppler, range].
    guard: [i64; 2],
    whole: [i64; 2],
    channels: usize,
    false_alarm_rate: f64,
    /// Number of cells whose noise power both windows correlate: that many count as one.
    per_independent: f64,
}

impl Censoring {
    /// Takes the training cells of a header, of which the windows make `per_independent` count as one.
    ///
    /// Detectors other than the averaging ones (`ca-cfar`, `go-cfar`) handle several echoes in their own way
    /// and keep their mask. So does Doppler division: the cells missing from its mask are the other
    /// transmitters' bands of an echo, which nothing hides.
    pub(crate) fn new(header: &CubeHeader, per_independent: f64) -> Self {
        let settings = &header.dsp;
        let averages = matches!(settings.detector, Detector::CaCfar | Detector::GoCfar);
        let guard = settings.guard_cells.map(i64::from);
        let training = settings.training_cells.map(i64::from);
        Self {
            is_greatest_of: settings.detector == Detector::GoCfar,
            has_hidden: averages && header.radar.array.multiplexing != Multiplexing::Ddm,
            guard,
            whole: [guard[0] + training[0], guard[1] + training[1]],
            channels: header.radar.map_channels(),
            false_alarm_rate: settings.false_alarm_rate,
            per_independent,
        }
    }
}

/// Mask with hidden cells detected; `noise_threshold` is the level that noise alone rarely exceeds if its
/// mean is known.
pub(crate) fn recover_masked(
    censoring: &Censoring,
    power: ArrayView2<f64>,
    mask: &[u8],
    noise_threshold: f64,
) -> Vec<u8> {
    let mut mask = mask.to_vec();
    if !censoring.has_hidden {
        return mask;
    }
    let strong =
        power.iter().enumerate().filter(|(cell, power)| mask[*cell] == TESTED && **power > noise_threshold);
    let mut hidden: Vec<usize> = strong.map(|(cell, _)| cell).collect();
    let mut window = TrainingWindow { power, censoring: *censoring, factors: BTreeMap::new() };
    for _ in 0..MOST_PASSES {
        let echoes = window.with_guard_cells(&mask);
        let (found, left): (Vec<usize>, Vec<usize>) =
            hidden.into_iter().partition(|cell| window.passes(*cell, &echoes));
        if found.is_empty() {
            break;
        }
        found.into_iter().for_each(|cell| mask[cell] = DETECTED);
        hidden = left;
    }
    mask
}

/// Training cells around a cell, and thresholds by the number of remaining ones.
struct TrainingWindow<'a> {
    power: ArrayView2<'a, f64>,
    censoring: Censoring,
    factors: BTreeMap<usize, f64>,
}

impl TrainingWindow<'_> {
    /// Detected cells and those within the guard distance of one, which may still contain an echo's main
    /// lobe.
    fn with_guard_cells(&self, mask: &[u8]) -> Vec<bool> {
        let columns = self.power.ncols();
        let mut echoes = vec![false; mask.len()];
        for cell in (0..mask.len()).filter(|cell| mask[*cell] == DETECTED) {
            for [down, along] in offsets(self.censoring.guard) {
                if let Some(at) = self.cell_at(cell / columns, cell % columns, down, along) {
                    echoes[at] = true;
                }
            }
        }
        echoes
    }

    fn passes(&mut self, cell: usize, echoes: &[bool]) -> bool {
        let columns = self.power.ncols();
        let (guard, whole) = (self.censoring.guard, self.censoring.whole);
        let (row, column) = (cell / columns, cell % columns);
        let (mut sum, mut count, mut all) = (0.0, 0, 0);
        for [down, along] in offsets(whole) {
            let is_guard = down.abs() <= guard[0] && along.abs() <= guard[1];
            if let Some(at) = self.cell_at(row, column, down, along).filter(|_| !is_guard) {
                all += 1;
                if !echoes[at] {
                    sum += self.power[(at / columns, at % columns)];
                    count += 1;
                }
            }
        }
        // The mean of the whole window is no threshold of the greatest-of detector: where no echo raises its
        // own, its answer stands.
        let is_retested = !self.censoring.is_greatest_of || count < all as usize;
        is_retested
            && (count as f64) > LEAST_SHARE * f64::from(all)
            && self.power[(row, column)] > self.factor(count) * sum / count as f64
    }

    fn factor(&mut self, cells: usize) -> f64 {
        let Censoring { per_independent, channels, false_alarm_rate: rate, .. } = self.censoring;
        let independent = cells as f64 / per_independent;
        *self.factors.entry(cells).or_insert_with(|| threshold_factor(independent, channels, rate))
    }

    /// Neighbouring cell; Doppler wraps, range does not.
    fn cell_at(&self, row: usize, column: usize, down: i64, along: i64) -> Option<usize> {
        let (rows, columns) = self.power.dim();
        let row = (row as i64 + down).rem_euclid(rows as i64) as usize;
        let column = column as i64 + along;
        (0..columns as i64).contains(&column).then_some(row * columns + column as usize)
    }
}

fn offsets([rows, columns]: [i64; 2]) -> impl Iterator<Item = [i64; 2]> {
    (-rows..=rows).flat_map(move |down| (-columns..=columns).map(move |along| [down, along]))
}
