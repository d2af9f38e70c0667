//! The scene from above as one radar has it: its lanes, true outlines, estimates and points.

use super::axes::{Axes, Axis};
use super::colours::class_colour;
use super::svg::Svg;
use crate::summary::FrameResult;
use artifact::scene::{Mesh, Pose, Role, SceneHeader, Target, TargetKind};
use artifact::settings::Lanes;
use glam::DVec2;

/// A sheet with the road on it: along it runs to the right, across it downwards, as seen from above.
struct PlanView {
    sheet: Svg,
    axes: Axes,
    road: Lanes,
    /// Points and objects that lie beyond the axes.
    beyond: usize,
}

/// Truth, points and estimates of one frame.
pub(super) fn of_frame(header: &SceneHeader, result: &FrameResult) -> Svg {
    let title = format!("Scene of frame {} from above", result.scene.index);
    let mut view = PlanView::new(header, title, extent(header, result));
    for point in &result.points.points {
        view.point(point.position_m);
    }
    for (target, pose) in header.targets.iter().zip(&result.scene.poses) {
        view.body(header, target, pose);
    }
    for object in &result.points.objects {
        view.object(object.position_m);
    }
    view.finish()
}

/// How far the sheet reaches across.
#[derive(Clone, Copy, PartialEq)]
enum Extent {
    /// The lanes.
    Lanes,
    /// As far as along.
    Crossing,
}

/// The lanes are enough where every target is in them or near.
fn extent(header: &SceneHeader, result: &FrameResult) -> Extent {
    let [left, right] = across_m(header);
    let across_m = |pose: &Pose| header.dsp.road.across_along_m(pose.position_m)[0];
    let is_near = |pose: &Pose| (left - 2.0..=right + 2.0).contains(&across_m(pose));
    if result.scene.poses.iter().all(is_near) { Extent::Lanes } else { Extent::Crossing }
}

/// Left and right rim of the lanes.
fn across_m(header: &SceneHeader) -> [f64; 2] {
    let lanes = &header.dsp.road.lanes;
    let left = lanes.iter().map(|l| l.centre_m - 0.5 * l.width_m).fold(-2.0, f64::min);
    let right = lanes.iter().map(|l| l.centre_m + 0.5 * l.width_m).fold(4.0, f64::max);
    [left, right]
}

impl PlanView {
    /// The empty road.
    fn new(header: &SceneHeader, title: String, extent: Extent) -> Self {
        let far = header.radar.waveform.range_max_m().clamp(10.0, 120.0);
        let [left, right] = if extent == Extent::Lanes { across_m(header) } else { [-far, far] };
        // Lanes are drawn wider than they are, so that labels have room; a crossing is drawn to scale.
        const PX_PER_M: f64 = 8.0;
        let [end_px, bottom_px] = match extent {
            Extent::Lanes => [740.0, 265.0],
            Extent::Crossing => [60.0 + PX_PER_M * (far + 2.0), 45.0 + PX_PER_M * (2.0 * far + 4.0)],
        };
        let axes = Axes {
            x: Axis { from: -2.0, to: far, start_px: 60.0, end_px },
            y: Axis { from: right + 2.0, to: left - 2.0, start_px: bottom_px, end_px: 45.0 },
        };
        let (sheet, road) = (Svg::new(title, end_px + 20.0, bottom_px + 45.0), header.dsp.road.clone());
        let mut view = Self { sheet, axes, road, beyond: 0 };
        view.road(header);
        view
    }

    fn road(&mut self, header: &SceneHeader) {
        let crossing = header.intersection.width_m;
        let far = self.axes.x.to;
        for lane in &header.dsp.road.lanes {
            let (low, high) = (lane.centre_m - 0.5 * lane.width_m, lane.centre_m + 0.5 * lane.width_m);
            self.rectangle("road", [crossing, low], [far, high]);
            let name = format!("lane {}", lane.number);
            let at = self.pixel([lane.centre_m, far]);
            self.sheet.words([at[0] - 4.0, at[1] + 4.0], 10.5, "end", &name);
        }
        self.rectangle("road", [0.0, self.axes.y.from], [crossing, self.axes.y.to]);
        for lane in &header.dsp.road.lanes {
            for across_m in [lane.centre_m - 0.5 * lane.width_m, lane.centre_m + 0.5 * lane.width_m] {
                let (from, to) = (self.pixel([across_m, crossing]), self.pixel([across_m, far]));
                self.sheet.line("lane", from, to);
            }
        }
        self.axes.draw(&mut self.sheet, "along the road, m", "across, m");
        let at = self.place(header.radar.position_m);
        self.sheet.disc("#777777", at, 5.0);
        self.sheet.words([at[0] + 8.0, at[1] + 4.0], 11.0, "start", "radar");
    }

    /// Corners as (along, across).
    fn rectangle(&mut self, class: &str, low: [f64; 2], high: [f64; 2]) {
        let (a, b) = (self.pixel([low[1], low[0]]), self.pixel([high[1], high[0]]));
        self.sheet.rectangle(class, [a[0].min(b[0]), a[1].min(b[1])], [(b[0] - a[0]).abs(), (b[1] - a[1]).abs()]);
    }

    /// Pixel of a place across and along the road.
    fn pixel(&self, [across_m, along_m]: [f64; 2]) -> [f64; 2] {
        [self.axes.x.at(along_m), self.axes.y.at(across_m)]
    }

    /// Pixel of a place of the world.
    fn place(&self, position_m: [f64; 3]) -> [f64; 2] {
        self.pixel(self.road.across_along_m(position_m))
    }

    /// Pixel of what was found, where it lies on the sheet.
    fn found(&mut self, position_m: [f64; 3]) -> Option<[f64; 2]> {
        let at = self.place(position_m);
        self.beyond += usize::from(!self.holds(at));
        self.holds(at).then_some(at)
    }

    fn holds(&self, [x, y]: [f64; 2]) -> bool {
        self.axes.x.holds(x) && self.axes.y.holds(y)
    }

    fn point(&mut self, position_m: [f64; 3]) {
        if let Some(at) = self.found(position_m) {
            self.sheet.disc("#d62728", at, 2.0);
        }
    }

    fn object(&mut self, position_m: [f64; 3]) {
        if let Some(at) = self.found(position_m) {
            self.sheet.ring("#d62728", at, 7.0);
        }
    }

    fn body(&mut self, header: &SceneHeader, body: &Target, pose: &Pose) {
        let mut label = self.place(pose.position_m);
        if !self.holds(label) {
            return;
        }
        match &body.kind {
            TargetKind::Point { .. } => self.sheet.disc(body_colour(body), label, 4.0),
            TargetKind::Mesh { mesh, .. } => {
                let outline = header.meshes.get(*mesh as usize).map(|m| footprint(m, pose)).unwrap_or_default();
                let outline: Vec<[f64; 2]> = outline.into_iter().map(|p| self.place([p.x, p.y, 0.0])).collect();
                label[1] = outline.iter().map(|p| p[1]).fold(label[1], f64::min) - 5.0;
                self.sheet.outline(body_colour(body), &outline);
            }
        }
        self.sheet.words(label, 11.0, "middle", &body.id);
    }

    /// The picture with its legend.
    fn finish(mut self) -> Svg {
        let legend = "outlines: truth   ·   red dots: detected points   ·   red rings: objects";
        let beyond = match self.beyond {
            0 => String::new(),
            many => format!("   ·   beyond the sheet: {many}"),
        };
        self.sheet.words([60.0, 28.0], 11.5, "start", &format!("{legend}{beyond}"));
        self.sheet
    }
}

/// Colour of a body by its class; clutter is darker than a body of none.
pub(super) fn body_colour(body: &Target) -> &'static str {
    match &body.kind {
        TargetKind::Mesh { .. } if body.role == Role::Clutter => "#333333",
        TargetKind::Mesh { class, .. } => class_colour(*class),
        TargetKind::Point { .. } => class_colour(None),
    }
}

/// Corners of the bounding box on the ground, world x and y.
pub(super) fn footprint(mesh: &Mesh, pose: &Pose) -> Vec<DVec2> {
    let fold =
        |axis: usize, pick: fn(f64, f64) -> f64, start: f64| mesh.vertices_m.iter().map(|v| v[axis]).fold(start, pick);
    let low = DVec2::new(fold(0, f64::min, f64::INFINITY), fold(1, f64::min, f64::INFINITY));
    let high = DVec2::new(fold(0, f64::max, f64::NEG_INFINITY), fold(1, f64::max, f64::NEG_INFINITY));
    let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    let turn = DVec2::from_angle(pose.yaw_rad);
    corners.map(|c| DVec2::new(pose.position_m[0], pose.position_m[1]) + turn.rotate(c)).to_vec()
}
