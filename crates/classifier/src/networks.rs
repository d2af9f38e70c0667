//! Networks over the range cells of signatures: inference, and training by backpropagation.

pub(crate) mod batch; // values of a batch, and sums over them
pub(crate) mod optimizer; // parameters and their steps
pub(crate) mod convolution; // layer along range
pub(crate) mod normalization; // layer of equal means and variances
pub(crate) mod pooling; // rectifier and maximum of two cells
pub(crate) mod dense; // fully connected layer
pub(crate) mod dropout; // random zeros in training
pub(crate) mod profile_network; // inference
pub(crate) mod network_training; // one network from inputs and classes
