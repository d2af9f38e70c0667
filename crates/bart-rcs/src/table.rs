//! S at aspects, over frequency.

pub(crate) mod joint_sum; // of all joints of one order
pub(crate) mod meeting; // of both ends, in ways of one order
pub(crate) mod small_mirrors; // too small to be followed: what they would have added
pub(crate) mod end_tree; // of an aspect, or of all with one receiver
pub(crate) mod aspect_settings; // with what an aspect is traced, and what is measured beside S
pub(crate) mod aspect; // S at one aspect, by order and node rule
pub(crate) mod rcs_request; // what is asked for
pub(crate) mod keeper; // what is done of a table, for another run
pub(crate) mod finer_mirrors; // where more was dropped than was asked for
pub(crate) mod measured_aspects; // of a table, and the error of its integrals
pub(crate) mod other_skins; // coarser facets, and sheets that waves pass
pub(crate) mod far_field_error; // what a far-field table misses near by
pub(crate) mod rcs_table; // S over frequency and aspect
pub(crate) mod antennas; // where no method says anything
pub(crate) mod contributions; // S of one aspect by facet sequence
