//! Maps of all channels from samples, their axes and their sum.

pub(crate) mod shapes; // validation of header, cube and map
pub(crate) mod map_cells; // adjacency of cells
pub(crate) mod axes; // metres and metres per second of rows and columns
pub(crate) mod division; // channels of transmitters and receivers
pub mod window; // tapers, and their effect on tones and noise
pub(crate) mod doppler_transform; // chirps to Doppler rows, staggered ones too
pub(crate) mod map_transform; // both transforms of a channel
pub(crate) mod inverse_transform; // its inverse
pub(crate) mod doppler_bands; // Doppler-division transmitters
pub(crate) mod code_division; // code-division transmitters
pub(crate) mod all_channels; // maps of a cube
pub(crate) mod noncoherent; // sum over channels, and its noise
