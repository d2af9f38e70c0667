//! Recordings of SUMO and of OSI: vehicles step by step, and the lanes of a network.

pub(crate) mod xml;
mod step_order;
pub mod fcd;
#[cfg_attr(not(feature = "interchange"), path = "recording/no_trace.rs")]
pub(crate) mod trace;
pub mod interpolation;
pub(crate) mod driven;
pub(crate) mod clock;
pub(crate) mod in_view;
pub mod net;
