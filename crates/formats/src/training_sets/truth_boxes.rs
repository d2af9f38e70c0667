//! Boxes of a scene's bodies, the ground truth of training datasets: upright, of the mesh's length, width and
//! height, at the frame's middle.
//!
//! Every target with a class has a box; clutter, points and bodies without a class have none. Only the
//! scene's snapshot is read, so it is unknown whether a body is hidden.

use artifact::scene::{Pose, Role, Scene, SceneHeader, Target, TargetKind};
use artifact::settings::Class;
use artifact::{Provenance, Radar};
use glam::{DVec2, DVec3};
use pipeline::chain::keys::cube_header;
use pipeline::host::failure::Failure;
use pipeline::host::frame_matching::{FrameMatcher, ROUNDED_TIME_S, SAME_TIME_S, check_poses, check_time};
use pipeline::host::progress;
use pipeline::host::provenance_checks;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A body's box.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TruthBox {
    /// Number of the body in the whole scene, the same in all frames.
    pub(crate) number: u32,
    /// Name of the body.
    pub(crate) id: String,
    pub(crate) class: Class,
    /// Middle of the lower face, world metres.
    pub(crate) foot_m: DVec3,
    /// Length, width, height.
    pub(crate) size_m: [f64; 3],
    /// Forward direction from world +x towards +y.
    pub(crate) yaw_rad: f64,
    pub(crate) velocity_mps: DVec3,
}

impl TruthBox {
    /// Corners in world metres: those of the lower face, then those of the upper one.
    pub(crate) fn corners_m(&self) -> [DVec3; 8] {
        let [length, width, height] = self.size_m;
        std::array::from_fn(|corner| {
            let side = |bit: usize| if corner >> bit & 1 == 1 { 0.5 } else { -0.5 };
            let along = DVec2::new(side(0) * length, side(1) * width);
            let up_m = if corner >> 2 & 1 == 1 { height } else { 0.0 };
            self.foot_m + DVec2::from_angle(self.yaw_rad).rotate(along).extend(up_m)
        })
    }

    /// Middle in world metres.
    pub(crate) fn middle_m(&self) -> DVec3 {
        self.foot_m + DVec3::Z * (0.5 * self.size_m[2])
    }

    /// The place of the box nearest to a given place, which is that place itself if it is inside.
    pub(crate) fn nearest_m(&self, place_m: DVec3) -> DVec3 {
        let [length, width, height] = self.size_m;
        let away = place_m - self.foot_m;
        let in_body = DVec2::from_angle(-self.yaw_rad).rotate(away.truncate());
        let half = DVec2::new(0.5 * length, 0.5 * width);
        let nearest = in_body.clamp(-half, half);
        let turned = DVec2::from_angle(self.yaw_rad).rotate(nearest);
        self.foot_m + turned.extend(away.z.clamp(0.0, height))
    }
}

/// A sentence about the models of bodies that have no box for lack of a class.
fn without_class(header: &SceneHeader) -> Option<String> {
    let targets = header.targets.iter().filter(|target| target.role == Role::Target).map(|t| &t.kind);
    let recorded = header.traffic.iter().flat_map(|traffic| &traffic.vehicles).map(|vehicle| &vehicle.kind);
    let unclassed = targets.chain(recorded).filter(|kind| kind.class().is_none());
    let models: BTreeSet<&str> = unclassed.filter_map(|kind| kind.model().map(String::as_str)).collect();
    let names = models.iter().copied().collect::<Vec<_>>().join(", ");
    (!models.is_empty()).then(|| {
        format!(
            "bodies of {names} have no labels, as no class is told of them (`class` of [[target]] and of \
             `models` of [traffic])"
        )
    })
}

/// A scene read beside an artifact, as boxes of its frames.
pub(crate) struct TruthBoxes {
    file: PathBuf,
    scene: FrameMatcher<Scene>,
    header: SceneHeader,
    /// Whether the frames were made from the same scene file, so that their times must agree.
    is_same: bool,
    /// Least and greatest corner of each mesh, in body axes.
    extents_m: Vec<[DVec3; 2]>,
}

impl TruthBoxes {
    /// Opens the scene of an artifact with this `radar` and provenance.
    ///
    /// # Errors
    /// The file is not a scene, its radar is another one, or it was made from other files of the same names.
    pub(crate) fn open(file: &Path, radar: Option<&Radar>, from: &Provenance) -> Result<Self, Failure> {
        let scene = FrameMatcher::<Scene>::open(file, |frame| frame.index)?;
        let is_same = provenance_checks::same_scene(file, scene.provenance(), ("frames", from))?;
        let header = scene.header().clone();
        // Frames do not contain the errors of their radar.
        if radar.is_some_and(|radar| *radar != cube_header(&header).radar) {
            let rule = "its radar is not the one that the frames are of";
            return Err(Failure::Refused(format!("{}: {rule}", file.display())));
        }
        if let Some(told) = without_class(&header) {
            progress::note(format!("note: {}: {told}", file.display()));
        }
        let extents_m = header.meshes.iter().map(|mesh| mesh.bounds_m().map(DVec3::from)).collect();
        Ok(Self { file: file.to_owned(), scene, header, is_same, extents_m })
    }

    /// Header of the scene.
    pub(crate) fn header(&self) -> &SceneHeader {
        &self.header
    }

    /// Boxes of a frame at its middle, in the order of the scene's bodies; frames must be requested in order.
    pub(crate) fn of_frame(&mut self, index: u32, time_s: f64) -> Result<Vec<TruthBox>, Failure> {
        let frame = self.scene.frame(index)?;
        let within_s = if self.is_same { SAME_TIME_S } else { ROUNDED_TIME_S };
        check_time(&self.file, &frame, (time_s, within_s))?;
        let view = scene::frame_view(&self.header, index);
        check_poses(&self.file, &view, &frame)?;
        let middle_s = view.in_frame(index).radar.frame_middle_s();
        let numbers = scene::bodies_in_view(&self.header, index);
        let bodies = view.targets.iter().zip(&frame.poses).zip(numbers);
        let boxes = bodies.filter_map(|((target, pose), number)| {
            self.of_body(target, &radar::motion::pose_after(pose, middle_s), number)
        });
        let boxes: Vec<TruthBox> = boxes.collect();
        boxes.iter().try_for_each(|body| self.check(index, body))?;
        Ok(boxes)
    }

    fn of_body(&self, target: &Target, pose: &Pose, number: u32) -> Option<TruthBox> {
        let TargetKind::Mesh { class: Some(class), mesh, .. } = target.kind else { return None };
        let [low, high] = *self.extents_m.get(mesh as usize)?;
        if target.role != Role::Target {
            return None;
        }
        let middle = 0.5 * (low + high).truncate();
        let turned = DVec2::from_angle(pose.yaw_rad).rotate(middle);
        Some(TruthBox {
            number,
            id: target.id.clone(),
            class,
            foot_m: DVec3::from(pose.position_m) + turned.extend(low.z),
            size_m: (high - low).to_array(),
            yaw_rad: pose.yaw_rad,
            velocity_mps: pose.velocity_mps.into(),
        })
    }

    /// Refuses a box with invalid numbers.
    fn check(&self, index: u32, body: &TruthBox) -> Result<(), Failure> {
        let is_number = body.foot_m.is_finite()
            && body.velocity_mps.is_finite()
            && DVec3::from(body.size_m).is_finite()
            && body.yaw_rad.is_finite();
        if is_number {
            return Ok(());
        }
        let rule = format!("frame {index}, `{}`: place, size or motion is no number", body.id);
        Err(Failure::Refused(format!("{}: {rule}", self.file.display())))
    }
}
