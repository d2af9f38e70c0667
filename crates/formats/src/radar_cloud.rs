//! Clouds of radar detections as sets of vehicles have them, in the levelled axes of the sensor: rows of
//! View-of-Delft's `velodyne` files, and nuScenes' `.pcd`.

mod detection;
mod cloud_error;
pub(crate) mod velodyne;
pub(crate) mod pcd;
pub mod import;

pub(crate) use detection::Detection;

/// Bytes of a cloud's file.
pub(crate) const LIMIT_BYTES: u64 = 1 << 20;
/// Detections of a cloud: objects are formed of them, pair by pair, in 7 s of 4,096 in one heap of 3 m.
pub(crate) const DETECTION_LIMIT: usize = 4_096;
