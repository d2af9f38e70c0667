//! Costs that `run --dry-run` predicts for random scenes, over what their runs take.

use crate::bench::{PredictedCost, RATIOS, Spread, cost_of_random};
use crate::study::extent::Extent;
use crate::study::pages::page_section::{PageSection, figure};
use crate::study::pages::row_cache::RowCache;
use crate::study::sources::{self, CHAIN, RUN, SourcePaths};
use wayside::host::failure::Failure;
use wayside::host::progress::Work;
use wayside::program::values::Shard;

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths = &[
    CHAIN,
    RUN,
    &["xtask/src/bench/predictions.rs", "xtask/src/bench/predictions", "xtask/src/random_scenes.rs"],
    &["fixtures/junction.fcd.xml.gz", file!()],
];

/// Seed of the scenes: the rates were fitted to others.
const SEED: u64 = 11;
const SCENES: u64 = 100;

/// All scenes; missing ones are run.
pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    section_of_rows(extent, get_or_run)
}

/// The kept scenes, and the number of missing ones.
pub(crate) fn section_from_cache(extent: Extent) -> Result<PageSection, Failure> {
    section_of_rows(extent, |cache, number| Ok(cache.get::<Row>(&name(number)).flatten()))
}

/// Runs every `of`th scene from `number` on, and keeps its costs for the page.
pub(crate) fn rows(extent: Extent, shard: Shard) -> Result<(), Failure> {
    let (cache, count) = (cache()?, extent.case_count(SCENES));
    let work = Work::begin("scenes");
    for number in (u64::from(shard.number - 1)..count).step_by(shard.of as usize) {
        work.at(number as usize, count as usize);
        get_or_run(&cache, number)?;
    }
    Ok(())
}

/// Costs of a scene; `None` if it is refused.
type Row = Option<PredictedCost>;

fn cache() -> Result<RowCache, Failure> {
    Ok(RowCache::of("predictions", &sources::hash(SOURCES)?))
}

fn name(number: u64) -> String {
    format!("random-{SEED}-{number:03}")
}

fn get_or_run(cache: &RowCache, number: u64) -> Result<Row, Failure> {
    cache.get_or_make(&name(number), || cost_of_random(SEED, number))
}

fn section_of_rows(
    extent: Extent,
    row: impl Fn(&RowCache, u64) -> Result<Row, Failure>,
) -> Result<PageSection, Failure> {
    let (cache, count) = (cache()?, extent.case_count(SCENES));
    let work = Work::begin("scenes");
    let mut costs = vec![];
    for number in 0..count {
        work.at(number as usize, count as usize);
        costs.extend(row(&cache, number)?);
    }
    let mut part = table(&costs);
    let missing = cache.missing::<Row>((0..count).map(name));
    if missing > 0 {
        part.line(format!("\nOf {count} scenes {missing} were not run."));
    }
    Ok(part)
}

fn table(costs: &[PredictedCost]) -> PageSection {
    let mut part = PageSection::default();
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
