//! A run's frames as folders in the layouts of training datasets: tensors, maps, samples and clouds with the
//! truth as boxes; and the boxes of such sets, read (docs/training-sets.md).
//!
//! The ground truth comes only from the scene's snapshot and is used only for labels; arrays and clouds are
//! those of the artifact.

mod truth_boxes; // labels in world axes
#[cfg(test)]
mod test_body; // what the tests share
mod angle_spectrum; // tensors over range, azimuth and Doppler
mod cell_boxes; // labels in cells of a tensor
mod set_folder;
mod radar_of_points; // radar whose axes clouds use
mod opened_points;
mod pickle;
pub mod raddet;
pub mod carrada;
pub mod uwcr;
pub mod kitti;
mod nuscenes_tables;
pub mod nuscenes;
pub mod labels; // boxes of others
