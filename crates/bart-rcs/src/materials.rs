//! Reflection and transmission.

pub(crate) mod reflection_coefficients; // of a plane boundary
pub(crate) mod layers; // coefficients of plane layers
pub(crate) mod surface_response; // a material's coefficients, and what they do to a field
#[cfg(test)]
mod against_matrices;
