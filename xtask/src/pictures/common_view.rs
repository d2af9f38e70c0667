//! The scene from above as several radars have it together: north is up, to scale.

use super::axes::{Axes, Axis};
use super::colours::line_colour;
use super::plan_view::{body_colour, footprint};
use super::svg::Svg;
use crate::products::Seen;
use artifact::scene::{Pose, SceneHeader, Target, TargetKind};

const PX_PER_M: f64 = 8.0;
/// Around what is to be seen.
const MARGIN_M: f64 = 10.0;
/// Length of the two lines that show where a radar looks, and half the angle between them.
const GAZE: (f64, f64) = (5.0, 0.5);

/// One frame: what there was, and the points and objects of each radar in a colour of its own. `radars` are names and what they
/// saw, at least one.
pub(crate) fn common_view(radars: &[(&str, &Seen)]) -> Svg {
    let number = radars.first().map_or(0, |(_, seen)| seen.scene.index);
    let mut view = CommonView::of(format!("Frame {number} from above, as all radars have it"), radars);
    for (_, seen) in radars {
        view.lanes(&seen.view);
    }
    view.axes.draw(&mut view.sheet, "x, m", "y, m");
    for (target, pose, header) in bodies(radars) {
        view.body(header, target, pose);
    }
    for (n, (id, seen)) in radars.iter().enumerate() {
        view.seen(line_colour(n), id, seen);
    }
    view.sheet
}

/// Every body once, though several radars have it in view.
fn bodies<'a>(radars: &[(&str, &'a Seen)]) -> Vec<(&'a Target, &'a Pose, &'a SceneHeader)> {
    let mut bodies: Vec<(&Target, &Pose, &SceneHeader)> = vec![];
    for (_, seen) in radars {
        for (target, pose) in seen.view.targets.iter().zip(&seen.scene.poses) {
            if !bodies.iter().any(|(known, ..)| known.id == target.id) {
                bodies.push((target, pose, &seen.view));
            }
        }
    }
    bodies
}

struct CommonView {
    sheet: Svg,
    axes: Axes,
}

impl CommonView {
    /// As large as bodies and radars need it.
    fn of(title: String, radars: &[(&str, &Seen)]) -> Self {
        let radar = |(_, seen): &(&str, &Seen)| seen.view.radar.position_m;
        let places: Vec<[f64; 3]> =
            bodies(radars).iter().map(|(_, pose, _)| pose.position_m).chain(radars.iter().map(radar)).collect();
        let span = |axis: usize| {
            let values = places.iter().map(|place| place[axis]);
            let (low, high) = values.fold((0.0, 0.0), |(low, high): (f64, f64), v| (low.min(v), high.max(v)));
            (low - MARGIN_M, high + MARGIN_M)
        };
        let ((x0, x1), (y0, y1)) = (span(0), span(1));
        let (end_px, bottom_px) = (60.0 + PX_PER_M * (x1 - x0), 30.0 + PX_PER_M * (y1 - y0));
        let axes = Axes {
            x: Axis { from: x0, to: x1, start_px: 60.0, end_px },
            y: Axis { from: y0, to: y1, start_px: bottom_px, end_px: 30.0 },
        };
        Self { sheet: Svg::new(title, end_px + 20.0, bottom_px + 45.0), axes }
    }

    fn pixel(&self, x_m: f64, y_m: f64) -> [f64; 2] {
        [self.axes.x.at(x_m), self.axes.y.at(y_m)]
    }

    /// A pixel moved to the nearest that lies on the sheet.
    fn kept(&self, x_m: f64, y_m: f64) -> [f64; 2] {
        let within = |axis: &Axis, v: f64| v.clamp(axis.from.min(axis.to), axis.from.max(axis.to));
        self.pixel(within(&self.axes.x, x_m), within(&self.axes.y, y_m))
    }

    /// Rims of a radar's lanes, from the crossing to the end of its range.
    fn lanes(&mut self, header: &SceneHeader) {
        let (road, far_m) = (&header.dsp.road, header.radar.waveform.range_max_m());
        for lane in &road.lanes {
            for across_m in [lane.centre_m - 0.5 * lane.width_m, lane.centre_m + 0.5 * lane.width_m] {
                let ends = [header.intersection.width_m, far_m].map(|along_m| road.world_m([across_m, along_m]));
                let [from, to] = ends.map(|[x_m, y_m]| self.kept(x_m, y_m));
                self.sheet.line("lane", from, to);
            }
        }
    }

    fn body(&mut self, header: &SceneHeader, body: &Target, pose: &Pose) {
        let [x_m, y_m, _] = pose.position_m;
        let mut label = self.pixel(x_m, y_m);
        match &body.kind {
            TargetKind::Point { .. } => self.sheet.disc(body_colour(body), label, 4.0),
            TargetKind::Mesh { mesh, .. } => {
                let outline = header.meshes.get(*mesh as usize).map(|m| footprint(m, pose)).unwrap_or_default();
                let outline: Vec<[f64; 2]> = outline.into_iter().map(|p| self.pixel(p.x, p.y)).collect();
                label[1] = outline.iter().map(|p| p[1]).fold(label[1], f64::min) - 5.0;
                self.sheet.outline(body_colour(body), &outline);
            }
        }
        self.sheet.words(label, 11.0, "middle", &body.id);
    }

    /// The radar, the way it looks, its points and its objects.
    fn seen(&mut self, colour: &str, id: &str, seen: &Seen) {
        let radar = &seen.view.radar;
        let [x_m, y_m, _] = radar.position_m;
        let at = self.pixel(x_m, y_m);
        let (length_m, half_angle) = GAZE;
        for turn in [-half_angle, half_angle] {
            let (sin, cos) = (radar.boresight_az_rad + turn).sin_cos();
            self.sheet.polyline(colour, 1.5, &[at, self.pixel(x_m + length_m * sin, y_m + length_m * cos)]);
        }
        self.sheet.disc(colour, at, 5.0);
        let (sin, cos) = radar.boresight_az_rad.sin_cos();
        let name = self.pixel(x_m + 1.4 * length_m * sin, y_m + 1.4 * length_m * cos);
        self.sheet.words([name[0], name[1] + 4.0], 11.0, "middle", id);
        for point in &seen.points.points {
            self.found(point.position_m, |sheet, at| sheet.disc(colour, at, 2.0));
        }
        for object in &seen.points.objects {
            self.found(object.position_m, |sheet, at| sheet.ring(colour, at, 7.0));
        }
    }

    fn found(&mut self, position_m: [f64; 3], draw: impl FnOnce(&mut Svg, [f64; 2])) {
        let at = self.pixel(position_m[0], position_m[1]);
        if self.axes.x.holds(at[0]) && self.axes.y.holds(at[1]) {
            draw(&mut self.sheet, at);
        }
    }
}
