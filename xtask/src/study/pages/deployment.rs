//! Choice of a radar at the paper's intersection: `scenes/studies/intersection.sweep.toml`, twice, with
//! different noise.

use crate::project::project_root;
use crate::study::extent::Extent;
use crate::study::pages::page_section::PageSection;
use crate::study::sources::{CHAIN, SourcePaths};
use std::path::PathBuf;
use wayside::host::cancellation::Cancellation;
use wayside::host::failure::Failure;
use wayside::host::files;
use wayside::sweep::{self, Outcome, Settings};
use wayside::{Allowance, CacheLocation};

/// Sources that the figures depend on.
pub(crate) const SOURCES: SourcePaths =
    &[CHAIN, &["crates/evaluation", "crates/sweeps/src", "scenes/studies", file!()]];

const SEEDS: [u64; 2] = [1, 2];

/// Answer of each seed, details of the first; the picture only for the whole study. There is no quick form:
/// kept runs are not repeated.
pub(crate) fn section(extent: Extent) -> Result<PageSection, Failure> {
    let mut part = PageSection::default();
    let mut chosen = vec![];
    for seed in SEEDS {
        let Outcome { answer, details, chosen: design } = carried_out(seed)?;
        part.line(format!("Seed {seed}:\n\n{answer}"));
        if seed == SEEDS[0] {
            part.line("![Designs by what they are worth and what they cost](../pictures/deployment.svg)\n");
            part.line(details.replace("## ", "### "));
        }
        chosen.push(design);
    }
    if extent == Extent::Full {
        picture()?;
    }
    if chosen[0] != chosen[1] {
        part.complain("another seed has another answer".into());
    }
    Ok(part)
}

/// Runs the study with a seed, in a separate folder that is reused.
fn carried_out(seed: u64) -> Result<Outcome, Failure> {
    let study = project_root().join("scenes/studies/intersection.sweep.toml");
    let settings = Settings {
        study,
        out: folder(seed),
        shard: Some([1, 1]),
        seed: Some(seed),
        classifier: None,
        cache: Some(CacheLocation::default()),
        memory: Allowance::of(None),
        command: "cargo xtask study deployment".into(),
        tell: &|_| {},
        cancellation: Cancellation::default(),
    };
    let outcome = sweep::run(&settings)?;
    outcome.ok_or_else(|| Failure::Refused("runs of the study are missing".into()))
}

fn folder(seed: u64) -> PathBuf {
    project_root().join(format!("out/deployment-{seed}"))
}

/// Copies the picture of the first seed to those of the other pages.
fn picture() -> Result<(), Failure> {
    let file = folder(SEEDS[0]).join("pareto.svg");
    let drawn = std::fs::read(&file).map_err(|error| Failure::system(&file, "read", error))?;
    files::write_file(&project_root().join("docs/pictures/deployment.svg"), &drawn)
}
