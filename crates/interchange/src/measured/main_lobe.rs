//! Points on the slope of a stronger one: an echo fills the cells under its window's main lobe, so a point
//! there may belong to the echo of the lobe's strongest point.

use artifact::cube::CubeHeader;
use artifact::points::Point;
use artifact::settings::Window;
use artifact::units::amplitude_from_db;
use radar::doppler_ambiguity::folded_mps;
use std::f64::consts::PI;

/// Distance of a point from the strongest one under the same main lobe, m and m/s; zero for the strongest
/// itself.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct MainLobeOffset {
    pub(crate) range_m: f64,
    pub(crate) velocity_mps: f64,
}

/// Extent of a main lobe on its axis.
struct MainLobe {
    range_m: f64,
    velocity_mps: f64,
    span_mps: f64,
}

impl MainLobe {
    fn of(cube: &CubeHeader) -> Self {
        let radar = &cube.radar;
        Self {
            range_m: half_width_cells(cube.dsp.range_window) * radar.waveform.range_resolution_m().abs(),
            velocity_mps: half_width_cells(cube.dsp.doppler_window) * radar.velocity_resolution_mps().abs(),
            span_mps: 2.0 * radar.velocity_max_mps().abs(),
        }
    }

    /// Distance of one point from another; `None` if they are not under one lobe.
    fn offset(&self, point: &Point, peak: &Point) -> Option<MainLobeOffset> {
        let range_m = point.range_m - peak.range_m;
        let velocity_mps = folded_mps(point.radial_velocity_mps - peak.radial_velocity_mps, self.span_mps);
        let is_under = range_m.abs() <= self.range_m && velocity_mps.abs() <= self.velocity_mps;
        is_under.then_some(MainLobeOffset { range_m, velocity_mps })
    }
}

/// Offsets of the points of a frame, in their order.
pub(crate) fn main_lobe_offsets(cube: &CubeHeader, points: &[Point]) -> Vec<MainLobeOffset> {
    let lobe = MainLobe::of(cube);
    let mut by_range: Vec<&Point> = points.iter().collect();
    by_range.sort_by(|a, b| a.range_m.total_cmp(&b.range_m));
    let offset = |point: &Point| {
        let first = by_range.partition_point(|other| other.range_m < point.range_m - lobe.range_m);
        let near = by_range[first..].iter().take_while(|other| other.range_m <= point.range_m + lobe.range_m);
        let stronger = near.filter(|other| other.snr_db > point.snr_db);
        let under = stronger.filter_map(|other| Some((other.snr_db, lobe.offset(point, other)?)));
        under.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(MainLobeOffset::default(), |(_, offset)| offset)
    };
    points.iter().map(offset).collect()
}

/// Half width of a main lobe, from its peak to its first zero, plus half a cell for the offset of peaks from
/// cells.
fn half_width_cells(window: Window) -> f64 {
    let zero = match window {
        Window::Rect => 1.0,
        Window::Hann | Window::Hamming => 2.0,
        Window::Blackman => 3.0,
        // π√(x² − ¼) = arcosh A for long windows, with A the level of the sidelobes.
        Window::Chebyshev(sidelobe_db) => (amplitude_from_db(sidelobe_db.abs()).acosh() / PI).hypot(0.5),
    };
    zero + 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_zero_of_a_window_is_half_a_cell_within_its_lobe() {
        for (window, length) in [
            (Window::Rect, 64),
            (Window::Hann, 64),
            (Window::Blackman, 64),
            (Window::Chebyshev(60.0), 64),
            (Window::Chebyshev(100.0), 128),
        ] {
            let taper = radar::window::taper(window, length).unwrap();
            let level = |cells: f64| {
                let turn = 2.0 * PI * cells / length as f64;
                let sums = taper.iter().enumerate().fold((0.0, 0.0), |(re, im), (n, w)| {
                    (re + w * (turn * n as f64).cos(), im + w * (turn * n as f64).sin())
                });
                sums.0.hypot(sums.1)
            };
            let half_cells = half_width_cells(window);
            let falls =
                (0..).map(|i| 0.01 * f64::from(i)).take_while(|cells| level(cells + 0.01) < level(*cells));
            let zero = falls.last().unwrap() + 0.01;
            assert!((half_cells - 0.5 - zero).abs() < 0.15, "{window:?}: {half_cells}, {zero}");
        }
    }
}
