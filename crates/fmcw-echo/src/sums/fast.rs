//! Sum over paths in the time of a few transforms, to a requested error.

pub(crate) mod scalar; // precision of a grid
pub(crate) mod equidistant_chirps; // chirps that transforms can process together
pub(crate) mod instants; // exact value of a path at any instant
pub(crate) mod empirical_interpolation; // empirical interpolation from a few instants
pub(crate) mod smooth_part; // common factor of a group of paths
pub(crate) mod kernel; // spreading of a tone to grid cells
pub(crate) mod tone_grid; // non-uniform FFT
pub(crate) mod groups; // paths that move alike
pub mod fast_sum; // the cube
#[cfg(test)]
mod test_path;
