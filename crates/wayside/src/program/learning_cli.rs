//! Arguments of the commands that make datasets, train and classify.

use crate::program::numbers::whole;
use crate::program::terminal::ResultKind;
use crate::program::values::{Shard, shard};
use artifact::seed::SEEDS;
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Commands that need the classifier.
#[derive(Debug, Subcommand)]
pub enum LearningCommand {
    /// Make a dataset of labelled vehicle signatures and map crops from a recipe; resumes where it stopped.
    Dataset(DatasetArguments),
    /// Train a classifier on datasets; write the model, its curves and its evaluation.
    Train(TrainArguments),
    /// Classify the objects of range-Doppler maps or the samples of datasets, one JSON line each.
    Classify(ClassifyArguments),
    /// Evaluate a model on datasets: accuracy by frame and by track, with its spread over vehicles.
    Evaluate(EvaluateArguments),
    /// Train and test by protocol over several seeds: on unseen scenes, unseen vehicles, other datasets.
    Protocols(ProtocolsArguments),
}

impl LearningCommand {
    /// Returns whether the command's results are files or only lines of standard output.
    pub(crate) fn results(&self) -> ResultKind {
        match self {
            Self::Dataset(_) | Self::Train(_) => ResultKind::Files,
            Self::Classify(_) | Self::Evaluate(_) | Self::Protocols(_) => ResultKind::Lines,
        }
    }
}

/// Learners.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum LearnerWord {
    Trees,
    Profile,
    Both,
    Paper,
}

/// Arguments of `dataset`.
#[derive(Debug, Clone, Args)]
pub struct DatasetArguments {
    /// Recipe.
    #[arg(value_name = "SPEC.toml")]
    pub(crate) spec: PathBuf,
    /// Output folder.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Part K of N.
    #[arg(long, value_name = "K/N", value_parser = shard, default_value = "1/1")]
    pub(crate) shard: Shard,
    /// Make no shards; write the results of all shards, or report which are missing.
    #[arg(long, conflicts_with = "shard")]
    pub(crate) conclude: bool,
    /// Print the number of files, bytes and core-hours of the whole dataset, and stop.
    #[arg(long, conflicts_with_all = ["conclude", "shard"])]
    pub(crate) dry_run: bool,
    /// Replace the recipe's seed.
    #[arg(long, value_parser = whole(SEEDS, 7))]
    pub(crate) seed: Option<u64>,
}

/// Arguments of `train`.
#[derive(Debug, Clone, Args)]
pub struct TrainArguments {
    /// Dataset folders.
    #[arg(value_name = "DIR", required = true)]
    pub(crate) datasets: Vec<PathBuf>,
    /// Output folder of the model.
    #[arg(long, value_name = "MODEL")]
    pub(crate) out: PathBuf,
    /// Learner: trees on features of signatures, networks over their range cells, or the paper's on crops.
    #[arg(long, value_enum, default_value_t = LearnerWord::Trees)]
    pub(crate) learner: LearnerWord,
    /// Seed of all random draws: examples and features of trees, initial weights, order of samples.
    #[arg(long, default_value_t = 1, value_parser = whole(SEEDS, 7))]
    pub(crate) seed: u64,
    /// Steps of the network's optimizer [default: 1440, the paper's number].
    #[arg(long, value_name = "N", value_parser = whole(1..=u32::MAX, 1440))]
    pub(crate) iterations: Option<u32>,
    /// Text file with one line for each vehicle source whose licence requires attribution with the model.
    #[arg(long, value_name = "FILE")]
    pub(crate) attributions: Option<PathBuf>,
}

/// Arguments of `evaluate`.
#[derive(Debug, Clone, Args)]
pub struct EvaluateArguments {
    /// Model file or folder.
    #[arg(value_name = "MODEL")]
    pub(crate) model: PathBuf,
    /// Dataset folders.
    #[arg(value_name = "DIR", required = true)]
    pub(crate) datasets: Vec<PathBuf>,
    /// Write the results to this page too (Markdown or text).
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
}

/// Arguments of `protocols`.
#[derive(Debug, Clone, Args)]
pub struct ProtocolsArguments {
    /// Dataset folders to train on; their vehicles are held out in turn.
    #[arg(value_name = "DIR", required = true)]
    pub(crate) datasets: Vec<PathBuf>,
    /// Dataset folders to test on only.
    #[arg(long, value_name = "DIR")]
    pub(crate) test: Vec<PathBuf>,
    /// Learner: one of signatures, or the paper's network by the paper's protocol (P) and by two that keep
    /// copies of a map apart.
    #[arg(long, value_enum, default_value_t = LearnerWord::Trees)]
    pub(crate) learner: LearnerWord,
    /// Steps of the network's optimizer in each training [default: 1440, the paper's number].
    #[arg(long, value_name = "N", value_parser = whole(1..=u32::MAX, 1440))]
    pub(crate) iterations: Option<u32>,
    /// Number of trainings, with the seeds 1, 2, ...
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = whole(1..=100_u64, 5))]
    pub(crate) seeds: u64,
    /// Add learning curves: train on parts of the scenes and of the vehicles too.
    #[arg(long)]
    pub(crate) curves: bool,
    /// Write the results to this page too (Markdown or text).
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
}

/// Arguments of `classify`.
#[derive(Debug, Clone, Args)]
pub struct ClassifyArguments {
    /// Model file or folder.
    #[arg(value_name = "MODEL")]
    pub(crate) model: PathBuf,
    /// Range-Doppler maps or datasets.
    #[arg(value_name = "FILE", required = true)]
    pub(crate) files: Vec<PathBuf>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct One {
        #[command(subcommand)]
        command: LearningCommand,
    }

    #[test]
    fn a_training_takes_at_least_one_step() {
        for command in ["train d --out m", "protocols d"] {
            let words = |steps: &str| format!("wayside {command} --learner paper --iterations {steps}");
            let parsed = |steps: &str| One::try_parse_from(words(steps).split_whitespace());
            assert!(parsed("1").is_ok(), "{command}");
            let refused = parsed("0").unwrap_err().to_string();
            assert!(refused.contains("it must be from 1 to 4294967295, is 0"), "{command}: {refused}");
        }
    }
}
