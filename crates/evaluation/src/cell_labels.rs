//! Labels of the cells of a range-Doppler map: the target and bounce order of the strongest echo in each
//! cell.
//!
//! As in the labels of points, echoes of one kind are added coherently within each channel; then the powers
//! of the channels are added, as in the map. A few channels, spread over the array, represent all of them.

use crate::doppler_response::{at, reached};
use crate::labels::{EchoGroup, MapResponse, PathOnMap};
use artifact::cube::CubeHeader;
use artifact::paths::PathsFrame;
use artifact::radar::Radar;
use glam::DVec3;
use num_complex::Complex64;
use radar::window::Sidelobes;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Kinds of echo in the cells of a map, row-major `[doppler, range]`.
#[derive(Debug, Clone, PartialEq)]
pub struct CellOrigins {
    /// Kinds of echo, by the order of targets, then by ascending bounces.
    pub groups: Vec<EchoGroup>,
    /// The strongest kind in each cell, counted from 1; 0 if all kinds together are below the noise.
    pub strongest: Vec<u32>,
    /// Power of the strongest kind relative to the sum of the powers of the kinds in the cell, percent.
    pub percent: Vec<u8>,
}

/// Largest number of channels that represent the array.
const CHANNELS: usize = 4;

/// Labels of all cells with echoes; `noise_power` is that of one cell of one channel of the map.
pub fn cell_origins(
    header: &CubeHeader,
    paths: &PathsFrame,
    noise_power: f64,
) -> Result<CellOrigins, Sidelobes> {
    let response = MapResponse::new(header)?;
    let map = CellMap::of(header, &response);
    let mut kinds: BTreeMap<EchoGroup, Vec<PathOnMap>> = BTreeMap::new();
    for echo in paths.paths.iter().map(|path| PathOnMap::of(&header.radar, path)) {
        kinds.entry(echo.group).or_default().push(echo);
    }
    let mut cells = vec![Strongest::default(); map.cells()];
    for (number, echoes) in (1..).zip(kinds.values()) {
        let power = map.power(echoes);
        cells.iter_mut().zip(power).for_each(|(cell, power)| cell.add(number, power));
    }
    let floor = noise_power / response.gain.powi(2);
    let label = |cell: &Strongest| if cell.sum > floor { cell.label() } else { (0, 0) };
    let (strongest, percent) = cells.iter().map(label).unzip();
    Ok(CellOrigins { groups: kinds.into_keys().collect(), strongest, percent })
}

/// The strongest kind in a cell so far.
#[derive(Debug, Clone, Copy, Default)]
struct Strongest {
    number: u32,
    power: f64,
    /// Sum of the powers of all kinds.
    sum: f64,
}

impl Strongest {
    fn add(&mut self, number: u32, power: f64) {
        self.sum += power;
        if power > self.power {
            (self.number, self.power) = (number, power);
        }
    }

    fn label(&self) -> (u32, u8) {
        (self.number, (100.0 * self.power / self.sum).round() as u8)
    }
}

/// Cells of a map to which echoes are added.
struct CellMap<'a> {
    radar: &'a Radar,
    response: &'a MapResponse,
    rows: usize,
    columns: usize,
    /// Places of the elements of each channel relative to the array's centre, m.
    channels: Vec<[DVec3; 2]>,
}

impl<'a> CellMap<'a> {
    fn of(header: &'a CubeHeader, response: &'a MapResponse) -> Self {
        let radar = &header.radar;
        let (rows, columns) = (radar.waveform.chirps as usize, radar.waveform.range_cells());
        Self { radar, response, rows, columns, channels: channels(radar) }
    }

    fn cells(&self) -> usize {
        self.rows * self.columns
    }

    /// Mean power over the channels, W of an IF sample.
    fn power(&self, echoes: &[PathOnMap]) -> Vec<f64> {
        let mut power = vec![0.0; self.cells()];
        for channel in &self.channels {
            let sums = self.sums(echoes, channel);
            power.iter_mut().zip(sums).for_each(|(power, sum)| *power += sum.norm_sqr());
        }
        let count = self.channels.len() as f64;
        power.iter_mut().for_each(|power| *power /= count);
        power
    }

    /// Sum of the echoes in each cell of one channel.
    fn sums(&self, echoes: &[PathOnMap], [transmit, receive]: &[DVec3; 2]) -> Vec<Complex64> {
        let wavenumber = TAU / self.radar.waveform.wavelength_m();
        let mut sums = vec![Complex64::ZERO; self.cells()];
        for echo in echoes {
            let ahead_m = transmit.dot(echo.directions[0]) + receive.dot(echo.directions[1]);
            self.add_echo(echo, echo.value * Complex64::from_polar(1.0, -wavenumber * ahead_m), &mut sums);
        }
        sums
    }

    /// Adds an echo's response to the cells around it. Rows are periodic, and so are the columns over a whole
    /// sample rate; the map of real samples shows half of these (the part that folds into it is left out).
    fn add_echo(&self, echo: &PathOnMap, value: Complex64, sums: &mut [Complex64]) {
        let [velocity_cell_mps, range_cell_m] = self.response.cells;
        let tone = echo.position.radial_velocity_mps / velocity_cell_mps;
        let column = echo.position.range_m / range_cell_m;
        let samples = self.radar.waveform.samples as usize;
        for (row, left) in self.response.doppler.reached(tone, self.rows) {
            let of_row = value * left;
            let begin = (row + (self.rows / 2) as i64).rem_euclid(self.rows as i64) as usize * self.columns;
            for c in reached(column, samples) {
                let shown = c.rem_euclid(samples as i64) as usize;
                if shown < self.columns {
                    sums[begin + shown] += of_row * at(&self.response.range, c as f64 - column);
                }
            }
        }
    }
}

/// Elements of some channels, evenly selected from all.
fn channels(radar: &Radar) -> Vec<[DVec3; 2]> {
    let centre = DVec3::from(radar.position_m);
    let from_centre = |element: &[f64; 3]| DVec3::from(*element) - centre;
    let (transmit, receive) = (&radar.array.tx_m, &radar.array.rx_m);
    let all = transmit.iter().flat_map(|t| receive.iter().map(move |r| [from_centre(t), from_centre(r)]));
    let all: Vec<[DVec3; 2]> = all.collect();
    let taken = all.len().min(CHANNELS);
    let last = taken.max(2) - 1;
    (0..taken).map(|i| all[i * (all.len() - 1) / last]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_strongest_of_two_kinds_has_its_share_of_their_power() {
        let mut cell = Strongest::default();
        cell.add(1, 1.0);
        cell.add(2, 3.0);
        assert_eq!(cell.label(), (2, 75));
    }
}
