//! Clouds of radar detections as in vehicle datasets, in the levelled axes of the sensor: rows of
//! View-of-Delft's `velodyne` files, and nuScenes' `.pcd`.

mod detection;
mod cloud_error;
pub(crate) mod velodyne;
pub(crate) mod pcd;
mod summits; // main lobes
pub mod import;

pub(crate) use detection::{Detection, PLACE_LIMIT_M};

/// Largest file of a cloud, bytes.
pub(crate) const LIMIT_BYTES: u64 = 1 << 20;
/// Largest number of detections in a cloud: clustering compares all pairs and takes 7 s for 4,096 in one heap
/// of 3 m.
pub(crate) const DETECTION_LIMIT: usize = 4_096;
