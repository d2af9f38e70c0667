//! Path table of a frame blended along time, the array's row, or both, from as few nodes as meet the
//! accuracy.

use crate::frame::band_power::power_over_frame;
use crate::frame::blends::axis::{BlendAxis, FINEST, GRID_STEPS, STEPS_OF_LOOKS};
use crate::frame::blends::changing_sequences::{bodies, least_missed, named, present_sequences};
use crate::frame::blends::nodes::{BlendContext, BlendNodes};
use crate::frame::frame_error::{FrameError, FrameReference, OmittedPowers};
use crate::frame::path_plan::{MOMENTS_MAX, PATHS_MAX, Plan};
use crate::frame::path_pruning::PrunedPaths;
use crate::frame::path_table::PathTable;
use crate::frame::snapshot::TracedScene;
use crate::run_control::error::BartError;
use artifact::paths::{Amplitude, Fineness, Path};

/// The table itself if its freezing error is within the requested accuracy; otherwise one in which the most
/// variable paths are blended from as few nodes as meet it, or the best found.
pub(crate) fn split(
    scenery: &TracedScene<'_>,
    whole: PathTable,
    points: &[Path],
    reference: &FrameReference,
) -> Result<PathTable, BartError> {
    if !needs_nodes(scenery.plan, &whole) {
        return Ok(whole);
    }
    let (fineness, strongest_dropped) = (whole.fineness.clone(), whole.strongest_dropped.clone());
    let middle = whole.paths.clone();
    let context = BlendContext {
        scenery,
        fineness: &fineness,
        strongest_dropped: &strongest_dropped,
        of_middle: middle.len(),
    };
    let mut blending =
        Blending { plan: scenery.plan, middle: &middle, points, reference, best: whole, along: vec![] };
    for axis in BlendAxis::ALL.into_iter().filter(|axis| scenery.changes_along(*axis)) {
        if needs_nodes(scenery.plan, &blending.best) {
            blending.add(axis, &context)?;
        }
    }
    Ok(blending.best)
}

/// Paths of the frame's middle, of which those blended in another frame are blended from the same number of
/// nodes.
pub(crate) fn split_alike(
    scenery: &TracedScene<'_>,
    kept: PrunedPaths,
    fineness: &Fineness,
) -> Result<Vec<Path>, BartError> {
    let PrunedPaths { paths: middle, strongest_dropped, .. } = kept;
    let (strongest_dropped, of_middle) = (strongest_dropped.as_slice(), middle.len());
    let context = BlendContext { scenery, fineness, strongest_dropped, of_middle };
    let mut along: Vec<BlendNodes<'_>> = Vec::new();
    for axis in BlendAxis::ALL {
        let (nodes, ways) = match axis {
            BlendAxis::Time => (fineness.moments, &fineness.ways),
            BlendAxis::Array => (fineness.places, &fineness.ways_of_places),
        };
        let ways = present_sequences(ways, scenery.plan);
        let steps = nodes.checked_sub(1).filter(|steps| GRID_STEPS.contains(steps) && !ways.is_empty());
        if let Some(steps) = steps {
            let mut nodes = BlendNodes::of(&context, axis, ways, &middle);
            nodes.fill(steps, along.iter().map(BlendNodes::paths).sum())?;
            along.push(nodes);
        }
    }
    if along.is_empty() {
        return Ok(middle);
    }
    Ok(blended(&middle, &along.iter().collect::<Vec<_>>()))
}

/// Whether a table misses the requested accuracy, mostly because of changes over the frame and the array.
fn needs_nodes(plan: &Plan<'_>, table: &PathTable) -> bool {
    table.error.measured() > plan.allowed_error() && table.error.is_mostly_freezing()
}

/// A frame blended along one axis after the other.
struct Blending<'a> {
    plan: &'a Plan<'a>,
    /// Paths of the frame's middle.
    middle: &'a [Path],
    points: &'a [Path],
    reference: &'a FrameReference,
    best: PathTable,
    /// Nodes of the best table, by axis.
    along: Vec<BlendNodes<'a>>,
}

impl<'a> Blending<'a> {
    /// Blends the paths that change along an axis from as few nodes as meet the accuracy, if that helps.
    fn add(&mut self, axis: BlendAxis, context: &'a BlendContext<'a>) -> Result<(), BartError> {
        let (before, others) = (self.best.paths.len(), self.along.iter().map(BlendNodes::paths).sum());
        let measured = self.best.error.measured();
        let mut nodes = BlendNodes::probed(context, axis, self.middle, (measured, others))?;
        if nodes.ways.is_empty() {
            return Ok(());
        }
        let power = power_over_frame(self.middle, self.plan);
        let most = if context.scenery.turns_wheels() { FINEST } else { MOMENTS_MAX - 1 };
        let mut best_steps = None;
        for steps in GRID_STEPS.into_iter().filter(|steps| *steps <= most) {
            if before + nodes.of_middle() * steps as usize > PATHS_MAX {
                break;
            }
            nodes.fill(steps, others)?;
            let (measured, is_best) = self.measure(&nodes);
            if is_best {
                best_steps = Some(steps);
            }
            let is_met = measured <= self.plan.allowed_error();
            // Between two or three nodes a phase rotated by whole cycles seems constant.
            let tells = steps >= STEPS_OF_LOOKS;
            if is_met || (tells && nodes.missed_halfway(steps / 2) < least_missed(measured, power)) {
                break;
            }
        }
        if let Some(steps) = best_steps {
            nodes.steps = steps;
            self.along.push(nodes);
        }
        Ok(())
    }

    /// Error of the table with these additional nodes, and whether it is the best so far, in which case it is
    /// kept.
    fn measure(&mut self, nodes: &BlendNodes<'a>) -> (f64, bool) {
        let along: Vec<&BlendNodes<'_>> = self.along.iter().chain([nodes]).collect();
        let paths = blended(self.middle, &along);
        let blends_power_m2 = along.iter().map(|nodes| nodes.missed_beside_check()).sum();
        let omitted_powers = OmittedPowers { blends_power_m2, ..self.best.omitted_powers };
        let error = FrameError::measured_on(self.plan, &paths, self.points, self.reference, &omitted_powers);
        let is_best = error.measured() < self.best.error.measured();
        if is_best {
            let (fineness, ways) = (&mut self.best.fineness, named(&nodes.ways, self.plan));
            match nodes.axis {
                BlendAxis::Time => (fineness.moments, fineness.ways) = (nodes.steps + 1, ways),
                BlendAxis::Array => (fineness.places, fineness.ways_of_places) = (nodes.steps + 1, ways),
            }
            let bytes = self.best.bytes.max(nodes.bytes);
            (self.best.paths, self.best.error, self.best.bytes) = (paths, error, bytes);
            self.best.omitted_powers = omitted_powers;
        }
        (error.measured(), is_best)
    }
}

/// Paths of the frame's middle without those that are blended, each subtracted once for every axis beyond the
/// first along which it is blended, followed by those of the nodes.
fn blended(middle: &[Path], along: &[&BlendNodes<'_>]) -> Vec<Path> {
    let own = middle.iter().filter_map(|path| {
        let way = bodies(path);
        match along.iter().filter(|nodes| nodes.ways.contains(&way)).count() {
            0 => Some(*path),
            1 => None,
            axes => Some(times(path, 1.0 - axes as f64)),
        }
    });
    own.chain(along.iter().flat_map(|nodes| nodes.blended())).collect()
}

fn times(path: &Path, factor: f64) -> Path {
    let of = |amplitude: Amplitude| amplitude.map(|row| row.map(|value| factor * value));
    Path { amplitude_m: of(path.amplitude_m), slope_m_per_hz: of(path.slope_m_per_hz), ..*path }
}
