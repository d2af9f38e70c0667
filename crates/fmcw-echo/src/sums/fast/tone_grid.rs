//! Sum of many tones on all chirps and samples: two-dimensional type-1 non-uniform FFT.
//!
//! Tones are spread over the cells of a grid with twice as many cells as chirps and samples ([`Kernel`]), the
//! grid is transformed, and each chirp and sample is divided by the kernel's transform. Several sets of
//! strengths share the tones: their cells are interleaved, so that one weight serves all of them. Only
//! Doppler rows reached by a tone are stored.

use crate::sums::fast::instants::Tone;
use crate::sums::fast::kernel::{CELLS_MAX, Kernel};
use crate::sums::fast::scalar::Scalar;
use num_complex::Complex;
use pulp::Arch;
use rayon::prelude::*;
use rustfft::{Fft, FftPlanner};
use std::sync::Arc;

/// Positions of tones on a grid, and the dimensions of the grid.
pub(crate) struct ToneGrid<T: Scalar> {
    kernel: Kernel,
    /// Numbers of chirps and of samples.
    modes: [usize; 2],
    cells: [usize; 2],
    /// Tones in the order of the cells that they reach.
    spots: Vec<SpreadTone<T>>,
    /// Rows of cells reached by any tone, ascending.
    rows: Vec<usize>,
    /// Index of a row among those reached by tones; `u32::MAX` for others.
    place_of_row: Vec<u32>,
    /// Reciprocal of the kernel's weight, by axis and mode.
    corrections: [Vec<T>; 2],
    transforms: [Arc<dyn Fft<T>>; 2],
}

/// Position of a tone among the cells.
#[derive(Clone, Copy)]
struct SpreadTone<T> {
    /// Index of the tone.
    tone: u32,
    /// First row and column of cells.
    first: [u32; 2],
    weights: [[T; CELLS_MAX]; 2],
}

/// Number of sets of strengths spread together: as many as fit in two cache lines in single precision.
pub(crate) const SETS: usize = 16;

impl<T: Scalar> ToneGrid<T> {
    /// Grid for an error relative to Σ|strengths|.
    pub(crate) fn new(tones: &[Tone], modes: [usize; 2], error: f64) -> Self {
        let kernel = Kernel::for_error(error);
        let cells = modes.map(|modes| smooth_at_least((2 * modes).max(2 * kernel.cells)));
        let mut order: Vec<([u32; 2], u32)> = tones
            .par_iter()
            .enumerate()
            .map(|(i, tone)| (first_cells(&kernel, cells, tone), i as u32))
            .collect();
        order.par_sort_unstable();
        let spots: Vec<SpreadTone<T>> =
            order.par_iter().map(|&(first, i)| spot(&kernel, cells, tones[i as usize], first, i)).collect();
        let mut place_of_row = vec![u32::MAX; cells[0]];
        for row in spots.iter().flat_map(|spot| rows_of(spot.first[0], kernel.cells, cells[0])) {
            place_of_row[row] = 0;
        }
        let rows: Vec<usize> = (0..cells[0]).filter(|row| place_of_row[*row] == 0).collect();
        rows.iter().enumerate().for_each(|(place, row)| place_of_row[*row] = place as u32);
        let corrections = [0, 1].map(|axis| corrections(&kernel, modes[axis], cells[axis]));
        let mut planner = FftPlanner::new();
        let transforms = cells.map(|cells| planner.plan_fft_inverse(cells));
        Self { kernel, modes, cells, spots, rows, place_of_row, corrections, transforms }
    }

    /// Indices of the tones in the order expected of strengths.
    pub(crate) fn order(&self) -> impl Iterator<Item = usize> {
        self.spots.iter().map(|spot| spot.tone as usize)
    }

    /// Sums Σ over tones of strength·e^{j2π(αn + βm)}, n and m from the frame's middle:
    /// `[set][chirp][sample]` are passed on one set after the other. `strengths` are `[set][tone]`, tones in
    /// [`Self::order`].
    pub(crate) fn transform(
        &self,
        strengths: &[Vec<Complex<T>>],
        give: &mut dyn FnMut(usize, &[Complex<T>]),
    ) {
        let sets = strengths.len();
        let grid = self.spread(strengths);
        let zero = Complex::new(T::zero(), T::zero());
        let [chirps, samples] = self.modes;
        let mut along_samples = vec![zero; self.cells[1]];
        let mut along_chirps = vec![zero; samples * self.cells[0]];
        let mut scratch =
            vec![zero; self.transforms.iter().map(|fft| fft.get_inplace_scratch_len()).max().unwrap_or(0)];
        let mut result = vec![zero; chirps * samples];
        for set in 0..sets {
            along_chirps.fill(zero);
            for (place, &row) in self.rows.iter().enumerate() {
                self.gather_row(&grid, sets, set, place, &mut along_samples);
                self.transforms[1].process_with_scratch(&mut along_samples, &mut scratch);
                for (m, correction) in self.corrections[1].iter().enumerate() {
                    along_chirps[m * self.cells[0] + row] =
                        along_samples[cell_of(m, samples, self.cells[1])] * *correction;
                }
            }
            self.transforms[0].process_with_scratch(&mut along_chirps, &mut scratch);
            for (n, correction) in self.corrections[0].iter().enumerate() {
                let cell = cell_of(n, chirps, self.cells[0]);
                for m in 0..samples {
                    result[n * samples + m] = along_chirps[m * self.cells[0] + cell] * *correction;
                }
            }
            give(set, &result);
        }
    }

    /// Number of columns, including as many extra as the kernel is wide: these wrap to the start of the row.
    fn columns(&self) -> usize {
        self.cells[1] + self.kernel.cells
    }

    fn gather_row(&self, grid: &[Complex<T>], sets: usize, set: usize, place: usize, row: &mut [Complex<T>]) {
        let columns = self.columns();
        let cells = &grid[place * columns * sets..][..columns * sets];
        let of_set = || cells.iter().skip(set).step_by(sets);
        row.iter_mut().zip(of_set()).for_each(|(value, cell)| *value = *cell);
        let beyond = of_set().skip(row.len());
        row.iter_mut().zip(beyond).for_each(|(value, cell)| *value = *value + *cell);
    }

    /// Spreads strengths over the cells, `[row][column][set]`.
    fn spread(&self, strengths: &[Vec<Complex<T>>]) -> Vec<Complex<T>> {
        let mut grid =
            vec![Complex::new(T::zero(), T::zero()); self.rows.len() * self.columns() * strengths.len()];
        // The inner loops are compiled for the processor's instruction set.
        Arch::new().dispatch(|| self.spread_into(strengths, &mut grid));
        grid
    }

    #[inline(always)]
    fn spread_into(&self, strengths: &[Vec<Complex<T>>], grid: &mut [Complex<T>]) {
        let (width, columns, sets) = (self.kernel.cells, self.columns(), strengths.len());
        let mut of_spot = vec![Complex::new(T::zero(), T::zero()); sets];
        for (i, spot) in self.spots.iter().enumerate() {
            of_spot.iter_mut().zip(strengths).for_each(|(strength, of_set)| *strength = of_set[i]);
            for (row, of_row) in rows_of(spot.first[0], width, self.cells[0]).zip(&spot.weights[0]) {
                let first = (self.place_of_row[row] as usize * columns + spot.first[1] as usize) * sets;
                let cells = &mut grid[first..first + width * sets];
                for (cell, of_column) in cells.chunks_exact_mut(sets).zip(&spot.weights[1]) {
                    let weight = *of_row * *of_column;
                    for (sum, strength) in cell.iter_mut().zip(&of_spot) {
                        sum.re = sum.re + weight * strength.re;
                        sum.im = sum.im + weight * strength.im;
                    }
                }
            }
        }
    }
}

/// Position of a tone in cells, from 0 to the number of cells.
fn places(cells: [usize; 2], tone: &Tone) -> [f64; 2] {
    [0, 1].map(|axis| {
        let cycles = [tone.per_chirp, tone.per_sample][axis];
        (cycles - cycles.floor()) * cells[axis] as f64
    })
}

fn first_cells(kernel: &Kernel, cells: [usize; 2], tone: &Tone) -> [u32; 2] {
    let places = places(cells, tone);
    [0, 1].map(|axis| (kernel.first(places[axis]) as i64).rem_euclid(cells[axis] as i64) as u32)
}

fn spot<T: Scalar>(
    kernel: &Kernel,
    cells: [usize; 2],
    tone: Tone,
    first: [u32; 2],
    index: u32,
) -> SpreadTone<T> {
    let mut weights = [[T::zero(); CELLS_MAX]; 2];
    let places = places(cells, &tone);
    (0..2).for_each(|axis| kernel.weigh(places[axis], &mut weights[axis]));
    SpreadTone { tone: index, first, weights }
}

/// Rows of cells from a first one on, wrapping around the grid.
fn rows_of(first: u32, width: usize, cells: usize) -> impl Iterator<Item = usize> {
    (0..width).map(move |i| {
        let row = first as usize + i;
        if row < cells { row } else { row - cells }
    })
}

/// Cell in which the transform stores mode n − N/2.
fn cell_of(n: usize, modes: usize, cells: usize) -> usize {
    let middle = modes / 2;
    if n >= middle { n - middle } else { cells + n - middle }
}

fn corrections<T: Scalar>(kernel: &Kernel, modes: usize, cells: usize) -> Vec<T> {
    let mode = |n: usize| n as f64 - (modes / 2) as f64;
    (0..modes).map(|n| T::of(1.0 / kernel.transform(mode(n), cells))).collect()
}

/// Next number with no prime factors but 2, 3 and 5.
fn smooth_at_least(least: usize) -> usize {
    let is_smooth = |n: &usize| [2, 3, 5].into_iter().fold(*n, without) == 1;
    (least..).find(is_smooth).unwrap_or(least)
}

/// A number without its factors `prime`.
fn without(mut n: usize, prime: usize) -> usize {
    while n.is_multiple_of(prime) {
        n /= prime;
    }
    n
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex64;
    use std::f64::consts::TAU;

    #[test]
    fn many_tones_are_those_of_the_direct_sum_over_ten_decades_of_error() {
        let fraction = |i: usize, step: f64| (i as f64 * step).fract();
        let tones: Vec<Tone> = (1..300)
            .map(|i| Tone {
                per_chirp: 3.0 * fraction(i, 0.618_034) - 1.5,
                per_sample: fraction(i, 0.732_051),
            })
            .collect();
        let strengths: Vec<Complex64> =
            (1..300).map(|i| Complex64::from_polar(fraction(i, 0.414_214), fraction(i, 0.236_068))).collect();
        for modes in [[16, 30], [9, 7], [1, 5]] {
            let exact = |n: usize, m: usize| -> Complex64 {
                let turn = |t: &Tone| {
                    t.per_chirp * (n as f64 - (modes[0] / 2) as f64)
                        + t.per_sample * (m as f64 - (modes[1] / 2) as f64)
                };
                tones.iter().zip(&strengths).map(|(t, s)| s * Complex64::cis(TAU * turn(t))).sum()
            };
            for decade in 2..=12 {
                let asked = 10_f64.powi(-decade);
                let grid = ToneGrid::<f64>::new(&tones, modes, asked);
                let mut worst = 0.0_f64;
                let in_order = grid.order().map(|i| strengths[i]).collect();
                grid.transform(&[in_order], &mut |_, values| {
                    for (i, value) in values.iter().enumerate() {
                        worst = worst.max((value - exact(i / modes[1], i % modes[1])).norm());
                    }
                });
                let total: f64 = strengths.iter().map(|s| s.norm()).sum();
                println!("{modes:?}: asked {asked:.0e}, got {:.1e}", worst / total);
                assert!(worst / total <= asked);
            }
        }
    }
}
