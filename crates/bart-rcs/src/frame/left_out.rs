//! Error of paths that are not traced: what they would contribute to a frame.

pub(crate) mod neglected_paths; // selected paths summed in addition to the traced ones
pub(crate) mod road; // paths via a road
pub(crate) mod between_bodies; // paths between bodies
pub(crate) mod echo_parts; // all of them at once, coarsely, for planning
