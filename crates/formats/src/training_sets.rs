//! A run's frames as folders in the layouts of sets that people train on: tensors, maps, samples and clouds
//! with the truth as boxes (docs/training-sets.md).
//!
//! Truth comes from the scene's snapshot alone and goes into labels alone; arrays and clouds are those of the
//! artifact.

mod truth_boxes; // labels, in the world
#[cfg(test)]
mod test_body; // what the tests share
mod angle_spectrum; // range, azimuth and Doppler
mod cell_boxes; // labels, in cells of it
mod set_folder;
mod radar_of_points; // whose axes clouds are told in
mod opened_points;
mod pickle;
pub mod raddet;
pub mod carrada;
pub mod uwcr;
pub mod kitti;
mod nuscenes_tables;
pub mod nuscenes;
