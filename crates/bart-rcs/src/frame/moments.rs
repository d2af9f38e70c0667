//! Ways that change too much within a frame for one moment: they are traced at several, and blended between
//! them.
//!
//! Where bodies that move against each other light or shade one another, the outlines of what is lit slide
//! over both. Paths keep what was lit at their moment: once outlines have slid by δ along a phase gradient w,
//! what ends there has turned by θ = wδ, and is missed whole from half a cycle on. A cubic through moments
//! between which it turns by θ follows it to 3/128·θ⁴ at most, where the nearest moment alone leaves θ/2 and
//! a straight line between two θ²/8 (docs/speed.md has what was measured). Only the ways that change are
//! traced again: bodies seen alone keep one moment.
//!
//! The moments lie on a grid of equal steps h from the frame's begin to its end, made finer until the
//! measured error meets the accuracy asked for; what was traced for a coarser grid is used again. Between two
//! moments a blend errs by u(1−u)(1+u)(2−u)·h⁴f⁗/24, u from 0 to 1, in the first and last step by
//! u(1−u)(2−u)(3−u)·h⁴f⁗/24. The moment of the check is where each of the grids errs as the frame does, to
//! 1.4 dB (a test has it).

use crate::beams::body_ways::BodyWays;
use crate::frame::band_power::{MARGIN, frequencies_hz, mean_difference, power_over_frame};
use crate::frame::frame_error::{FrameError, Reference};
use crate::frame::path_plan::{MOMENTS_LEAST, MOMENTS_MAX, PATHS_MAX, Plan, WHEEL_STEPS};
use crate::frame::path_pruning::{Kept, pruned_alike};
use crate::frame::path_sum::element_over_band;
use crate::frame::path_table::{Moment, PathTable, paths_along};
use crate::frame::snapshot::Scenery;
use crate::oversight::error::BartError;
use crate::oversight::progress::Phase;
use artifact::paths::{Fineness, Path, Span};
use num_complex::Complex64;
use std::collections::{BTreeMap, BTreeSet};

/// Steps of the grids that are tried, the last where wheels turn.
///
/// Four would be enough at times, but at the moment of the check their blend errs 5 dB less than over the
/// frame.
const STEPS: [u32; 4] = [MOMENTS_LEAST - 1, 16, MOMENTS_MAX - 1, WHEEL_STEPS];
/// Steps of the finest grid, in whose places all moments are counted.
const FINEST: u32 = WHEEL_STEPS;
/// Places of every grid where ways show whether they change, 3/8 of a frame before its middle and 1/4 after.
///
/// Errors in proportion to the time from the middle have within 1 dB of their mean square over the frame
/// there. An outline that slides at an even pace turns what ends at it at an even pace as well: whole cycles
/// from the middle nothing seems to be missed. That is so at both of these for 8, 16 … cycles a frame, and at
/// both ends of the frame for 2, 4, 6 … (of a van behind a bus, three bounces, 4 dB less were missed there
/// than over the frame, and no way seemed to change).
const LOOKED_AT: [u32; 2] = [FINEST / 8, 3 * FINEST / 4];
/// Share of the accuracy asked for that all ways together that keep one moment may miss.
const KEPT_SHARE: f64 = 0.5;
/// Least share of the measured error: where what one moment misses at [`LOOKED_AT`], or a grid
/// halfway between its moments, is less, as an amplitude, something else makes that error (a wide
/// array, cells), and no finer grid is tried.
const LEAST_SHARE: f64 = 0.5;

/// The table where its freezing is within the accuracy asked for; else one whose ways that change most are
/// blended from as few moments as meet it, or the best that was found.
pub(crate) fn split(
    scenery: &Scenery<'_>,
    whole: PathTable,
    points: &[Path],
    reference: &Reference,
) -> Result<PathTable, BartError> {
    let plan = scenery.plan;
    let asked = plan.asked();
    if whole.error.measured() <= asked || !whole.error.is_mostly_freezing() {
        return Ok(whole);
    }
    let fineness = whole.fineness.clone();
    let mut moments = Moments::new(scenery, &fineness, whole.strongest_dropped.clone());
    let ways = moments.looked_at(&whole)?;
    if ways.is_empty() {
        return Ok(whole);
    }
    let kept = moments.take(&whole.paths, &ways);
    let changing = whole.paths.len() - kept.len();
    let power = power_over_frame(&whole.paths, plan);
    let mut best = whole;
    let most = if scenery.turns_wheels() { FINEST } else { MOMENTS_MAX - 1 };
    let fits = |steps: u32| kept.len() + changing * (steps as usize + 1) <= PATHS_MAX;
    for steps in STEPS.into_iter().filter(|steps| *steps <= most && fits(*steps)) {
        moments.fill(steps, &ways)?;
        let paths = moments.blended(&kept, steps);
        let error = FrameError::measured_on(plan, &paths, points, reference, &best.given_up);
        let measured = error.measured();
        if measured < best.error.measured() {
            let fineness = Fineness { moments: steps + 1, ways: named(&ways, plan), ..fineness.clone() };
            best = PathTable { paths, error, fineness, bytes: moments.bytes, ..best };
        }
        if measured <= asked || moments.missed_halfway(steps / 2) < least_missed(measured, power) {
            break;
        }
    }
    Ok(best)
}

/// Power that has to be missed for motion to explain a measured error.
fn least_missed(measured: f64, power: f64) -> f64 {
    (LEAST_SHARE * measured / MARGIN).powi(2) * power
}

/// Paths of the frame's middle, of which those ways that were blended in another frame are blended from as
/// many moments.
pub(crate) fn split_alike(
    scenery: &Scenery<'_>,
    kept: Kept,
    fineness: &Fineness,
) -> Result<Vec<Path>, BartError> {
    let ways = found(&fineness.ways, scenery.plan);
    let Some(steps) =
        fineness.moments.checked_sub(1).filter(|steps| STEPS.contains(steps) && !ways.is_empty())
    else {
        return Ok(kept.paths);
    };
    let mut moments = Moments::new(scenery, fineness, kept.strongest_dropped);
    let rest = moments.take(&kept.paths, &ways);
    moments.fill(steps, &ways)?;
    Ok(moments.blended(&rest, steps))
}

/// Paths of several moments of one frame.
struct Moments<'a> {
    scenery: &'a Scenery<'a>,
    fineness: &'a Fineness,
    strongest_dropped: Vec<f64>,
    /// Paths by place, in parts of the frame of which there are [`FINEST`].
    at: BTreeMap<u32, Vec<Path>>,
    /// Most bytes held by what was traced.
    bytes: u64,
}

impl<'a> Moments<'a> {
    fn new(scenery: &'a Scenery<'a>, fineness: &'a Fineness, strongest_dropped: Vec<f64>) -> Self {
        Self { scenery, fineness, strongest_dropped, at: BTreeMap::new(), bytes: 0 }
    }

    /// Traces two other moments and tells which ways have changed there from what they are in `middle`.
    fn looked_at(&mut self, middle: &PathTable) -> Result<BodyWays, BartError> {
        for place in LOOKED_AT {
            let paths = self.traced(place, None)?;
            self.at.insert(place, paths);
        }
        let others = LOOKED_AT.map(|place| (self.seconds(place), self.at[&place].as_slice()));
        let ways = ways_that_change(self.scenery.plan, middle, others);
        self.at.values_mut().for_each(|paths| paths.retain(|path| ways.contain(&bodies(path))));
        Ok(ways)
    }

    /// Takes the paths of the frame's middle that are among some ways; gives the others.
    fn take(&mut self, middle: &[Path], ways: &BodyWays) -> Vec<Path> {
        let (own, rest) = middle.iter().copied().partition(|path| ways.contain(&bodies(path)));
        self.at.insert(FINEST / 2, own);
        rest
    }

    /// Traces what is missing of a grid.
    fn fill(&mut self, steps: u32, ways: &BodyWays) -> Result<(), BartError> {
        for place in (0..=steps).map(|i| i * (FINEST / steps)) {
            if !self.at.contains_key(&place) {
                let paths = self.traced(place, Some(ways))?;
                self.at.insert(place, paths);
            }
        }
        Ok(())
    }

    fn traced(&mut self, place: u32, ways: Option<&BodyWays>) -> Result<Vec<Path>, BartError> {
        let (plan, seconds) = (self.scenery.plan, self.seconds(place));
        let snapshot = match ways {
            Some(ways) => self.scenery.along(ways, seconds, plan.position_m)?,
            None => self.scenery.at(seconds, plan.position_m)?,
        };
        self.bytes = self.bytes.max(snapshot.bytes());
        let moment = Moment { ways, seconds, held_bytes: self.held_bytes() };
        let paths = paths_along(&snapshot.scatterer(plan, Phase::Tracing), plan, self.fineness, &moment)?;
        Ok(pruned_alike(paths, plan, &snapshot.world, &self.strongest_dropped))
    }

    /// Bytes of all moments' paths with the blends that are made of them, two of which are compared.
    fn held_bytes(&self) -> usize {
        3 * size_of::<Path>() * self.at.values().map(Vec::len).sum::<usize>()
    }

    /// Mean power of what the blend of a grid misses halfway between its moments, where all are traced.
    fn missed_halfway(&self, steps: u32) -> f64 {
        let plan = self.scenery.plan;
        let missed = |place: u32| {
            let seconds = self.seconds(place);
            let blended = self.blended_field(steps, seconds);
            mean_difference(&field(self.at.get(&place), plan, seconds), &blended)
        };
        let places = (0..steps).map(|i| (2 * i + 1) * (FINEST / (2 * steps)));
        places.map(missed).sum::<f64>() / f64::from(steps)
    }

    /// S of the blend of a grid over the band, of the moments that have a share in it then.
    fn blended_field(&self, steps: u32, seconds: f64) -> Vec<Complex64> {
        let mut total = vec![Complex64::ZERO; FIELD_FREQUENCIES];
        for moment in 0..=steps {
            let share = self.span(moment, steps).share(seconds);
            if share != 0.0 {
                let of = field(self.at.get(&(moment * (FINEST / steps))), self.scenery.plan, seconds);
                total.iter_mut().zip(of).for_each(|(total, of)| *total += share * of);
            }
        }
        total
    }

    /// Share of a frame that one moment of a grid stands for.
    fn span(&self, moment: u32, steps: u32) -> Span {
        let duration_s = self.scenery.plan.header.radar.frame_duration_s();
        Span { first_s: 0.0, step_s: duration_s / f64::from(steps), moments: steps + 1, moment }
    }

    /// Paths that keep one moment, and behind them those of a grid's moments, one after the other.
    fn blended(&self, kept: &[Path], steps: u32) -> Vec<Path> {
        let mut all = kept.to_vec();
        for moment in 0..=steps {
            let span = self.span(moment, steps);
            let paths = self.at.get(&(moment * (FINEST / steps))).into_iter().flatten();
            all.extend(paths.map(|path| {
                let mut part = *path;
                part.curve.span = Some(span);
                part
            }));
        }
        all
    }

    fn seconds(&self, place: u32) -> f64 {
        self.scenery.plan.header.radar.frame_duration_s() * f64::from(place) / f64::from(FINEST)
    }
}

/// Bodies of a path, in the order of travel; none of a point target.
fn bodies(path: &Path) -> Vec<u32> {
    path.sequence().iter().map(|facet| facet.body).collect()
}

/// The ways whose paths of the frame's middle miss most of what is there at two `others`: all but those that
/// together miss a half of the accuracy asked for there, as an amplitude. None where what they miss does not
/// explain the error measured.
fn ways_that_change(plan: &Plan<'_>, middle: &PathTable, others: [(f64, &[Path]); 2]) -> BodyWays {
    let asked = plan.asked();
    let power = power_over_frame(&middle.paths, plan);
    let mut left = (KEPT_SHARE * asked / MARGIN).powi(2) * power;
    let of_middle = by_way(&middle.paths);
    let at_others = others.map(|(seconds, paths)| (seconds, by_way(paths)));
    let mut missed: BTreeMap<&Vec<u32>, f64> = BTreeMap::new();
    for (seconds, of_other) in &at_others {
        let ways: BTreeSet<&Vec<u32>> = of_middle.keys().chain(of_other.keys()).collect();
        for way in ways {
            let [was, is] = [&of_middle, of_other].map(|of| field(of.get(way), plan, *seconds));
            *missed.entry(way).or_default() += 0.5 * mean_difference(&was, &is);
        }
    }
    let mut ways: Vec<(&Vec<u32>, f64)> = missed.into_iter().collect();
    ways.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(b.0)));
    let mut change = BodyWays::default();
    let missed: f64 = ways.iter().map(|(_, missed)| missed).sum();
    if missed < least_missed(middle.error.measured(), power) {
        return change;
    }
    for (way, missed) in ways {
        left -= missed;
        if left < 0.0 && missed > 0.0 {
            change.add(way);
        }
    }
    change
}

/// A way and its way back are one.
fn by_way(paths: &[Path]) -> BTreeMap<Vec<u32>, Vec<Path>> {
    let mut ways: BTreeMap<Vec<u32>, Vec<Path>> = BTreeMap::new();
    for path in paths.iter().filter(|path| path.order > 0) {
        let there = bodies(path);
        let back = there.iter().rev().copied().collect();
        ways.entry(there.min(back)).or_default().push(*path);
    }
    ways
}

/// Frequencies that the fields of moments are compared at.
const FIELD_FREQUENCIES: usize = 12;

/// S of paths over the band, as the radar sees it.
fn field(paths: Option<&Vec<Path>>, plan: &Plan<'_>, seconds: f64) -> Vec<Complex64> {
    let frequencies = frequencies_hz(plan.band.centre_hz, plan.band.bandwidth_hz, FIELD_FREQUENCIES);
    let element = plan.header.radar.array.polarization.indices();
    element_over_band(paths.map_or(&[], Vec::as_slice), &plan.view(seconds), element, &frequencies)
}

/// Ways by the ids of their bodies.
fn named(ways: &BodyWays, plan: &Plan<'_>) -> Vec<Vec<String>> {
    let id = |body: &u32| {
        plan.header.targets.get(*body as usize).map_or(String::new(), |target| target.id.clone())
    };
    ways.iter().map(|way| way.iter().map(id).collect()).collect()
}

/// Ways among these names whose bodies are all in a frame.
fn found(names: &[Vec<String>], plan: &Plan<'_>) -> BodyWays {
    let index =
        |id: &String| plan.header.targets.iter().position(|target| target.id == *id).map(|i| i as u32);
    let mut ways = BodyWays::default();
    for way in names.iter().filter_map(|way| way.iter().map(index).collect::<Option<Vec<u32>>>()) {
        ways.add(&way);
    }
    ways
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::path_plan::check_offset_s;
    use std::f64::consts::TAU;

    /// An amplitude that turns at an even pace misses |1 − e^{iφ}|² = 2 − 2·cos φ of its power: over the
    /// frame, at both of its ends, and where it is looked at, from nearly still to four cycles a frame.
    #[test]
    fn what_turns_at_any_pace_is_seen_to_change_where_it_is_looked_at() {
        let missed = |cycles: f64, offset: f64| 2.0 - 2.0 * (TAU * cycles * offset).cos();
        let mut least_db = [f64::INFINITY; 2];
        for pace in 1..=400 {
            let cycles = f64::from(pace) / 100.0;
            let over_frame =
                (0..1000).map(|i| missed(cycles, (f64::from(i) + 0.5) / 1000.0 - 0.5)).sum::<f64>() / 1000.0;
            let looked_at = LOOKED_AT.map(|place| f64::from(place) / f64::from(FINEST) - 0.5);
            for (least, offsets) in least_db.iter_mut().zip([looked_at, [-0.5, 0.5]]) {
                let seen = offsets.map(|offset| missed(cycles, offset)).iter().sum::<f64>() / 2.0;
                *least = least.min(10.0 * (seen / over_frame).max(1e-9).log10());
            }
        }
        let [looked_at, ends] = least_db;
        println!(
            "least missed of what is missed over the frame: {looked_at:.1} dB, at its ends {ends:.1} dB"
        );
        assert!(looked_at > -6.0 && ends < -40.0);
    }

    /// Errors of blends of a fourth power, whose fourth derivative is constant: at the check's moment, and
    /// rms over the frame.
    #[test]
    fn at_the_moment_of_the_check_every_grid_errs_as_over_the_frame() {
        for steps in STEPS {
            let span = |moment: u32| Span {
                first_s: 0.0,
                step_s: 1.0 / f64::from(steps),
                moments: steps + 1,
                moment,
            };
            let blend = |t: f64| {
                (0..=steps).map(|i| span(i).share(t) * span(i).traced_at_s().powi(4)).sum::<f64>() - t.powi(4)
            };
            let squares = (0..4800).map(|i| blend((f64::from(i) + 0.5) / 4800.0).powi(2)).sum::<f64>();
            let of_check_db =
                20.0 * (blend(0.5 + check_offset_s(1.0)).abs() / (squares / 4800.0).sqrt()).log10();
            println!("{steps} steps: {of_check_db:.2} dB");
            assert!(of_check_db.abs() < 1.5, "{steps} steps: {of_check_db}");
        }
    }
}
