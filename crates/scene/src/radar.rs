//! `[radar]` and `[[radars]]`: where each stands, what it sends, its antennas, and what of it is not ideal.

pub(crate) mod waveform;
pub(crate) mod array;
pub(crate) mod hardware;
pub(crate) mod read_radar;
pub(crate) mod radars;
