//! Summary of one frame with its targets, objects, tracks and errors.

use crate::chain::frame_result::FrameResult;
use crate::chain::measured_frames::errors_of_frame;
use crate::chain::stages::Stage;
use crate::host::memory::peak_mib;
use crate::outcome::error_figures::{ErrorFigures, ModelErrorFigures, db};
use crate::outcome::false_objects::{self, FalseObject};
use crate::outcome::summary::targets::{ClutterSummary, TargetSummary};
use crate::outcome::summary::tracks::TrackSummary;
use crate::outcome::summary::words::DetailWord;
use crate::outcome::verdict::{AccuracyVerdict, RequestSource, Verdict};
use crate::planning::plan_figures::PlanFigures;
use artifact::paths::{self, PathsFrame};
use artifact::points::PointsFrame;
use artifact::scene::{Role, SceneHeader};
use artifact::settings::{Detail, StaticEchoes};
use evaluation::FrameTruth;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Summary of one frame: its targets, clutter, objects, tracks and errors.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameSummary {
    /// Time of the frame's first sample, s.
    pub time_s: f64,
    /// Wall-clock time of each stage, from its beginning to its end, s.
    pub stage_seconds: BTreeMap<Stage, f64>,
    /// Stages whose artifact was in the cache.
    pub cached: Vec<Stage>,
    /// Number of paths in the echo; `None` for echoes from tables.
    pub paths: Option<usize>,
    /// Level of detail of each target's paths; `None` for echoes from tables.
    pub detail: Option<Vec<TargetDetail>>,
    /// Number of detected points.
    pub points: usize,
    /// Number of points among them that give only the cone around the row: their range is less than the
    /// distance to the assumed height.
    #[serde(default)]
    pub points_without_height: usize,
    /// Whether the map shows velocities without aliasing.
    pub rdm_state: MapState,
    /// Whether there are objects, and the Doppler ambiguity of each is resolved.
    pub velocity_resolved: bool,
    /// Whether the numerical error is within the requested accuracy.
    pub accuracy: AccuracyVerdict,
    /// Estimated numerical error of the frame.
    pub error_db: ErrorFigures,
    /// The frame in which the paths' errors were measured; `None` for echoes from tables.
    pub error_measured_in: Option<u32>,
    /// Errors of the physical model.
    pub model_error_db: ModelErrorFigures,
    /// Largest number of bounces of paths over bodies; 0 for a scene without meshes.
    #[serde(default)]
    pub bounces: u8,
    /// Expected upper limit of the frame's memory, MiB.
    pub memory_estimate_mib: f64,
    /// Peak memory of the process until the frame's end, MiB; `None` where the system does not report it.
    pub peak_memory_mib: Option<f64>,
    /// Targets in view.
    pub targets: Vec<TargetSummary>,
    /// Bodies of clutter.
    pub clutter: Vec<ClutterSummary>,
    /// Objects of no target.
    pub false_objects: Vec<FalseObject>,
    /// Number of points at rest among `points`; `None` if the settings keep static echoes unmarked.
    pub stationary_points: Option<usize>,
    /// Objects at rest that belong to no body.
    pub stationary_objects: Vec<FalseObject>,
    /// Confirmed and coasting tracks.
    pub tracks: Vec<TrackSummary>,
}

/// State of a range-Doppler map, as in Table 2 of the paper.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MapState {
    /// Every target appears at its true velocity.
    #[default]
    Normal,
    /// The velocity of some target is aliased.
    Abnormal,
}

/// Level of detail of a target: the part of its paths that makes the echo.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TargetDetail {
    /// Level of detail in use; never `Auto`.
    #[serde(with = "DetailWord")]
    pub level: Detail,
    /// Number of traced paths.
    pub paths_traced: u64,
    /// Number of paths in the echo.
    pub paths: u64,
    /// Error of the target's echo relative to that of all its paths, dB; `None` if all were kept.
    pub error_db: Option<f64>,
}

impl FrameSummary {
    /// Summarizes a frame's result beside its ground truth.
    pub fn of(
        header: &SceneHeader,
        result: &FrameResult,
        truth: &FrameTruth,
        tracks: Vec<TrackSummary>,
    ) -> Self {
        Self::of_planned(header, None, (result, truth), tracks)
    }

    /// Summarizes a frame of a scene whose physics may have been planned.
    pub fn of_planned(
        header: &SceneHeader,
        plan: Option<&PlanFigures>,
        (result, truth): (&FrameResult, &FrameTruth),
        tracks: Vec<TrackSummary>,
    ) -> Self {
        let (paths, points) = (result.scattering.paths(), &result.points);
        let error_measured_in = paths.map(|paths| errors_of_frame(header, result.scene.index, paths));
        let header = &header.in_frame(result.scene.index);
        let of_role = |role: Role| (0..truth.truths.len()).filter(move |i| header.targets[*i].role == role);
        let targets: Vec<_> =
            of_role(Role::Target).map(|i| TargetSummary::of(header, result, truth, &tracks, i)).collect();
        let clutter = of_role(Role::Clutter).filter_map(|i| ClutterSummary::of(header, i, &truth.truths[i]));
        Self {
            time_s: result.scene.time_s,
            stage_seconds: result.seconds.iter().copied().collect(),
            cached: result.cached.clone(),
            paths: paths.map(|p| p.paths.len()),
            detail: paths.map(detail),
            points: points.points.len(),
            points_without_height: points.points_without_height(),
            rdm_state: state(&targets),
            velocity_resolved: !points.objects.is_empty()
                && points.objects.iter().all(|o| o.velocity_resolved),
            accuracy: Verdict::of_paths(&header.fidelity, &result.error, paths)
                .with_model_error(&result.model_error)
                .with_plan(plan)
                .for_summary(RequestSource::Scene),
            error_db: ErrorFigures::of(&result.error),
            error_measured_in,
            model_error_db: ModelErrorFigures::of(&result.model_error),
            bounces: if header.meshes.is_empty() { 0 } else { header.fidelity.bounces },
            memory_estimate_mib: result.memory_estimate_mib,
            peak_memory_mib: peak_mib(),
            targets,
            clutter: clutter.collect(),
            false_objects: false_objects::moving(header, result, truth),
            stationary_points: stationary_points(header, points),
            stationary_objects: false_objects::stationary(header, result, truth),
            tracks,
        }
    }
}

fn state(targets: &[TargetSummary]) -> MapState {
    let is_abnormal = targets.iter().any(|target| target.velocity_aliased);
    if is_abnormal { MapState::Abnormal } else { MapState::Normal }
}

fn stationary_points(header: &SceneHeader, points: &PointsFrame) -> Option<usize> {
    let at_rest = points.points.iter().filter(|point| point.stationary == Some(true));
    (header.dsp.static_echoes != StaticEchoes::Keep).then(|| at_rest.count())
}

fn detail(frame: &PathsFrame) -> Vec<TargetDetail> {
    let of = |target: &paths::TargetDetail| TargetDetail {
        level: target.level,
        paths_traced: target.traced,
        paths: target.kept,
        error_db: db(target.error),
    };
    frame.trace.detail.iter().map(of).collect()
}
