//! The range-Doppler map and its profile.

use super::axes::{Axes, Axis};
use super::heat_map::{heat_png, scale_bar};
use super::lines::{Line, LinePlot, Scale};
use super::svg::Svg;
use crate::failure::Failure;
use artifact::cube::CubeHeader;
use artifact::points::PointsFrame;
use artifact::rdm::RdmFrame;
use artifact::units::db_from_power;
use ndarray::Array2;

/// Decibels shown below the brightest cell at most, and below the noise.
const SPAN_DB: f64 = 60.0;
const BELOW_NOISE_DB: f64 = 4.0;

/// Map with axes in metres and m/s; every object is ringed.
pub(super) fn draw(header: &CubeHeader, rdm: &RdmFrame, points: &PointsFrame) -> Result<Svg, Failure> {
    let map = decibels(header, rdm)?;
    let levels = levels(&map);
    let axes = axes(header);
    let mut sheet = Svg::new(format!("Range-Doppler map of frame {}", rdm.index), 760.0, 470.0);
    let corner = [axes.x.start_px, axes.y.end_px];
    let size = [axes.x.end_px - axes.x.start_px, axes.y.start_px - axes.y.end_px];
    sheet.image(corner, size, &heat_png(&map, levels)?);
    axes.draw(&mut sheet, "range, m", "radial velocity, m/s");
    for object in &points.objects {
        let velocity = header.radar.folded_velocity_mps(object.radial_velocity_mps);
        sheet.ring("#39d0ff", [axes.x.at(object.range_m), axes.y.at(velocity)], 11.0);
    }
    scale_bar(&mut sheet, levels, "dBW");
    Ok(sheet)
}

/// Strongest cell over Doppler.
pub(super) fn range_profile(header: &CubeHeader, rdm: &RdmFrame) -> Result<Svg, Failure> {
    let map = decibels(header, rdm)?;
    let strongest = |column: ndarray::ArrayView1<f64>| column.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let points = dsp::range_axis_m(header).into_iter().zip(map.columns()).map(|(r, c)| [r, strongest(c)]).collect();
    let plot = LinePlot {
        title: format!("Range profile of frame {}", rdm.index),
        x_label: "range, m".into(),
        y_label: "strongest cell over velocity, dBW".into(),
        x_scale: Scale::Linear,
        y_scale: Scale::Linear,
        lines: vec![Line { name: String::new(), points, marked: false }],
    };
    Ok(plot.draw())
}

fn decibels(header: &CubeHeader, rdm: &RdmFrame) -> Result<Array2<f64>, Failure> {
    Ok(dsp::power_map(header, rdm).map_err(Failure::refused)?.mapv(db_from_power))
}

fn axes(header: &CubeHeader) -> Axes {
    let (ranges, velocities) = (dsp::range_axis_m(header), dsp::velocity_axis_mps(header));
    let (from, to) = ends(&ranges);
    let x = Axis { from, to, start_px: 60.0, end_px: 660.0 };
    let (from, to) = ends(&velocities);
    Axes { x, y: Axis { from, to, start_px: 425.0, end_px: 20.0 } }
}

/// Outer edges of the first and last cell.
fn ends(axis: &[f64]) -> (f64, f64) {
    let (first, last) = (axis.first().copied().unwrap_or(0.0), axis.last().copied().unwrap_or(1.0));
    let half = 0.5 * (last - first) / (axis.len().max(2) - 1) as f64;
    (first - half, last + half)
}

/// Darkest and brightest level: from a little below the median cell, which is noise, to the peak.
fn levels(map: &Array2<f64>) -> [f64; 2] {
    let mut cells: Vec<f64> = map.iter().copied().collect();
    cells.sort_by(f64::total_cmp);
    let (peak, median) = (cells[cells.len() - 1], cells[cells.len() / 2]);
    [(median - BELOW_NOISE_DB).clamp(peak - SPAN_DB, peak - 10.0), peak]
}
