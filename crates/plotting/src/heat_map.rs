//! Numbers over a plane as colours.

use crate::axes::{Axes, Axis, room_beside_px};
use crate::colours::inferno;
use crate::error::PlottingError;
use crate::layout::Layout;
use crate::marks::Legend;
use crate::raster::{self, Pixels};
use crate::svg::{Svg, wrap_text};
use ndarray::Array2;

/// A map with axes; row 0 lies at the bottom, and axes run between the middles of the outer cells.
#[derive(Debug, Clone)]
pub struct HeatMap {
    /// Title over the map.
    pub title: String,
    /// Notes below the title.
    pub notes: Vec<String>,
    /// Label and ends of the horizontal axis.
    pub x: (String, [f64; 2]),
    /// Label and ends of the vertical axis.
    pub y: (String, [f64; 2]),
    /// Decibels, `[y, x]`.
    pub levels_db: Array2<f64>,
    /// Span of the levels that are shown below the brightest cell.
    pub span_db: f64,
    /// Unit of the levels, below their scale.
    pub unit: String,
    /// A picture with transparent parts that is laid over the map.
    pub overlay: Option<Vec<u8>>,
    /// Legend of what marks mean.
    pub legend: Legend,
}

impl HeatMap {
    /// Draws the map as high as wide: a metre is as long across as up.
    pub fn draw_square(&self) -> Result<Svg, PlottingError> {
        const SIDE: f64 = 420.0;
        let up = |top: f64| Axis { from: self.y.1[0], to: self.y.1[1], start_px: top + SIDE, end_px: top };
        let left = room_beside_px(&up(0.0).numbered()).max(60.0);
        let mut sheet = Svg::new(self.title.clone(), left + SIDE + 70.0, 0.0);
        let top = draw_title(&mut sheet, &self.title, &self.notes);
        let axes = Axes {
            x: Axis { from: self.x.1[0], to: self.x.1[1], start_px: left, end_px: left + SIDE },
            y: up(top),
        };
        let brightest =
            self.levels_db.iter().copied().filter(|l| l.is_finite()).fold(f64::NEG_INFINITY, f64::max);
        let brightest = if brightest.is_finite() { brightest } else { 0.0 };
        let levels = [brightest - self.span_db, brightest];
        sheet.image([left, top], [SIDE, SIDE], &heat_png(&self.levels_db, levels)?);
        if let Some(png) = &self.overlay {
            sheet.image([left, top], [SIDE, SIDE], png);
        }
        axes.draw(&mut sheet, &self.x.0, &self.y.0);
        scale_bar(&mut sheet, &axes, levels, &self.unit);
        self.legend.draw(&mut sheet, top + SIDE + 74.0, [50.0, left + SIDE + 60.0]);
        Ok(sheet)
    }
}

/// Title and what is to be known beforehand; where the drawing begins.
pub fn draw_title(sheet: &mut Svg, title: &str, notes: &[String]) -> f64 {
    let mut y = 20.0;
    for line in wrap_text(title, 0.82 * sheet.width) {
        sheet.heading([10.0, y], &line);
        y += 18.0;
    }
    let room_px = sheet.width - 20.0;
    for line in notes.iter().flat_map(|note| wrap_text(note, room_px)) {
        sheet.text([10.0, y], "start", &line);
        y += 17.0;
    }
    y - 4.0
}

/// Levels as colours, row 0 at the bottom.
pub fn heat_png(map: &Array2<f64>, [dark, bright]: [f64; 2]) -> Result<Vec<u8>, PlottingError> {
    let (rows, columns) = map.dim();
    let upside_down = map.rows().into_iter().rev();
    let colours: Vec<u8> = upside_down
        .flat_map(|row| row.to_vec())
        .flat_map(|level| inferno((level - dark) / (bright - dark)))
        .collect();
    raster::encode_png(Pixels::Rgb, [columns, rows], &colours)
}

/// Room for the colours' levels at the right of a map.
pub const SCALE_BAR_PX: f64 = 66.0;

/// The colours' levels, right of the map.
pub fn scale_bar(sheet: &mut Svg, axes: &Axes, [dark, bright]: [f64; 2], unit: &str) {
    let (x, top, bottom) = (axes.x.end_px + 14.0, axes.y.end_px, axes.y.start_px);
    let column: Vec<u8> = (0..64).flat_map(|y| inferno(1.0 - f64::from(y) / 63.0)).collect();
    if let Ok(png) = raster::encode_png(Pixels::Rgb, [1, 64], &column) {
        sheet.image([x, top], [12.0, bottom - top], &png);
    }
    let axis = Axis { from: dark, to: bright, start_px: bottom, end_px: top };
    for value in axis.ticks() {
        sheet.text([x + 16.0, axis.to_px(value) + 4.0], "start", &format!("{value:.0}").replace('-', "−"));
    }
    sheet.text([x, bottom + 17.0], "start", unit);
}

impl Layout {
    /// Left and right end of a map with its scale.
    pub fn map_sides_px(self) -> [f64; 2] {
        let [left, right] = self.sides_px();
        [left, right + 12.0 - SCALE_BAR_PX]
    }
}
