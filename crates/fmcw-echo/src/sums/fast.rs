//! The sum over paths in the time of a few transforms, to an error that is asked for.

pub(crate) mod scalar; // precision of a grid
pub(crate) mod equal_steps; // chirps that transforms can take together
pub(crate) mod instants; // the exact value of a path at any moment
pub(crate) mod skeleton; // a few moments that tell all
pub(crate) mod smooth_part; // what a group of paths has in common
pub(crate) mod kernel; // a tone on the cells beside it
pub(crate) mod tone_grid; // non-uniform FFT
pub(crate) mod groups; // paths that move alike
pub mod fast_sum; // the cube
#[cfg(test)]
mod test_path;
