//! Settings of a training.

use classifier::{CombinedSettings, ProfileSettings, SignatureTraining, TreeSettings};
use std::path::PathBuf;

/// Default number of the network's optimizer steps: the paper's number.
pub const PAPER_ITERATIONS: u32 = 1440;

/// Method by which a classifier is learned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Learner {
    /// Boosted trees on features of signatures.
    #[default]
    Trees,
    /// Networks over the range cells of signatures.
    Profile,
    /// Trees and networks, their answers averaged.
    Both,
    /// The paper's network on crops.
    Paper,
}

impl Learner {
    /// Training on signatures; `None` for the paper's network.
    pub(crate) fn on_signatures(self) -> Option<SignatureTraining> {
        match self {
            Self::Profile => Some(SignatureTraining::Profile(ProfileSettings::default())),
            Self::Trees => Some(SignatureTraining::Trees(TreeSettings::default())),
            Self::Both => Some(SignatureTraining::Both(CombinedSettings::default())),
            Self::Paper => None,
        }
    }
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
    /// Text file with a line for each source of vehicles that a model of signatures must name.
    pub attributions: Option<PathBuf>,
    /// Receives each line of results.
    pub tell: &'a dyn Fn(&str),
}
