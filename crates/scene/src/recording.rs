//! Recordings of SUMO and of OSI: vehicles step by step, and the lanes of a network.

pub(crate) mod xml;
mod step_order;
pub mod fcd;
#[cfg_attr(not(feature = "interchange"), path = "recording/trace_unavailable.rs")]
pub(crate) mod trace;
pub mod interpolation;
pub(crate) mod odometer;
pub(crate) mod frame_clock;
pub(crate) mod field_of_view;
pub mod net;
