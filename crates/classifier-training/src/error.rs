use artifact::ArtifactError;
use artifact::dataset::Split;
use artifact::settings::Class;
use classifier::ClassifierError;
use std::path::PathBuf;

/// Faults of a dataset, settings or a training.
#[derive(Debug, thiserror::Error)]
pub enum TrainingError {
    /// Samples, settings or weights broke a rule of the classifier's.
    #[error(transparent)]
    Classifier(#[from] ClassifierError),
    /// A part of the split that is needed holds no labelled sample.
    #[error("no labelled sample in split {0:?}")]
    EmptySplit(Split),
    /// The network cannot learn what it never sees.
    #[error("no sample of class {} in the training split", .0.name())]
    MissingClass(Class),
    /// A class has not one vehicle for each part.
    #[error("class {} has {vehicles} vehicles; to part them takes five", class.name())]
    TooFewVehicles {
        /// Class of the vehicles.
        class: Class,
        /// Number of its vehicles.
        vehicles: usize,
    },
    /// The loss is no number any more.
    #[error("training diverged at iteration {iteration}: the loss is not finite; lower the learning rate")]
    Diverged {
        /// Iteration, from 1.
        iteration: u32,
    },
    /// No shard was given: there is nothing to learn from.
    #[error("no shards of a dataset")]
    NoShards,
    /// A shard cannot be read.
    #[error("{}: cannot be read: {cause}", shard.display())]
    Unreadable {
        /// The shard.
        shard: PathBuf,
        /// The system's words.
        cause: std::io::Error,
    },
    /// The learning library failed.
    #[error("the learning library cannot {doing}: {cause}")]
    Library {
        /// Action that was tried.
        doing: &'static str,
        /// Words of the library.
        cause: Box<dyn std::error::Error + Send + Sync>,
    },
}

impl From<ArtifactError> for TrainingError {
    fn from(error: ArtifactError) -> Self {
        Self::Classifier(error.into())
    }
}

impl TrainingError {
    /// Whether the system refused (missing, unreadable, disk full), not the content.
    pub fn is_system(&self) -> bool {
        match self {
            Self::Classifier(ClassifierError::Artifact(error)) => error.is_system(),
            Self::NoShards | Self::Unreadable { .. } => true,
            _ => false,
        }
    }
}
