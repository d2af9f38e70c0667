//! The artifacts in the order in which the stages produce them.

pub mod scene; // bodies and the radar
pub mod paths; // scattering paths
pub mod rcs; // scattering over aspect and frequency
pub mod cube; // IF samples
pub mod rdm; // range-Doppler maps
pub mod points; // detected points and objects
pub mod tracks; // vehicles over frames
pub mod signature; // an object, cell by cell
pub mod dataset; // signatures and crops with labels
pub mod model; // a trained classifier
pub mod classes; // classes and probabilities of objects
