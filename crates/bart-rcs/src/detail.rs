//! Levels of detail: fewer paths for the same echo, at an error that is measured; the stage that makes them.

pub(crate) mod looks; // path tables as some samples of a cube see them
pub(crate) mod merged_paths; // paths that turn alike become one
pub(crate) mod scattering_centres; // orthogonal matching pursuit
pub(crate) mod statistical_points; // points drawn like the body's own
pub(crate) mod detail_cost; // processor seconds of each level
pub(crate) mod level; // the cheapest level that meets the accuracy
pub(crate) mod tracer; // the stage: paths, tables and their cost of a scene's frames
