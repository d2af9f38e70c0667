//! Promises of fmcw-echo, one file a subject.
#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too; clippy knows only marked functions")]

mod setting;
mod three_sums;
mod sums;
mod links;
mod impairments;
mod sources;
mod synthesis;
