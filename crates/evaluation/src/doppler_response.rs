//! Response of a map's rows to a tone, by the Doppler window and the chirps' start times.
//!
//! For equidistant chirps it is the window's transform; in the labels of whole maps its main lobe and one
//! sidelobe count. If chirp m starts δ_m later than m·T, a tone d rows beside a row has there the response
//! Σ_m w_m·e^{j2πd(m/N + δ_m/NT − ½)}/N, which is small nowhere: all rows count, and tones a whole turn per
//! chirp apart differ. For chirps r, r + P, … with equal delays the sum has period N rows and is tabulated.

use artifact::Radar;
use num_complex::Complex64;
use radar::doppler_ambiguity::folded;
use radar::window::fine_transform;
use std::f64::consts::{PI, TAU};

/// Distance in cells from the peak within which a tone counts in all cells of a map: the main lobe of all
/// windows here and a sidelobe.
const REACH_CELLS: f64 = 4.0;
/// Tabulated places per cell: finer than the accuracy of a point's place.
const PLACES_PER_CELL: usize = 64;

/// Response along the rows of a radar's map.
pub(crate) enum DopplerResponse {
    /// Equidistant chirps: amplitudes in steps from the centre on, to half the axis.
    Even(Vec<f64>),
    /// Chirps with periodically repeated delays.
    Staggered(Staggered),
}

/// Chirps with periodically repeated delays: P sums over N rows, and their delays.
pub(crate) struct Staggered {
    parts: Vec<Vec<Complex64>>,
    /// Index of each transmitter's sums, and their delays relative to equidistant chirps, frames.
    late: Vec<(usize, f64)>,
    transmitters: f64,
}

impl DopplerResponse {
    /// Response for a window with one weight per chirp of a transmitter.
    pub(crate) fn of(radar: &Radar, taper: &[f64]) -> Self {
        if radar.schedule.is_uniform() {
            Self::Even(response(taper))
        } else {
            Self::Staggered(Staggered::of(radar, taper))
        }
    }

    /// Amplitude in a row, counted from that of zero velocity, of a tone at another place, which is not
    /// folded.
    pub(crate) fn at(&self, tone: f64, row: f64, rows: u32) -> Complex64 {
        match self {
            Self::Even(along) => at(along, folded(tone - row, f64::from(rows))).into(),
            Self::Staggered(staggered) => staggered.at(tone - signed(row, f64::from(rows))),
        }
    }

    /// Rows in which a tone counts, which may lie outside the map but are each one row of it, and its
    /// amplitudes there.
    pub(crate) fn reached(&self, tone: f64, rows: usize) -> Vec<(i64, Complex64)> {
        match self {
            Self::Even(along) => {
                reached(tone, rows).map(|row| (row, at(along, row as f64 - tone).into())).collect()
            }
            Self::Staggered(staggered) => {
                let first = -((rows / 2) as i64);
                (first..first + rows as i64).map(|row| (row, staggered.at(tone - row as f64))).collect()
            }
        }
    }
}

impl Staggered {
    fn of(radar: &Radar, taper: &[f64]) -> Self {
        let (rows, transmitters) = (taper.len(), radar.array.tx_m.len().max(1));
        let delays = radar.schedule.stagger_s.len().min(rows);
        let frame_s = radar.repetition_interval_s() * rows as f64;
        let late = |tx: usize, first: usize| {
            let start_s = radar.chirp_start_s(tx, first) - radar.chirp_start_s(tx, 0);
            (first, start_s / frame_s - first as f64 / rows as f64)
        };
        let late = (0..transmitters).flat_map(|tx| (0..delays).map(move |first| late(tx, first)));
        let late = late.collect();
        let parts = (0..delays).map(|first| part(taper, first, delays)).collect();
        Self { parts, late, transmitters: transmitters as f64 }
    }

    /// Amplitude at a distance of `rows` from a tone, relative to the frame's middle.
    fn at(&self, rows: f64) -> Complex64 {
        let step = (rows * PLACES_PER_CELL as f64).round();
        let turns = step / PLACES_PER_CELL as f64;
        let value = |(first, late): &(usize, f64)| {
            let part = &self.parts[*first];
            part[step.rem_euclid(part.len() as f64) as usize] * Complex64::cis(TAU * turns * (late - 0.5))
        };
        self.late.iter().map(value).sum::<Complex64>() / self.transmitters
    }
}

/// Σ over chirps first, first + P, … of w_m·e^{j2πdm/N}/N, for d in steps from 0 to N.
fn part(taper: &[f64], first: usize, delays: usize) -> Vec<Complex64> {
    let (rows, length) = (taper.len(), taper.len() * PLACES_PER_CELL);
    let turns: Vec<Complex64> = (0..length).map(|i| Complex64::cis(TAU * i as f64 / length as f64)).collect();
    let own = || taper.iter().enumerate().skip(first).step_by(delays);
    let sum = |step: usize| own().map(|(m, w)| turns[step * m % length] * w).sum::<Complex64>();
    (0..length).map(|step| sum(step) / rows as f64).collect()
}

/// Signed row of a map, which begins at −N/2, for a place; rounding does not wrap around.
fn signed(row: f64, rows: f64) -> f64 {
    row - rows * (row / rows + 0.5 + 1e-9).floor()
}

/// Cells within [`REACH_CELLS`] of a fractional cell, of an axis that repeats after `period` cells: the
/// nearest of those that are one.
pub(crate) fn reached(cell: f64, period: usize) -> std::ops::Range<i64> {
    let reach = REACH_CELLS.min(0.5 * period as f64);
    let first = (cell - reach).ceil() as i64;
    first..((cell + reach).ceil() as i64).min(first + period as i64)
}

/// Amplitude of a tabulated response at a distance of `cells` from its centre.
pub(crate) fn at(response: &[f64], cells: f64) -> f64 {
    response.get((cells.abs() * PLACES_PER_CELL as f64).round() as usize).copied().unwrap_or(0.0)
}

/// Amplitude in a cell of a tone at a distance from the cell's centre, relative to the window's middle, where
/// it is real: to half the axis, which repeats beyond.
pub(crate) fn response(taper: &[f64]) -> Vec<f64> {
    let about_middle = |(step, value): (usize, Complex64)| {
        (value * Complex64::cis(-PI * step as f64 / PLACES_PER_CELL as f64)).re / taper.len() as f64
    };
    let half = taper.len() * PLACES_PER_CELL / 2;
    fine_transform(taper, PLACES_PER_CELL).into_iter().take(half + 1).enumerate().map(about_middle).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use radar::aperture::Preset;
    use radar::paper;

    #[test]
    fn an_echo_reaches_four_cells_on_both_sides() {
        assert_eq!(reached(10.0, 64), 6..14);
        assert_eq!(reached(10.5, 64), 7..15);
    }

    #[test]
    fn an_echo_reaches_every_row_of_a_short_map_once() {
        for rows in 1..8 {
            for tone in [-7.5, -0.4, 0.0, 0.5, 1.2, 3.0] {
                let reached: std::collections::BTreeSet<i64> =
                    reached(tone, rows).map(|row| row.rem_euclid(rows as i64)).collect();
                assert_eq!(reached.len(), rows, "{rows} rows, {tone}");
            }
        }
    }

    /// Every row of a tone that is 1.3 spans fast, from the sum over the chirps' own times.
    #[test]
    fn staggered_rows_are_the_sum_over_the_chirps_own_times() {
        let mut radar = paper::radar([0.0; 3], paper::waveform(64, 32), Preset::OneByFour.elements());
        radar.schedule.stagger_s = vec![0.0, 20e-6, 5e-6];
        let taper: Vec<f64> = (0..32).map(|m| (TAU * (f64::from(m) + 0.5) / 64.0).sin()).collect();
        let response = DopplerResponse::of(&radar, &taper);
        let frame_s = 32.0 * radar.repetition_interval_s();
        let tone = 41.25;
        let rows = response.reached(tone, 32);
        assert_eq!(rows.iter().map(|(row, _)| *row).collect::<Vec<_>>(), (-16..16).collect::<Vec<_>>());
        for (row, told) in rows {
            let turns = |m: usize| (tone - row as f64) * (radar.chirp_start_s(0, m) / frame_s - 0.5);
            let sum: Complex64 = (0..32).map(|m| Complex64::cis(TAU * turns(m)) * taper[m] / 32.0).sum();
            assert!((told - sum).norm() < 1e-12, "row {row}: {told} of {sum}");
            assert_eq!(response.at(tone, row as f64, 32), told);
        }
    }

    /// The sidelobes of a rectangular window fall as 1/πd alone.
    #[test]
    fn even_rows_are_the_sum_over_the_chirps_as_far_as_the_axis_goes() {
        let radar = paper::radar([0.0; 3], paper::waveform(64, 32), Preset::OneByFour.elements());
        let response = DopplerResponse::of(&radar, &[1.0; 32]);
        for apart in [0.5, 3.25, 4.5, 9.5, 15.75, 16.0, 20.5] {
            let turns = |m: usize| folded(apart, 32.0) * (m as f64 / 32.0 - 0.5);
            let sum: f64 = (0..32).map(|m| (TAU * turns(m)).cos() / 32.0).sum();
            let told = response.at(apart, 0.0, 32);
            assert!((told - sum).norm() < 1e-12, "{apart}: {told} of {sum}");
        }
    }
}
