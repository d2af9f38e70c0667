//! Lines that `run` prints at its end, from its summary alone: detections, their quality, and whether the
//! requested accuracy was reached.

use artifact::settings::StaticEchoes;
use pipeline::outcome::error_figures::decibels;
use pipeline::outcome::summary::{
    AccuracyVerdict, Cause, FalseObject, FrameSummary, Predicted, RadarEntry, RadarsSummary, Summary,
    TargetSummary,
};
use pipeline::outcome::verdict::{self, FRAMES_IN_FULL};
use std::collections::BTreeMap;

/// Largest number of frames with a line each: more would push the rest off the screen.
const FRAMES_TOLD: usize = 24;
/// Largest number of a frame's false objects with a line each.
const FALSE_OBJECTS_LISTED: usize = 8;

/// Lines about several radars: one for each radar, and one for each target of a frame that none of them
/// found.
pub fn lines_of_radars(summary: &RadarsSummary) -> Vec<String> {
    let by_nobody = summary.frames.iter().enumerate().flat_map(|(number, frame)| {
        let unseen = frame.targets.iter().filter(|t| t.found_by.is_empty() && !t.missed_by.is_empty());
        unseen.map(move |target| format!("  frame {number}: {} is found by no radar", target.id))
    });
    summary.radars.iter().map(of_radar).chain(by_nobody.take(FRAMES_TOLD)).collect()
}

fn of_radar(radar: &RadarEntry) -> String {
    let accuracy = radar.accuracy.as_ref();
    let verdict = match accuracy.and_then(|accuracy| accuracy.met) {
        Some(true) => "reached",
        Some(false) => "NOT REACHED",
        None => "not known",
    };
    let error = accuracy.map_or_else(|| decibels(None), AccuracyVerdict::reached_in_words);
    let asked = accuracy.map_or("whatever was asked".into(), verdict::asked_in_words);
    let count = DetectionCounts::of_radar(radar).text();
    format!("radar {}: {count}; numerical error {error}, {asked}: {verdict}", radar.id)
}

/// Lines about a run with one radar: a few frames are shown in full, many by a line each and a total.
pub fn lines(summary: &Summary) -> Vec<String> {
    let frames = &summary.frames[..];
    if frames.len() <= FRAMES_IN_FULL {
        let lanes = LaneColumn::of(summary);
        let in_full = frames.iter().enumerate().flat_map(|(number, frame)| in_full(number, frame, lanes));
        return in_full.chain(of_clutter(summary)).chain(of_what_lacks(summary)).collect();
    }
    let mut lines: Vec<String> =
        frames.iter().take(FRAMES_TOLD).enumerate().map(|(number, frame)| in_a_line(number, frame)).collect();
    if frames.len() > FRAMES_TOLD {
        lines.push(format!("frames {FRAMES_TOLD} to {} stand in summary.json", frames.len() - 1));
    }
    lines.extend(together(frames));
    lines.extend(of_clutter(summary));
    lines.extend(of_what_lacks(summary));
    lines
}

/// Sentence about directions where the array measures no azimuth.
pub const WITHOUT_AZIMUTH: &str = "the array has no two elements side by side and tells no azimuth: directions \
                                   are the boresight's, objects are in no lane and are a target's by range and \
                                   velocity alone";

/// Sentence about maps without noise, whose levels are relative to a substitute floor.
pub const WITHOUT_NOISE: &str = "there is no noise: a floor 60 dB below the map's peak stands for it, and \
                                 thresholds, SNRs and objects hang on that floor. A recording always has \
                                 noise, which is taken from its map where the scene of its radar has [noise]";

/// Sentence about points whose range is shorter than that of any place on the ground; `None` if there are
/// none.
pub fn without_height([points, of]: [usize; 2]) -> Option<String> {
    (points > 0).then(|| {
        format!("{points} of {of} points are nearer than assumed_height_m is below or above the radar: their azimuth is the boresight's and the cone's angle, their height the radar's")
    })
}

/// Lines about missing properties of echoes and directions: noise, azimuths, or heights.
fn of_what_lacks(summary: &Summary) -> impl Iterator<Item = String> {
    let sum = |count: fn(&FrameSummary) -> usize| summary.frames.iter().map(count).sum();
    let heights = without_height([sum(|frame| frame.points_without_height), sum(|frame| frame.points)]);
    let azimuths = (!summary.radar.tells_azimuth).then(|| WITHOUT_AZIMUTH.to_owned());
    let noise = (!summary.radar.has_noise).then(|| WITHOUT_NOISE.to_owned());
    noise.into_iter().chain(azimuths).chain(heights)
}

/// Advice for removing clutter from the false objects, where some of them are clutter and the settings keep
/// it.
fn of_clutter(summary: &Summary) -> Option<String> {
    let false_ones = summary.frames.iter().flat_map(|frame| &frame.false_objects);
    let clutter = false_ones.filter(|object| object.cause == Cause::Clutter).count();
    let is_asked = clutter > 0 && summary.static_echoes == StaticEchoes::Keep;
    is_asked.then(|| {
        format!("{clutter} false objects are clutter: static = \"mark\" in [dsp] tells apart what is at rest, \"remove\" leaves it out")
    })
}

/// Counts of targets and objects: found, missed, false, at rest, removed and hidden.
#[derive(Default, Clone, Copy)]
struct DetectionCounts {
    found: usize,
    missed: usize,
    false_ones: usize,
    stationary: usize,
    removed: usize,
    hidden: usize,
}

impl DetectionCounts {
    fn of_radar(radar: &RadarEntry) -> Self {
        let RadarEntry { found, missed, false_ones, stationary, removed, .. } = *radar;
        Self { found, missed, false_ones, stationary, removed, hidden: 0 }
    }

    fn of(frame: &FrameSummary) -> Self {
        let targets = |found| frame.targets.iter().filter(|target| target.found == found).count();
        let removed = frame.targets.iter().filter(|target| target.removed).count();
        Self {
            found: targets(Some(true)),
            missed: targets(Some(false)),
            hidden: targets(None) - removed,
            false_ones: frame.false_objects.len(),
            stationary: frame.stationary_objects.len(),
            removed,
        }
    }

    fn and(self, more: Self) -> Self {
        Self {
            found: self.found + more.found,
            missed: self.missed + more.missed,
            false_ones: self.false_ones + more.false_ones,
            stationary: self.stationary + more.stationary,
            removed: self.removed + more.removed,
            hidden: self.hidden + more.hidden,
        }
    }

    fn text(self) -> String {
        let Self { found, missed, false_ones, stationary, removed, hidden } = self;
        let more = [
            (stationary, "at rest and of no target"),
            (removed, "removed as echoes at rest"),
            (hidden, "hidden or out of range"),
        ];
        let more =
            more.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("; {count} {what}"));
        let more: String = more.collect();
        format!("{found} of {} targets found, {missed} missed, {false_ones} false{more}", found + missed)
    }
}

fn in_a_line(number: usize, frame: &FrameSummary) -> String {
    let error = frame.accuracy.reached_in_words();
    let missed = if frame.accuracy.met == Some(false) { " (not reached)" } else { "" };
    format!(
        "frame {number:>3}, {:.3} s: {}; error {error}{missed}",
        frame.time_s,
        DetectionCounts::of(frame).text()
    )
}

/// Lines about all frames together: counts, and the frame with the largest error.
fn together(frames: &[FrameSummary]) -> Vec<String> {
    let count = frames.iter().map(DetectionCounts::of).fold(DetectionCounts::default(), DetectionCounts::and);
    let causes = causes(frames.iter().flat_map(|frame| &frame.false_objects));
    let causes = if causes.is_empty() { causes } else { format!(" (false: {causes})") };
    let mut lines = vec![format!("all {} frames: {}{causes}", frames.len(), count.text())];
    lines.extend(worst_error(frames));
    lines
}

/// The frame with the largest error, and the number of frames that missed the requested accuracy.
fn worst_error(frames: &[FrameSummary]) -> Vec<String> {
    let known = frames.iter().enumerate();
    let known = known.filter_map(|(number, frame)| Some((number, frame, frame.accuracy.level_db()?)));
    let Some((number, frame, _)) = known.max_by(|a, b| a.2.total_cmp(&b.2)) else { return vec![] };
    let missed = frames.iter().filter(|frame| frame.accuracy.met == Some(false)).count();
    let mut lines = vec![format!(
        "  accuracy reached in {} of {} frames; the worst, frame {number}:",
        frames.len() - missed,
        frames.len()
    )];
    lines.extend(
        verdict::lines(&frame.accuracy, &frame.error_db).into_iter().map(|line| format!("    {line}")),
    );
    lines.extend(left_out(frame).into_iter().chain(drawn(frame)).chain(outweighing(frame)));
    lines
}

fn in_full(number: usize, frame: &FrameSummary, lanes: LaneColumn) -> Vec<String> {
    let (time_s, points) = (frame.time_s, frame.points);
    let mut lines = vec![format!(
        "frame {number}, {time_s:.3} s: {}; {points} points",
        DetectionCounts::of(frame).text()
    )];
    lines
        .extend(verdict::lines(&frame.accuracy, &frame.error_db).into_iter().map(|line| format!("  {line}")));
    lines.extend(left_out(frame).into_iter().chain(drawn(frame)).chain(outweighing(frame)));
    lines.extend(targets(&frame.targets, lanes));
    lines.extend(false_objects(&frame.false_objects));
    lines.extend(standing(&frame.stationary_objects));
    lines
}

/// Sentence about objects at rest: their number by cause.
fn standing(all: &[FalseObject]) -> Option<String> {
    let objects = if all.len() == 1 { "object" } else { "objects" };
    let told = || format!("  {} {objects} at rest and of no target: {}", all.len(), causes(all));
    (!all.is_empty()).then(told)
}

/// The strongest false objects, and the number of the others by cause.
fn false_objects(all: &[FalseObject]) -> Vec<String> {
    let (listed, more) = all.split_at(all.len().min(FALSE_OBJECTS_LISTED));
    let mut lines: Vec<String> = listed.iter().map(false_object).collect();
    if !more.is_empty() {
        lines.push(format!("  {} more false objects: {}", more.len(), causes(more)));
    }
    lines
}

/// Text of the number of objects of each cause.
fn causes<'a>(objects: impl IntoIterator<Item = &'a FalseObject>) -> String {
    let mut causes: BTreeMap<&str, usize> = BTreeMap::new();
    for object in objects {
        *causes.entry(object.cause.name()).or_default() += 1;
    }
    causes.iter().map(|(cause, many)| format!("{many} {cause}")).collect::<Vec<_>>().join(", ")
}

/// Line about the errors of the physical model, apart from numerical errors; `None` if there are none or none
/// was estimated.
fn left_out(frame: &FrameSummary) -> Option<String> {
    let estimated = frame.model_error_db.sources().into_iter().filter_map(|(name, db)| Some((name, db?)));
    let of_tables = shading_left_out(frame).then_some("shading between bodies, which is not estimated");
    let of_bounces = higher_orders_unknown(frame).then_some("bounces not estimated (one order alone)");
    let others = of_bounces.into_iter().chain(of_tables).map(str::to_owned);
    let named: Vec<String> =
        estimated.map(|(name, db)| format!("{name} {}", decibels(db))).chain(others).collect();
    (!named.is_empty()).then(|| format!("  left out by the model: {}", named.join(", ")))
}

/// Line about the echo that is drawn at random; `None` if none is.
fn drawn(frame: &FrameSummary) -> Option<String> {
    let level_db = frame.model_error_db.small_parts?;
    Some(format!("  small parts drawn at random: {} of the echo without them", decibels(level_db)))
}

/// Sentences about parts of the physics that the scene leaves out although they outweigh the computed echo,
/// each with the key that adds it.
fn outweighing(frame: &FrameSummary) -> impl Iterator<Item = String> {
    let error = frame.model_error_db;
    let parts = [
        ("what the road reflects", error.road, "[road] with its mirror"),
        (
            "what bodies reflect to each other",
            error.between_bodies,
            "between_bodies = \"traced\" in [fidelity]",
        ),
    ];
    let outweighing = parts.into_iter().filter(|(_, db, _)| db.is_some_and(|db| db > 0.0));
    outweighing.map(|(part, _, key)| format!("  {part} outweighs the computed echo: {key} adds it"))
}

/// Whether the error of omitted bounces is unknown: it is estimated from the decay of orders, which a single
/// order does not show.
pub fn higher_orders_unknown(frame: &FrameSummary) -> bool {
    frame.bounces == 1 && frame.model_error_db.bounces.is_none()
}

/// Whether shading between bodies is missing, because far-field tables treat each body alone.
pub fn shading_left_out(frame: &FrameSummary) -> bool {
    frame.paths.is_none() && frame.targets.len() + frame.clutter.len() > 1
}

/// A table with one row per target.
fn targets(targets: &[TargetSummary], lanes: LaneColumn) -> Vec<String> {
    let Some(longest) = targets.iter().map(|target| target.id.chars().count()).max() else { return vec![] };
    let width = longest.max(6);
    let head = format!("  {:<width$}   range   error    velocity   error     SNR  lane  predicted", "target");
    std::iter::once(head).chain(targets.iter().map(|target| target_row(target, width, lanes))).collect()
}

fn target_row(target: &TargetSummary, width: usize, lanes: LaneColumn) -> String {
    let (id, truth) = (&target.id, &target.truth);
    let Some(estimate) = &target.estimate else {
        let why = match (target.found, target.removed) {
            (Some(false), _) => "missed",
            (_, true) => "removed as an echo at rest (static in [dsp])",
            _ => "hidden or out of range",
        };
        return format!("  {id:<width$} {:6.2} m  {why}", truth.compared_range_m());
    };
    let (range, velocity, snr) = (estimate.range_m, estimate.radial_velocity_mps, estimate.snr_db);
    let range_error = signed(range - truth.compared_range_m(), 6);
    let velocity_error = signed(velocity - truth.compared_radial_velocity_mps(), 6);
    let velocity = signed(velocity, 7);
    let numbers = format!("{range:6.2} m  {range_error} {velocity} m/s  {velocity_error} {snr:4.0} dB");
    let lane = lanes.text(estimate.lane, truth.lane);
    let (numbers, class) = (numbers.replace('-', "−"), class(target));
    let aliasing = if target.velocity_aliased { "; velocity aliased in the map" } else { "" };
    format!("  {id:<width$} {numbers}  {lane:<4}  {class}{aliasing}")
}

/// Text of a value with its sign, to hundredths; a value that rounds to zero has a plus.
fn signed(value: f64, width: usize) -> String {
    let value = if value.abs() < 0.005 { 0.0 } else { value };
    format!("{value:+width$.2}")
}

/// Column of lanes: compared with the truth where the array tells an azimuth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum LaneColumn {
    Compared,
    Unknown,
}

impl LaneColumn {
    fn of(summary: &Summary) -> Self {
        if summary.radar.tells_azimuth { Self::Compared } else { Self::Unknown }
    }

    fn text(self, got: Option<u8>, asked: Option<u8>) -> String {
        let [got, asked] = [got, asked].map(|lane| lane.map_or("–".into(), |lane| lane.to_string()));
        if got == asked || self == Self::Unknown { got } else { format!("{got}≠{asked}") }
    }
}

/// Class of the target: that of its track if there is one, otherwise that of this frame.
fn class(target: &TargetSummary) -> String {
    let by_track = target.track_class.zip(target.track_probabilities);
    let told = by_track.or(target.predicted_class.map(|predicted| (predicted, target.probabilities)));
    let Some((predicted, probabilities)) = told else { return "–".into() };
    let name = predicted.name();
    let Some((likeliest, probability)) = probabilities.likeliest() else { return name.into() };
    let is_likeliest = predicted == Predicted::Class(likeliest);
    let told = if is_likeliest { name.to_owned() } else { format!("{name}, {}", likeliest.name()) };
    let wrong = target.class.filter(|class| predicted != Predicted::Class(*class));
    let wrong = wrong.map_or(String::new(), |class| format!(" (is a {})", class.name()));
    format!("{told} {probability:.2}{wrong}")
}

fn false_object(object: &FalseObject) -> String {
    let FalseObject { range_m, x_m, y_m, snr_db, .. } = object;
    let velocity = signed(object.radial_velocity_mps, 1);
    let text =
        format!("  false object at {range_m:.2} m ({x_m:.1}, {y_m:.1}), {velocity} m/s, {snr_db:.0} dB: ");
    text.replace('-', "−") + &object.cause_in_words()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lane_is_compared_with_the_true_one_where_the_array_tells_an_azimuth_alone() {
        let compared = |got, asked| LaneColumn::Compared.text(got, asked);
        assert_eq!([compared(Some(2), Some(2)), compared(None, None)], ["2", "–"]);
        assert_eq!([compared(Some(1), Some(2)), compared(None, Some(1))], ["1≠2", "–≠1"]);
        assert_eq!(LaneColumn::Unknown.text(None, Some(1)), "–");
    }
}
