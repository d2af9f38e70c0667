//! Files that the program reads and writes: nothing of the user's is destroyed, nothing damaged is believed.

#[path = "../common/mod.rs"]
mod common;

mod assets;
mod caches;
mod crafted_artifacts;
mod damage;
mod earlier_results;
mod full_disk;
mod heights;
mod outputs;
mod raw_data;
mod recordings;
mod resumed_tables;
mod set_labels;
mod tensors;
mod training_sets;
