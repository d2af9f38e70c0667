//! Velocity ambiguity resolution from two sub-frames with different chirp intervals.
//!
//! Each sub-frame measures a velocity modulo its own span (λ/2T, also under time division once the phases
//! between transmitters have resolved the folds of a transmitter's longer repetition:
//! `time_division_folds.rs`); the multiples at which both agree, together with ranges, directions and levels,
//! determine the velocity (the Chinese remainder with tolerance: Richards, Fundamentals of Radar Signal
//! Processing (2014), §5.3.2). A vehicle has many points, so a hypothesis is scored by how well *all* points
//! of an object find partners in the other sub-frame; vehicles that share range cells are decided jointly, so
//! that no echo serves two. Range contributes as well: a hypothesis one span higher is f_c/μ·span nearer
//! (0.11 m at 17.6 m/s) and moves on between the sub-frames.

use crate::ambiguity::ambiguous_velocities::{FASTEST_MPS, ambiguity_mps};
use crate::direction::angle::Direction;
use crate::direction::position::{WorldPosition, world_position};
use crate::plan::Plan;
use artifact::Radar;
use artifact::points::{Object, Point, PointsFrame};
use artifact::radar::Multiplexing;
use artifact::units::amplitude_from_db;
use glam::DVec3;
use radar::doppler_ambiguity::folded_mps;

/// Points of one sub-frame.
struct SubFrame<'a> {
    /// Radar of this sub-frame.
    plan: &'a Plan,
    /// Middle of the sub-frame on a clock common to both, s.
    middle_s: f64,
    /// Points of the sub-frame, with folded velocities.
    points: &'a PointsFrame,
}

/// Position tolerance of partners: points on slopes are placed at cell centres, which gives 0.6 cells rms,
/// and one more for the body's spread.
const CELLS: f64 = 1.0;
/// Level tolerance: echoes of one body interfere anew after some centimetres, so level and direction are weak
/// evidence.
const LEVEL_DB: f64 = 8.0;
/// Direction tolerance, as a fraction of a beamwidth.
const BEAMS: f64 = 0.5;
/// Maximum score of the runner-up, relative to the best hypothesis, for it to be accepted.
const SECOND_BEST: f64 = 0.8;
/// Maximum number of combinations, for vehicles that share range cells, that are searched exhaustively.
const MOST_COMBINATIONS: usize = 4096;

/// Points of a cycle's sub-frames, each with velocities resolved by the other chirp interval of the next.
/// Unchanged if there is only one sub-frame, and under time division with varying chirp intervals, where a
/// velocity's fold would also change the directions.
pub(crate) fn resolved<'p>(plan_of: impl Fn(u32) -> &'p Plan, points: Vec<PointsFrame>) -> Vec<PointsFrame> {
    let turns_directions =
        |radar: &Radar| radar.array.multiplexing == Multiplexing::Tdm && !radar.schedule.is_uniform();
    if points.len() < 2 || turns_directions(&plan_of(0).radar) {
        return points;
    }
    let sub_frame = |i: usize| {
        let (plan, points) = (plan_of(points[i].index), &points[i]);
        SubFrame { plan, middle_s: points.time_s + plan.radar.frame_middle_s(), points }
    };
    (0..points.len()).map(|i| resolved_by(&sub_frame(i), &sub_frame((i + 1) % points.len()))).collect()
}

/// Points of `own` with velocities resolved by `other`; objects whose fold is beyond doubt are marked
/// `velocity_resolved`.
fn resolved_by(own: &SubFrame<'_>, other: &SubFrame<'_>) -> PointsFrame {
    let scorer = Scorer { own, other };
    let choices: Vec<FoldHypotheses> =
        own.points.objects.iter().enumerate().map(|(o, _)| scorer.choices(Some(o as u32))).collect();
    let chosen = scorer.together(&choices);
    let mut frame = own.points.clone();
    let mut over_ends_m = vec![];
    for (object, (choice, (best, is_certain))) in frame.objects.iter_mut().zip(choices.iter().zip(&chosen)) {
        over_ends_m.push(scorer.move_object(object, choice.folds[*best]));
        object.velocity_resolved = *is_certain;
        if scorer.is_certainly_moving(object) {
            object.stationary = object.stationary.map(|_| false);
        }
    }
    for point in &mut frame.points {
        let object = point.object.map(|index| index as usize);
        scorer.move_point(point, object.map(|index| (&frame.objects[index], over_ends_m[index])));
        if object.is_some_and(|index| scorer.is_certainly_moving(&frame.objects[index])) {
            point.stationary = point.stationary.map(|_| false);
        }
    }
    frame
}

/// Hypotheses of one object: whole spans to add, and what each of them explains.
struct FoldHypotheses {
    folds: Vec<f64>,
    /// Amplitude-weighted agreement of the object's points with their best partners, by hypothesis.
    own: Vec<f64>,
    /// Agreement of the other sub-frame's points with their best partners, `[hypothesis][point]`, 0 … 1.
    other: Vec<Vec<f64>>,
}

struct Scorer<'a> {
    own: &'a SubFrame<'a>,
    other: &'a SubFrame<'a>,
}

impl Scorer<'_> {
    /// Whether an object's resolved fold is not the one at rest: marks were made while either was possible.
    fn is_certainly_moving(&self, object: &Object) -> bool {
        let fastest_shown_mps = self.own.plan.radar.velocity_max_mps();
        object.velocity_resolved && object.radial_velocity_mps.abs() > fastest_shown_mps
    }

    /// Folds up to the fastest vehicle, and their scores.
    fn choices(&self, object: Option<u32>) -> FoldHypotheses {
        let span_mps = ambiguity_mps(&self.own.plan.radar);
        let points: Vec<&Point> = self.own.points.points.iter().filter(|p| p.object == object).collect();
        let strongest_mps = points.first().map_or(0.0, |p| p.radial_velocity_mps);
        let most = (2.0 * FASTEST_MPS / span_mps).ceil() as i32;
        let mut folds: Vec<f64> = (-most..=most)
            .map(|k| f64::from(k) * span_mps)
            .filter(|fold| (strongest_mps + fold).abs() <= FASTEST_MPS)
            .collect();
        if folds.is_empty() {
            folds.push(0.0);
        }
        let mut choice = FoldHypotheses { folds, own: vec![], other: vec![] };
        for fold in &choice.folds {
            let mut met = vec![0.0_f64; self.other.points.points.len()];
            let mut sum = 0.0;
            for point in &points {
                let near_mps =
                    unwrapped(&self.own.plan.radar, point.radial_velocity_mps, strongest_mps) + fold;
                let best = self.partners(point, near_mps, &mut met);
                sum += amplitude_from_db(point.snr_db) * best;
            }
            choice.own.push(sum);
            choice.other.push(met);
        }
        choice
    }

    /// Best agreement of a point at this velocity with any point of the other sub-frame; `met` keeps the
    /// maximum for each of those.
    fn partners(&self, point: &Point, velocity_mps: f64, met: &mut [f64]) -> f64 {
        let mut best = 0.0_f64;
        for (candidate, met) in self.other.points.points.iter().zip(met) {
            let agreement = self.agreement(point, velocity_mps, candidate);
            *met = met.max(agreement);
            best = best.max(agreement);
        }
        best
    }

    /// Agreement of a candidate with the expected appearance of this point, at this velocity, in the other
    /// sub-frame: 1 for a perfect match, decreasing with distance.
    fn agreement(&self, point: &Point, velocity_mps: f64, candidate: &Point) -> f64 {
        let (own, other) = (self.own.plan.array.cells(), self.other.plan.array.cells());
        let velocity_cell_mps = own.velocity_cell_mps.max(other.velocity_cell_mps);
        let apart_mps = velocity_mps - candidate.radial_velocity_mps;
        let velocity =
            folded_mps(apart_mps, ambiguity_mps(&self.other.plan.radar)) / (CELLS * velocity_cell_mps);
        if velocity.abs() > 5.0 {
            return 0.0;
        }
        let passed_s = self.other.middle_s - self.own.middle_s;
        let true_m = point.range_m - own.coupling_m(velocity_mps - point.radial_velocity_mps)
            + velocity_mps * passed_s;
        let shown_m = true_m + other.coupling_m(velocity_mps - candidate.radial_velocity_mps);
        let range = other.range_apart_m(shown_m, candidate.range_m) / (CELLS * own.range_cell_m);
        let level = (point.snr_db - candidate.snr_db) / LEVEL_DB;
        let squares =
            velocity.powi(2) + range.powi(2) + level.powi(2) + self.beams_apart(point, candidate).powi(2);
        (-0.5 * squares).exp()
    }

    fn beams_apart(&self, a: &Point, b: &Point) -> f64 {
        let beam = self.own.plan.array.beams()[0];
        let cosine = |p: &Point| self.direction(p.position_m, p.range_m).right;
        if beam.is_finite() { (cosine(a) - cosine(b)) / (BEAMS * beam) } else { 0.0 }
    }

    /// Best hypothesis of each object, decided jointly, and whether it is beyond doubt.
    fn together(&self, choices: &[FoldHypotheses]) -> Vec<(usize, bool)> {
        let mut chosen: Vec<usize> = choices.iter().map(|c| best_of(&c.own)).collect();
        for group in self.sharing_ranges() {
            self.decide(choices, &group, &mut chosen);
        }
        let with = |object: usize, hypothesis: usize| {
            let mut tried = chosen.clone();
            tried[object] = hypothesis;
            self.explained(choices, &tried, &[object])
        };
        (0..choices.len())
            .map(|object| {
                let best = with(object, chosen[object]);
                let others = (0..choices[object].folds.len()).filter(|h| *h != chosen[object]);
                let second = others.map(|h| with(object, h)).fold(0.0, f64::max);
                (chosen[object], best > 0.0 && second <= SECOND_BEST * best)
            })
            .collect()
    }

    /// Searches all combinations of a group's hypotheses, if they are few, for the one that explains most.
    fn decide(&self, choices: &[FoldHypotheses], group: &[usize], chosen: &mut [usize]) {
        let combinations: usize = group.iter().fold(1, |n, o| n.saturating_mul(choices[*o].folds.len()));
        if combinations > MOST_COMBINATIONS {
            return;
        }
        let mut best = (f64::NEG_INFINITY, chosen.to_vec());
        for combination in 0..combinations {
            let mut tried = chosen.to_vec();
            group.iter().fold(combination, |rest, object| {
                tried[*object] = rest % choices[*object].folds.len();
                rest / choices[*object].folds.len()
            });
            let explained = self.explained(choices, &tried, group);
            if explained > best.0 {
                best = (explained, tried);
            }
        }
        chosen.copy_from_slice(&best.1);
    }

    /// Amplitude explained by a group's hypotheses: own echoes that find partners, and echoes of the other
    /// sub-frame matched by any of the group.
    fn explained(&self, choices: &[FoldHypotheses], tried: &[usize], group: &[usize]) -> f64 {
        let own: f64 = group.iter().map(|o| choices[*o].own[tried[*o]]).sum();
        let met = |j: usize| group.iter().map(|o| choices[*o].other[tried[*o]][j]).fold(0.0, f64::max);
        let others = self.other.points.points.iter().enumerate();
        own + others.map(|(j, point)| amplitude_from_db(point.snr_db) * met(j)).sum::<f64>()
    }

    /// Groups of objects whose ranges overlap, allowing for motion at the maximum velocity between sub-frames
    /// and for range shifts by folds.
    fn sharing_ranges(&self) -> Vec<Vec<usize>> {
        let (objects, axes) = (&self.own.points.objects, self.own.plan.array.cells());
        let reach_m = FASTEST_MPS * (self.other.middle_s - self.own.middle_s).abs()
            + axes.coupling_m(FASTEST_MPS).abs()
            + axes.range_cell_m;
        let mut order: Vec<usize> = (0..objects.len()).collect();
        order.sort_by(|a, b| objects[*a].range_extent_m[0].total_cmp(&objects[*b].range_extent_m[0]));
        let mut groups: Vec<(Vec<usize>, f64)> = vec![];
        for object in order {
            let [first_m, last_m] = objects[object].range_extent_m;
            match groups.last_mut() {
                Some((group, end_m)) if first_m <= *end_m + reach_m => {
                    group.push(object);
                    *end_m = end_m.max(last_m);
                }
                _ => groups.push((vec![object], last_m)),
            }
        }
        groups.into_iter().map(|(group, _)| group).collect()
    }

    /// Moves an object to a fold; returns its shift past an end of the range axis.
    fn move_object(&self, object: &mut Object, fold_mps: f64) -> f64 {
        object.radial_velocity_mps += fold_mps;
        object.velocity_extent_mps = object.velocity_extent_mps.map(|v| v + fold_mps);
        let axes = self.own.plan.array.cells();
        let nearer_m = axes.coupling_m(fold_mps);
        let range_m = axes.on_axis(object.range_m - nearer_m);
        let place = self.moved(object.position_m, object.range_m, range_m);
        object.position_m = place.position_m.to_array();
        (object.azimuth_rad, object.height) = (place.azimuth_rad, place.height);
        let farther_m = range_m - object.range_m;
        object.range_m = range_m;
        object.range_extent_m = object.range_extent_m.map(|m| axes.between_ends(m + farther_m));
        object.lane = self.own.plan.lanes.at(object.position_m);
        farther_m + nearer_m
    }

    /// Moves a point to the fold of its object, on the same side of the ends of the range axis.
    fn move_point(&self, point: &mut Point, object: Option<(&Object, f64)>) {
        let axes = self.own.plan.array.cells();
        let near_mps = object.map_or(point.radial_velocity_mps, |(object, _)| object.radial_velocity_mps);
        let velocity_mps = unwrapped(&self.own.plan.radar, point.radial_velocity_mps, near_mps);
        let fold_mps = velocity_mps - point.radial_velocity_mps;
        let true_m = point.range_m - axes.coupling_m(fold_mps);
        let range_m = match object {
            // The object's shift past an end of the axis applies to its points too.
            Some((_, over_end_m)) => axes.between_ends(true_m + over_end_m),
            None => axes.on_axis(true_m),
        };
        let place = self.moved(point.position_m, point.range_m, range_m);
        point.position_m = place.position_m.to_array();
        (point.azimuth_rad, point.elevation_rad) = (place.azimuth_rad, place.elevation_rad);
        point.height = place.height;
        point.range_m = range_m;
        point.radial_velocity_mps = velocity_mps;
    }

    /// Place in the same direction from the array, at another range.
    fn moved(&self, position_m: [f64; 3], from_m: f64, to_m: f64) -> WorldPosition {
        world_position(&self.own.plan.array, self.direction(position_m, from_m), to_m)
    }

    fn direction(&self, position_m: [f64; 3], range_m: f64) -> Direction {
        let [right, up, _] = self.own.plan.array.axes();
        let away =
            (DVec3::from(position_m) - self.own.plan.array.position_m()) / range_m.max(f64::MIN_POSITIVE);
        Direction {
            right: away.dot(right),
            up: self.own.plan.array.beams()[1].is_finite().then(|| away.dot(up)),
        }
    }
}

/// `velocity_mps` moved by whole ambiguities until it is nearest to `near_mps`.
fn unwrapped(radar: &Radar, velocity_mps: f64, near_mps: f64) -> f64 {
    near_mps + folded_mps(velocity_mps - near_mps, ambiguity_mps(radar))
}

fn best_of(scores: &[f64]) -> usize {
    (0..scores.len()).fold(0, |best, i| if scores[i] > scores[best] { i } else { best })
}
