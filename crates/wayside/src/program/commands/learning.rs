//! Datasets, training, classes and how right they are.

pub(crate) mod classify;
pub(crate) mod dataset;
pub(crate) mod evaluate;
pub(crate) mod train;
pub(crate) mod protocols;
