//! The scene from above for several radars together: north is up, to scale.

use crate::pictures::bodies::{Body, bodies};
use crate::pictures::detection_marks::{self, Owner};
use crate::pictures::field_of_view;
use crate::pictures::ground::{Ground, Region};
use crate::pictures::off_map_marks::MarkKind;
use crate::pictures::radar_frame::RadarFrame;
use artifact::settings::Lanes;
use plotting::colours::line_colour;
use plotting::layout::{Figure, Layout};
use plotting::marks::Mark;
use plotting::svg::Svg;

/// Margin around the shown things.
const MARGIN_M: f64 = 10.0;

/// Draws the frame of this number: the bodies, and the points and objects of each radar in its own colour.
/// `radars` are names and views, at least one.
pub fn common_view(number: usize, radars: &[(&str, &RadarFrame)]) -> Figure {
    Figure::draw(|layout| draw(number, radars, layout))
}

fn draw(number: usize, radars: &[(&str, &RadarFrame)], layout: Layout) -> Svg {
    let title = format!("Scene from above as all radars have it, frame {number}");
    let bodies = all_bodies(radars);
    let mut ground = Ground::new(&title, &[], layout, region(radars, &bodies), &Lanes::default());
    for (_, seen) in radars {
        let (road, far_m) = (&seen.view.dsp.road, seen.view.radar.waveform.range_max_m());
        if ground.lane_lines(road, [seen.view.intersection.width_m, far_m]) {
            ground.add_legend(Mark::Line, "lanes", "lane");
        }
    }
    for (n, (id, seen)) in radars.iter().enumerate() {
        ground.radar(line_colour(n), id, &seen.view.radar);
    }
    bodies.iter().for_each(|body| ground.body(body));
    for (n, (id, seen)) in radars.iter().enumerate() {
        found(&mut ground, line_colour(n), id, seen);
    }
    if !radars.is_empty() {
        ground.add_legend(Mark::Dot, "plain", "detected point, in its radar's colour");
        ground.add_legend(Mark::Ring, "plain", "object, in its radar's colour");
        if radars
            .iter()
            .any(|(_, seen)| seen.points.objects.iter().any(|object| object.stationary == Some(true)))
        {
            ground.add_legend(Mark::SmallRing, "plain", detection_marks::POINT_AT_REST);
            ground.add_legend(Mark::SquareOutline, "plain", "object at rest");
        }
        ground.add_legend(Mark::DashedLine, "plain", "boresight");
        fields_of_view(&mut ground, radars);
    }
    ground.finish(["x, m", "y, m"])
}

/// Adds each radar's field of view to the legend, once if all are equal.
fn fields_of_view(ground: &mut Ground, radars: &[(&str, &RadarFrame)]) {
    let words: Vec<String> = radars.iter().map(|(_, seen)| field_of_view::words(&seen.view.radar)).collect();
    if words.windows(2).all(|pair| pair[0] == pair[1]) {
        return words.into_iter().take(1).for_each(|words| ground.add_legend(Mark::Line, "plain", words));
    }
    for (n, ((id, _), words)) in radars.iter().zip(words).enumerate() {
        ground.add_legend(Mark::Line, line_colour(n), format!("{id}: {words}"));
    }
}

/// Bodies of all radars, each once even if several radars have it in view.
fn all_bodies(radars: &[(&str, &RadarFrame)]) -> Vec<Body> {
    let mut all: Vec<Body> = vec![];
    for body in radars.iter().flat_map(|(_, seen)| bodies(&seen.view, &seen.scene)) {
        if !all.iter().any(|known| known.name == body.name) {
            all.push(body);
        }
    }
    all
}

/// Region that contains bodies and radars.
fn region(radars: &[(&str, &RadarFrame)], bodies: &[Body]) -> Region {
    let radar = |(_, seen): &(&str, &RadarFrame)| seen.view.radar.position_m;
    let mut places = radars.iter().map(radar).chain(bodies.iter().map(|body| body.place_m));
    let first = places.next().unwrap_or_default();
    let start = Region::of([first[0], first[1]]).with([first[0], first[1]], MARGIN_M);
    places.fold(start, |region, place| region.with([place[0], place[1]], MARGIN_M))
}

/// Draws the points and objects of a radar.
fn found(ground: &mut Ground, colour: &str, id: &str, seen: &RadarFrame) {
    for point in &seen.points.points {
        ground.found(MarkKind::Point, detection_marks::of_point(point), colour, point.position_m, "");
    }
    for object in &seen.points.objects {
        ground.found(
            MarkKind::Object,
            detection_marks::of_object(object, Owner::Unknown),
            colour,
            object.position_m,
            "",
        );
    }
    ground.add_legend(Mark::Triangle, colour, format!("radar {id}"));
}
