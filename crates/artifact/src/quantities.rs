//! Numbers with units, the accuracy they have, and seeds.

pub mod units; // constants and conversions
pub mod accuracy; // asked for, and returned
pub mod seed; // what randomness is a function of
