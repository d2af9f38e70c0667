//! Costs that `run --dry-run` predicts for random scenes, over what their runs take.

use crate::bench::{PredictedCost, RATIOS, Spread, cost_of_random};
use crate::study::extent::Extent;
use crate::study::pages::kept::Kept;
use crate::study::pages::part::{Part, figure};
use crate::study::sources::{self, CHAIN, Places, RUN};
use wayside::host::failure::Failure;
use wayside::host::progress::Work;
use wayside::program::values::Shard;

/// Sources that the figures depend on.
pub(crate) const SOURCES: Places = &[
    CHAIN,
    RUN,
    &["xtask/src/bench/predictions.rs", "xtask/src/bench/predictions", "xtask/src/random_scenes.rs"],
    &["fixtures/junction.fcd.xml.gz", file!()],
];

/// Seed of the scenes: the rates were fitted to others.
const SEED: u64 = 11;
const SCENES: u64 = 100;

/// All scenes; missing ones are run.
pub(crate) fn part(extent: Extent) -> Result<Part, Failure> {
    told(extent, made)
}

/// The kept scenes, and the number of missing ones.
pub(crate) fn part_of_kept(extent: Extent) -> Result<Part, Failure> {
    told(extent, |kept, number| Ok(kept.row::<Row>(&name(number)).flatten()))
}

/// Runs every `of`th scene from `number` on, and keeps its costs for the page.
pub(crate) fn rows(extent: Extent, shard: Shard) -> Result<(), Failure> {
    let (kept, count) = (kept()?, extent.of(SCENES));
    let work = Work::begin("scenes");
    for number in (u64::from(shard.number - 1)..count).step_by(shard.of as usize) {
        work.at(number as usize, count as usize);
        made(&kept, number)?;
    }
    Ok(())
}

/// Costs of a scene; `None` if it is refused.
type Row = Option<PredictedCost>;

fn kept() -> Result<Kept, Failure> {
    Ok(Kept::of("predictions", &sources::hash(SOURCES)?))
}

fn name(number: u64) -> String {
    format!("random-{SEED}-{number:03}")
}

fn made(kept: &Kept, number: u64) -> Result<Row, Failure> {
    kept.or_made(&name(number), || cost_of_random(SEED, number))
}

fn told(extent: Extent, row: impl Fn(&Kept, u64) -> Result<Row, Failure>) -> Result<Part, Failure> {
    let (kept, count) = (kept()?, extent.of(SCENES));
    let work = Work::begin("scenes");
    let mut costs = vec![];
    for number in 0..count {
        work.at(number as usize, count as usize);
        costs.extend(row(&kept, number)?);
    }
    let mut part = table(&costs);
    let missing = kept.missing::<Row>((0..count).map(name));
    if missing > 0 {
        part.line(format!("\nOf {count} scenes {missing} were not run."));
    }
    Ok(part)
}

fn table(costs: &[PredictedCost]) -> Part {
    let mut part = Part::default();
    let quantiles = ["least", "5 %", "25 %", "50 %", "75 %", "95 %", "most"];
    let head = [&["predicted over actual", "scenes"][..], &quantiles, &["within a factor of 2", "below 1"]];
    part.head(&head.concat());
    for (name, ratio) in RATIOS {
        let Spread { runs, quantiles, within, below } = Spread::of(costs, ratio);
        let quantiles = quantiles.map(|ratio| figure(ratio, 2));
        let counts = [within, below].map(|count| count.to_string());
        part.named_row(name, [runs.to_string()].into_iter().chain(quantiles).chain(counts));
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_ratio_has_a_row_and_no_scene_none() {
        let cost =
            PredictedCost { said_s: 3.0, taken_s: 2.0, said_mib: 80.0, most_mib: 400.0, held_mib: 100.0 };
        let (text, _) = table(&[cost]).finished();
        let ones = |ratio: &str| [ratio; 7].join(" | ");
        assert!(text.contains(&format!("| seconds | 1 | {} | 1 | 0 |", ones("1.50"))), "{text}");
        assert!(text.contains(&format!("| memory | 1 | {} | 1 | 1 |", ones("0.80"))), "{text}");
        assert!(text.contains(&format!("| memory at most | 1 | {} | 0 | 0 |", ones("4.00"))), "{text}");
    }
}
