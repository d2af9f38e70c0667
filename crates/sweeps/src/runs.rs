//! Runs of a study: a design in a situation through the chain, what is measured of it, and what is kept.

pub(crate) mod reached;
pub(crate) mod one_run;
pub(crate) mod ledger;
pub(crate) mod kept;
