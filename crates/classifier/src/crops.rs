//! The network over crops, and its folder on disk.

pub(crate) mod pooling; // 451 x 451 averaged to the network's input
pub mod tensor_name; // names in the weights
pub(crate) mod layout; // its shape, from a model's header
pub(crate) mod parameters; // its parameters: read, written
pub(crate) mod network; // the network itself
pub(crate) mod classify; // probabilities of crops
pub(crate) mod samples; // a dataset at the network's resolution
pub(crate) mod model_folder; // weights, metrics and curves on disk
