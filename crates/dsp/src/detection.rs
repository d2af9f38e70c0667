//! Detection of the cells of a map that hold echoes, and of the places of their peaks between cells.

pub(crate) mod summed_bands; // how cells correlate along an axis, with the bands of Doppler division
pub(crate) mod cell_power; // the noise of one cell
pub(crate) mod correlated_cells; // what windows do to the noise of a region
pub(crate) mod images; // of cells, in maps of real samples
pub(crate) mod cfar_threshold; // the factor of cell averaging
pub(crate) mod noise_estimate; // those of all other estimates
pub(crate) mod cell_means; // where the sums of a cell are looked up
pub mod cfar; // the detector
pub(crate) mod empty_band; // folds under Doppler division
pub(crate) mod range_doppler; // the map of a frame with its detections
pub(crate) mod censored; // cells that stronger echoes hid
pub(crate) mod interpolation; // offsets from a cell
pub(crate) mod leakage; // sidelobes of echoes
pub(crate) mod peaks; // local maxima without sidelobes
