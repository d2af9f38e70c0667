//! What `run` says at its end, from `summary.json` alone: what was found, how well, and whether the accuracy
//! asked for was reached.

use crate::outcome::verdict::{self, FRAMES_IN_FULL, decibels};
use serde_json::Value;
use std::collections::BTreeMap;

/// Frames that have a line: more would push the rest off the screen.
const FRAMES_TOLD: usize = 24;
/// False objects of a frame that have a line of their own.
const FALSE_OBJECTS_LISTED: usize = 8;

/// What several radars have in common, from the summary above theirs: a line for each, and what none of them
/// found.
pub(crate) fn lines_of_radars(summary: &Value) -> Vec<String> {
    let of_radar = |radar: &Value| {
        let count = |key: &str| radar[key].as_u64().unwrap_or(0) as usize;
        let count = Count {
            found: count("found"),
            missed: count("missed"),
            false_ones: count("false"),
            stationary: count("stationary"),
            removed: count("removed"),
            hidden: 0,
        };
        let accuracy = &radar["accuracy"];
        let verdict = if accuracy["met"] == false { "NOT REACHED" } else { "reached" };
        let (error, asked) = (decibels(&accuracy["reached_db"]), decibels(&accuracy["asked_db"]));
        let id = radar["id"].as_str().unwrap_or_default();
        format!("radar {id}: {}; numerical error {error}, {asked} asked: {verdict}", count.text())
    };
    let by_nobody = items(&summary["frames"]).enumerate().flat_map(|(number, frame)| {
        let is_empty = |list: &Value| items(list).next().is_none();
        let unseen =
            items(&frame["targets"]).filter(move |t| is_empty(&t["found_by"]) && !is_empty(&t["missed_by"]));
        unseen.map(move |target| {
            format!("  frame {number}: {} is found by no radar", target["id"].as_str().unwrap_or("?"))
        })
    });
    let mut lines: Vec<String> = items(&summary["radars"]).map(of_radar).collect();
    lines.extend(by_nobody.take(FRAMES_TOLD));
    lines
}

/// All that a person wants to know first.
pub(crate) fn lines(root: &Value) -> Vec<String> {
    let frames: Vec<&Value> = items(&root["frames"]).collect();
    if frames.len() <= FRAMES_IN_FULL {
        let in_full = frames.iter().enumerate().flat_map(|(number, frame)| in_full(number, frame));
        return in_full.chain(of_clutter(root, &frames)).collect();
    }
    let mut lines: Vec<String> =
        frames.iter().take(FRAMES_TOLD).enumerate().map(|(number, frame)| in_a_line(number, frame)).collect();
    if frames.len() > FRAMES_TOLD {
        lines.push(format!("frames {FRAMES_TOLD} to {} stand in summary.json", frames.len() - 1));
    }
    lines.extend(together(&frames));
    lines.extend(of_clutter(root, &frames));
    lines
}

/// What would take clutter out of the false objects, where some of them are that and nobody asked for it.
fn of_clutter(root: &Value, frames: &[&Value]) -> Option<String> {
    let false_ones = frames.iter().flat_map(|frame| items(&frame["false_objects"]));
    let clutter = false_ones.filter(|object| object["cause"] == "clutter").count();
    let is_asked = clutter > 0 && root["static"] == "keep";
    is_asked.then(|| {
        format!("{clutter} false objects are clutter: static = \"mark\" in [dsp] tells apart what is at rest, \"remove\" leaves it out")
    })
}

fn items(list: &Value) -> impl Iterator<Item = &Value> {
    list.as_array().into_iter().flatten()
}

/// What was found of what was to be found.
#[derive(Default, Clone, Copy)]
struct Count {
    found: usize,
    missed: usize,
    false_ones: usize,
    stationary: usize,
    removed: usize,
    hidden: usize,
}

impl Count {
    fn of(frame: &Value) -> Self {
        let targets =
            |found: Value| items(&frame["targets"]).filter(|target| target["found"] == found).count();
        let removed = items(&frame["targets"]).filter(|target| target["removed"] == true).count();
        Self {
            found: targets(true.into()),
            missed: targets(false.into()),
            hidden: targets(Value::Null) - removed,
            false_ones: items(&frame["false_objects"]).count(),
            stationary: items(&frame["stationary_objects"]).count(),
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

fn in_a_line(number: usize, frame: &Value) -> String {
    let error = decibels(&frame["accuracy"]["reached_db"]);
    let missed = if frame["accuracy"]["met"] == false { " (not reached)" } else { "" };
    format!(
        "frame {number:>3}, {:.3} s: {}; error {error}{missed}",
        number_of(&frame["time_s"]),
        Count::of(frame).text()
    )
}

/// All frames together.
fn together(frames: &[&Value]) -> Vec<String> {
    let count = frames.iter().map(|frame| Count::of(frame)).fold(Count::default(), Count::and);
    let false_ones: Vec<&Value> = frames.iter().flat_map(|frame| items(&frame["false_objects"])).collect();
    let causes =
        if false_ones.is_empty() { String::new() } else { format!(" (false: {})", causes(&false_ones)) };
    let mut lines = vec![format!("all {} frames: {}{causes}", frames.len(), count.text())];
    lines.extend(worst_error(frames));
    lines
}

/// The frame with the largest error, and how many did not reach what was asked.
fn worst_error(frames: &[&Value]) -> Vec<String> {
    let error = |frame: &Value| frame["accuracy"]["reached_db"].as_f64();
    let known = frames.iter().enumerate().filter_map(|(number, frame)| Some((number, frame, error(frame)?)));
    let Some((number, frame, _)) = known.max_by(|a, b| a.2.total_cmp(&b.2)) else { return vec![] };
    let missed = frames.iter().filter(|frame| frame["accuracy"]["met"] == false).count();
    let mut lines = vec![format!(
        "  accuracy reached in {} of {} frames; the worst, frame {number}:",
        frames.len() - missed,
        frames.len()
    )];
    lines.extend(
        verdict::lines(&frame["accuracy"], &frame["error_db"]).into_iter().map(|line| format!("    {line}")),
    );
    lines.extend(left_out(frame));
    lines
}

fn in_full(number: usize, frame: &Value) -> Vec<String> {
    let points = frame["points"].as_u64().unwrap_or(0);
    let mut lines = vec![format!(
        "frame {number}, {:.3} s: {}; {points} points",
        number_of(&frame["time_s"]),
        Count::of(frame).text()
    )];
    lines.extend(
        verdict::lines(&frame["accuracy"], &frame["error_db"]).into_iter().map(|line| format!("  {line}")),
    );
    lines.extend(left_out(frame));
    lines.extend(targets(frame));
    lines.extend(false_objects(frame));
    lines.extend(standing(frame));
    lines
}

/// Objects that the radar tells to be at rest: how many of which causes.
fn standing(frame: &Value) -> Option<String> {
    let all: Vec<&Value> = items(&frame["stationary_objects"]).collect();
    (!all.is_empty()).then(|| format!("  {} objects at rest and of no target: {}", all.len(), causes(&all)))
}

/// The strongest, and how many more of which causes.
fn false_objects(frame: &Value) -> Vec<String> {
    let all: Vec<&Value> = items(&frame["false_objects"]).collect();
    let (listed, more) = all.split_at(all.len().min(FALSE_OBJECTS_LISTED));
    let mut lines: Vec<String> = listed.iter().map(|object| false_object(object)).collect();
    if !more.is_empty() {
        lines.push(format!("  {} more false objects: {}", more.len(), causes(more)));
    }
    lines
}

/// How many of each cause.
fn causes(objects: &[&Value]) -> String {
    let mut causes: BTreeMap<&str, usize> = BTreeMap::new();
    for object in objects {
        *causes.entry(object["cause"].as_str().unwrap_or("unknown")).or_default() += 1;
    }
    causes.iter().map(|(cause, many)| format!("{many} {cause}")).collect::<Vec<_>>().join(", ")
}

/// What the model leaves out, apart from numerical errors.
fn left_out(frame: &Value) -> Option<String> {
    let sources = frame["model_error_db"].as_object()?.iter();
    let named: Vec<String> = sources
        .filter(|(_, db)| !db.is_null())
        .map(|(name, db)| format!("{} {}", name.replace('_', " "), decibels(db)))
        .collect();
    (!named.is_empty()).then(|| format!("  left out by the model: {}", named.join(", ")))
}

/// A table, one row a target.
fn targets(frame: &Value) -> Vec<String> {
    let targets: Vec<&Value> = items(&frame["targets"]).collect();
    if targets.is_empty() {
        return vec![];
    }
    let width = targets
        .iter()
        .filter_map(|t| t["id"].as_str())
        .map(|id| id.chars().count())
        .max()
        .unwrap_or(0)
        .max(6);
    let head = format!("  {:<width$}   range   error    velocity   error     SNR  lane  predicted", "target");
    std::iter::once(head).chain(targets.iter().map(|target| target_row(target, width))).collect()
}

fn target_row(target: &Value, width: usize) -> String {
    let id = target["id"].as_str().unwrap_or("?");
    let (truth, estimate) = (&target["truth"], &target["estimate"]);
    if estimate.is_null() {
        let why = match (&target["found"], &target["removed"]) {
            (Value::Bool(false), _) => "missed",
            (_, Value::Bool(true)) => "removed as an echo at rest (static in [dsp])",
            _ => "hidden or out of range",
        };
        let range = number_of(first(&truth["echo_range_m"], &truth["range_m"]));
        return format!("  {id:<width$} {range:6.2} m  {why}");
    }
    let (range, range_error) =
        compared(&estimate["range_m"], first(&truth["echo_range_m"], &truth["range_m"]));
    let told = &truth["echo_radial_velocity_mps"];
    let (velocity, velocity_error) =
        compared(&estimate["radial_velocity_mps"], first(told, &truth["radial_velocity_mps"]));
    let snr = number_of(&estimate["snr_db"]);
    let [range_error, velocity, velocity_error] =
        [(range_error, 6), (velocity, 7), (velocity_error, 6)].map(|(value, width)| signed(value, width));
    let numbers = format!("{range:6.2} m  {range_error} {velocity} m/s  {velocity_error} {snr:4.0} dB");
    let (numbers, lane, class) = (numbers.replace('-', "−"), lane(target), class(target));
    format!("  {id:<width$} {numbers}  {lane:<4}  {class}{}", aliasing(target))
}

/// The first where it is known.
fn first<'a>(known: &'a Value, otherwise: &'a Value) -> &'a Value {
    if known.is_null() { otherwise } else { known }
}

/// With its sign, and none that rounding left of nothing.
fn signed(value: f64, width: usize) -> String {
    let value = if value.abs() < 0.005 { 0.0 } else { value };
    format!("{value:+width$.2}")
}

fn number_of(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// An estimate and what it errs by.
fn compared(estimate: &Value, truth: &Value) -> (f64, f64) {
    (number_of(estimate), number_of(estimate) - number_of(truth))
}

fn lane(target: &Value) -> String {
    let of = |value: &Value| value.as_u64().map_or("–".into(), |lane| lane.to_string());
    let [got, asked] = [&target["estimate"]["lane"], &target["truth"]["lane"]].map(of);
    if got == asked { got } else { format!("{got}≠{asked}") }
}

/// Of the target's track where there is one, else of this frame.
fn class(target: &Value) -> String {
    let keys = [("track_class", "track_probabilities"), ("predicted_class", "probabilities")];
    let told = keys.iter().find_map(|(class, p)| Some((target[*class].as_str()?, &target[*p])));
    let Some((predicted, probabilities)) = told else { return "–".into() };
    let likeliest =
        probabilities.as_object().into_iter().flatten().filter_map(|(name, p)| Some((name, p.as_f64()?)));
    let Some((name, probability)) = likeliest.max_by(|a, b| a.1.total_cmp(&b.1)) else {
        return predicted.into();
    };
    let class = if predicted == name { predicted.to_owned() } else { format!("{predicted}, {name}") };
    let wrong = target["class"].as_str().filter(|class| *class != predicted);
    format!("{class} {probability:.2}{}", wrong.map_or(String::new(), |class| format!(" (is a {class})")))
}

/// Whether the map shows another velocity than the true one; the estimate may have got over it.
fn aliasing(target: &Value) -> &'static str {
    match target["velocity_aliased"] == true {
        true => "; velocity aliased in the map",
        false => "",
    }
}

fn false_object(object: &Value) -> String {
    let [range, velocity, snr] =
        ["range_m", "radial_velocity_mps", "snr_db"].map(|key| number_of(&object[key]));
    let [x, y] = ["x_m", "y_m"].map(|key| number_of(&object[key]));
    let velocity = signed(velocity, 1);
    let text = format!("  false object at {range:.2} m ({x:.1}, {y:.1}), {velocity} m/s, {snr:.0} dB: ");
    text.replace('-', "−") + &cause(object)
}

fn cause(object: &Value) -> String {
    let bodies: Vec<&str> = items(&object["bodies"]).filter_map(Value::as_str).collect();
    let bounces = object["bounces"].as_u64().map_or(String::new(), |n| format!(", {n} bounces"));
    match (object["cause"].as_str().unwrap_or("unknown"), &bodies[..]) {
        ("ghost", _) => format!("ghost by {}{bounces}", bodies.join(" and ")),
        ("split", _) => format!("split off {}, which has an object", bodies.join(" and ")),
        ("misplaced", _) => format!("echo of {}, too far from it{bounces}", bodies.join(" and ")),
        ("clutter", []) => "clutter: the road".into(),
        ("clutter", _) => format!("clutter: {}", bodies.join(" and ")),
        (other, _) => other.to_owned(),
    }
}
