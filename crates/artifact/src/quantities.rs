//! Units, accuracy and seeds.

pub mod units; // constants and conversions
pub mod accuracy; // requested accuracy and estimated error
pub mod seed; // random streams
