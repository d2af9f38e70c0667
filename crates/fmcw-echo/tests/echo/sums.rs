//! The three sums, and what they have in common.

mod direct_sum_against_reference;
mod fast_sum_against_direct;
mod single_precision;
mod superposition;
mod moments;
