//! Truth beside estimates. Only reports come here: nothing behind the radar cube reads it.

pub mod ground_outline;
pub mod path_legs;
pub mod truth;
pub mod labels;
pub mod metrics;
pub mod pairing;
pub mod frame_truth;
