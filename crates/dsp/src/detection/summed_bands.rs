//! Correlation of noise along an axis between cells that sum several bands of one spectrum: with Doppler
//! division a cell holds one of every transmitter, N/M rows apart on the circle of the N rows of a receiver.
//!
//! The sum of the powers of some cells is Σλ_i·E_i over the eigenvalues of the correlation between all their
//! bands. Bands of cells a few rows apart overlap if M is a large part of N, and those of one cell if a band
//! is narrower than the window's main lobe: then the cell under test, too, has fewer variables than channels.

use crate::numerics::symmetric_qr::eigenvalues;
use crate::spectrum::division::Division;
use crate::spectrum::doppler_bands::band_cycles;
use crate::spectrum::window::noise_correlation;
use artifact::radar::Multiplexing;
use std::f64::consts::TAU;

/// Correlation ρ between the bands of cells, without the phase that cancels in closed chains of cells.
pub(crate) struct SummedBands {
    /// Correlation ρ by band difference, from −(bands − 1) on, then by cell distance.
    rho: Vec<Vec<f64>>,
    /// Power correlation |ρ|² by cell distance: the mean over one cell's bands of the sum over those of the
    /// other.
    power: Vec<f64>,
}

/// Correlation below which cells count as independent: a region of 10⁴ cells changes by less than 1e-8.
const NEGLIGIBLE: f64 = 1e-6;

impl SummedBands {
    /// Bands of a radar's Doppler axis under a window, for cells up to `most_rows` apart.
    pub(crate) fn of(division: &Division, taper: &[f64], most_rows: usize) -> Self {
        if division.multiplexing != Multiplexing::Ddm {
            return Self::alone(taper, most_rows);
        }
        let band_rows = band_cycles(division, 1) * taper.len() as f64;
        Self::apart(taper, most_rows, division.transmitters, band_rows)
    }

    /// One band per cell, for cells up to `most_cells` apart.
    pub(crate) fn alone(taper: &[f64], most_cells: usize) -> Self {
        Self::apart(taper, most_cells, 1, 0.0)
    }

    fn apart(taper: &[f64], most_cells: usize, count: usize, band_cells: f64) -> Self {
        let bands = || 1 - count as i64..count as i64;
        let lag = |band: i64, cells: usize| cells as f64 + band as f64 * band_cells;
        let of_band = |band: i64| -> Vec<f64> {
            (0..=most_cells).map(|cells| noise_correlation(taper, lag(band, cells))).collect()
        };
        let power: Vec<Vec<f64>> = bands().map(of_band).collect();
        let rho = |(band, of_cells): (i64, &Vec<f64>)| {
            let signed =
                |(cells, k): (usize, &f64)| k.max(0.0).sqrt() * amplitude_sign(taper, lag(band, cells));
            of_cells.iter().enumerate().map(signed).map(negligible_is_none).collect()
        };
        let share = |band: i64| (count as i64 - band.abs()) as f64 / count as f64;
        let mean =
            |cells: usize| bands().zip(&power).map(|(band, of_cells)| share(band) * of_cells[cells]).sum();
        Self { rho: bands().zip(&power).map(rho).collect(), power: (0..=most_cells).map(mean).collect() }
    }

    /// Number of bands of a cell.
    pub(crate) fn count(&self) -> usize {
        self.rho.len().div_ceil(2)
    }

    /// Whether all bands and cells are uncorrelated.
    pub(crate) fn are_white(&self) -> bool {
        self.count() == 1 && self.within()[1..].iter().all(|rho| *rho == 0.0)
    }

    /// Correlation ρ of cells of one band, by their distance.
    pub(crate) fn within(&self) -> &[f64] {
        &self.rho[self.count() - 1]
    }

    /// Power correlation |ρ|² of cells by their distance: the mean over one cell's bands of the sum over
    /// those of the other.
    pub(crate) fn power(&self) -> &[f64] {
        &self.power
    }

    /// [`Self::power`] of a cell with itself: more than 1 if its own bands overlap.
    pub(crate) fn with_itself(&self) -> f64 {
        if self.count() == 1 { 1.0 } else { self.power[0] }
    }

    /// Correlation matrix of all bands of `cells` adjacent cells.
    pub(crate) fn matrix(&self, cells: usize) -> Vec<Vec<f64>> {
        let count = self.count();
        let places: Vec<[i64; 2]> =
            (0..cells).flat_map(|cell| (0..count).map(move |band| [cell as i64, band as i64])).collect();
        let rho = |a: &[i64; 2], b: &[i64; 2]| self.rho(a[0] - b[0], a[1] - b[1]);
        places.iter().map(|a| places.iter().map(|b| rho(a, b)).collect()).collect()
    }

    /// Eigenvalues of the bands of one cell; their mean is 1.
    pub(crate) fn cell_eigenvalues(&self) -> Vec<f64> {
        eigenvalues(self.matrix(1))
    }

    /// Correlation ρ at a distance in cells and bands; 0 beyond the computed range.
    pub(crate) fn rho(&self, cells: i64, bands: i64) -> f64 {
        let bands = bands * if cells < 0 { -1 } else { 1 };
        let of_cells = &self.rho[(self.count() as i64 - 1 + bands) as usize];
        of_cells.get(cells.unsigned_abs() as usize).copied().unwrap_or(0.0)
    }
}

fn negligible_is_none(rho: f64) -> f64 {
    if rho.abs() < NEGLIGIBLE { 0.0 } else { rho }
}

/// Sign of Σw²cos(2π·lag·(n − N/2)/N).
fn amplitude_sign(taper: &[f64], lag: f64) -> f64 {
    let length = taper.len() as f64;
    let angle = |n: usize| TAU * lag * (n as f64 / length - 0.5);
    taper.iter().enumerate().map(|(n, w)| w * w * angle(n).cos()).sum::<f64>().signum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::window::taper;
    use artifact::settings::Window;

    fn seven_bands(chirps: usize) -> SummedBands {
        let window = taper(Window::Hann, chirps).unwrap();
        SummedBands::apart(&window, 20, 6, chirps as f64 / 7.0)
    }

    #[test]
    fn bands_of_sixteen_chirps_are_sixteen_variables_at_most() {
        // 13 rows of 6 bands each, all of one spectrum of 16 independent chirps.
        let values = eigenvalues(seven_bands(16).matrix(13));
        let positive = values.iter().filter(|value| **value > 1e-4).count();
        assert!(positive <= 16 && values.iter().all(|value| *value > -1e-4), "{values:?}");
        assert!((values.iter().sum::<f64>() / 78.0 - 1.0).abs() < 1e-9);
    }

    #[test]
    fn powers_are_those_of_the_matrix_of_bands() {
        for chirps in [16, 32, 64] {
            let bands = seven_bands(chirps);
            let matrix = bands.matrix(4);
            for cells in 0..4 {
                let block = |i: usize| matrix[i][6 * cells..6 * cells + 6].iter().map(|rho| rho * rho);
                let asked: f64 = (0..6).flat_map(block).sum::<f64>() / 6.0;
                let got = bands.power()[cells];
                assert!((got - asked).abs() < 1e-9, "{chirps} chirps, {cells} cells: {got} for {asked}");
            }
        }
    }
}
