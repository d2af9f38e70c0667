//! Echoes of other than paths.

mod rcs_tables;
mod ground;
