//! Runs of a study: a design in a situation through the chain, with its metrics and its kept results.

pub(crate) mod run_accuracy;
pub(crate) mod one_run;
pub(crate) mod ledger;
pub(crate) mod run_store;
