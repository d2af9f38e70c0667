//! Artifacts from and to what others read.

pub(crate) mod sidecar;
pub(crate) mod inspect;
pub(crate) mod writing;
pub(crate) mod npy_stream;
pub(crate) mod mat_file;
pub(crate) mod heights;
pub(crate) mod levelled_axes;
pub(crate) mod radar_cloud;
pub(crate) mod raw_data;
pub(crate) mod training_sets;
pub(crate) mod export;
pub(crate) mod device_config;
pub(crate) mod scene_from;
pub(crate) mod import;
