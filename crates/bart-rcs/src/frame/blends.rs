//! Ways that change too much within a frame, or from one end of the array to the other, for one tracing: they
//! are traced at several nodes, and blended between them.
//!
//! Where bodies that move against each other light or shade one another, the outlines of what is lit slide
//! over both; and so do outlines on bodies at rest, seen from element after element of a wide array. Paths
//! keep what was lit at their node: once outlines have slid by δ along a phase gradient w, what ends there
//! has turned by θ = wδ, and is missed whole from half a cycle on. A cubic through nodes between which it
//! turns by θ follows it to 3/128·θ⁴ at most, where the nearest node alone leaves θ/2 and a straight line
//! between two θ²/8 (docs/speed.md has what was measured). Only the ways that change are traced again.
//!
//! Along both axes at once S(t, u) is taken as S(t, u₀) + S(t₀, u) − S(t₀, u₀), t₀ and u₀ the frame's middle
//! and the array's: what is left out changes with both in product.

pub(crate) mod axis; // time, or the array's row
pub(crate) mod changing_ways; // ways that are not at other nodes what they are in the middle
pub(crate) mod nodes; // paths traced at the nodes of one axis
pub(crate) mod blending; // the table of as few nodes as meet the accuracy
