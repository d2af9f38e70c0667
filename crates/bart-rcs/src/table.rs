//! Scattering amplitude S at aspects, over frequency.

pub(crate) mod joint_sum; // sum over all joints of one order
pub(crate) mod order_joints; // meetings of both ends on paths of one order
pub(crate) mod small_mirrors; // estimated scattering of unfollowed mirrors
pub(crate) mod end_tree; // tree of an aspect, or common to all with one receiver
pub(crate) mod aspect_settings; // settings of an aspect, and measurements besides S
pub(crate) mod aspect; // S at one aspect, by order and node rule
pub(crate) mod rcs_request; // request of a table
pub(crate) mod checkpoint; // finished aspects, stored for another run
pub(crate) mod finer_mirrors; // retracing where too much was dropped
pub(crate) mod measured_aspects; // measured aspects of a table, and the error of its integrals
pub(crate) mod skin_comparison; // comparison with coarser facets, and with transmission
pub(crate) mod far_field_error; // error of a far-field table at close range
pub(crate) mod rcs_table; // S over frequency and aspect
pub(crate) mod antennas; // antennas where no method is valid
pub(crate) mod contributions; // S of one aspect by facet sequence
