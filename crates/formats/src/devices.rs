//! Boards and their sample orders.

/// Evaluation board of a device family, automotive and industrial alike.
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
    /// IWR6843ISK; boards with the antenna in or on the package have different antennas.
    Xwr6843,
    /// AWR2243BOOST.
    Awr2243,
}

/// Lanes between a device and its capture card.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lanes {
    /// Receiver after receiver, in pairs if samples are complex.
    Two,
    /// One lane per receiver, sample after sample.
    Four,
}

/// First part of a complex sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IqOrder {
    /// I before Q.
    InPhaseFirst,
    /// Q before I.
    QuadratureFirst,
}
