//! Studies of signals alone: synthetic radars, targets by formula.

pub(crate) mod ambiguity;
pub(crate) mod calibration;
pub(crate) mod estimates;
pub(crate) mod false_alarms;
pub(crate) mod ghosts;
pub(crate) mod rivals;
pub(crate) mod super_resolution;
pub(crate) mod traced_ghosts;
pub(crate) mod transmitters_in_turn;
