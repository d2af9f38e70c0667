//! Tests of how exact estimates are, and of which velocity is told where several look alike.

#[path = "../common/mod.rs"]
mod common; // radars and cubes
mod bound_trials;
mod estimates;
mod fold_trials;
mod velocity_folds;
