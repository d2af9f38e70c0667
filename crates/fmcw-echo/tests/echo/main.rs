//! What fmcw-echo promises, one file a subject.
#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too; clippy knows only marked functions")]

mod setting;
mod three_sums;
mod waveform_table;
mod point_target;
mod direct_sum_against_reference;
mod fast_sum_against_direct;
mod single_precision;
mod superposition;
mod moments;
mod multiplexing;
mod schedules;
mod chirp_phases;
mod large_arrays;
mod hardware;
mod pattern_tables;
mod phase_noise;
mod interferers;
mod real_sampling;
mod receiver_noise;
mod rcs_tables;
mod ground;
mod reproducibility;
mod refusals;
