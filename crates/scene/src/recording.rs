//! Recordings of SUMO: vehicles step by step, and the lanes of a network.

pub(crate) mod xml;
pub mod fcd;
pub mod interpolation;
pub(crate) mod clock;
pub(crate) mod in_view;
pub mod net;
