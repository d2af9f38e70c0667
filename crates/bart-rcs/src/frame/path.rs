//! Path table of a frame: bodies frozen at the frame's middle, or traced at several moments where they
//! change, with every cell of their lit facets as a moving path.

use crate::bodies::body_gains::BodyGains;
use crate::bodies::models::Models;
use crate::bodies::road::check_road;
use crate::frame::blends::blending::{split, split_alike};
use crate::frame::cells::point_paths::point_paths;
use crate::frame::cells::small_part_paths::{relative_to, small_part_paths};
use crate::frame::frame_error::target_error::target_errors;
use crate::frame::frame_error::{FrameReference, reference};
use crate::frame::left_out::between_bodies::between_bodies_left_out;
use crate::frame::left_out::road::road_left_out;
use crate::frame::path_plan::Plan;
use crate::frame::path_table::{Fit, paths_as_fine};
use crate::frame::snapshot::nearest_surface::nearest_range_m;
use crate::frame::snapshot::{Snapshot, TracedScene};
use crate::joins::scatterer::check_order;
use crate::run_control::error::BartError;
use crate::run_control::progress::{NoProgress, Phase, Progress};
use crate::surface::skin::{COARSER, FinerSkin, reported_error};
use artifact::paths::{ErrorOrigin, Fineness, Path, PathsFrame, TraceStatistics};
use artifact::scene::{SceneFrame, SceneHeader};
use artifact::settings::Surface;
use artifact::{ErrorBudget, ModelError};

/// Context in which a frame is made.
#[derive(Clone, Copy)]
pub struct FrameContext<'a> {
    /// Nearby frame of the scene whose fineness is used and whose measured errors are reported for this one.
    /// Nothing is then traced or integrated twice, which makes a frame three to six times cheaper. If that
    /// frame had no bodies this one is measured itself, as reported by `trace.origin`.
    pub like: Option<&'a PathsFrame>,
    /// Receiver of progress reports.
    pub progress: &'a dyn Progress,
}

impl FrameContext<'static> {
    /// Measured itself, without progress reports.
    pub const ALONE: Self = Self { like: None, progress: &NoProgress };
}

/// [`crate::Tracer::all_paths`] for these models.
pub(crate) fn trace_frame(
    models: &Models,
    header: &SceneHeader,
    frame: &SceneFrame,
    context: &FrameContext<'_>,
) -> Result<PathsFrame, BartError> {
    check_order(header.fidelity.bounces)?;
    check_road(header)?;
    let gains = BodyGains::of(models, header, frame)?;
    let plan = Plan::of(header, frame, context.progress).with_gains(gains);
    let scenery = TracedScene { models, frame, plan: &plan, held_bytes: 0 };
    let result = match context.like.and_then(|measured| Some((measured, measured.trace.fineness.as_ref()?))) {
        Some((measured, fineness)) => traced_like(&scenery, measured, fineness),
        None => traced(&scenery),
    }?;
    check_amplitudes(header, &result)?;
    Ok(result)
}

/// Refuses paths whose amplitude is NaN or infinite: relative to them, every error would be.
fn check_amplitudes(header: &SceneHeader, frame: &PathsFrame) -> Result<(), BartError> {
    let is_finite = |path: &Path| path.amplitude_m.iter().flatten().all(|a| a.is_finite());
    let Some(path) = frame.paths.iter().find(|path| !is_finite(path)) else { return Ok(()) };
    let target = header.targets.get(path.target as usize).map_or("?", |target| &target.id);
    Err(BartError::AmplitudeNotFinite { place: format!("frame {}, target `{target}`", frame.index) })
}

fn traced(scenery: &TracedScene<'_>) -> Result<PathsFrame, BartError> {
    let (plan, frame) = (scenery.plan, scenery.frame);
    let header = plan.header;
    let points = point_paths(header, frame);
    // Bodies and beams of one moment at a time.
    let (reference, left_out, skin, check_bytes) = {
        let check = scenery.at(plan.check_s, plan.check_ends_m)?;
        let reference = reference(&check.scatterer(plan, Phase::Checking), plan, &points);
        let left_out = ModelError {
            road: road_left_out(&check.world, plan, &reference)?,
            between_bodies: between_bodies_left_out(&check.world, plan, &reference)?,
            ..reference.model_error()
        };
        let skin = (check.world.facets().len(), check.world.skin_error());
        (reference, left_out, skin, check.bytes())
    };
    let (reference, second_bytes) = with_second(scenery, reference)?;
    let tessellation = tessellation(scenery, &reference, skin)?;
    let (seen, table, small, has_bodies) = {
        let snapshot = scenery.at(plan.middle_s, [plan.position_m; 2])?;
        let scatterer = snapshot.scatterer(plan, Phase::Integrating);
        let fit = Fit::new(scenery, &scatterer, &points, &reference);
        let table = fit.table(&|table, others| {
            let beside = scenery.with_held_bytes(snapshot.bytes_beside() + others);
            split(&beside, table, &points, &reference)
        })?;
        let small = small_part_paths(&scatterer, plan);
        (FrameFindings::of(&snapshot, plan), table, small, !snapshot.world.facets().is_empty())
    };
    let errors = target_errors(plan, &table, &reference);
    let fineness = table.fineness.with_errors(errors);
    let small_parts = (!small.is_empty()).then(|| relative_to(reference.power_m2(), &small, plan));
    let measured = Measured {
        error: ErrorBudget { tessellation, ..table.error.budget() },
        model_error: ModelError { small_parts, ..left_out },
        dropped_power_ratio: table.error.dropped_at_most.powi(2),
        fineness: has_bodies.then_some(fineness),
        origin: ErrorOrigin::Measured,
        // The moments are traced while the frame's middle is held.
        bytes: check_bytes.max(second_bytes).max(table.bytes + seen.bytes),
    };
    let paths = table.paths.into_iter().chain(small).collect();
    Ok(paths_frame(plan, frame, seen, paths, measured))
}

/// Extends the reference by a second pair of elements if the array is wide; also returns the memory used,
/// bytes.
fn with_second(
    scenery: &TracedScene<'_>,
    reference: FrameReference,
) -> Result<(FrameReference, u64), BartError> {
    let plan = scenery.plan;
    let Some((ends_m, seconds)) = plan.second_check else { return Ok((reference, 0)) };
    let second = scenery.at(seconds, ends_m)?;
    let view = plan.view_from(ends_m, seconds);
    Ok((reference.with_second(&second.scatterer(plan, Phase::Checking), plan, view), second.bytes()))
}

/// Ratio ‖S(of facets subdivided for [`COARSER`] times the error) − S‖ over ‖S‖ at the moment of the check,
/// or with finer facets where these show more ([`FinerSkin`]), for a `reference` of this number of facets
/// subdivided for an error; `None` if facets are the surface.
fn tessellation(
    scenery: &TracedScene<'_>,
    reference: &FrameReference,
    (facets, skin_error): (usize, f64),
) -> Result<Option<f64>, BartError> {
    let plan = scenery.plan;
    let header = plan.header;
    if header.fidelity.surface == Surface::Flat {
        return Ok(None);
    }
    let difference = |models: Models| -> Result<(f64, usize), BartError> {
        let models = models.within(scenery.models.memory_limit);
        let other = TracedScene { models: &models, ..*scenery }.at(plan.check_s, plan.check_ends_m)?;
        Ok((reference.difference(&other.scatterer(plan, Phase::Checking), plan), other.world.facets().len()))
    };
    let (by_coarser, coarser) = difference(Models::build_coarser(header, COARSER * skin_error)?)?;
    let by_finer = match FinerSkin::affordable(facets, coarser, header.fidelity.bounces) {
        Some(cut) => cut.over_difference() * difference(Models::build_finer(header, cut.times)?)?.0,
        None => 0.0,
    };
    Ok(Some(reported_error(by_coarser.max(by_finer), skin_error)))
}

fn traced_like(
    scenery: &TracedScene<'_>,
    measured: &PathsFrame,
    fineness: &Fineness,
) -> Result<PathsFrame, BartError> {
    let (plan, frame) = (scenery.plan, scenery.frame);
    let (seen, kept, small) = {
        let snapshot = scenery.at(plan.middle_s, [plan.position_m; 2])?;
        let scatterer = snapshot.scatterer(plan, Phase::Integrating);
        let kept = paths_as_fine(scenery, &scatterer, fineness)?;
        (FrameFindings::of(&snapshot, plan), kept, small_part_paths(&scatterer, plan))
    };
    let mut paths = split_alike(scenery, kept, fineness)?;
    paths.extend(point_paths(plan.header, frame));
    paths.extend(small);
    let taken_over = Measured {
        error: ErrorBudget { detail: None, ..measured.error },
        model_error: measured.model_error,
        dropped_power_ratio: measured.trace.dropped_power_ratio,
        fineness: Some(fineness.clone()),
        origin: ErrorOrigin::TakenOver,
        bytes: 0,
    };
    Ok(paths_frame(plan, frame, seen, paths, taken_over))
}

/// Errors and statistics reported for a frame's paths.
struct Measured {
    error: ErrorBudget,
    model_error: ModelError,
    dropped_power_ratio: f64,
    fineness: Option<Fineness>,
    origin: ErrorOrigin,
    /// Peak memory of the comparison, bytes.
    bytes: u64,
}

/// Findings on the bodies and beams at the frame's middle.
struct FrameFindings {
    nearest_range_m: Vec<Option<f64>>,
    triangles: u64,
    beams: Vec<u64>,
    bytes: u64,
}

impl FrameFindings {
    fn of(snapshot: &Snapshot, plan: &Plan<'_>) -> Self {
        let Snapshot { world, tree, .. } = snapshot;
        Self {
            nearest_range_m: nearest_range_m(world, tree, plan.position_m, plan.header.targets.len()),
            triangles: world.triangles() as u64,
            beams: tree.audit.orders.iter().map(|order| order.beams).collect(),
            bytes: snapshot.bytes(),
        }
    }
}

fn paths_frame(
    plan: &Plan<'_>,
    frame: &SceneFrame,
    seen: FrameFindings,
    paths: Vec<Path>,
    measured: Measured,
) -> PathsFrame {
    PathsFrame {
        index: frame.index,
        time_s: frame.time_s,
        nearest_range_m: seen.nearest_range_m,
        error: measured.error,
        model_error: measured.model_error,
        trace: TraceStatistics {
            triangles: seen.triangles,
            beams: seen.beams,
            paths: (1..=plan.header.fidelity.bounces).map(|order| count(&paths, order)).collect(),
            dropped_power_ratio: measured.dropped_power_ratio,
            bytes: seen.bytes.max(measured.bytes),
            fineness: measured.fineness,
            origin: measured.origin,
            detail: vec![],
        },
        paths,
    }
}

fn count(paths: &[Path], order: u8) -> u64 {
    paths.iter().filter(|path| path.order == order).count() as u64
}
