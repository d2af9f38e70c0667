//! Services for the chain beside the stages: failures, whole files, memory, progress, places and checkpoints
//! of long work; and folders of datasets as inputs.

pub mod safe_text;
pub mod failure;
pub mod progress;
pub mod files;
pub mod dataset_folders;
pub mod memory;
pub mod processor_time;
pub mod default_paths;
pub mod checkpoint;
pub mod cancellation;
pub mod provenance_checks;
pub mod frame_matching;
pub mod toml_text;
pub mod parallel_jobs;
pub mod ordered_jobs;
