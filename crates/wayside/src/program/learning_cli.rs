//! Arguments of the commands that make datasets, train and classify.

use crate::program::terminal::Results;
use crate::program::values::{Shard, shard};
use artifact::seed::SEEDS;
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Commands that need the classifier.
#[derive(Debug, Subcommand)]
pub enum LearningCommand {
    /// A dataset recipe to labelled signatures of vehicles and crops of range-Doppler maps; resumes where it
    /// stopped.
    Dataset(DatasetArguments),
    /// A dataset to a trained model with its curves and its evaluation.
    Train(TrainArguments),
    /// Range-Doppler maps or a dataset to classes and probabilities, one JSON line each.
    Classify(ClassifyArguments),
    /// A model and datasets to how often it is right, by frame and by track, with its spread over vehicles.
    Evaluate(EvaluateArguments),
    /// Datasets to how right trees are that several seeds train: on unseen scenes, unseen vehicles, other
    /// datasets.
    Protocols(ProtocolsArguments),
}

impl LearningCommand {
    /// Returns whether the command's results are files or only lines of standard output.
    pub(crate) fn results(&self) -> Results {
        match self {
            Self::Dataset(_) | Self::Train(_) => Results::Files,
            Self::Classify(_) | Self::Evaluate(_) | Self::Protocols(_) => Results::Lines,
        }
    }
}

/// Learners.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum LearnerWord {
    Trees,
    Paper,
}

/// Arguments of `dataset`.
#[derive(Debug, Clone, Args)]
pub struct DatasetArguments {
    /// Recipe.
    #[arg(value_name = "SPEC.toml")]
    pub(crate) spec: PathBuf,
    /// Folder of the dataset.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Part K of N.
    #[arg(long, value_name = "K/N", value_parser = shard, default_value = "1/1")]
    pub(crate) shard: Shard,
    /// Makes no shards: writes what is made of all of them, or says which lack.
    #[arg(long, conflicts_with = "shard")]
    pub(crate) conclude: bool,
    /// Says how many files, bytes and core-hours the whole dataset would take, and makes nothing.
    #[arg(long, conflicts_with_all = ["conclude", "shard"])]
    pub(crate) dry_run: bool,
    /// Replaces the recipe's seed.
    #[arg(long, value_parser = clap::value_parser!(u64).range(SEEDS))]
    pub(crate) seed: Option<u64>,
}

/// Arguments of `train`.
#[derive(Debug, Clone, Args)]
pub struct TrainArguments {
    /// Dataset folders.
    #[arg(value_name = "DIR", required = true)]
    pub(crate) datasets: Vec<PathBuf>,
    /// Model folder.
    #[arg(long, value_name = "MODEL")]
    pub(crate) out: PathBuf,
    /// Boosted trees on features of signatures, or the paper's network on crops.
    #[arg(long, value_enum, default_value_t = LearnerWord::Trees)]
    pub(crate) learner: LearnerWord,
    /// Seed of every draw: examples and features of trees, initial weights, the order of samples.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u64).range(SEEDS))]
    pub(crate) seed: u64,
    /// Steps of the network's optimizer [default: 1440, the paper's number].
    #[arg(long, value_name = "N")]
    pub(crate) iterations: Option<u32>,
    /// Text file with a line for each source of vehicles that its licence asks to be named with the model of
    /// trees.
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
    /// Page (Markdown) that holds what is told.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
}

/// Arguments of `protocols`.
#[derive(Debug, Clone, Args)]
pub struct ProtocolsArguments {
    /// Dataset folders that train; their vehicles are held out in turn.
    #[arg(value_name = "DIR", required = true)]
    pub(crate) datasets: Vec<PathBuf>,
    /// Dataset folders that never train.
    #[arg(long, value_name = "DIR")]
    pub(crate) test: Vec<PathBuf>,
    /// Learner that is asked: trees, or the paper's network by the paper's protocol (P) and by two that keep
    /// copies of a map apart.
    #[arg(long, value_enum, default_value = "trees")]
    pub(crate) learner: LearnerWord,
    /// Steps of the network's optimizer in each training [default: 1440, the paper's number].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) iterations: Option<u32>,
    /// Trainings, of the seeds 1, 2, ...
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u64).range(1..=100))]
    pub(crate) seeds: u64,
    /// Trains on parts of the scenes and of the vehicles too, and tables how right that is.
    #[arg(long)]
    pub(crate) curves: bool,
    /// Page (Markdown) that holds what is told.
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
