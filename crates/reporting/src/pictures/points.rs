//! The point cloud, coloured by object: from above, and with a measured elevation also from two sides.

use crate::pictures::bodies::Body;
use crate::pictures::detection_marks::{self, Owner};
use crate::pictures::field_of_view;
use crate::pictures::ground::Ground;
use crate::pictures::off_map_marks::MarkKind;
use crate::pictures::plan_view::{axis_names, region};
use artifact::cube::CubeHeader;
use artifact::points::{Point, PointsFrame};
use artifact::radar::Radar;
use artifact::settings::Lanes;
use dsp::angle::VirtualArray;
use plotting::axes::{Axes, Axis};
use plotting::clip;
use plotting::colours::line_colour;
use plotting::heat_map::draw_title;
use plotting::layout::Layout;
use plotting::marks::{Legend, Mark};
use plotting::svg::Svg;

/// Draws points and objects, and the true bodies, none if truth is unknown.
pub(super) fn draw(header: &CubeHeader, frame: &PointsFrame, bodies: &[Body], layout: Layout) -> Svg {
    if measures_elevation(header) {
        views(header, frame, bodies, layout)
    } else {
        plan(header, frame, bodies, layout)
    }
}

/// Whether heights are measured, not assumed.
fn measures_elevation(header: &CubeHeader) -> bool {
    VirtualArray::new(header).beams()[1].is_finite()
}

fn title(frame: &PointsFrame) -> String {
    format!("Point cloud, frame {}", frame.index)
}

fn colour(point: &Point) -> &'static str {
    point.object.map_or("plain", |object| line_colour(object as usize))
}

/// Point cloud from above only, for an array without elevation rows.
fn plan(header: &CubeHeader, frame: &PointsFrame, bodies: &[Body], layout: Layout) -> Svg {
    let road = &header.dsp.road;
    let height_m = header.dsp.assumed_height_m;
    let note = format!(
        "From above only: the array has no elevation rows, so heights are not measured (assumed: {height_m} m)."
    );
    let places = bodies.iter().map(|body| body.place_m).chain(frame.points.iter().map(|p| p.position_m));
    let region = region(road, &header.radar, places.map(|place| road.across_along_m(place)));
    let mut ground = Ground::new(&title(frame), &[note], layout, region, road);
    ground.radar("radar", "radar", &header.radar);
    bodies.iter().for_each(|body| ground.body(body));
    for point in &frame.points {
        ground.found(MarkKind::Point, detection_marks::of_point(point), colour(point), point.position_m, "");
    }
    for (number, object) in frame.objects.iter().enumerate() {
        let mark = detection_marks::of_object(object, Owner::Unknown);
        ground.found(MarkKind::Object, mark, line_colour(number), object.position_m, &format!("#{number}"));
    }
    meanings(frame, "object with its number")
        .into_iter()
        .for_each(|(mark, class, words)| ground.add_legend(mark, class, words));
    crate::pictures::plan_view::add_radar_legend(&mut ground, &header.radar);
    ground.finish(axis_names(road))
}

/// Marks of points and objects, with their colours and meanings; those at rest if there are any.
fn meanings(frame: &PointsFrame, object: &'static str) -> Vec<(Mark, &'static str, &'static str)> {
    let usual = [
        (Mark::Dot, "c0", "detected point, in its object's colour"),
        (Mark::Dot, "plain", "point of no object"),
        (Mark::Ring, "c0", object),
    ];
    let at_rest = [
        (
            Mark::SmallRing,
            "c0",
            detection_marks::POINT_AT_REST,
            frame.points.iter().any(|p| p.stationary == Some(true)),
        ),
        (
            Mark::SquareOutline,
            "c0",
            "object at rest",
            frame.objects.iter().any(|o| o.stationary == Some(true)),
        ),
    ];
    let shown = at_rest
        .into_iter()
        .filter(|(.., is_shown)| *is_shown)
        .map(|(mark, class, words, _)| (mark, class, words));
    usual.into_iter().chain(shown).collect()
}

/// One view of the point cloud: two of the coordinates across, along and up.
struct View {
    name: &'static str,
    coordinates: [usize; 2],
    /// Axes of the view, in pixels.
    axes: Axes,
}

/// Point cloud from above, from the side and from the front.
fn views(header: &CubeHeader, frame: &PointsFrame, bodies: &[Body], layout: Layout) -> Svg {
    let mut sheet = Svg::new(title(frame), layout.width_px(), 0.0);
    let top = draw_title(&mut sheet, &title(frame), &[]) + 8.0;
    let views = placed(header, frame, bodies, layout, top);
    let [across, along] = axis_names(&header.dsp.road);
    let names = [across, along, "height, m"];
    for view in &views {
        let Axes { x, y } = view.axes;
        view.axes.draw(&mut sheet, names[view.coordinates[0]], names[view.coordinates[1]]);
        sheet.text([x.start_px + 2.0, y.end_px - 6.0], "start", view.name);
        if view.coordinates == [0, 1] {
            draw_radar(&mut sheet, header, view);
        }
        bodies.iter().for_each(|body| draw_body(&mut sheet, header, view, body));
        for point in &frame.points {
            put(&mut sheet, header, view, detection_marks::of_point(point), colour(point), point.position_m);
        }
        for (number, object) in frame.objects.iter().enumerate() {
            let mark = detection_marks::of_object(object, Owner::Unknown);
            put(&mut sheet, header, view, mark, line_colour(number), object.position_m);
        }
    }
    let bottom = views.iter().map(|view| view.axes.y.start_px).fold(top, f64::max);
    legend(header, frame, bodies).draw(&mut sheet, bottom + 62.0, [10.0, layout.width_px() - 10.0]);
    sheet
}

fn legend(header: &CubeHeader, frame: &PointsFrame, bodies: &[Body]) -> Legend {
    let mut legend = Legend::default();
    meanings(frame, "object").into_iter().for_each(|(mark, class, words)| legend.add(mark, class, words));
    for body in bodies {
        let (mark, what) = if body.corners_m.is_empty() {
            (Mark::Cross, "truth")
        } else {
            (Mark::Outline, "truth, its box")
        };
        legend.add(mark, body.colour, format!("{} ({what})", body.kind));
    }
    legend.add(Mark::Triangle, "radar", "radar");
    legend.add(Mark::DashedLine, "radar", "boresight");
    legend.add(Mark::Line, "radar", field_of_view::words(&header.radar));
    legend
}

/// Arranges the views side by side on a page, one below the other on a telephone.
fn placed(header: &CubeHeader, frame: &PointsFrame, bodies: &[Body], layout: Layout, top: f64) -> [View; 3] {
    let boxes = match layout {
        Layout::Wide => [
            [60.0, top, 320.0, top + 420.0],
            [390.0, top, 744.0, top + 165.0],
            [390.0, top + 255.0, 744.0, top + 420.0],
        ],
        Layout::Narrow => {
            let [left, right] = layout.sides_px();
            [
                [left, top, right, top + 380.0],
                [left, top + 460.0, right, top + 600.0],
                [left, top + 680.0, right, top + 820.0],
            ]
        }
    };
    let names = ["from above", "from the side", "from the front"];
    let coordinates = [[0, 1], [1, 2], [0, 2]];
    let points = frame.points.iter().map(|point| point.position_m);
    let spans = spans(&header.dsp.road, &header.radar, points, bodies);
    [0, 1, 2].map(|i: usize| {
        let [x, y] = coordinates[i].map(|c: usize| spans[c]);
        let [left, top, right, bottom] = boxes[i];
        let axes = Axes {
            x: Axis { from: x[0], to: x[1], start_px: left, end_px: right },
            y: Axis { from: y[0], to: y[1], start_px: bottom, end_px: top },
        };
        let axes = axes.with_room_beside(&axes.y.numbered());
        View { name: names[i], coordinates: coordinates[i], axes }
    })
}

/// Coordinates of a place across and along the road, and up, m.
fn on_road(header: &CubeHeader, position_m: [f64; 3]) -> [f64; 3] {
    let [across_m, along_m] = header.dsp.road.across_along_m(position_m);
    [across_m, along_m, position_m[2]]
}

fn pixel(header: &CubeHeader, view: &View, position_m: [f64; 3]) -> [f64; 2] {
    let at_m = on_road(header, position_m);
    let [i, j] = view.coordinates;
    [view.axes.x.to_px(at_m[i]), view.axes.y.to_px(at_m[j])]
}

fn put(sheet: &mut Svg, header: &CubeHeader, view: &View, mark: Mark, colour: &str, position_m: [f64; 3]) {
    let at = pixel(header, view, position_m);
    if view.axes.x.contains_px(at[0]) && view.axes.y.contains_px(at[1]) {
        mark.draw(sheet, colour, at);
    }
}

/// Draws the radar from above, its boresight and its field of view.
fn draw_radar(sheet: &mut Svg, header: &CubeHeader, view: &View) {
    let radar = &header.radar;
    let frame = [view.axes.x.start_px, view.axes.y.end_px, view.axes.x.end_px, view.axes.y.start_px];
    let ground = |[x_m, y_m]: [f64; 2]| pixel(header, view, [x_m, y_m, 0.0]);
    let rim: Vec<[f64; 2]> = field_of_view::rim_m(radar).into_iter().map(ground).collect();
    for pair in rim.windows(2) {
        if let Some(line) = clip::segment([pair[0], pair[1]], frame) {
            sheet.polyline("radar", 1.0, &line);
        }
    }
    let [x_m, y_m, _] = radar.position_m;
    let ends = [[x_m, y_m], field_of_view::ahead_m(radar, radar.waveform.range_max_m())].map(ground);
    if let Some(line) = clip::segment(ends, frame) {
        sheet.dashed_polyline("radar", 1.4, &line);
    }
    put(sheet, header, view, Mark::Triangle, "radar", radar.position_m);
}

/// Draws the box of a body in the view.
fn draw_body(sheet: &mut Svg, header: &CubeHeader, view: &View, body: &Body) {
    if body.corners_m.is_empty() {
        return put(sheet, header, view, Mark::Cross, body.colour, body.place_m);
    }
    let [low_m, high_m] = body.heights_m;
    let corners = |z_m: f64| body.corners_m.iter().map(move |[x, y]| [*x, *y, z_m]);
    let pixels: Vec<[f64; 2]> = match view.coordinates {
        [_, 2] => corners(low_m).chain(corners(high_m)).map(|p| pixel(header, view, p)).collect(),
        _ => corners(low_m).map(|p| pixel(header, view, p)).collect(),
    };
    let outline = if view.coordinates[1] == 2 { bounds(&pixels) } else { pixels };
    let frame = [view.axes.x.start_px, view.axes.y.end_px, view.axes.x.end_px, view.axes.y.start_px];
    sheet.translucent_polygon(body.colour, &clip::polygon(&outline, frame));
}

/// Corners of the bounding rectangle of some pixels.
fn bounds(pixels: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let [[x0, x1], [y0, y1]] = [0, 1].map(|axis: usize| {
        let values = pixels.iter().map(|p| p[axis]);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
    });
    vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
}

/// Spans of the views across and along the road and up, m: the region of plans, up to the radar's maximum
/// range, extended to points and bodies beyond it.
fn spans(
    road: &Lanes,
    radar: &Radar,
    points: impl Iterator<Item = [f64; 3]>,
    bodies: &[Body],
) -> [[f64; 2]; 3] {
    const ROOM_M: f64 = 1.0;
    let at_radar = road.across_along_m(radar.position_m);
    let range_max_m = radar.waveform.range_max_m();
    let of_bodies = bodies.iter().map(|body| body.place_m).filter(|place_m| {
        let [across_m, along_m] = road.across_along_m(*place_m);
        (across_m - at_radar[0]).hypot(along_m - at_radar[1]) <= range_max_m
    });
    let places: Vec<[f64; 3]> =
        points.chain(of_bodies).filter(|place_m| place_m.iter().all(|m| m.is_finite())).collect();
    let on_ground = || places.iter().map(|place_m| road.across_along_m(*place_m));
    let ground = on_ground().fold(region(road, radar, on_ground()), |all, at| all.with(at, ROOM_M));
    let heights_m = places.iter().map(|place_m| place_m[2]);
    let up_m = heights_m.fold([-0.5_f64, 6.5], |[low, high], m| [low.min(m), high.max(m)]);
    [ground.across_m, ground.along_m, up_m]
}

#[cfg(test)]
mod tests {
    use super::*;
    use radar::aperture::Preset;
    use radar::paper;

    /// Waveforms of Table 2 tell ranges to 61 m.
    #[test]
    fn views_show_what_lies_before_the_radar_wherever_it_stands_and_looks() {
        let elements = || Preset::SixByEight.elements();
        let mut radar = paper::radar([-45_000.0, 80_000.0, 6.0], paper::waveform(256, 128), elements());
        radar.boresight_az_rad = std::f64::consts::PI;
        let body = |place_m: [f64; 3]| Body {
            name: "car-1".into(),
            colour: "car",
            kind: "car",
            place_m,
            corners_m: vec![],
            heights_m: [0.0, 1.5],
        };
        let bodies = [body([-45_020.0, 79_970.0, 0.0]), body([5.0, 30.0, 0.0])];
        let points = [[-45_000.0, 79_900.0, 8.0]];
        let [across_m, along_m, up_m] = spans(&Lanes::default(), &radar, points.into_iter(), &bodies);
        assert!(across_m[0] <= -45_020.0 && across_m[1] - across_m[0] < 40.0, "{across_m:?}");
        assert_eq!((along_m, up_m), ([79_899.0, 80_005.0], [-0.5, 8.0]));
    }
}
