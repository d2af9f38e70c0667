//! Numbers over a plane as colours.

use super::axes::{Axes, Axis};
use super::colours::heat;
use super::raster;
use super::svg::Svg;
use crate::failure::Failure;
use ndarray::Array2;

/// A map with axes; row 0 lies at the bottom, and axes run between the middles of the outer cells.
#[derive(Debug, Clone)]
pub(crate) struct HeatMap {
    pub(crate) title: String,
    pub(crate) x: (String, [f64; 2]),
    pub(crate) y: (String, [f64; 2]),
    /// Decibels, `[y, x]`.
    pub(crate) levels_db: Array2<f64>,
    /// Shown below the brightest cell.
    pub(crate) span_db: f64,
    pub(crate) unit: String,
    /// Whether a metre is as long across as up.
    pub(crate) shape: Shape,
}

/// Proportions of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shape {
    /// The sheet is filled.
    Wide,
    /// As high as wide.
    Square,
}

impl HeatMap {
    pub(crate) fn draw(&self) -> Result<Svg, Failure> {
        let right = if self.shape == Shape::Wide { 660.0 } else { 465.0 };
        let mut sheet = Svg::new(self.title.clone(), 760.0, 470.0);
        let axes = Axes {
            x: Axis { from: self.x.1[0], to: self.x.1[1], start_px: 60.0, end_px: right },
            y: Axis { from: self.y.1[0], to: self.y.1[1], start_px: 425.0, end_px: 20.0 },
        };
        let brightest = self.levels_db.iter().copied().filter(|l| l.is_finite()).fold(f64::NEG_INFINITY, f64::max);
        let brightest = if brightest.is_finite() { brightest } else { 0.0 };
        let levels = [brightest - self.span_db, brightest];
        sheet.image([60.0, 20.0], [right - 60.0, 405.0], &heat_png(&self.levels_db, levels)?);
        axes.draw(&mut sheet, &self.x.0, &self.y.0);
        scale_bar(&mut sheet, levels, &self.unit);
        Ok(sheet)
    }
}

/// Levels as colours, row 0 at the bottom.
pub(super) fn heat_png(map: &Array2<f64>, [dark, bright]: [f64; 2]) -> Result<Vec<u8>, Failure> {
    let (rows, columns) = map.dim();
    let colour = |x: u32, y: u32| {
        let level = map[[rows - 1 - y as usize, x as usize]];
        image::Rgb(heat((level - dark) / (bright - dark)))
    };
    let picture = image::RgbImage::from_fn(columns as u32, rows as u32, colour);
    raster::encode(picture.into()).map_err(Failure::refused)
}

/// The colours' levels, right of the picture.
pub(super) fn scale_bar(sheet: &mut Svg, [dark, bright]: [f64; 2], unit: &str) {
    let column = image::RgbImage::from_fn(1, 64, |_, y| image::Rgb(heat(1.0 - f64::from(y) / 63.0)));
    if let Ok(png) = raster::encode(column.into()) {
        sheet.image([680.0, 20.0], [14.0, 405.0], &png);
    }
    let axis = Axis { from: dark, to: bright, start_px: 425.0, end_px: 20.0 };
    for value in axis.ticks() {
        sheet.words([698.0, axis.at(value) + 4.0], 11.0, "start", &format!("{value:.0}").replace('-', "−"));
    }
    sheet.words([680.0, 446.0], 11.0, "start", unit);
}
