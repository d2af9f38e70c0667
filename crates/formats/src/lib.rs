//! Foreign formats, read and written: samples of capture cards, SigMF, NumPy and MATLAB, clouds of
//! detections, configurations of boards, tables, messages, and folders in the layouts of sets that people
//! train on.
//!
//! An artifact goes in and a file or a folder comes out that another program reads, with a `.json` beside it
//! that tells axes and units where the format has no place for them; or the other way round. Axes, units and
//! shapes of every format: `docs/interface.md`, `docs/interchange.md`, `docs/training-sets.md`.
//!
//! Reading order is that of the rooms below; each uses only those that stand before it.

pub mod devices; // boards and how they send samples
pub mod plain_name; // names that an artifact gives to files
pub mod sidecar; // axes and units beside a file
mod sub_frames; // what each sub-frame has of its own
pub mod npy_stream; // NumPy arrays, value after value
pub mod mat_file; // arrays of MATLAB
pub mod heights; // what is said of heights that were not measured
pub mod levelled_axes; // axes of a radar, levelled
mod azimuth_row; // the row of an array that tensors see
pub mod device_config; // configurations of boards
pub mod radar_cloud; // clouds of detections
pub mod raw_data; // samples as devices record them
pub mod training_sets; // folders in the layouts of training sets
pub mod export; // each kind of artifact in each format
