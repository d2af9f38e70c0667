//! A level over azimuth, all round.

use crate::colours::line_colour;
use crate::heat_map::draw_title;
use crate::lines::{draw_stroke, stroke_mark};
use crate::marks::Legend;
use crate::svg::Svg;

/// Decibels over azimuth: 0° points up, where the body's front is, and grows counter-clockwise as seen from
/// above.
#[derive(Debug, Clone)]
pub struct PolarPlot {
    /// Title over the diagram.
    pub title: String,
    /// Unit of the levels.
    pub unit: String,
    /// Name and (degrees, decibels) of each line.
    pub lines: Vec<(String, Vec<[f64; 2]>)>,
}

const CENTRE_PX: [f64; 2] = [240.0, 270.0];
const RADIUS_PX: f64 = 195.0;
/// Span of levels from the rim to the centre.
const SPAN_DB: f64 = 60.0;
const RING_DB: f64 = 10.0;

impl PolarPlot {
    /// The whole diagram.
    pub fn draw(&self) -> Svg {
        let mut sheet = Svg::new(self.title.clone(), 500.0, 0.0);
        let note = "0° is the body's front; azimuth grows counter-clockwise, seen from above".to_owned();
        draw_title(&mut sheet, &self.title, &[note]);
        let levels = self.lines.iter().flat_map(|(_, points)| points.iter().map(|p| p[1]));
        let highest = levels.filter(|l| l.is_finite()).fold(f64::NEG_INFINITY, f64::max);
        let rim_db = if highest.is_finite() { (highest / RING_DB).ceil() * RING_DB } else { 0.0 };
        self.draw_grid(&mut sheet, rim_db);
        let mut legend = Legend::default();
        for (n, (name, points)) in self.lines.iter().enumerate() {
            let places: Vec<[f64; 2]> = points.iter().map(|&[az, db]| place(az, db, rim_db)).collect();
            draw_stroke(&mut sheet, n, 1.3, &places);
            legend.add(stroke_mark(n), line_colour(n), name);
        }
        legend.draw(&mut sheet, CENTRE_PX[1] + RADIUS_PX + 46.0, [10.0, 490.0]);
        sheet
    }

    fn draw_grid(&self, sheet: &mut Svg, rim_db: f64) {
        for ring in 0..(SPAN_DB / RING_DB) as u32 {
            let db = rim_db - RING_DB * f64::from(ring);
            let circle: Vec<[f64; 2]> = (0..=120).map(|i| place(3.0 * f64::from(i), db, rim_db)).collect();
            sheet.polyline("grid", 0.8, &circle);
            let [x, y] = place(-75.0, db, rim_db);
            let unit = if ring == 0 { self.unit.as_str() } else { "" };
            sheet.text([x + 3.0, y - 3.0], "start", format!("{db:.0} {unit}").replace('-', "−").trim_end());
        }
        for az in (0..360).step_by(30) {
            let az = f64::from(az);
            sheet.polyline("grid", 0.8, &[CENTRE_PX, place(az, rim_db, rim_db)]);
            let [x, y] = place(az, rim_db + 5.0, rim_db);
            sheet.text([x, y + 4.0], "middle", &format!("{az:.0}°"));
        }
    }
}

fn place(azimuth_deg: f64, db: f64, rim_db: f64) -> [f64; 2] {
    let radius = RADIUS_PX * ((db - rim_db + SPAN_DB) / SPAN_DB).max(0.0);
    let (sin, cos) = azimuth_deg.to_radians().sin_cos();
    [CENTRE_PX[0] - radius * sin, CENTRE_PX[1] - radius * cos]
}
