//! Effects of receivers, oscillators, elements, converters and other radars on samples.

pub mod noise; // of the receiver
pub mod oscillator; // its phase noise
pub mod element_errors; // that the seed draws
pub mod interference; // of other radars
pub mod adc; // the converter
