//! Maps of all channels made from samples, their axes and their sum.

pub(crate) mod shapes; // what header, cube and map have to be like
pub(crate) mod map_cells; // which cells lie beside which
pub(crate) mod axes; // metres and metres per second of rows and columns
pub(crate) mod division; // channels of transmitters and receivers
pub mod window; // tapers, and what they do to tones and to noise
pub(crate) mod doppler_transform; // chirps to Doppler rows, staggered ones too
pub(crate) mod map_transform; // both transforms of a channel
pub(crate) mod inverse_transform; // and backwards
pub(crate) mod doppler_bands; // transmitters told apart by Doppler
pub(crate) mod code_division; // transmitters told apart by codes
pub(crate) mod all_channels; // the maps of a cube
pub(crate) mod noncoherent; // their sum, and its noise
