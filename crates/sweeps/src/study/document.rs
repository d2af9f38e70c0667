//! A study's file, `STUDY.toml`; its keys are in `docs/sweeps.md`.

use crate::metrics::{Better, Metrics};
use crate::study::axes;
use crate::study::axis::Axis;
use crate::study::fields::{Fields, nearest, number};
use crate::study::study_text::StudyText;
use artifact::seed::SEEDS;
use pipeline::host::failure::Failure;
use scene::toml_text::{self, TooDeep};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::de::DeTable;

/// Largest number of designs, and of runs, of a study: at a second per run it takes a third of a year.
pub(crate) const DESIGNS_LIMIT: u64 = 100_000;
pub(crate) const RUNS_LIMIT: u64 = 10_000_000;
const REPEATS_LIMIT: u64 = 10_000;

const KEYS: [&str; 11] = [
    "scene",
    "radar",
    "seed",
    "repeats",
    "confidence",
    "range_bands_m",
    "vary",
    "condition",
    "sample",
    "goal",
    "stop",
];

/// A study, checked by itself; its scenes are checked later.
pub(crate) struct Study {
    /// File that was read.
    pub(crate) page: Arc<StudyText>,
    /// Scene that all designs change.
    pub(crate) scene: PathBuf,
    /// Id of one of several radars.
    pub(crate) radar: Option<String>,
    pub(crate) seed: u64,
    pub(crate) repeats: u32,
    /// Confidence of the intervals of means.
    pub(crate) confidence: f64,
    pub(crate) metrics: Metrics,
    /// Axes of the choice.
    pub(crate) vary: Vec<Axis>,
    /// Axes of conditions, over which results are averaged.
    pub(crate) conditions: Vec<Axis>,
    /// Number of drawn designs; `None`: all combinations of the listed values.
    pub(crate) sample: Option<u32>,
    pub(crate) goal: Goal,
    /// Rule for dropping designs; `None`: all are repeated equally often.
    pub(crate) stop: Option<EarlyStopping>,
}

/// Metric that a study chooses by.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Goal {
    /// Index of the metric among the metrics.
    pub(crate) metric: usize,
    pub(crate) better: Better,
    /// Index of a design's cost among the metrics; less is better.
    pub(crate) cost: usize,
    /// Acceptable loss of the metric for a cheaper design; `None`: one standard error of the difference.
    pub(crate) margin: Option<f64>,
}

/// Rule for dropping designs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EarlyStopping {
    /// Probability that the best design is not dropped.
    pub(crate) confidence: f64,
    /// Least number of situations before a design is dropped.
    pub(crate) least: usize,
}

impl Study {
    /// Reads and checks the file; `seed` replaces its own.
    pub(crate) fn read(file: &Path, seed: Option<u64>) -> Result<Self, Failure> {
        let page = Arc::new(StudyText::read(file)?);
        let too_deep = |fault: TooDeep| page.refused(fault.byte, "", &fault.to_string());
        toml_text::check_brackets(&page.text).map_err(too_deep)?;
        let table = DeTable::parse(&page.text).map_err(|error| {
            let at = error.span().map_or(0, |span| span.start);
            page.refused(at, "", &format!("not valid TOML: {}", error.message()))
        })?;
        toml_text::check(table.get_ref()).map_err(too_deep)?;
        let root = Fields::of(&page, "", 0, table.get_ref(), &KEYS)?;
        let study = Self::of(&root, &page)?;
        Ok(Self { seed: seed.unwrap_or(study.seed), ..study })
    }

    fn of(root: &Fields<'_>, page: &Arc<StudyText>) -> Result<Self, Failure> {
        let axes = |key| root.tables(key, &axes::KEYS)?.iter().map(axes::read).collect::<Result<Vec<_>, _>>();
        let (vary, conditions) = (axes("vary")?, axes("condition")?);
        let sample = root.table("sample", &["count"])?.map(|sample| count(&sample)).transpose()?;
        once_each(root, &vary, &conditions)?;
        with_effect(page, &vary, &conditions)?;
        size(root, &vary, sample)?;
        let confidence = root.number("confidence", 0.5..=0.9999)?.unwrap_or(0.95);
        let metrics = Metrics::of(bands(root)?);
        let goal = root.table("goal", &["metric", "better", "cost", "margin"])?;
        let stop = root.table("stop", &["confidence", "least"])?;
        Ok(Self {
            page: page.clone(),
            scene: page.file.parent().unwrap_or(Path::new("")).join(required(
                root,
                "scene",
                root.text("scene")?,
            )?),
            radar: root.text("radar")?.map(str::to_owned),
            seed: root.whole("seed", SEEDS)?.unwrap_or(1),
            repeats: root.whole("repeats", 1..=REPEATS_LIMIT)?.unwrap_or(1) as u32,
            confidence,
            goal: read_goal(&required(root, "goal", goal)?, &metrics)?,
            stop: stop.map(|stop| read_stop(&stop, confidence)).transpose()?,
            metrics,
            vary,
            conditions,
            sample,
        })
    }
}

fn required<T>(fields: &Fields<'_>, key: &str, value: Option<T>) -> Result<T, Failure> {
    value.ok_or_else(|| fields.refused_whole(&format!("`{key}` is missing")))
}

fn bands(root: &Fields<'_>) -> Result<Vec<f64>, Failure> {
    let Some(bounds) = root.list("range_bands_m")? else { return Ok(vec![30.0, 60.0]) };
    let bounds: Option<Vec<f64>> = bounds.iter().map(|bound| number(bound.get_ref())).collect();
    let is_right = |bounds: &Vec<f64>| {
        (1..=16).contains(&bounds.len()) && bounds[0] > 0.0 && bounds.windows(2).all(|pair| pair[0] < pair[1])
    };
    let rule = "`range_bands_m` has to be 1 to 16 rising numbers of metres above 0";
    bounds.filter(is_right).ok_or_else(|| root.refused_whole(rule))
}

fn count(sample: &Fields<'_>) -> Result<u32, Failure> {
    Ok(required(sample, "count", sample.whole("count", 1..=DESIGNS_LIMIT)?)? as u32)
}

/// Refuses keys that two axes change, which would have the value of neither; likewise a key within a list or
/// table that another one replaces.
fn once_each(root: &Fields<'_>, vary: &[Axis], conditions: &[Axis]) -> Result<(), Failure> {
    let all: Vec<&str> =
        vary.iter().chain(conditions).flat_map(|axis| &axis.keys).map(String::as_str).collect();
    let mut pairs =
        all.iter().enumerate().flat_map(|(number, key)| all[..number].iter().map(move |of| (*key, *of)));
    match pairs.find(|(key, other)| overlap(key, other)) {
        Some((key, other)) if key == other => {
            Err(root.refused_whole(&format!("`{key}` is changed by two of `vary` and `condition`")))
        }
        Some((key, other)) => Err(root.refused_whole(&format!(
            "`{key}` and `{other}`, of which one holds the other, are changed by two of `vary` and `condition`"
        ))),
        None if vary.is_empty() => Err(root.refused_whole("`vary` is missing: there is nothing to choose")),
        None => Ok(()),
    }
}

/// Whether two keys are equal, or one is within a list or table of the other. Indices in lists are numbers: 0
/// and 00 are equal.
fn overlap(key: &str, other: &str) -> bool {
    let place = |text: &str| text.parse::<u32>().ok();
    let is_same = |(a, b): (&str, &str)| a == b || place(a).is_some_and(|a| place(b) == Some(a));
    key.split('.').zip(other.split('.')).all(is_same)
}

/// Keys of a scene that have no effect in a study, each with the reason.
const WITHOUT_EFFECT: [(&str, &str); 4] = [
    ("seed", "every situation has a seed of its own, drawn by that of the study"),
    ("name", "a scene is computed alike by any name"),
    ("fidelity.measured_every", "a study measures errors once in a run"),
    ("fidelity.plan", "a study takes the scene's keys as they are said"),
];

/// Refuses keys without effect, which make equal designs.
fn with_effect(page: &StudyText, vary: &[Axis], conditions: &[Axis]) -> Result<(), Failure> {
    let reason = |key: &String| WITHOUT_EFFECT.iter().find(|(idle, _)| idle == key);
    let idle = |axis: &Axis| Some((axis.places.first().copied(), axis.keys.iter().find_map(reason)?));
    match vary.iter().chain(conditions).find_map(idle) {
        Some((place, (key, reason))) => {
            let place = place.map_or_else(String::new, |place| format!("{place}:"));
            let file = page.file.display();
            Err(Failure::Refused(format!("{file}:{place} `{key}` changes nothing: {reason}")))
        }
        None => Ok(()),
    }
}

fn size(root: &Fields<'_>, vary: &[Axis], sample: Option<u32>) -> Result<(), Failure> {
    let is_drawn = vary.iter().any(|axis| axis.listed().is_none());
    if is_drawn && sample.is_none() {
        return Err(root.refused_whole("`draw` of [[vary]] asks for [sample] with the `count` of designs"));
    }
    let counts = vary.iter().map(|axis| axis.listed().map_or(1, <[_]>::len) as u64);
    let all = counts.fold(1, u64::saturating_mul);
    if sample.is_none() && all > DESIGNS_LIMIT {
        return Err(root.refused_whole(&format!(
            "`vary` has {all} designs, more than {DESIGNS_LIMIT}: draw a [sample]"
        )));
    }
    Ok(())
}

fn read_goal(goal: &Fields<'_>, metrics: &Metrics) -> Result<Goal, Failure> {
    let metric = required(goal, "metric", goal.text("metric")?)?;
    let metric = metric_index(goal, "metric", metric, metrics)?;
    let better = match goal.text("better")? {
        None => metrics.better(metric),
        Some("lower") => Better::Lower,
        Some("higher") => Better::Higher,
        Some(other) => {
            return Err(
                goal.refused_whole(&format!("`better` has to be \"lower\" or \"higher\", is \"{other}\""))
            );
        }
    };
    let cost = metric_index(goal, "cost", goal.text("cost")?.unwrap_or("channels"), metrics)?;
    Ok(Goal { metric, better, cost, margin: goal.number("margin", 0.0..=1e9)? })
}

fn metric_index(goal: &Fields<'_>, key: &str, name: &str, metrics: &Metrics) -> Result<usize, Failure> {
    let known: Vec<&str> = metrics.names().collect();
    let refused = || {
        let at = goal.value(key).map_or(goal.at, |value| value.span().start);
        goal.refused(at, &format!("`{key}`: there is no metric `{name}`{}", nearest(name, &known)))
    };
    known.iter().position(|known| *known == name).ok_or_else(refused)
}

fn read_stop(stop: &Fields<'_>, confidence: f64) -> Result<EarlyStopping, Failure> {
    let confidence = stop.number("confidence", 0.5..=0.9999)?.unwrap_or(confidence);
    Ok(EarlyStopping { confidence, least: stop.whole("least", 2..=RUNS_LIMIT)?.unwrap_or(8) as usize })
}
