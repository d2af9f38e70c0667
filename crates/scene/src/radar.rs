//! `[radar]` and `[[radars]]`: position, waveform, antennas and imperfections of each radar.

pub(crate) mod waveform;
pub(crate) mod array;
pub(crate) mod hardware;
pub(crate) mod read_radar;
pub(crate) mod radars;
