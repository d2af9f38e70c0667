//! Echoes of other than paths: far-field tables, and the road.

pub mod rcs_table; // sections by aspect and frequency
pub mod ground; // patches of the road
