//! Paths of a frame, or its table.

pub(crate) mod cells; // lit polygons and edges as cells with one node each
pub(crate) mod path_sum; // S from path records, by definition
mod array_positions; // row along which paths are traced, and the pair of the check
pub(crate) mod path_plan; // parameters of a frame's tracing
pub(crate) mod band_power; // sums and mean powers over the band
pub(crate) mod path_pruning; // paths too weak to matter
pub(crate) mod integration_error; // fineness of integrals
pub(crate) mod frame_error; // measured error of a frame's paths
pub(crate) mod snapshot; // bodies and beams of one moment, with nearest lit points and sliding outlines
pub(crate) mod left_out; // paths summed in addition to the traced ones
pub(crate) mod path_table; // largest cells that meet the accuracy
pub(crate) mod blends; // paths traced at several moments, or from several places of the array
pub(crate) mod expected_work; // prediction of a frame's work from a sample
pub(crate) mod path; // the path table of a frame
pub(crate) mod rcs_frame; // the paper's table of a frame
