//! Certainty of a mean, and designs that are worse for sure.

pub(crate) mod student;
pub(crate) mod interval;
mod bets;
pub(crate) mod pairs;
pub(crate) mod contest;
