//! Confidence intervals of means, and designs that are certainly worse.

pub(crate) mod student;
pub(crate) mod interval;
mod betting_capital;
pub(crate) mod pairs;
pub(crate) mod racing;
