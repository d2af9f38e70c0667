//! Metrics of answers.

pub(crate) mod split; // which scenes train, validate, test
pub(crate) mod metrics; // accuracy, confusion, log loss, reliability
pub(crate) mod evaluate; // of a dataset
pub(crate) mod temperature; // calibration
pub(crate) mod by_vehicle; // accuracy with its spread over vehicles
