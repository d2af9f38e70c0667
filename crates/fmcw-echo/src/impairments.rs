//! Effects of receivers, oscillators, elements, converters and other radars on samples.

pub mod noise; // receiver noise
pub mod oscillator; // phase noise of the oscillator
pub mod element_errors; // random element errors from the seed
pub mod interference; // interference by other radars
pub mod adc; // analogue-to-digital converter
