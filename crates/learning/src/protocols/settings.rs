//! Settings of protocols.

use crate::training::Learner;
use std::path::PathBuf;

/// Settings of protocols.
pub struct Settings<'a> {
    /// Folders of datasets that train; their vehicles are held out in turn.
    pub datasets: Vec<PathBuf>,
    /// Folders of datasets that never train.
    pub test: Vec<PathBuf>,
    /// Learner that is asked.
    pub learner: Learner,
    /// Steps of the network's optimizer; `None`: the paper's number.
    pub iterations: Option<u32>,
    /// Trainings, of the seeds 1, 2, …
    pub seeds: u64,
    /// Whether parts of the scenes and of the vehicles train too.
    pub curves: bool,
    /// File of the page; `None`: none is written.
    pub out: Option<PathBuf>,
    /// Hears what the program that trains the network tells.
    pub tell: &'a dyn Fn(&str),
}
