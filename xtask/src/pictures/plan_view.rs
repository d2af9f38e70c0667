//! The scene from above: lanes, radar, true outlines, estimates and points.

use super::axes::{Axes, Axis};
use super::colours::class_colour;
use super::svg::Svg;
use crate::summary::FrameResult;
use artifact::scene::{Mesh, Pose, Role, SceneHeader, Target, TargetKind};
use glam::{DVec2, DVec3};

/// Darker than a body of no class.
const CLUTTER_COLOUR: &str = "#333333";

/// A sheet with the road on it: y runs to the right and x downwards, as seen from above.
pub(crate) struct PlanView {
    sheet: Svg,
    axes: Axes,
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
    let is_near = |pose: &Pose| (left - 2.0..=right + 2.0).contains(&pose.position_m[0]);
    if result.scene.poses.iter().all(is_near) { Extent::Lanes } else { Extent::Crossing }
}

/// Left and right rim of the lanes.
fn across_m(header: &SceneHeader) -> [f64; 2] {
    let lanes = &header.dsp.lanes;
    let left = lanes.iter().map(|l| l.centre_x_m - 0.5 * l.width_m).fold(-2.0, f64::min);
    let right = lanes.iter().map(|l| l.centre_x_m + 0.5 * l.width_m).fold(4.0, f64::max);
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
        let mut view = Self { sheet: Svg::new(title, end_px + 20.0, bottom_px + 45.0), axes };
        view.road(header);
        view
    }

    fn road(&mut self, header: &SceneHeader) {
        let crossing = header.intersection.width_m;
        let far = self.axes.x.to;
        for lane in &header.dsp.lanes {
            let (low, high) = (lane.centre_x_m - 0.5 * lane.width_m, lane.centre_x_m + 0.5 * lane.width_m);
            self.rectangle("road", [crossing, low], [far, high]);
            let name = format!("lane {}", lane.number);
            let at = self.place(DVec2::new(far, lane.centre_x_m));
            self.sheet.words([at[0] - 4.0, at[1] + 4.0], 10.5, "end", &name);
        }
        self.rectangle("road", [0.0, self.axes.y.from], [crossing, self.axes.y.to]);
        for lane in &header.dsp.lanes {
            for x in [lane.centre_x_m - 0.5 * lane.width_m, lane.centre_x_m + 0.5 * lane.width_m] {
                let (from, to) = (self.place(DVec2::new(crossing, x)), self.place(DVec2::new(far, x)));
                self.sheet.line("lane", from, to);
            }
        }
        self.axes.draw(&mut self.sheet, "y along the road, m", "x across, m");
        let radar = header.radar.position_m;
        let at = self.place(DVec2::new(radar[1], radar[0]));
        self.sheet.disc("#777777", at, 5.0);
        self.sheet.words([at[0] + 8.0, at[1] + 4.0], 11.0, "start", "radar");
    }

    fn rectangle(&mut self, class: &str, low: [f64; 2], high: [f64; 2]) {
        let (a, b) = (self.place(DVec2::from(low)), self.place(DVec2::from(high)));
        self.sheet.rectangle(class, [a[0].min(b[0]), a[1].min(b[1])], [(b[0] - a[0]).abs(), (b[1] - a[1]).abs()]);
    }

    /// Pixel of (along, across).
    fn place(&self, along_across: DVec2) -> [f64; 2] {
        [self.axes.x.at(along_across.x), self.axes.y.at(along_across.y)]
    }

    fn point(&mut self, position_m: [f64; 3]) {
        let at = self.place(DVec2::new(position_m[1], position_m[0]));
        self.sheet.disc("#d62728", at, 2.0);
    }

    fn object(&mut self, position_m: [f64; 3]) {
        let at = self.place(DVec2::new(position_m[1], position_m[0]));
        self.sheet.ring("#d62728", at, 7.0);
    }

    fn body(&mut self, header: &SceneHeader, body: &Target, pose: &Pose) {
        let origin = DVec3::from(pose.position_m);
        let mut label = self.place(DVec2::new(origin.y, origin.x));
        match &body.kind {
            TargetKind::Point { .. } => self.sheet.disc(class_colour(None), label, 4.0),
            TargetKind::Mesh { class, mesh, .. } => {
                let outline = header.meshes.get(*mesh as usize).map(|m| footprint(m, pose)).unwrap_or_default();
                let outline: Vec<[f64; 2]> = outline.into_iter().map(|p| self.place(DVec2::new(p.y, p.x))).collect();
                label[1] = outline.iter().map(|p| p[1]).fold(label[1], f64::min) - 5.0;
                let colour = if body.role == Role::Clutter { CLUTTER_COLOUR } else { class_colour(*class) };
                self.sheet.outline(colour, &outline);
            }
        }
        self.sheet.words(label, 11.0, "middle", &body.id);
    }

    /// The picture with its legend.
    pub(crate) fn finish(mut self) -> Svg {
        self.sheet.words(
            [60.0, 28.0],
            11.5,
            "start",
            "outlines: truth   ·   red dots: detected points   ·   red rings: objects",
        );
        self.sheet
    }
}

/// Corners of the bounding box on the ground, world x and y.
fn footprint(mesh: &Mesh, pose: &Pose) -> Vec<DVec2> {
    let fold =
        |axis: usize, pick: fn(f64, f64) -> f64, start: f64| mesh.vertices_m.iter().map(|v| v[axis]).fold(start, pick);
    let low = DVec2::new(fold(0, f64::min, f64::INFINITY), fold(1, f64::min, f64::INFINITY));
    let high = DVec2::new(fold(0, f64::max, f64::NEG_INFINITY), fold(1, f64::max, f64::NEG_INFINITY));
    let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    let turn = DVec2::from_angle(pose.yaw_rad);
    corners.map(|c| DVec2::new(pose.position_m[0], pose.position_m[1]) + turn.rotate(c)).to_vec()
}
