//! Division of the channels of cubes and maps among transmitters and receivers.

use artifact::Radar;
use artifact::radar::Multiplexing;

/// Transmitters and receivers, and how the former share the air.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Division {
    /// Multiplexing, which tells transmitters apart.
    pub(crate) multiplexing: Multiplexing,
    /// Number of them.
    pub(crate) transmitters: usize,
    /// Number of elements that hear each.
    pub(crate) receivers: usize,
    /// Chirps in the air from one chirp of a cube's channel to its next.
    pub(crate) slots: usize,
    /// Channels of a map: the transmit–receive pairs, and behind them codes that no transmitter has.
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

    /// Transmit–receive pairs.
    pub(crate) fn pairs(&self) -> usize {
        self.transmitters * self.receivers
    }
}
