//! Detection of the cells of a map that contain echoes, and interpolation of their peaks.

pub(crate) mod summed_bands; // correlation along an axis, with the bands of Doppler division
pub(crate) mod cell_power; // noise of one cell
pub(crate) mod correlated_cells; // effect of windows on the noise of a region
pub(crate) mod images; // image cells of real samples
pub(crate) mod cfar_threshold; // factor of cell averaging
pub(crate) mod noise_estimate; // factors of all other estimates
pub(crate) mod cell_means; // look-ups of a cell's sums
pub mod cfar; // the detector
pub(crate) mod empty_band; // velocity folds under Doppler division
pub(crate) mod range_doppler; // map of a frame with its detections
pub(crate) mod censored; // cells hidden by stronger echoes
pub(crate) mod interpolation; // offsets of peaks from their cells
pub(crate) mod leakage; // sidelobes of echoes
pub(crate) mod peaks; // local maxima without sidelobes
