//! Integration of a field over a lit polygon, in closed form.

pub(crate) mod polarization; // polarization vectors of a leg, through its mirrors
pub(crate) mod leg_surfaces; // surfaces between an antenna and a node
pub(crate) mod divided_difference; // divided differences of exp: phase and polynomial over a triangle
pub(crate) mod chebyshev; // interpolation over a band from few frequencies
pub(crate) mod phasors; // phasors of one length at several wavenumbers
pub(crate) mod polygon_phase; // integral of a linear phase over a polygon, exactly
pub(crate) mod node; // a lit polygon with both its legs
pub(crate) mod field; // the integrand of a node
pub(crate) mod tiling; // subdivision of a polygon
pub(crate) mod tile_integrals; // integrals of the phase over a tile
pub(crate) mod lossy_node; // weights with reflection coefficients
pub(crate) mod physical_optics; // the integral over a lit polygon
pub(crate) mod interpolation; // the same shared among the corners of a grid
pub(crate) mod critical_points; // the same off its specular: parts near its stationary point and far from it
#[cfg(test)]
pub(crate) mod test_quadrature; // quadrature rule for comparison
