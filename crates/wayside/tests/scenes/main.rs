//! Scenes through the whole chain: what `run` leaves, tells and draws.

#[path = "../common/mod.rs"]
mod common;

mod ghost_streets;
mod ghosts;
mod main_job;
mod paths_of_scenes;
mod report;
mod score;
mod several_radars;
mod street;
mod told;
mod traffic;
