//! The scene from above for one radar: the radar and its field of view, its lanes if any, true outlines,
//! objects and points.

use crate::pictures::bodies::bodies;
use crate::pictures::detection_marks::{self, Owner};
use crate::pictures::field_of_view;
use crate::pictures::ground::{Ground, Region};
use crate::pictures::off_map_marks::MarkKind;
use artifact::radar::Radar;
use artifact::scene::SceneHeader;
use artifact::settings::{Lane, Lanes};
use pipeline::chain::frame_result::FrameResult;
use plotting::layout::Layout;
use plotting::marks::Mark;
use plotting::svg::Svg;

/// Draws truth, points and estimates of one frame; `false_objects` are indices of objects that belong to no
/// body.
pub(super) fn of_frame(
    header: &SceneHeader,
    result: &FrameResult,
    false_objects: &[usize],
    layout: Layout,
) -> Svg {
    let title = format!("Scene from above, frame {}", result.scene.index);
    let bodies = bodies(header, &result.scene);
    let (road, radar) = (&header.dsp.road, &header.radar);
    let places = bodies.iter().map(|body| road.across_along_m(body.place_m));
    let mut ground = Ground::new(&title, &[], layout, region(road, radar, places), road);
    if lanes_in_reach(road, radar).next().is_some() {
        lanes(&mut ground, header);
    }
    if !road.courses.is_empty() {
        ground.courses(road);
        ground.lane_lines(road, [0.0; 2]);
        ground.add_legend(Mark::Line, "lanes", "lane of the network");
    }
    ground.radar("radar", "radar", radar);
    bodies.iter().for_each(|body| ground.body(body));
    for point in &result.points.points {
        ground.found(MarkKind::Point, detection_marks::of_point(point), "found", point.position_m, "");
    }
    let marks: Vec<(Mark, Owner)> = marks(result, false_objects).collect();
    for (number, (object, (mark, _))) in result.points.objects.iter().zip(&marks).enumerate() {
        let name = if *mark == Mark::DashedRing { format!("#{number}") } else { String::new() };
        ground.found(MarkKind::Object, *mark, "found", object.position_m, &name);
    }
    add_legends(&mut ground, radar, result, &marks);
    ground.finish(axis_names(road))
}

/// Mark and owner of each object.
fn marks(result: &FrameResult, false_objects: &[usize]) -> impl Iterator<Item = (Mark, Owner)> {
    result.points.objects.iter().enumerate().map(|(number, object)| {
        let owner = if false_objects.contains(&number) { Owner::Nobody } else { Owner::Body };
        (detection_marks::of_object(object, owner), owner)
    })
}

fn add_legends(ground: &mut Ground, radar: &Radar, result: &FrameResult, objects: &[(Mark, Owner)]) {
    ground.add_legend(Mark::Dot, "found", "detected point");
    if result.points.points.iter().any(|point| point.stationary == Some(true)) {
        ground.add_legend(Mark::SmallRing, "found", detection_marks::POINT_AT_REST);
    }
    for shown in [Mark::Ring, Mark::DashedRing, Mark::SquareOutline] {
        if let Some((mark, owner)) = objects.iter().find(|(mark, _)| *mark == shown) {
            ground.add_legend(*mark, "found", detection_marks::words(*mark, *owner));
        }
    }
    add_radar_legend(ground, radar);
}

/// Adds the marks of a radar to the legend.
pub(super) fn add_radar_legend(ground: &mut Ground, radar: &Radar) {
    ground.add_legend(Mark::Triangle, "radar", "radar");
    ground.add_legend(Mark::DashedLine, "radar", "boresight");
    ground.add_legend(Mark::Line, "radar", field_of_view::words(radar));
}

/// Names of the axes across and along the road; the world's x and y if those are the road's.
pub(super) fn axis_names(road: &Lanes) -> [&'static str; 2] {
    match (road.lanes.is_empty(), road.azimuth_rad == 0.0 && road.origin_m == [0.0; 2]) {
        (true, true) => ["x, m", "y, m"],
        (_, true) => ["x, across the road, m", "y, along the road, m"],
        _ => ["across the road, m", "along the road, m"],
    }
}

/// Range to which a plan shows the ground, m.
fn shown_to_m(radar: &Radar) -> f64 {
    radar.waveform.range_max_m().clamp(10.0, 120.0)
}

/// Straight lanes within the range that a plan shows. Others, such as those of a crossing at the world's
/// origin that a distant radar has by default, would enlarge the plan to their distance.
fn lanes_in_reach<'a>(road: &'a Lanes, radar: &Radar) -> impl Iterator<Item = &'a Lane> {
    let ([radar_m, _], far_m) = (road.across_along_m(radar.position_m), shown_to_m(radar));
    road.lanes.iter().filter(move |lane| (lane.centre_m - radar_m).abs() - 0.5 * lane.width_m <= far_m)
}

/// Region of the radar, its lanes and the bodies within its range, in steps that keep frames equal.
pub(super) fn region(road: &Lanes, radar: &Radar, bodies: impl Iterator<Item = [f64; 2]>) -> Region {
    const ROOM_M: f64 = 3.0;
    const STEP_M: f64 = 5.0;
    let at_radar = road.across_along_m(radar.position_m);
    let far_m = shown_to_m(radar);
    let [x_m, y_m] = field_of_view::ahead_m(radar, far_m);
    let ahead = road.across_along_m([x_m, y_m, 0.0]);
    let mut region = Region::of(at_radar).with(at_radar, 2.0).with(ahead, 2.0);
    for lane in lanes_in_reach(road, radar) {
        for across_m in [lane.centre_m - 0.5 * lane.width_m, lane.centre_m + 0.5 * lane.width_m] {
            region = region.with([across_m, at_radar[1]], 2.0);
        }
    }
    let is_near = |at: &[f64; 2]| (at[0] - at_radar[0]).hypot(at[1] - at_radar[1]) <= far_m;
    region = bodies.filter(is_near).fold(region, |region, at| region.with(at, ROOM_M));
    let outer = |[low, high]: [f64; 2]| [(low / STEP_M).floor() * STEP_M, (high / STEP_M).ceil() * STEP_M];
    Region { across_m: outer(region.across_m), along_m: outer(region.along_m) }
}

/// Draws the lanes and the road that crosses them before they begin.
fn lanes(ground: &mut Ground, header: &SceneHeader) {
    let (road, crossing_m) = (&header.dsp.road, header.intersection.width_m);
    let [_, far_m] = ground.along_m();
    ground.strip("road", [-1e3, 1e3], [0.0, crossing_m]);
    for lane in lanes_in_reach(road, &header.radar) {
        let sides = [lane.centre_m - 0.5 * lane.width_m, lane.centre_m + 0.5 * lane.width_m];
        ground.strip("road", sides, [crossing_m, far_m]);
        ground.note([lane.centre_m, far_m], &format!("lane {}", lane.number));
    }
    ground.lane_lines(road, [crossing_m, far_m]);
    ground.add_legend(Mark::Outline, "lanes", "road");
    ground.add_legend(Mark::Line, "lanes", "lane");
}

#[cfg(test)]
mod tests {
    use super::*;
    use radar::aperture::Preset;
    use radar::paper;

    #[test]
    fn a_plan_has_the_lanes_beside_the_radar_and_not_those_far_away() {
        let lanes = vec![Lane { number: 1, centre_m: 2.0, width_m: 3.75 }];
        let road = Lanes { lanes, ..Lanes::default() };
        let at = |x_m: f64, y_m: f64| {
            let waveform = paper::waveform(256, 128);
            let radar = paper::radar([x_m, y_m, 6.0], waveform, Preset::OneByFour.elements());
            (region(&road, &radar, std::iter::empty()), lanes_in_reach(&road, &radar).count())
        };
        assert_eq!(at(0.0, 0.0).1, 1);
        let (far, lanes) = at(-45_000.0, 80_000.0);
        assert_eq!((lanes, far.across_m), (0, [-45_005.0, -44_995.0]));
        assert_eq!(far.along_m, [79_995.0, 80_065.0]);
    }
}
