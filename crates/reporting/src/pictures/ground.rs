//! The ground from above, to scale, with bodies, radars and detections; things outside are marked at the
//! edges.

use crate::pictures::bodies::Body;
use crate::pictures::field_of_view;
use crate::pictures::lane_sides::lane_sides_m;
use crate::pictures::off_map_marks::{MarkKind, OffMapMarks};
use artifact::radar::Radar;
use artifact::settings::{Lanes, NetworkLane};
use plotting::axes::{Axes, Axis};
use plotting::clip;
use plotting::heat_map::draw_title;
use plotting::labels::Labels;
use plotting::layout::Layout;
use plotting::marks::{Legend, Mark};
use plotting::svg::Svg;

/// Direction of a road on the sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RoadDirection {
    /// The road runs to the right, and across it is downwards.
    Right,
    /// The road runs upwards, and across it is to the right.
    Up,
}

/// Shown region of the ground, in metres across and along the road.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Region {
    pub(super) across_m: [f64; 2],
    pub(super) along_m: [f64; 2],
}

impl Region {
    /// The smallest region that contains a place.
    pub(super) fn of([across_m, along_m]: [f64; 2]) -> Self {
        Self { across_m: [across_m; 2], along_m: [along_m; 2] }
    }

    /// The region extended to contain another place with some room about it.
    pub(super) fn with(self, [across_m, along_m]: [f64; 2], room_m: f64) -> Self {
        let wider = |[low, high]: [f64; 2], v: f64| [low.min(v - room_m), high.max(v + room_m)];
        Self { across_m: wider(self.across_m, across_m), along_m: wider(self.along_m, along_m) }
    }

    fn sizes_m(&self) -> [f64; 2] {
        [self.across_m, self.along_m].map(|[low, high]| high - low)
    }

    /// Direction of the road on the sheet: to the right if the region is long, else upwards.
    pub(super) fn way(&self, layout: Layout) -> RoadDirection {
        let [across_m, along_m] = self.sizes_m();
        if layout == Layout::Wide && across_m < 0.6 * along_m {
            RoadDirection::Right
        } else {
            RoadDirection::Up
        }
    }
}

/// A sheet with a piece of ground on it.
pub(super) struct Ground {
    sheet: Svg,
    layout: Layout,
    axes: Axes,
    way: RoadDirection,
    road: Lanes,
    legend: Legend,
    labels: Labels,
    beyond: OffMapMarks,
}

impl Ground {
    /// Makes an empty ground, to scale; the region is extended to fill the sheet's width.
    pub(super) fn new(title: &str, notes: &[String], layout: Layout, region: Region, road: &Lanes) -> Self {
        let mut sheet = Svg::new(title, layout.width_px(), 0.0);
        let top = draw_title(&mut sheet, title, notes);
        let way = region.way(layout);
        let axes = axes(layout, way, region, top);
        let frame = [axes.x.start_px, axes.y.end_px, axes.x.end_px, axes.y.start_px];
        let (legend, labels, beyond) = (Legend::default(), Labels::within(frame), OffMapMarks::of(frame));
        Self { sheet, layout, axes, way, road: road.clone(), legend, labels, beyond }
    }

    /// Adds the meaning of a mark to the legend.
    pub(super) fn add_legend(&mut self, mark: Mark, colour: &str, words: impl Into<String>) {
        self.legend.add(mark, colour, words);
    }

    /// Pixel of a place across and along the road.
    fn pixel(&self, [across_m, along_m]: [f64; 2]) -> [f64; 2] {
        match self.way {
            RoadDirection::Right => [self.axes.x.to_px(along_m), self.axes.y.to_px(across_m)],
            RoadDirection::Up => [self.axes.x.to_px(across_m), self.axes.y.to_px(along_m)],
        }
    }

    /// Pixel of world x and y.
    fn world(&self, [x_m, y_m]: [f64; 2]) -> [f64; 2] {
        self.pixel(self.road.across_along_m([x_m, y_m, 0.0]))
    }

    fn frame(&self) -> [f64; 4] {
        [self.axes.x.start_px, self.axes.y.end_px, self.axes.x.end_px, self.axes.y.start_px]
    }

    fn clipped(&self, corners: &[[f64; 2]]) -> Vec<[f64; 2]> {
        clip::polygon(corners, self.frame())
    }

    /// Draws the part of a rectangle across and along the road that is on the sheet, in a class of styles.
    pub(super) fn strip(&mut self, class: &str, [left, right]: [f64; 2], [near, far]: [f64; 2]) {
        let corners = [[left, near], [left, far], [right, far], [right, near]].map(|p| self.pixel(p));
        let [mut low, mut high] = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for p in self.clipped(&corners) {
            low = [low[0].min(p[0]), low[1].min(p[1])];
            high = [high[0].max(p[0]), high[1].max(p[1])];
        }
        if low[0] < high[0] && low[1] < high[1] {
            self.sheet.rectangle(class, low, [high[0] - low[0], high[1] - low[1]]);
        }
    }

    /// Writes words on the ground if there is room.
    pub(super) fn note(&mut self, [across_m, along_m]: [f64; 2], words: &str) {
        let [x, y] = self.pixel([across_m, along_m]);
        self.labels.place([x, y, x, y], words);
    }

    /// Ends of the sheet along the road.
    pub(super) fn along_m(&self) -> [f64; 2] {
        let axis = if self.way == RoadDirection::Right { self.axes.x } else { self.axes.y };
        [axis.from, axis.to]
    }

    /// Draws the lines of a radar's lanes, from `from_m` on along its road, which may differ from the
    /// sheet's; returns whether any of them is on it.
    pub(super) fn lane_lines(&mut self, road: &Lanes, [from_m, to_m]: [f64; 2]) -> bool {
        let mut are_there = false;
        for lane in &road.lanes {
            for across_m in [lane.centre_m - 0.5 * lane.width_m, lane.centre_m + 0.5 * lane.width_m] {
                let ends = [from_m, to_m].map(|along_m| self.world(road.world_m([across_m, along_m])));
                are_there |= self.lane_line(ends);
            }
        }
        for course in &road.courses {
            for side in lane_sides_m(course) {
                let line: Vec<[f64; 2]> = side.into_iter().map(|place| self.world(place)).collect();
                line.windows(2).for_each(|ends| are_there |= self.lane_line([ends[0], ends[1]]));
            }
        }
        are_there
    }

    /// Draws the part of a line that is on the sheet; returns whether there is any.
    fn lane_line(&mut self, ends: [[f64; 2]; 2]) -> bool {
        let part = clip::segment(ends, self.frame());
        if let Some([from, to]) = part {
            self.sheet.line("lane", from, to);
        }
        part.is_some()
    }

    /// Draws the surface of a network's lanes, with their names where there is room.
    pub(super) fn courses(&mut self, road: &Lanes) {
        for course in &road.courses {
            let [left, right] = lane_sides_m(course);
            for i in 1..left.len() {
                let corners = [left[i - 1], left[i], right[i], right[i - 1]].map(|place| self.world(place));
                let corners = self.clipped(&corners);
                self.sheet.polygon("road", &corners);
            }
        }
        for course in &road.courses {
            if let Some(at) = self.middle_on_sheet(course) {
                self.labels
                    .place([at[0], at[1], at[0], at[1]], &format!("{} {}", course.number, course.name));
            }
        }
    }

    /// Middle of the visible part of a lane.
    fn middle_on_sheet(&self, course: &NetworkLane) -> Option<[f64; 2]> {
        let line: Vec<[f64; 2]> = course.line_m.iter().map(|place| self.world(*place)).collect();
        let seen: Vec<[[f64; 2]; 2]> =
            line.windows(2).filter_map(|ends| clip::segment([ends[0], ends[1]], self.frame())).collect();
        let length = |[a, b]: &[[f64; 2]; 2]| (b[0] - a[0]).hypot(b[1] - a[1]);
        let longest = seen.iter().max_by(|a, b| length(a).total_cmp(&length(b)))?;
        Some([0, 1].map(|axis: usize| 0.5 * (longest[0][axis] + longest[1][axis])))
    }

    /// Draws a radar, its boresight and its field of view.
    pub(super) fn radar(&mut self, colour: &str, name: &str, radar: &Radar) {
        let [x_m, y_m, _] = radar.position_m;
        let at = self.world([x_m, y_m]);
        let rim: Vec<[f64; 2]> = field_of_view::rim_m(radar).into_iter().map(|p| self.world(p)).collect();
        for pair in rim.windows(2) {
            if let Some(line) = clip::segment([pair[0], pair[1]], self.frame()) {
                self.sheet.polyline(colour, 1.0, &line);
            }
        }
        let ahead = self.world(field_of_view::ahead_m(radar, radar.waveform.range_max_m()));
        if let Some(line) = clip::segment([at, ahead], self.frame()) {
            self.sheet.dashed_polyline(colour, 1.4, &line);
        }
        if self.holds(at) {
            Mark::Triangle.draw(&mut self.sheet, colour, at);
            self.labels.place([at[0] - 7.0, at[1] - 7.0, at[0] + 7.0, at[1] + 7.0], name);
        } else {
            self.beyond.mark(MarkKind::Radar, colour, at);
        }
    }

    fn holds(&self, [x, y]: [f64; 2]) -> bool {
        self.axes.x.contains_px(x) && self.axes.y.contains_px(y)
    }

    /// Draws the outline and the name of a body.
    pub(super) fn body(&mut self, body: &Body) {
        let middle = self.world([body.place_m[0], body.place_m[1]]);
        let outline: Vec<[f64; 2]> = body.corners_m.iter().map(|p| self.world(*p)).collect();
        let outline = self.clipped(&outline);
        match &outline[..] {
            [] if body.corners_m.is_empty() && self.holds(middle) => {
                Mark::Cross.draw(&mut self.sheet, body.colour, middle);
                self.add_legend(Mark::Cross, body.colour, format!("{} (truth)", body.kind));
                self.labels
                    .place([middle[0] - 6.0, middle[1] - 6.0, middle[0] + 6.0, middle[1] + 6.0], &body.name);
            }
            [] => self.beyond.mark(MarkKind::Body, body.colour, middle),
            _ => {
                self.sheet.translucent_polygon(body.colour, &outline);
                self.add_legend(Mark::Outline, body.colour, format!("{} (truth)", body.kind));
                let x = outline.iter().map(|p| p[0]);
                let y = outline.iter().map(|p| p[1]);
                let (x, y) = (ends(x), ends(y));
                self.labels.place([x[0], y[0], x[1], y[1]], &body.name);
            }
        }
    }

    /// Draws a detected point or object: a mark if it is on the sheet, with a name if it has one.
    pub(super) fn found(
        &mut self,
        kind: MarkKind,
        mark: Mark,
        colour: &str,
        position_m: [f64; 3],
        name: &str,
    ) {
        let at = self.world([position_m[0], position_m[1]]);
        if !self.holds(at) {
            self.beyond.mark(kind, colour, at);
            return;
        }
        mark.draw(&mut self.sheet, colour, at);
        if !name.is_empty() {
            self.labels.place([at[0] - 8.0, at[1] - 8.0, at[0] + 8.0, at[1] + 8.0], name);
        }
    }

    /// The picture with its axes, names, edges and legend.
    pub(super) fn finish(mut self, [across, along]: [&str; 2]) -> Svg {
        let labels = if self.way == RoadDirection::Right { [along, across] } else { [across, along] };
        self.axes.draw(&mut self.sheet, labels[0], labels[1]);
        self.labels.draw(&mut self.sheet);
        if let Some(words) = self.beyond.draw(&mut self.sheet) {
            self.legend.add(Mark::Arrow, "plain", words);
        }
        let [left, right] = self.layout.sides_px();
        self.legend.draw(&mut self.sheet, self.axes.y.start_px + 62.0, [left - 44.0, right]);
        self.sheet
    }
}

fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
}

/// Axes to scale: as large as width and height allow beside their numbers, with more ground in the remaining
/// room.
fn axes(layout: Layout, way: RoadDirection, region: Region, top: f64) -> Axes {
    let sides_px = layout.sides_px();
    let usual = axes_between(sides_px, layout, way, region, top);
    // Numbers of a smaller scale are as long.
    let left = usual.with_room_beside(&usual.y.numbered()).x.start_px;
    if left > sides_px[0] { axes_between([left, sides_px[1]], layout, way, region, top) } else { usual }
}

fn axes_between(
    [left, right]: [f64; 2],
    layout: Layout,
    way: RoadDirection,
    region: Region,
    top: f64,
) -> Axes {
    let [least_px, most_px] = if layout == Layout::Wide { [230.0, 560.0] } else { [200.0, 470.0] };
    let [across_m, along_m] = region.sizes_m();
    let (width_m, height_m) =
        if way == RoadDirection::Right { (along_m, across_m) } else { (across_m, along_m) };
    let scale = ((right - left) / width_m).min(most_px / height_m);
    let height_px = (scale * height_m).max(least_px);
    let (more_width_m, more_height_m) = ((right - left) / scale - width_m, height_px / scale - height_m);
    let wider = |[low, high]: [f64; 2], by_m: f64| [low - 0.5 * by_m, high + 0.5 * by_m];
    let farther = |[low, high]: [f64; 2], by_m: f64| [low, high + by_m];
    let (x, y) = match way {
        RoadDirection::Right => {
            (farther(region.along_m, more_width_m), wider(region.across_m, more_height_m))
        }
        RoadDirection::Up => (wider(region.across_m, more_width_m), farther(region.along_m, more_height_m)),
    };
    // With a road to the right, its right side is at the bottom.
    let y = if way == RoadDirection::Right { [y[1], y[0]] } else { y };
    Axes {
        x: Axis { from: x[0], to: x[1], start_px: left, end_px: right },
        y: Axis { from: y[0], to: y[1], start_px: top + height_px, end_px: top },
    }
}
