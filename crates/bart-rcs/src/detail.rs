//! Levels of detail: fewer paths for the same echo, with a measured error; and the stage that produces them.

pub(crate) mod sampled_chirps; // fields of path tables at samples of a cube
pub(crate) mod merged_paths; // merging of paths with like phase rotation
pub(crate) mod scattering_centres; // orthogonal matching pursuit
pub(crate) mod statistical_points; // random points with the body's statistics
pub(crate) mod detail_cost; // processor seconds of each level
pub(crate) mod level; // cheapest level that meets the accuracy
pub(crate) mod tracer; // the stage: paths and tables of frames, and their cost
