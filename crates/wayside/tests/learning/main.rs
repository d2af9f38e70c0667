//! Datasets, protocols, labels and calibration.

#[path = "../common/mod.rs"]
mod common;

mod calibration;
mod datasets;
mod folders;
mod labels;
mod learners;
mod parts;
mod protocols;
