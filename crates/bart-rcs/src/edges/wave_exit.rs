//! Point at which a wave over faces leaves them.

use glam::DVec3;

/// End of a wave over faces: it leaves towards one antenna from an edge other than the one where it began.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WaveExit {
    pub(crate) end_m: DVec3,
    /// Path length over all faces.
    pub(crate) way_m: f64,
    /// Antenna to which it leaves.
    pub(crate) towards: ExitLeg,
}

/// Leg on which a wave over faces leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ExitLeg {
    /// The wave leaves towards the transmitter, which is the receiver of its reverse.
    Transmit,
    Receive,
}
