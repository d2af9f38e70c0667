//! Settings of a training.

use std::path::PathBuf;

/// Default number of the network's optimizer steps: the paper's number.
pub const PAPER_ITERATIONS: u32 = 1440;

/// Method by which a classifier is learned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Learner {
    /// Boosted trees on features of signatures.
    Trees,
    /// The paper's network on crops.
    Paper,
}

/// Settings of a training.
pub struct TrainingSettings<'a> {
    /// Folders of datasets.
    pub datasets: Vec<PathBuf>,
    /// Folder of the model.
    pub out: PathBuf,
    /// Learner to train.
    pub learner: Learner,
    /// Seed of every draw: examples and features of trees, initial weights, the order of samples.
    pub seed: u64,
    /// Steps of the network's optimizer; `None`: [`PAPER_ITERATIONS`].
    pub iterations: Option<u32>,
    /// Text file with a line for each source of vehicles that the model of trees must name.
    pub attributions: Option<PathBuf>,
    /// Receives each line of results.
    pub tell: &'a dyn Fn(&str),
}
