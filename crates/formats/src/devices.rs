//! Boards and the order in which they send samples.

/// Evaluation board of a family of devices, automotive and industrial alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Board {
    /// AWR1243BOOST.
    Xwr1243,
    /// AWR1443BOOST and IWR1443BOOST.
    Xwr1443,
    /// AWR1642BOOST and IWR1642BOOST.
    Xwr1642,
    /// AWR1843BOOST and IWR1843BOOST.
    Xwr1843,
    /// IWR6843ISK; boards with the antenna in or on the package have other antennas.
    Xwr6843,
    /// AWR2243BOOST.
    Awr2243,
}

/// Lanes between a device and its capture card.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lanes {
    /// Receiver after receiver, each by twos where samples are complex.
    Two,
    /// A lane for each receiver, sample after sample.
    Four,
}

/// The part of a complex sample that comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IqOrder {
    /// I before Q.
    InPhaseFirst,
    /// Q before I.
    QuadratureFirst,
}
