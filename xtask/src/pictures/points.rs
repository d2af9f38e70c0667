//! The point cloud in three views, coloured by object.

use super::axes::{Axes, Axis};
use super::colours::line_colour;
use super::svg::Svg;
use artifact::cube::CubeHeader;
use artifact::points::{Point, PointsFrame};

/// Names of a view's axes, which coordinates they show, and where the view lies on the sheet.
struct View {
    labels: [&'static str; 2],
    coordinates: [usize; 2],
    corner: [f64; 2],
    size: [f64; 2],
}

const VIEWS: [View; 3] = [
    View { labels: ["across, m", "along, m"], coordinates: [0, 1], corner: [60.0, 30.0], size: [240.0, 390.0] },
    View { labels: ["along, m", "z up, m"], coordinates: [1, 2], corner: [380.0, 30.0], size: [350.0, 155.0] },
    View { labels: ["across, m", "z up, m"], coordinates: [0, 2], corner: [380.0, 265.0], size: [350.0, 155.0] },
];

/// From above, from the side, from the radar.
pub(super) fn draw(header: &CubeHeader, frame: &PointsFrame) -> Svg {
    let mut sheet = Svg::new(format!("Point cloud of frame {}", frame.index), 760.0, 470.0);
    for (view, words) in VIEWS.iter().zip(["from above", "from the side", "from the radar"]) {
        let axes = axes(header, frame, view);
        axes.draw(&mut sheet, view.labels[0], view.labels[1]);
        sheet.words([view.corner[0] + 4.0, view.corner[1] - 8.0], 12.0, "start", words);
        let [i, j] = view.coordinates;
        for point in &frame.points {
            let at_m = on_road(header, point);
            sheet.disc(colour(point), [axes.x.at(at_m[i]), axes.y.at(at_m[j])], 2.6);
        }
    }
    sheet
}

/// Across and along the road, and up.
fn on_road(header: &CubeHeader, point: &Point) -> [f64; 3] {
    let [across_m, along_m] = header.dsp.road.across_along_m(point.position_m);
    [across_m, along_m, point.position_m[2]]
}

fn colour(point: &Point) -> &'static str {
    point.object.map_or("#777777", |object| line_colour(object as usize))
}

fn axes(header: &CubeHeader, frame: &PointsFrame, view: &View) -> Axes {
    let [x0, y0] = view.corner;
    let [w, h] = view.size;
    let (x, y) = (span(header, frame, view.coordinates[0]), span(header, frame, view.coordinates[1]));
    Axes {
        x: Axis { from: x.0, to: x.1, start_px: x0, end_px: x0 + w },
        y: Axis { from: y.0, to: y.1, start_px: y0 + h, end_px: y0 },
    }
}

/// What is always shown (lanes, range, heights of vehicles) and whatever points lie beyond.
fn span(header: &CubeHeader, frame: &PointsFrame, coordinate: usize) -> (f64, f64) {
    let lanes = header.dsp.road.lanes.iter().map(|l| l.centre_m + l.width_m);
    let usual =
        [(-4.0, lanes.fold(4.0, f64::max)), (0.0, header.radar.waveform.range_max_m()), (-0.5, 6.5)][coordinate];
    let values = frame.points.iter().map(|p| on_road(header, p)[coordinate]).filter(|v| v.is_finite());
    values.fold(usual, |(low, high), v| (low.min(v), high.max(v)))
}
