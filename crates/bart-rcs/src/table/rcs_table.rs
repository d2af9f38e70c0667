//! Scattering amplitude of a mesh over frequency, elevation and azimuth: far field or finite range, one
//! antenna or two.

use crate::beams::beam::{BeamTree, TraceSettings};
use crate::bodies::world::World;
use crate::joins::join::tree_order;
use crate::joins::scatterer::check_order;
use crate::joins::small_parts::sum_of_small_parts;
use crate::run_control::cancellation::CancellationCheck;
use crate::run_control::error::BartError;
use crate::run_control::memory::{MemoryLimit, memory_estimate_bytes};
use crate::run_control::progress::{Phase, Progress};
use crate::run_control::work_meter::WorkMeter;
use crate::table::aspect::{AspectContext, Scattering, scattering_with};
use crate::table::aspect_settings::{AspectSettings, Check, Checks, IntegralsCheck};
use crate::table::checkpoint::{CheckpointKey, CheckpointStore, NoCheckpoint};
use crate::table::far_field_error::{FarFieldError, far_field_error};
use crate::table::finer_mirrors::{FinerMirrors, dropped_error};
use crate::table::measured_aspects::{
    ALL_UP_TO, MeasuredAspects, compared_aspects, error_of_sample, interpolation_error, measured_error,
};
use crate::table::rcs_request::{Aspect, RcsRequest, traced_aspects};
use crate::table::skin_comparison::{SkinComparison, skin};
use artifact::scene::Mesh;
use artifact::settings::{Edges, NodeRule, SmallParts};
use artifact::units::amplitude_ratio;
use artifact::{ErrorBudget, ModelError};
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// Scattering amplitude S in metres, with its errors and statistics.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RcsResult {
    /// Scattering amplitude S, row-major `[frequency, elevation, azimuth]`, phase at the body's origin.
    pub amplitude_m: Vec<Complex64>,
    /// Scattering amplitude by bounce order, from order 1; their sum is `amplitude_m`.
    pub by_order_m: Vec<Vec<Complex64>>,
    /// Number of beams by order of their tree, over all aspects and both ends; orders needed only for the
    /// comparison of node rules are traced where that is made.
    pub beams: Vec<u64>,
    /// Work by phase, as measured by [`RcsContext::clock_s`]: of all threads, and of all runs from which
    /// aspects were kept.
    pub seconds: RcsSeconds,
    /// Whether S is mere rounding relative to the other polarizations, like the cross-polarized component of
    /// a single reflection back to a conductor, by symmetry: no error can be relative to it, and none is
    /// reported.
    pub vanishes: bool,
    /// Numerical error over the table.
    pub error: ErrorBudget,
    /// Errors of the physical model, over the table.
    pub model_error: ModelError,
    /// Node spread per order from 1: ‖S − S(by the other node rule)‖ of that order over ‖S‖ of all, where the
    /// other rule is exit, and middle for exit; measured at 33 to 64 aspects of a larger table.
    pub node_spread: Vec<f64>,
    /// Largest sum over one aspect of the maximum scattering of dropped beams, over the table's root mean
    /// square |S|.
    pub dropped_at_most: f64,
    /// Mirrors followed to keep the dropped part within the accuracy.
    pub mirrors: MirrorRefinement,
    /// Error of the table at the ranges of a road; `None` if it has a finite range, or is too small to
    /// measure it.
    pub far_field: Option<FarFieldError>,
}

/// Refinement of the smallest followed mirrors.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MirrorRefinement {
    /// Smallest area across the wave over all aspects, m².
    pub least_area_m2: f64,
    /// Number of aspects retraced with smaller mirrors than the rest.
    pub traced_again: u64,
}

/// Seconds of work by phase.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RcsSeconds {
    /// Hierarchy of the mesh.
    pub build: f64,
    /// Beam trees.
    pub trace: f64,
    /// Joins and integrals.
    pub integrate: f64,
    /// Measurement of the errors: finer integrals, the other node rule and the deeper trees that it needs.
    pub check: f64,
}

/// Scattering amplitude S of a mesh in body axes.
///
/// One tree (two with a separate receiver) serves all frequencies of an aspect. `progress` receives (aspects
/// done, aspects). The same request gives the same bytes for any number of threads, except for `seconds`.
///
/// At finite range, and with edges, the error of the integrals is measured against integrals ten times finer:
/// at every aspect of a table of up to eight, where the finer ones are the result, and at up to six of a
/// larger one, including the strongest. If it exceeds the requested accuracy, everything is integrated more
/// finely. If the dropped part exceeds it, the aspects that drop too much are retraced with smaller mirrors,
/// at most three times and as far as memory permits. Errors of the model are measured at 33 to 64 aspects of
/// a table of more than 64, one drawn from each of equal parts, and are relative to the whole table.
pub fn rcs(
    mesh: &Mesh,
    request: &RcsRequest,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<RcsResult, BartError> {
    let aspects = |phase: Phase, done: usize, of: usize| {
        if phase == Phase::Aspects {
            progress(done, of);
        }
    };
    let (memory_limit, start) = (MemoryLimit::NONE, Instant::now());
    let clock_s = &|| start.elapsed().as_secs_f64();
    rcs_within(
        mesh,
        request,
        &RcsContext {
            memory_limit,
            checkpoint: &NoCheckpoint,
            progress: &aspects,
            clock_s,
            cancellation: CancellationCheck::NEVER,
        },
    )
}

/// Refuses a table with an amplitude that is NaN or infinite: relative to it, every error would be.
fn check_amplitudes(result: &RcsResult) -> Result<(), BartError> {
    match result.amplitude_m.iter().position(|a| !a.is_finite()) {
        None => Ok(()),
        Some(index) => Err(BartError::AmplitudeNotFinite { place: format!("value {index} of the table") }),
    }
}

/// Context in which a table is made: limits, checkpoint, progress, clock, cancellation.
pub struct RcsContext<'a> {
    /// Memory limit: a mesh predicted to need more is refused before it is traced, and trees that exceed
    /// their share are abandoned with an error.
    pub memory_limit: MemoryLimit,
    /// Storage of finished aspects, which are not computed again; the result is the same to the byte.
    pub checkpoint: &'a dyn CheckpointStore,
    /// Receiver of progress reports.
    pub progress: &'a dyn Progress,
    /// Processor time of the program so far, s, over all processors: the basis of [`RcsSeconds`].
    pub clock_s: &'a (dyn Fn() -> f64 + Sync),
    /// Checked before each aspect is begun; a cancelled table has no result.
    pub cancellation: CancellationCheck<'a>,
}

/// Like [`rcs`], in a context that may limit it and store finished aspects.
pub fn rcs_within(
    mesh: &Mesh,
    request: &RcsRequest,
    context: &RcsContext<'_>,
) -> Result<RcsResult, BartError> {
    check(request)?;
    let limit = context.memory_limit;
    let meter = WorkMeter::new(context.clock_s);
    let start_s = meter.total_s();
    let count = request.elevation_rad.len() * request.azimuth_rad.len();
    let at_a_time = count.min(rayon::current_num_threads());
    let fits = |triangles: usize| {
        limit.check_estimate(triangles, memory_estimate_bytes(triangles, request.bounces, at_a_time))
    };
    fits(mesh.triangles.len())?;
    context.progress.at(Phase::Building, 0, 0);
    let world = World::of_skin(mesh, skin(request))?;
    fits(world.facets().len())?;
    let limit = limit.shared(world.bytes() as u64, at_a_time);
    let world = world.within(limit);
    let aspects = traced_aspects(request, &world);
    let build = meter.total_s() - start_s;
    let asked = request.accuracy.amplitude().max(1e-8);
    let accuracy = first_bound(asked, &world, request.edges, aspects.len());
    let start_s = meter.total_s();
    let first = aspect_settings(request, &world, accuracy);
    let received = tree_of_receiver(&world, &aspects, &first, context.progress)?;
    let trace = meter.total_s() - start_s;
    let meter = &meter;
    let sweep = SharedByAspects {
        world: &world,
        aspects: &aspects,
        compared: compared_aspects(aspects.len()),
        edges: request.edges,
        received: received.as_ref(),
        context,
        meter,
    };
    let FineTable { table, settings, mirrors } = sweep.fine_table(first, asked)?;
    let mut result = result(request, &table, build);
    check_amplitudes(&result)?;
    let (traced_again, share) = mirrors.reached();
    result.mirrors =
        MirrorRefinement { least_area_m2: share * settings.trace.least_mirror_area_m2, traced_again };
    if result.vanishes {
        return Ok(result);
    }
    let interpolation = interpolation_error(&world, request.frequency_hz.len(), settings.accuracy);
    result.error.integration = result.error.integration.map(|error| error.max(interpolation));
    let start_s = meter.total_s();
    context.progress.at(Phase::Checking, 0, 0);
    let cancellation = context.cancellation;
    let other =
        SkinComparison { mesh, request, aspects: &aspects, settings: &settings, table: &table, cancellation };
    result.error.tessellation = other.tessellation(&world)?;
    result.model_error.transmission = other.transmission_left_out()?;
    result.far_field = far_field_error(&world, request, &settings, &table, cancellation)?;
    if request.small_parts == SmallParts::Statistical {
        sweep.add_small_parts(&mut result, &settings)?;
    }
    result.seconds.trace += trace;
    result.seconds.check += meter.total_s() - start_s;
    Ok(result)
}

pub(crate) fn check(request: &RcsRequest) -> Result<(), BartError> {
    check_order(request.bounces)?;
    if let Some(&found) = request.frequency_hz.iter().find(|f| !(f.is_finite() && **f > 0.0)) {
        return Err(BartError::FrequencyNotPositive { frequency_hz: found });
    }
    let ranges = request.receiver.iter().map(|r| r.range_m).chain([request.range_m]);
    if let Some(range_m) = ranges.into_iter().find(|r| r.is_nan() || *r <= 0.0) {
        return Err(BartError::RangeNotPositive { range_m });
    }
    Ok(())
}

fn mean_facet_m2(world: &World) -> f64 {
    let facets = world.facets();
    facets.iter().map(|facet| facet.area_m2).sum::<f64>() / facets.len().max(1) as f64
}

/// Initial bound on every tile's error, relative like `asked`; integrals that exceed the requested error are
/// made finer.
///
/// Bounds are far above errors, which cancel from tile to tile: for cars and lorries 30 m away with bounds of
/// −40 dB the integrals err by −56 to −65 dB, for spheres with −20 dB by −64 dB. Above −10 dB of a flat facet
/// necessary subdivisions are missing: the side of a bus errs by −8 dB with bounds of 0 and of −6 dB, by −17
/// dB with −12 dB.
///
/// With edges, aspects differ by more: for a large table, of which only some are measured, bounds start at
/// the requested accuracy.
fn first_bound(asked: f64, world: &World, edges: Edges, aspects: usize) -> f64 {
    const BOUND_OVER_ERROR: f64 = 7.0;
    const LARGEST_ON_FLAT: f64 = 0.25;
    if edges == Edges::FirstOrder && aspects > ALL_UP_TO {
        return asked;
    }
    let largest = if world.skin_error() > 0.0 { f64::INFINITY } else { LARGEST_ON_FLAT };
    (BOUND_OVER_ERROR * asked).min(largest)
}

/// Share of the requested error at which finer integrals aim, based on the error of the coarser ones.
const ERROR_AIMED_AT: f64 = 0.7;
/// Maximum number of tiles with which an aspect's integrals start: some seconds of one processor.
const FEW_TILES: u64 = 2_000_000;
/// Maximum number of tiles of an aspect's integrals in the end, if errors are still larger than requested;
/// these are reported.
const MOST_TILES: u64 = 50_000_000;

pub(crate) fn aspect_settings(request: &RcsRequest, world: &World, accuracy: f64) -> AspectSettings {
    let wavenumbers_per_m = request.wavenumbers_per_m();
    let shortest_m = TAU / wavenumbers_per_m.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    // λ²/100·accuracy (physics §2), or that share of the mean facet if facets are smaller than the
    // wavelength: a fine mesh must not be dropped completely. The smallest mirrors followed are a hundred
    // times that size.
    let least_area_m2 =
        1e-2 * mean_facet_m2(world).min(shortest_m * shortest_m) * request.accuracy.amplitude();
    let both = tree_order(request.bounces, NodeRule::Exit).max(tree_order(request.bounces, NodeRule::Middle));
    AspectSettings {
        trace: TraceSettings {
            max_order: both,
            sides: request.sides,
            least_area_m2,
            least_mirror_area_m2: 100.0 * least_area_m2,
        },
        wavenumbers_per_m,
        bounces: request.bounces,
        nodes: request.nodes,
        edges: request.edges,
        polarization: request.polarization,
        accuracy,
        most_tiles: FEW_TILES,
    }
}

/// Offset of the numbers of measuring passes, which follow those that make the table.
const MEASURING: u32 = 1 << 16;

/// Data shared by all aspects of a table: bodies, hierarchy, patches, edges and skin are the world's, built
/// once.
struct SharedByAspects<'a> {
    world: &'a World,
    aspects: &'a [Aspect],
    /// Indices of the aspects at which errors of the model are measured, ascending.
    compared: Vec<usize>,
    edges: Edges,
    /// Tree of a stationary receiver, which does not depend on the aspect.
    received: Option<&'a BeamTree>,
    context: &'a RcsContext<'a>,
    meter: &'a WorkMeter<'a>,
}

/// Beam tree of a stationary receiver, if more than one aspect needs it.
fn tree_of_receiver(
    world: &World,
    aspects: &[Aspect],
    settings: &AspectSettings,
    progress: &dyn Progress,
) -> Result<Option<BeamTree>, BartError> {
    match aspects {
        [Aspect { receive: Some((antenna, _)), .. }, _, ..] => BeamTree::trace_from_outside(
            world,
            *antenna,
            settings.longest_wave_m(),
            &settings.trace,
            progress,
        )
        .map(Some),
        _ => Ok(None),
    }
}

/// A table with its final settings.
struct FineTable {
    table: Vec<Scattering>,
    /// Settings before mirrors were made smaller anywhere.
    settings: AspectSettings,
    mirrors: FinerMirrors,
}

impl SharedByAspects<'_> {
    /// Adds the small parts drawn on what both ends see at each aspect, with their share of the whole.
    fn add_small_parts(&self, result: &mut RcsResult, settings: &AspectSettings) -> Result<(), BartError> {
        let (p, q) = settings.polarization.indices();
        let of = |aspect: &Aspect| {
            let ends = (aspect.transmit, aspect.receive);
            let drawn = sum_of_small_parts(self.world, ends, &settings.trace, &settings.wavenumbers_per_m)?;
            Ok(drawn.iter().map(|s| s[p][q]).collect())
        };
        let drawn = self.aspects.par_iter().map(of).collect::<Result<Vec<Vec<Complex64>>, _>>()?;
        let power = |s: &[Complex64]| s.iter().map(|s| s.norm_sqr()).sum::<f64>();
        let drawn_power: f64 = drawn.iter().map(|of| power(of)).sum();
        result.model_error.small_parts = Some(amplitude_ratio(drawn_power, power(&result.amplitude_m)));
        let by_frequency =
            (0..settings.wavenumbers_per_m.len()).flat_map(|f| drawn.iter().map(move |s| s[f]));
        for (index, added) in by_frequency.enumerate() {
            result.amplitude_m[index] += added;
            result.by_order_m[0][index] += added;
        }
        Ok(())
    }

    /// Table with all aspects integrated more finely, and some traced more finely as needed, until both
    /// errors are as requested or no further improvement is possible.
    fn fine_table(&self, mut settings: AspectSettings, asked: f64) -> Result<FineTable, BartError> {
        let all: Vec<usize> = (0..self.aspects.len()).collect();
        let mut mirrors = FinerMirrors::of_none(all.len());
        let first = self.scatter(&all, self.every_check(), &settings, &mirrors, 0);
        let mut table = first.into_iter().collect::<Result<Vec<_>, _>>()?;
        for pass in 1.. {
            if vanishes(&table) {
                break;
            }
            self.measure(&mut table, &settings, &mut mirrors, MEASURING + pass)?;
            let error = measured_error(&table);
            let is_coarse = error > asked
                && settings.accuracy >= 1e-4 * asked
                && !(settings.most_tiles == MOST_TILES && is_bounded(&table, &settings));
            let again = if is_coarse { all.clone() } else { mirrors.aspects_to_retrace(&table, asked) };
            if again.is_empty() {
                break;
            }
            if is_coarse {
                settings.accuracy *= (ERROR_AIMED_AT * asked / error).clamp(0.1, 0.3);
                // A little more than 10^⅔, the maximum growth in the number of tiles.
                settings.most_tiles = (5 * settings.most_tiles).min(MOST_TILES);
            }
            let found = self.scatter(&again, self.every_check(), &settings, &mirrors, pass);
            again.iter().zip(found).try_for_each(|(&index, found)| mirrors.take(index, found, &mut table))?;
        }
        Ok(FineTable { table, settings, mirrors })
    }

    /// Checks of the integrals while aspects are made: for few aspects all are computed ten times finer,
    /// which is the result; for many none before the strong ones are known.
    fn every_check(&self) -> IntegralsCheck {
        if self.aspects.len() <= ALL_UP_TO { IntegralsCheck::Taken } else { IntegralsCheck::Skipped }
    }

    /// Measures the integrals at the drawn aspects that have not been measured.
    fn measure(
        &self,
        table: &mut [Scattering],
        settings: &AspectSettings,
        mirrors: &mut FinerMirrors,
        pass: u32,
    ) -> Result<(), BartError> {
        let unmeasured = |index: &usize| table[*index].error_power.is_none() && !self.is_exact(*index);
        let drawn: Vec<usize> = MeasuredAspects::of(table).all().filter(unmeasured).collect();
        let found = self.scatter(&drawn, IntegralsCheck::Compared, settings, mirrors, pass);
        drawn.iter().zip(found).try_for_each(|(&index, found)| mirrors.take(index, found, table))
    }

    /// Scattering of some aspects, in their order.
    fn scatter(
        &self,
        which: &[usize],
        integrals: IntegralsCheck,
        settings: &AspectSettings,
        mirrors: &FinerMirrors,
        pass: u32,
    ) -> Vec<Result<Scattering, BartError>> {
        let done = AtomicUsize::new(0);
        let one = |&index: &usize| {
            let received = self.received.filter(|_| mirrors.is_first(index));
            let checks = self.checks(index, integrals);
            let settings = mirrors.settings(index, settings);
            let wanted = self.context.cancellation.check();
            let found = wanted.and_then(|()| self.aspect(index, received, &settings, checks, pass));
            self.context.progress.at(Phase::Aspects, done.fetch_add(1, Ordering::Relaxed) + 1, which.len());
            found
        };
        which.par_iter().map(one).collect()
    }

    /// Scattering of an aspect from storage, or computed and stored now.
    fn aspect(
        &self,
        index: usize,
        received: Option<&BeamTree>,
        settings: &AspectSettings,
        checks: Checks,
        pass: u32,
    ) -> Result<Scattering, BartError> {
        let checkpoint = self.context.checkpoint;
        let key = CheckpointKey { pass, aspect: index as u32 };
        let aspect = &self.aspects[index];
        let kept = checkpoint.load(key).and_then(Scattering::from_bytes);
        if let Some(kept) = kept.filter(|kept| kept.is_of(settings, checks)) {
            return Ok(kept);
        }
        let context = AspectContext { received, progress: self.context.progress, meter: self.meter };
        scattering_with(self.world, aspect, settings, checks, &context)
            .inspect(|done| checkpoint.store(key, &done.to_bytes()))
    }

    fn checks(&self, index: usize, integrals: IntegralsCheck) -> Checks {
        let is_compared = self.compared.binary_search(&index).is_ok();
        Checks {
            integrals: if self.is_exact(index) { IntegralsCheck::Skipped } else { integrals },
            model: if is_compared { Check::Measured } else { Check::Skipped },
        }
    }

    /// Whether the polygons' closed form is exact, as in the far field; curved facets and currents that end
    /// on a face are integrated piecewise.
    fn is_exact(&self, index: usize) -> bool {
        let is_in_closed_form = self.edges == Edges::Ignored && self.world.skin_error() == 0.0;
        is_in_closed_form && !self.aspects[index].is_near()
    }
}

/// Whether some integrals had to be coarser than the settings.
fn is_bounded(table: &[Scattering], settings: &AspectSettings) -> bool {
    table.iter().any(|aspect| aspect.accuracy > settings.accuracy)
}

/// Whether a table is mere rounding in its polarization: sums of 10⁶ polygons are rounded by 10⁻¹³ of their
/// terms, which may cancel to a thousandth.
fn vanishes(table: &[Scattering]) -> bool {
    const ROUNDING: f64 = 1e-10;
    let whole = table.iter().map(|s| s.whole_power).sum::<f64>();
    whole > 0.0 && amplitude_ratio(table.iter().map(Scattering::mean_power).sum(), whole) < ROUNDING
}

fn result(request: &RcsRequest, table: &[Scattering], build: f64) -> RcsResult {
    let values = request.frequency_hz.len();
    let orders = usize::from(request.bounces);
    let transposed = |of: &dyn Fn(&Scattering, usize) -> Complex64| {
        (0..values).flat_map(|f| table.iter().map(move |s| (s, f))).map(|(s, f)| of(s, f)).collect::<Vec<_>>()
    };
    let power = table.iter().map(Scattering::mean_power).sum::<f64>();
    let spread = |order: usize| error_of_sample(table, |s| s.order_spread_power(order)).unwrap_or(0.0);
    let most_m = table.iter().map(|s| s.dropped_at_most_m).fold(0.0, f64::max);
    let without_error = RcsResult {
        amplitude_m: transposed(&|s, f| s.total_m(f)),
        by_order_m: (0..orders).map(|order| transposed(&|s, f| s.chosen_m[order][f])).collect(),
        beams: sums(table.iter().map(|s| s.beams.as_slice())),
        seconds: RcsSeconds {
            build,
            trace: table.iter().map(|s| s.trace_seconds).sum(),
            integrate: table.iter().map(|s| s.integrate_seconds).sum(),
            check: table.iter().map(|s| s.check_seconds).sum(),
        },
        vanishes: vanishes(table),
        ..RcsResult::default()
    };
    if without_error.vanishes {
        return without_error;
    }
    RcsResult {
        error: ErrorBudget {
            integration: Some(measured_error(table)),
            dropped: Some(dropped_error(table)),
            ..ErrorBudget::default()
        },
        model_error: ModelError {
            nodes: error_of_sample(table, Scattering::node_spread_power),
            bounces: error_of_sample(table, |s| s.left_out_power),
            edges: error_of_sample(table, |s| s.left_out_edges.map(|edges| edges.power)),
            ..ModelError::default()
        },
        node_spread: (0..orders).map(spread).collect(),
        dropped_at_most: amplitude_ratio(most_m * most_m, power / table.len() as f64),
        ..without_error
    }
}

/// Power of the first omitted order if orders continue to decay like the last two, without assuming growth;
/// `None` for a single order.
pub(crate) fn next_order(by_order: &[f64]) -> Option<f64> {
    let [.., before, last] = by_order else { return None };
    Some(if last < before { last * last / before } else { *last })
}

fn sums<'a>(lists: impl Iterator<Item = &'a [u64]>) -> Vec<u64> {
    let mut total = Vec::new();
    for list in lists {
        total.resize(total.len().max(list.len()), 0);
        total.iter_mut().zip(list).for_each(|(sum, n)| *sum += n);
    }
    total
}
