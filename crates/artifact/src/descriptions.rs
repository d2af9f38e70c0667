//! Descriptions shared by several artifacts: the radar, the settings of the stages, and materials.

pub mod pattern; // gain of an element over direction
pub mod radar; // waveform, array, link
pub mod goal; // goal of a run
pub mod settings; // settings of the stages
pub mod material; // materials of bodies
pub mod permittivity; // permittivities of substances
