//! The report of a study: the selected design, its certainty, and the worth of the others.

use crate::answer::{Answer, Effect, effects};
use crate::outputs::accuracy;
use crate::outputs::blocks::Block;
use crate::outputs::gaps;
use crate::runs::ledger::Ledger;
use crate::statistics::interval::Mean;
use crate::study::axis::AxisChoice;
use crate::study::document::Study;
use plotting::axes::tick_text;

/// A study with all of its measurements.
pub(crate) struct FinishedStudy<'a> {
    pub(crate) study: &'a Study,
    pub(crate) designs: &'a [Vec<AxisChoice>],
    pub(crate) ledger: &'a Ledger,
    pub(crate) answer: &'a Answer,
    /// Sentences about the parts of its scene that a study does not use.
    pub(crate) remarks: &'a [String],
}

/// Parts of the report before its picture: the answer.
pub(crate) fn answer(finished: &FinishedStudy) -> Vec<Block> {
    finished.sentences().into_iter().map(Block::Paragraph).collect()
}

/// Parts of the report after its picture.
pub(crate) fn details(finished: &FinishedStudy) -> Vec<Block> {
    let front = Block::Table(
        "Front".into(),
        finished.head(),
        finished.answer.front.iter().map(|d| finished.row(*d)).collect(),
    );
    let mut blocks = vec![Block::Heading("The front".into()), front];
    for (number, axis) in finished.study.vary.iter().enumerate().filter(|(_, axis)| axis.listed().is_some()) {
        blocks.push(Block::Heading(format!("By {}", axis.name)));
        blocks.push(finished.by_axis(
            &axis.name,
            &effects(finished.study, finished.designs, finished.ledger, finished.answer, number),
        ));
    }
    blocks.push(Block::Heading("All metrics".into()));
    blocks.push(finished.metrics());
    blocks.push(Block::Paragraph(finished.method()));
    blocks
}

impl FinishedStudy<'_> {
    /// The answer in sentences: the first names the design; others qualify it by its situations and the
    /// accuracy of the runs.
    pub(crate) fn sentences(&self) -> Vec<String> {
        let gaps = gaps::sentence(&self.answer.results, |design| self.seen(design), self.metric());
        let accuracy = accuracy::sentences(self.ledger, &self.answer.candidates);
        self.choice().into_iter().chain(gaps).chain(accuracy).chain(self.remarks.iter().cloned()).collect()
    }

    fn choice(&self) -> Vec<String> {
        let (Some(best), Some(chosen)) = (self.answer.best, self.answer.chosen) else {
            return vec![format!("No answer: {} was known in no run.", self.metric())];
        };
        let candidates = self.answer.candidates.len();
        let (cost, metric) = (self.cost(), self.metric());
        let first = format!("Answer: {}.", self.named(chosen));
        let worth = format!(
            "It has a {metric} of {} and costs {} {cost}.",
            self.mean(chosen),
            number(self.answer.results[chosen].cost),
        );
        let others = match candidates {
            1 => "It is the best, and no other is as near to it as would do.".to_owned(),
            _ => format!(
                "It is the cheapest of {candidates} that {}; {} {}: {}.",
                self.bound(),
                if self.answer.is_by_pairs() { "the best by pairs is" } else { "the best mean has" },
                self.named(best),
                self.mean(best),
            ),
        };
        vec![first, worth, others]
    }

    /// Number of situations that a design has seen.
    fn seen(&self, design: usize) -> usize {
        self.ledger.runs(design).len()
    }

    /// Text of the mean of the goal's metric, with its number of situations if these are not all.
    fn mean(&self, design: usize) -> String {
        let mean = self.answer.results[design].mean;
        text(mean) + &gaps::of_fewer(mean, self.seen(design))
    }

    /// Text of the paired distance behind the best, with the number of common situations if these are not
    /// all.
    fn behind(&self, design: usize) -> String {
        let behind = self.answer.results[design].behind;
        match self.answer.best {
            Some(best) if best != design => {
                text(behind) + &gaps::of_fewer(behind, self.seen(design).min(self.seen(best)))
            }
            _ => "–".to_owned(),
        }
    }

    /// Text of the values common to the candidates.
    fn bound(&self) -> String {
        let margin = match self.study.goal.margin {
            Some(margin) => margin.to_string(),
            None => "one standard error".to_owned(),
        };
        let confidence = percent(self.study.confidence);
        format!("are behind the best by {margin} at most and not told apart from it at {confidence} %")
    }

    fn named(&self, design: usize) -> String {
        let axes = self.study.vary.iter().zip(&self.designs[design]);
        let picks: Vec<String> = axes.map(|(axis, pick)| format!("{} {}", axis.name, pick.label)).collect();
        format!("design {design} ({})", picks.join(", "))
    }

    fn metric(&self) -> &str {
        self.study.metrics.names().nth(self.study.goal.metric).unwrap_or_default()
    }

    fn cost(&self) -> &str {
        self.study.metrics.names().nth(self.study.goal.cost).unwrap_or_default()
    }

    fn head(&self) -> Vec<String> {
        let axes = self.study.vary.iter().map(|axis| axis.name.clone());
        let rest = [self.cost(), self.metric(), "behind the best", "situations", "accuracy not reached"];
        let rest = rest.map(str::to_owned);
        ["design".to_owned()].into_iter().chain(axes).chain(rest).collect()
    }

    fn row(&self, design: usize) -> Vec<String> {
        let result = &self.answer.results[design];
        let picks = self.designs[design].iter().map(|pick| pick.label.clone());
        let seen = self.seen(design).to_string();
        let counts = [accuracy::missed, accuracy::not_measured].map(|count| count(self.ledger, design));
        let missed = match counts {
            [0, 0] => "–".to_owned(),
            [missed, 0] => format!("in {missed}"),
            [0, unknown] => format!("not measured in {unknown}"),
            [missed, unknown] => format!("in {missed}, not measured in {unknown}"),
        };
        let rest = [number(result.cost), self.mean(design), self.behind(design), seen, missed];
        [design.to_string()].into_iter().chain(picks).chain(rest).collect()
    }

    fn by_axis(&self, name: &str, effects: &[Effect]) -> Block {
        let head = [name, "designs", "mean over them", "the best of them", "has"].map(str::to_owned).to_vec();
        let row = |effect: &Effect| {
            let worth = effect.best.map_or("–".to_owned(), |best| self.mean(best));
            let best = effect.best.map_or("–".to_owned(), |best| best.to_string());
            let designs = effect.designs.to_string();
            vec![effect.label.clone(), designs, number(effect.mean), best, worth]
        };
        Block::Table(format!("By {name}"), head, effects.iter().map(row).collect())
    }

    /// All metrics of the chosen design beside those of the best.
    fn metrics(&self) -> Block {
        let shown: Vec<usize> = self.answer.chosen.into_iter().chain(self.answer.best).collect();
        let best = if self.answer.is_by_pairs() { "the best by pairs" } else { "the best mean" };
        let titles = ["the answer", best].map(str::to_owned);
        let head = ["metric".to_owned()].into_iter().chain(titles.into_iter().take(shown.len())).collect();
        let mean = |design: usize, metric: usize| {
            let values = self.ledger.metric(design, metric);
            let mean = self.study.metrics.mean(metric, &values, self.study.confidence);
            text(mean) + &gaps::of_fewer(mean, self.seen(design))
        };
        let row = |(metric, name): (usize, &str)| {
            let means = shown.iter().map(|design| mean(*design, metric));
            [name.to_owned()].into_iter().chain(means).collect()
        };
        Block::Table("All metrics".into(), head, self.study.metrics.names().enumerate().map(row).collect())
    }

    fn method(&self) -> String {
        let runs: usize = (0..self.ledger.designs()).map(|design| self.ledger.runs(design).len()).sum();
        let most = (0..self.ledger.designs()).map(|design| self.ledger.runs(design).len()).max().unwrap_or(0);
        let dropped = self.ledger.designs() - self.ledger.open.len();
        let stopped = match self.study.stop {
            Some(_) => format!(" {dropped} designs were worse before that and were repeated no further."),
            None => String::new(),
        };
        format!(
            "{} designs in up to {most} situations, {runs} runs, seed {}; all designs see the same situations. Intervals \
             are Student's at {} % over situations, of shares and their differences that agree in all situations Clopper's and Pearson's; those behind the best are of paired differences, each at {} %, so \
             that all hold together.{stopped} Means by value are over the {}.",
            self.ledger.designs(),
            self.study.seed,
            percent(self.study.confidence),
            percent(self.answer.joint_confidence),
            self.of_values(),
        )
    }

    /// Words for the situations over which means by value are taken.
    fn of_values(&self) -> String {
        match self.answer.is_by_pairs() {
            true => {
                format!("{} situations in which all designs know {}", self.answer.shared.len(), self.metric())
            }
            false => format!("{} situations that every design has seen", self.ledger.common()),
        }
    }
}

fn percent(share: f64) -> String {
    let text = format!("{:.2}", 100.0 * share);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn number(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), figure)
}

/// A number to three decimals; one that would round to 0 to two significant digits.
fn figure(value: f64) -> String {
    match tick_text(value, 0.001) {
        text if text == "0" && value != 0.0 => format!("{value:.1e}").replace('-', "−"),
        text => text,
    }
}

/// Ratio of a width to its mean below which the width is rounding.
const ROUNDING: f64 = 1e-12;

/// Text of a mean with half the width of its interval.
fn text(mean: Option<Mean>) -> String {
    match mean {
        None => "–".into(),
        Some(Mean { value, half_width: None, .. }) => figure(value),
        Some(Mean { value, half_width: Some(half), .. }) => {
            let half = if half > ROUNDING * value.abs() { half } else { 0.0 };
            format!("{} ± {}", figure(value), figure(half))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_that_is_not_zero_is_not_told_as_zero() {
        assert_eq!(
            [0.0, 0.0004, -0.00012, 0.0006, 2.5].map(figure),
            ["0", "4.0e−4", "−1.2e−4", "0.001", "2.5"]
        );
        let mean = |value: f64, half: f64| Mean {
            value,
            standard_error: Some(half),
            half_width: Some(half),
            ends: Some([value - half, value + half]),
            count: 3,
        };
        assert_eq!(text(Some(mean(0.00037, 0.00002))), "3.7e−4 ± 2.0e−5");
        assert_eq!(text(Some(mean(0.625, 1e-17))), "0.625 ± 0", "rounding is no width");
    }
}
