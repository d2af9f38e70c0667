//! Tests of what noise alone does to the detectors, and of maps of real samples.

#[path = "../common/mod.rs"]
mod common; // radars and cubes
mod alarm_rates;
mod leakage;
mod false_alarms;
mod real_sampling;
