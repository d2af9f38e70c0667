//! The stages linked, frame by frame: a frame's dependencies, its cached parts, its expected cost and its
//! artifacts.

pub mod stages;
pub mod keys;
pub mod cache;
pub mod plan;
pub mod class_rule;
#[cfg_attr(not(feature = "classifier"), path = "chain/no_model.rs")]
pub mod loaded_model;
pub mod loading;
pub mod expected_work;
pub mod measured_frames;
pub mod frame_result;
pub mod link;
pub mod frames;
pub mod memory_estimate;
pub mod expectation;
