//! Mathematics that knows no radar.

pub(crate) mod finite; // the first value that is no number
pub(crate) mod precision; // single and double
pub(crate) mod box_sums; // sums over rectangles of a map
pub(crate) mod gamma_forms; // distributions of weighted sums of Gamma variables
pub(crate) mod symmetric_eigenvalues; // of small matrices
pub(crate) mod normal_equations; // least squares of few unknowns
