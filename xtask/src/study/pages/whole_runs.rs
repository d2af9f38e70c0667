//! Studies of whole scenes, from a scene file to objects, tracks and classes.

pub(super) mod scene_files; // texts of scenes with changed keys
pub(super) mod run_folder; // runs of such texts
pub(crate) mod table_2;
pub(crate) mod detection;
pub(crate) mod tracking;
pub(crate) mod traffic;
pub(crate) mod vehicles;
pub(crate) mod classifier;
pub(crate) mod predictions;
