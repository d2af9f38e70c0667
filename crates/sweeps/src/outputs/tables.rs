//! `sweep.csv`, one row per run, and `designs.csv`, one row per design.

use crate::answer::Answer;
use crate::outputs::accuracy;
use crate::runs::ledger::Ledger;
use crate::runs::run_accuracy::{ErrorSource, RunAccuracy};
use crate::statistics::interval::Mean;
use crate::study::axis::{Axis, AxisChoice};
use crate::study::document::Study;
use crate::study::situations::Situation;
use pipeline::host::safe_text::in_csv;

/// All runs: design, condition, repeat and seed, the value of every key, every metric, and the requested and
/// reached accuracy; empty if unknown.
pub(crate) fn runs(
    study: &Study,
    designs: &[Vec<AxisChoice>],
    situations: &[&Situation],
    ledger: &Ledger,
) -> String {
    let keys = keys(&study.vary).chain(keys(&study.conditions));
    let head = ["design", "condition", "repeat", "seed"].map(str::to_owned).into_iter().chain(keys);
    let metrics = study.metrics.names().chain(ACCURACY).map(str::to_owned);
    let mut table = row(head.chain(metrics));
    for (number, design) in designs.iter().enumerate() {
        for (situation, run) in situations.iter().zip(ledger.runs(number)) {
            let Situation { condition, repeat, seed, picks } = situation;
            let place = [number.to_string(), condition.to_string(), repeat.to_string(), seed.to_string()];
            let picked =
                design.iter().chain(picks).flat_map(|pick| pick.values.iter().map(|value| plain(value)));
            let measured = run.values.iter().copied().map(cell).chain(cells_of(&run.accuracy));
            table += &row(place.into_iter().chain(picked).chain(measured));
        }
    }
    table
}

/// All designs: the value of every key, the number of situations seen, the mean of every metric with its
/// interval, the distance behind the best, whether it is on the front and a candidate, the number of its runs
/// that missed their accuracy, the number for which this is unknown because their errors are those of other
/// runs, and the number of situations in which each mean is known.
pub(crate) fn designs(
    study: &Study,
    designs: &[Vec<AxisChoice>],
    ledger: &Ledger,
    answer: &Answer,
) -> String {
    let of_metric = |name: &str| [name.to_owned(), format!("{name}_low"), format!("{name}_high")];
    let behind = ["behind", "behind_low", "behind_high", "front", "candidate"];
    let behind = behind.into_iter().chain(["accuracy_missed", "accuracy_taken_over"]).map(str::to_owned);
    let counts = study.metrics.names().chain(["behind"]).map(|name| format!("{name}_situations"));
    let head = ["design".to_owned()].into_iter().chain(keys(&study.vary)).chain(["situations".to_owned()]);
    let mut table = row(head.chain(study.metrics.names().flat_map(of_metric)).chain(behind).chain(counts));
    for (number, design) in designs.iter().enumerate() {
        let seen = ledger.runs(number).len();
        let values = design.iter().flat_map(|pick| pick.values.iter().map(|value| plain(value)));
        let mean = |metric| study.metrics.mean(metric, &ledger.metric(number, metric), study.confidence);
        let means: Vec<Option<Mean>> = (0..study.metrics.names().count()).map(mean).collect();
        let behind = answer.results[number].behind;
        let count = |mean: &Option<Mean>| mean.map_or(0, |mean| mean.count).to_string();
        let counts = means.iter().chain([&behind]).map(count);
        let is_in = |designs: &[usize]| if designs.contains(&number) { "yes" } else { "no" }.to_owned();
        let missed = accuracy::missed(ledger, number).to_string();
        let taken_over = accuracy::not_measured(ledger, number).to_string();
        let verdict = [is_in(&answer.front), is_in(&answer.candidates), missed, taken_over];
        let first = [number.to_string()].into_iter().chain(values).chain([seen.to_string()]);
        let intervals = means.iter().chain([&behind]).flat_map(|mean| interval(*mean));
        table += &row(first.chain(intervals).chain(verdict).chain(counts));
    }
    table
}

/// Columns of the accuracy of a run.
const ACCURACY: [&str; 4] =
    ["accuracy_asked_db", "accuracy_reached_db", "accuracy_met", "accuracy_taken_over"];

fn cells_of(accuracy: &RunAccuracy) -> [String; 4] {
    let word = |is: bool| if is { "yes" } else { "no" };
    let met = accuracy.met.filter(|_| !accuracy.is_not_measured()).map_or("", word);
    let taken_over = accuracy.met.map_or("", |_| word(accuracy.errors == ErrorSource::TakenOver));
    [cell(accuracy.asked_db), cell(accuracy.reached_db), met.to_owned(), taken_over.to_owned()]
}

fn keys(axes: &[Axis]) -> impl Iterator<Item = String> {
    axes.iter().flat_map(|axis| axis.keys.clone())
}

/// A value as written, a string without its quotes.
fn plain(value: &str) -> String {
    let inside = value.strip_prefix('"').and_then(|value| value.strip_suffix('"'));
    inside.filter(|text| !text.contains('"')).unwrap_or(value).to_owned()
}

/// Mean and both ends of its interval, which are empty if the spread is unknown.
fn interval(mean: Option<Mean>) -> [String; 3] {
    let ends = mean.and_then(|mean| mean.ends);
    let end = |at: usize| ends.map(|ends| ends[at]);
    [cell(mean.map(|mean| mean.value)), cell(end(0)), cell(end(1))]
}

fn cell(value: Option<f64>) -> String {
    value.map_or(String::new(), |value| value.to_string())
}

fn row(cells: impl Iterator<Item = String>) -> String {
    cells.map(|cell| in_csv(&cell).into_owned()).collect::<Vec<_>>().join(",") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_with_commas_and_quotes_stays_one_cell() {
        let cells = ["[0.0, 6.0]", "\"3x4\"", "a \"b\""].map(plain);
        assert_eq!(row(cells.into_iter()), "\"[0.0, 6.0]\",3x4,\"a \"\"b\"\"\"\n");
    }
}
