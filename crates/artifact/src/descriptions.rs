//! Descriptions that several artifacts share: the radar, what is asked of the stages, and materials.

pub mod pattern; // gain of an element over direction
pub mod radar; // waveform, array, link
pub mod goal; // what a scene is run for
pub mod settings; // what a scene asks of the stages
pub mod material; // what bodies are made of
pub mod permittivity; // of substances
