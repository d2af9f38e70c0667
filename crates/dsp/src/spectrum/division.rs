//! Division of the channels of cubes and maps among transmitters and receivers.

use artifact::Radar;
use artifact::radar::Multiplexing;

/// Transmitters and receivers, and the multiplexing of transmitters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Division {
    /// Multiplexing that separates transmitters.
    pub(crate) multiplexing: Multiplexing,
    /// Number of transmitters.
    pub(crate) transmitters: usize,
    /// Number of receive elements.
    pub(crate) receivers: usize,
    /// Number of chirps sent from one chirp of a cube's channel to its next.
    pub(crate) slots: usize,
    /// Number of channels of a map: the transmit–receive pairs, followed by unused codes.
    pub(crate) map_channels: usize,
}

impl Division {
    /// Division of a radar's channels.
    pub(crate) fn of(radar: &Radar) -> Self {
        Self {
            multiplexing: radar.array.multiplexing,
            transmitters: radar.array.tx_m.len(),
            receivers: radar.array.rx_m.len(),
            slots: radar.slots(),
            map_channels: radar.map_channels(),
        }
    }

    /// Number of transmit–receive pairs.
    pub(crate) fn pairs(&self) -> usize {
        self.transmitters * self.receivers
    }
}
