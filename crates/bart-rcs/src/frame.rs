//! Paths of a frame, or its table.

pub(crate) mod cells; // lit polygons and edges as cells with one node each
pub(crate) mod path_sum; // S from path records, by definition
mod array_places; // the row that ways are traced along, and the pair that a frame is checked with
pub(crate) mod path_plan; // what a frame is traced with
pub(crate) mod band_power; // sums and mean powers over the band
pub(crate) mod path_pruning; // paths too weak to matter
pub(crate) mod integration_error; // how finely integrals are taken
pub(crate) mod frame_error; // what a frame's paths miss, measured
pub(crate) mod snapshot; // bodies and beams of one moment, and the nearest lit point of each
pub(crate) mod left_out; // ways added up beside what was traced
pub(crate) mod path_table; // the largest cells that meet the accuracy
pub(crate) mod blends; // ways traced at several moments, or from several places of the array
pub(crate) mod expected_work; // what a frame will take, from a sample of it
pub(crate) mod path; // the path table of a frame
pub(crate) mod rcs_frame; // the paper's table of a frame
