//! Reflection and transmission.

pub(crate) mod reflection_coefficients; // coefficients of a plane boundary
pub(crate) mod layers; // coefficients of plane layers
pub(crate) mod surface_response; // coefficients of a material, and their effect on a field
#[cfg(test)]
mod against_matrices;
