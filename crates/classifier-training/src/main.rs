//! `classifier-training SHARD… --out MODEL`: what `cargo xtask train` builds and runs.
//!
//! Standard output is a JSON object a line: `{"at": iteration, "of": iterations}`, `{"told": sentence}`, and
//! where it ends badly `{"refused": why}` (exit code 1) or `{"system": why}` (exit code 2). Where nobody
//! reads it, the training ends.

use artifact::{Provenance, inputs};
use clap::{Parser, ValueEnum};
use classifier::{format_of, samples_of};
use classifier_training::{
    Progress, SplitProtocol, TrainSettings, Trained, TrainingError, save_model, train, train_with_protocol,
};
use serde_json::{Value, json};
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

/// Trains the network on the shards of a dataset.
#[derive(Parser)]
struct Arguments {
    /// Shards of one dataset, in their order.
    #[arg(required = true)]
    shards: Vec<PathBuf>,
    /// Model folder.
    #[arg(long, allow_hyphen_values = true, required_unless_present = "deal")]
    out: Option<PathBuf>,
    /// Parts augmented images as said, whatever splits the dataset has, and tells `{"metrics": …, "curves":
    /// …}` in place of a model.
    #[arg(long, conflicts_with = "out")]
    deal: Option<SplitProtocolArgument>,
    /// Seed of the initial weights and the order of samples.
    #[arg(long)]
    seed: u64,
    /// Steps of the optimizer.
    #[arg(long)]
    iterations: u32,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if error.is_system() => {
            print_line(&json!({ "system": error.to_string() }));
            ExitCode::from(2)
        }
        Err(error) => {
            print_line(&json!({ "refused": error.to_string() }));
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), TrainingError> {
    let format = format_of(&arguments.shards)?.ok_or(TrainingError::NoShards)?;
    let samples = arguments.shards.iter().flat_map(|shard| samples_of(shard));
    let mut progress = |p: Progress| print_line(&json!({ "at": p.iteration, "of": p.iterations }));
    if let Some(deal) = arguments.deal {
        let settings = (&TrainSettings::of_protocol(arguments.iterations), deal.into());
        let trained = train_with_protocol(samples, &format, settings, arguments.seed, &mut progress)?;
        print_line(&json!({ "metrics": trained.metrics, "curves": trained.curves }));
    } else if let Some(out) = &arguments.out {
        let settings = TrainSettings::of_maps(arguments.iterations);
        let trained = train(samples, &format, &settings, arguments.seed, &mut progress)?;
        save_model(out, &trained, &provenance(arguments, &settings)?)?;
        print_accuracy(&trained);
    }
    Ok(())
}

/// [`SplitProtocol`] on the command line.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum SplitProtocolArgument {
    Images,
    Maps,
    Vehicles,
}

impl From<SplitProtocolArgument> for SplitProtocol {
    fn from(word: SplitProtocolArgument) -> Self {
        match word {
            SplitProtocolArgument::Images => Self::Images,
            SplitProtocolArgument::Maps => Self::Maps,
            SplitProtocolArgument::Vehicles => Self::Vehicles,
        }
    }
}

fn provenance(arguments: &Arguments, settings: &TrainSettings) -> Result<Provenance, TrainingError> {
    let unreadable = |shard: &PathBuf, cause| TrainingError::Unreadable { shard: shard.clone(), cause };
    let hashed = |shard: &PathBuf| inputs::named_hash(shard).map_err(|cause| unreadable(shard, cause));
    Ok(Provenance {
        stage: "classifier".into(),
        program_version: env!("CARGO_PKG_VERSION").into(),
        inputs: arguments.shards.iter().map(hashed).collect::<Result<_, TrainingError>>()?,
        settings: serde_json::to_string(settings)
            .map_err(|e| TrainingError::Library { doing: "write the settings as JSON", cause: e.into() })?,
        seed: arguments.seed,
    })
}

/// Prints the accuracy on each split.
fn print_accuracy(trained: &Trained) {
    for (split, evaluation) in &trained.metrics.splits {
        let [low, high] = evaluation.accuracy_interval.map(|share| 100.0 * share);
        let (right, of) = (100.0 * evaluation.accuracy, evaluation.samples);
        let sentence =
            format!("{split:?}: {right:.1} % of {of} right (95 % interval {low:.1} … {high:.1} %)");
        print_line(&json!({ "told": sentence }));
    }
}

/// Prints a JSON object. A training whose output nobody reads any more is given up: whoever began it has
/// ended. The library has no way to call it off from its progress, so the process ends here.
fn print_line(line: &Value) {
    if writeln!(std::io::stdout(), "{line}").is_err() {
        let _nothing_new = artifact::atomic_file::remove_all_temporaries();
        std::process::exit(2);
    }
}
