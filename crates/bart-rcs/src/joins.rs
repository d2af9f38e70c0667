//! Beams of both ends meet on a facet.

pub(crate) mod outline; // of what both ends light
pub(crate) mod shadow_sides; // borders along lines that cut out shadows
pub(crate) mod parting; // how far from its specular a double reflection is
pub(crate) mod joint; // what both ends light of a facet
pub(crate) mod own_edge; // weights of a sequence's nodes
pub(crate) mod join; // beams of both ends meet on a facet
pub(crate) mod group; // shares that turn alike
pub(crate) mod scatterer; // joints with the way to them
pub(crate) mod afforded; // how exactly their integrals can be had
pub(crate) mod band; // many frequencies from few
