//! The range-Doppler map and its profile.

use crate::pictures::detection_marks::{self, Owner};
use artifact::cube::CubeHeader;
use artifact::points::PointsFrame;
use artifact::rdm::RdmFrame;
use ndarray::Array2;
use pipeline::host::failure::Failure;
use plotting::axes::{Axes, Axis};
use plotting::heat_map::{draw_title, heat_png, scale_bar};
use plotting::labels::Labels;
use plotting::layout::Layout;
use plotting::lines::{Line, LinePlot, Scale};
use plotting::marks::{Legend, Mark};
use plotting::svg::Svg;
use radar::doppler_ambiguity::apparent_velocity_mps;

/// Largest range of decibels shown below the brightest cell, and below the noise.
const SPAN_DB: f64 = 60.0;
const BELOW_NOISE_DB: f64 = 4.0;

/// True range and radial velocity of a body's echo.
#[derive(Debug, Clone)]
pub(super) struct TrueEcho {
    pub(super) name: String,
    pub(super) range_m: f64,
    pub(super) radial_velocity_mps: f64,
}

/// Points, objects and truth drawn over a map; nothing if they are unknown.
#[derive(Debug, Clone, Default)]
pub(super) struct MapOverlay<'a> {
    pub(super) points: Option<&'a PointsFrame>,
    /// Indices of objects that belong to no body.
    pub(super) false_objects: Option<&'a [usize]>,
    pub(super) truth: &'a [TrueEcho],
}

impl MapOverlay<'_> {
    fn owner(&self, object: usize) -> Owner {
        match self.false_objects {
            Some(false_objects) if false_objects.contains(&object) => Owner::Nobody,
            Some(_) => Owner::Body,
            None => Owner::Unknown,
        }
    }
}

/// Draws a map with axes in metres and m/s, objects and truth; receding is at the top.
pub(super) fn draw(
    header: &CubeHeader,
    rdm: &RdmFrame,
    over: &MapOverlay,
    layout: Layout,
) -> Result<Svg, Failure> {
    let map = decibels(header, rdm)?;
    let levels = levels(&map);
    let title = format!("Range-Doppler map, frame {}, all channels", rdm.index);
    let mut sheet = Svg::new(title.clone(), layout.width_px(), 0.0);
    let velocity_max = header.radar.velocity_max_mps();
    let note = format!("Velocity is positive when the range grows; unambiguous to ±{velocity_max:.2} m/s.");
    let top = draw_title(&mut sheet, &title, &[note]);
    let axes = axes(header, layout, top);
    let (corner, size) = ([axes.x.start_px, top], [axes.x.end_px - axes.x.start_px, axes.y.start_px - top]);
    sheet.image(corner, size, &heat_png(&map, levels).map_err(Failure::refused)?);
    axes.draw(&mut sheet, "range, m", "radial velocity, m/s");
    scale_bar(&mut sheet, &axes, levels, header.unit.level_unit());
    let legend = marks(&mut sheet, header, &axes, over);
    legend.draw(&mut sheet, axes.y.start_px + 62.0, [10.0, layout.width_px() - 8.0]);
    Ok(sheet)
}

fn marks(sheet: &mut Svg, header: &CubeHeader, axes: &Axes, over: &MapOverlay) -> Legend {
    let mut legend = Legend::default();
    let frame = [axes.x.start_px, axes.y.end_px, axes.x.end_px, axes.y.start_px];
    let mut bodies = Labels::within(frame);
    let at = |range_m: f64, velocity_mps: f64| {
        [axes.x.to_px(range_m), axes.y.to_px(apparent_velocity_mps(&header.radar, velocity_mps))]
    };
    for echo in over.truth {
        let at = at(echo.range_m, echo.radial_velocity_mps);
        if axes.x.contains_px(at[0]) {
            shaded(sheet, Mark::Cross, "truthmap", at);
            bodies.place([at[0] - 8.0, at[1] - 8.0, at[0] + 8.0, at[1] + 8.0], &echo.name);
            legend.add_stacked(
                &[Mark::Backdrop, Mark::Cross],
                "truthmap",
                "echo of a body (truth), velocity folded",
            );
        }
    }
    let mut objects = bodies.next_layer();
    for (number, object) in over.points.iter().flat_map(|points| points.objects.iter().enumerate()) {
        let at = at(object.range_m, object.radial_velocity_mps);
        let owner = over.owner(number);
        let mark = detection_marks::of_object(object, owner);
        shaded(sheet, mark, "onmap", at);
        if mark == Mark::DashedRing {
            objects.place([at[0] - 9.0, at[1] - 9.0, at[0] + 9.0, at[1] + 9.0], &format!("#{number}"));
        }
        legend.add_stacked(&[Mark::Backdrop, mark], "onmap", detection_marks::words(mark, owner));
    }
    bodies.draw_on_map(sheet, "truthmap");
    objects.draw_on_map(sheet, "onmap");
    legend
}

/// Draws a mark with a dark shade that is visible on any level.
fn shaded(sheet: &mut Svg, mark: Mark, colour: &str, at: [f64; 2]) {
    mark.draw(sheet, "shadow", [at[0] + 1.0, at[1] + 1.0]);
    mark.draw(sheet, colour, at);
}

/// Draws the strongest cell over Doppler at each range.
pub(super) fn range_profile(header: &CubeHeader, rdm: &RdmFrame, layout: Layout) -> Result<Svg, Failure> {
    let map = decibels(header, rdm)?;
    let strongest =
        |column: ndarray::ArrayView1<f64>| column.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let points =
        dsp::range_axis_m(header).into_iter().zip(map.columns()).map(|(r, c)| [r, strongest(c)]).collect();
    let plot = LinePlot {
        title: format!("Range profile, frame {}", rdm.index),
        notes: vec![],
        x_label: "range, m".into(),
        y_label: format!("level, {}", header.unit.level_unit()),
        x_scale: Scale::Linear,
        y_scale: Scale::Linear,
        lines: vec![Line {
            name: "strongest cell over all velocities".into(),
            points,
            has_markers: false,
            tooltips: vec![],
        }],
    };
    Ok(plot.draw(layout))
}

fn decibels(header: &CubeHeader, rdm: &RdmFrame) -> Result<Array2<f64>, Failure> {
    let channels = header.radar.map_channels();
    let level_db = |power| header.map_level_db(power, channels);
    Ok(dsp::power_map(header, rdm).map_err(Failure::refused)?.mapv(level_db))
}

fn axes(header: &CubeHeader, layout: Layout, top: f64) -> Axes {
    let (ranges, velocities) = (dsp::range_axis_m(header), dsp::velocity_axis_mps(header));
    let [left, right] = layout.map_sides_px();
    let height = if layout == Layout::Wide { 400.0 } else { 320.0 };
    let (from, to) = ends(&ranges, header.radar.waveform.range_resolution_m());
    let x = Axis { from, to, start_px: left, end_px: right };
    let (from, to) = ends(&velocities, header.radar.velocity_resolution_mps());
    let axes = Axes { x, y: Axis { from, to, start_px: top + height, end_px: top } };
    axes.with_room_beside(&axes.y.numbered())
}

/// Outer edges of the first and last cell; a single cell is as wide as the resolution.
fn ends(axis: &[f64], resolution: f64) -> (f64, f64) {
    let (first, last) = (axis.first().copied().unwrap_or(0.0), axis.last().copied().unwrap_or(1.0));
    let half = 0.5 * if axis.len() > 1 { (last - first) / (axis.len() - 1) as f64 } else { resolution };
    (first - half, last + half)
}

/// Darkest and brightest level: from a little below the median cell, which contains noise, to the peak.
fn levels(map: &Array2<f64>) -> [f64; 2] {
    let mut cells: Vec<f64> = map.iter().copied().collect();
    cells.sort_by(f64::total_cmp);
    let (peak, median) = (cells[cells.len() - 1], cells[cells.len() / 2]);
    [(median - BELOW_NOISE_DB).clamp(peak - SPAN_DB, peak - 10.0), peak]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_ends_half_a_cell_beyond_its_cells_and_one_cell_alone_is_its_resolution_wide() {
        assert_eq!(ends(&[0.0, 2.0, 4.0], 3.0), (-1.0, 5.0));
        // A frame of one chirp tells no velocity: λ/2T from −λ/4T on.
        assert_eq!(ends(&[0.0], 86.0), (-43.0, 43.0));
    }
}
