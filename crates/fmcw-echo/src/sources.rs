//! Echoes from other sources than paths: far-field tables, and the road.

pub mod rcs_table; // scattering by aspect and frequency
pub mod ground; // patches of the road
