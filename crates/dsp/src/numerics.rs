//! Mathematics that knows no radar.

pub mod finite; // the first value that is no number
pub mod precision; // single and double
pub mod box_sums; // sums over rectangles of a map
pub mod gamma_forms; // distributions of weighted sums of Gamma variables
pub mod symmetric_eigenvalues; // of small matrices
pub mod normal_equations; // least squares of few unknowns
pub mod assignment; // rows to columns at the least cost
