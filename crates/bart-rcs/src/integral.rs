//! A field over a lit polygon, in closed form.

pub(crate) mod polarization; // v and h of a leg, through its mirrors
pub(crate) mod steps; // surfaces between an antenna and a node
pub(crate) mod divided_difference; // of exp: phase and polynomial over a triangle
pub(crate) mod chebyshev; // few frequencies for many
pub(crate) mod polygon_phase; // a linear phase over a polygon, exactly
pub(crate) mod tiling; // how far a polygon must be cut
pub(crate) mod turns; // one length at several wavenumbers
pub(crate) mod physical_optics; // the integral over a lit polygon
pub(crate) mod lossy_node; // the same with reflection coefficients
