//! Foreign formats, read and written: samples of capture cards, SigMF, NumPy and MATLAB, clouds of
//! detections, configurations of boards, tables, messages, and folders in the layouts of training datasets.
//!
//! An artifact is exported to a file or a folder for another program, with a `.json` beside it for axes and
//! units that have no place in the format; or the reverse. Axes, units and shapes of every format:
//! `docs/interface.md`, `docs/interchange.md`, `docs/training-sets.md`.
//!
//! Read the rooms below in their order; each uses only those before it.

pub mod devices; // boards and their sample orders
pub mod safe_file_name; // file names from names in artifacts
pub mod sidecar; // axes and units beside a file
mod sub_frames; // values that differ between sub-frames
pub mod npy_stream; // NumPy arrays, written value by value
pub mod mat_file; // arrays of MATLAB
pub mod height_source; // sources of points' heights
pub mod levelled_axes; // axes of a radar, levelled
mod azimuth_row; // the row of an array that tensors resolve
pub mod device_config; // configurations of boards
pub mod radar_cloud; // clouds of detections
pub mod raw_data; // samples as devices record them
pub mod training_sets; // folders in the layouts of training sets
pub mod export; // each kind of artifact in each format
