//! Settings of protocols.

use crate::training::Learner;
use std::path::PathBuf;

/// Settings of protocols.
pub struct ProtocolSettings<'a> {
    /// Folders of datasets for training; their vehicles are held out in turn.
    pub datasets: Vec<PathBuf>,
    /// Folders of datasets for testing only.
    pub test: Vec<PathBuf>,
    /// Learner to test.
    pub learner: Learner,
    /// Steps of the network's optimizer; `None`: the paper's number.
    pub iterations: Option<u32>,
    /// Number of trainings, with the seeds 1, 2, …
    pub seeds: u64,
    /// Whether to train on parts of the scenes and of the vehicles too.
    pub curves: bool,
    /// File of the page; `None`: none is written.
    pub out: Option<PathBuf>,
    /// Receives the output of the program that trains the network.
    pub tell: &'a dyn Fn(&str),
}
