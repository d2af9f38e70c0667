//! Data of a study's view: designs with their places, metrics, and the first situations.

use crate::metrics::Better;
use crate::outputs::report::FinishedStudy;
use crate::runs::one_run;
use crate::study::axis::{Axis, AxisChoice};
use crate::study::situations::Situation;
use pipeline::host::failure::Failure;
use reporting::report::sweep_view::{Design, Metric, Situation as Seen, SweepView};
use scene::MeshLoading;

/// Largest number of designs in a view: more make a page of several megabytes.
const DESIGNS: usize = 2_000;
/// Largest number of situations in a view.
const SITUATIONS: usize = 24;

/// The view of a finished study, with these situations in their order.
///
/// # Errors
/// Those of reading a scene, which every design has passed before its runs.
pub(crate) fn of(finished: &FinishedStudy, situations: &[&Situation]) -> Result<SweepView, Failure> {
    let shown = shown(finished);
    let place = |design: Option<usize>| shown.iter().position(|own| Some(*own) == design);
    let first = finished.answer.chosen.unwrap_or(0);
    let seen: Vec<&Situation> = situations.iter().take(SITUATIONS).copied().collect();
    let design = |number: &usize| design(finished, *number, seen.first().copied(), seen.len());
    let situation = |situation: &&Situation| {
        let words = words(finished, situation);
        Ok(Seen {
            words,
            header: one_run::read(finished.study, &finished.designs[first], situation, MeshLoading::Whole)?,
        })
    };
    Ok(SweepView {
        axes: finished.study.vary.iter().map(|axis| axis.name.clone()).collect(),
        metrics: metrics(finished),
        goal: finished.study.goal.metric,
        cost: finished.study.goal.cost,
        designs: shown.iter().map(design).collect::<Result<_, Failure>>()?,
        designs_all: finished.designs.len(),
        answer: place(finished.answer.chosen),
        best: place(finished.answer.best),
        situations: seen.iter().map(situation).collect::<Result<_, Failure>>()?,
        situations_all: situations.len(),
    })
}

/// Designs of the view in order: all, or the front, the candidates, and the best of the others.
fn shown(finished: &FinishedStudy) -> Vec<usize> {
    let answer = finished.answer;
    let worth = |design: &usize| {
        let mean = answer.results[*design].mean.map(|mean| finished.study.goal.better.rising(mean.value));
        mean.unwrap_or(f64::NEG_INFINITY)
    };
    let is_told = |design: &usize| answer.front.contains(design) || answer.candidates.contains(design);
    let mut all: Vec<usize> = (0..finished.designs.len()).collect();
    all.sort_by(|a, b| is_told(b).cmp(&is_told(a)).then(worth(b).total_cmp(&worth(a))).then(a.cmp(b)));
    all.truncate(DESIGNS);
    all.sort_unstable();
    all
}

/// Metrics in order; the direction of the goal's is that of the study.
fn metrics(finished: &FinishedStudy) -> Vec<Metric> {
    let (metrics, goal) = (&finished.study.metrics, &finished.study.goal);
    let better = |metric| if metric == goal.metric { goal.better } else { metrics.better(metric) };
    let metric = |(metric, name): (usize, &str)| Metric {
        name: name.to_owned(),
        is_lower_better: better(metric) == Better::Lower,
    };
    metrics.names().enumerate().map(metric).collect()
}

fn design(
    finished: &FinishedStudy,
    number: usize,
    situation: Option<&Situation>,
    situations: usize,
) -> Result<Design, Failure> {
    let FinishedStudy { study, designs, ledger, answer, remarks: _ } = finished;
    let mean = |metric| {
        let mean = study.metrics.mean(metric, &ledger.metric(number, metric), study.confidence);
        mean.map(|mean| (mean.value, mean.half_width))
    };
    let mut goal_by_situation = ledger.metric(number, study.goal.metric);
    goal_by_situation.resize(situations, None);
    let radar = match situation {
        Some(situation) => one_run::read(study, &designs[number], situation, MeshLoading::NamesOnly)?.radar,
        None => return Err(Failure::System("the study has no situation".into())),
    };
    Ok(Design {
        number,
        labels: designs[number].iter().map(|pick| pick.label.clone()).collect(),
        radar,
        means: (0..study.metrics.names().count()).map(mean).collect(),
        goal_by_situation,
        situations: ledger.runs(number).len(),
        is_candidate: answer.candidates.contains(&number),
        is_on_front: answer.front.contains(&number),
    })
}

/// A situation in words: its conditions and its repeat.
fn words(finished: &FinishedStudy, situation: &Situation) -> String {
    let picked = |(axis, pick): (&Axis, &AxisChoice)| {
        let of = if pick.label.chars().count() > 40 { "…" } else { &pick.label };
        format!("{} {of}, ", axis.name)
    };
    let picks: String = finished.study.conditions.iter().zip(&situation.picks).map(picked).collect();
    format!("{picks}repeat {}", situation.repeat)
}
