//! Services for the chain beside the stages: failures, whole files, memory, progress, places and checkpoints
//! of long work; and folders of datasets as inputs.

pub mod safe_text;
pub mod failure;
pub mod progress;
pub mod files;
pub mod dataset_folders;
pub mod memory;
pub mod processor_time;
pub mod places;
pub mod checkpoint;
pub mod call_off;
pub mod provenance_checks;
pub mod frame_matching;
pub mod toml_text;
pub mod side_by_side;
pub mod in_order;
