//! Paths that change too much within a frame, or from one end of the array to the other, for a single
//! tracing: they are traced at several nodes, and blended between them.
//!
//! If bodies in relative motion light or shade one another, the outlines of lit parts slide over both; so do
//! outlines on bodies at rest, seen from element after element of a wide array. Paths keep the lit parts of
//! their node: once outlines have slid by δ along a phase gradient w, contributions that end there have
//! rotated by θ = wδ, and are missed completely from half a cycle on. A cubic through nodes between which the
//! phase rotates by θ follows it to within 3/128·θ⁴, while the nearest node alone leaves θ/2 and a straight
//! line between two θ²/8 (docs/speed.md has measurements). Only the paths that change are traced again.
//!
//! Along both axes at once S(t, u) is approximated by S(t, u₀) + S(t₀, u) − S(t₀, u₀), t₀ and u₀ the middle
//! of the frame and of the array: the neglected part is a product of both changes.

pub(crate) mod axis; // time, or the array's row
pub(crate) mod changing_sequences; // sequences of bodies that differ at other nodes
pub(crate) mod nodes; // paths traced at the nodes of one axis
pub(crate) mod blending; // table of as few nodes as meet the accuracy
