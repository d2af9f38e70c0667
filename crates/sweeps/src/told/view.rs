//! Data of a study's view: designs with their places, metrics, and the first situations.

use crate::metrics::Better;
use crate::runs::one_run;
use crate::study::axis::{Axis, Pick};
use crate::study::situations::Situation;
use crate::told::report::Done;
use pipeline::host::failure::Failure;
use reporting::report::sweep_view::{Design, Metric, Situation as Seen, SweepView};
use scene::Meshes;

/// Largest number of designs in a view: more make a page of several megabytes.
const DESIGNS: usize = 2_000;
/// Largest number of situations in a view.
const SITUATIONS: usize = 24;

/// The view of a finished study, with these situations in their order.
///
/// # Errors
/// Those of reading a scene, which every design has passed before its runs.
pub(crate) fn of(done: &Done, situations: &[&Situation]) -> Result<SweepView, Failure> {
    let shown = shown(done);
    let place = |design: Option<usize>| shown.iter().position(|own| Some(*own) == design);
    let first = done.answer.chosen.unwrap_or(0);
    let seen: Vec<&Situation> = situations.iter().take(SITUATIONS).copied().collect();
    let design = |number: &usize| design(done, *number, seen.first().copied(), seen.len());
    let situation = |situation: &&Situation| {
        let words = words(done, situation);
        Ok(Seen { words, header: one_run::read(done.study, &done.designs[first], situation, Meshes::Whole)? })
    };
    Ok(SweepView {
        axes: done.study.vary.iter().map(|axis| axis.name.clone()).collect(),
        metrics: metrics(done),
        goal: done.study.goal.metric,
        cost: done.study.goal.cost,
        designs: shown.iter().map(design).collect::<Result<_, Failure>>()?,
        designs_all: done.designs.len(),
        answer: place(done.answer.chosen),
        best: place(done.answer.best),
        situations: seen.iter().map(situation).collect::<Result<_, Failure>>()?,
        situations_all: situations.len(),
    })
}

/// Designs of the view in order: all, or the front, the candidates, and the best of the others.
fn shown(done: &Done) -> Vec<usize> {
    let answer = done.answer;
    let worth = |design: &usize| {
        let mean = answer.standings[*design].mean.map(|mean| done.study.goal.better.rising(mean.value));
        mean.unwrap_or(f64::NEG_INFINITY)
    };
    let is_told = |design: &usize| answer.front.contains(design) || answer.candidates.contains(design);
    let mut all: Vec<usize> = (0..done.designs.len()).collect();
    all.sort_by(|a, b| is_told(b).cmp(&is_told(a)).then(worth(b).total_cmp(&worth(a))).then(a.cmp(b)));
    all.truncate(DESIGNS);
    all.sort_unstable();
    all
}

/// Metrics in order; the direction of the goal's is that of the study.
fn metrics(done: &Done) -> Vec<Metric> {
    let (measures, goal) = (&done.study.measures, &done.study.goal);
    let better = |metric| if metric == goal.metric { goal.better } else { measures.better(metric) };
    let metric = |(metric, name): (usize, &str)| Metric {
        name: name.to_owned(),
        is_lower_better: better(metric) == Better::Lower,
    };
    measures.names().enumerate().map(metric).collect()
}

fn design(
    done: &Done,
    number: usize,
    situation: Option<&Situation>,
    situations: usize,
) -> Result<Design, Failure> {
    let Done { study, designs, ledger, answer, remarks: _ } = done;
    let mean = |metric| {
        let mean = study.measures.mean(metric, &ledger.metric(number, metric), study.confidence);
        mean.map(|mean| (mean.value, mean.half_width))
    };
    let mut goal_by_situation = ledger.metric(number, study.goal.metric);
    goal_by_situation.resize(situations, None);
    let radar = match situation {
        Some(situation) => one_run::read(study, &designs[number], situation, Meshes::NamesOnly)?.radar,
        None => return Err(Failure::System("the study has no situation".into())),
    };
    Ok(Design {
        number,
        labels: designs[number].iter().map(|pick| pick.label.clone()).collect(),
        radar,
        means: (0..study.measures.names().count()).map(mean).collect(),
        goal_by_situation,
        situations: ledger.runs(number).len(),
        is_candidate: answer.candidates.contains(&number),
        is_on_front: answer.front.contains(&number),
    })
}

/// A situation in words: its conditions and its repeat.
fn words(done: &Done, situation: &Situation) -> String {
    let picked = |(axis, pick): (&Axis, &Pick)| {
        let of = if pick.label.chars().count() > 40 { "…" } else { &pick.label };
        format!("{} {of}, ", axis.name)
    };
    let picks: String = done.study.conditions.iter().zip(&situation.picks).map(picked).collect();
    format!("{picks}repeat {}", situation.repeat)
}
