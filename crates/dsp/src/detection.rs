//! Which cells of a map hold echoes, and where between cells their peaks lie.

pub mod correlated_cells; // what windows do to the noise of a region
pub mod images; // of cells, in maps of real samples
pub mod cfar_threshold; // the factor of cell averaging
pub mod noise_estimate; // those of all other estimates
pub mod cell_means; // where the sums of a cell are looked up
pub mod cfar; // the detector
pub mod empty_band; // folds under Doppler division
pub mod range_doppler; // the map of a frame with its detections
pub mod censored; // cells that stronger echoes hid
pub mod interpolation; // offsets from a cell
pub mod peaks; // local maxima without sidelobes
