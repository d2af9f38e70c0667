//! Mathematics independent of radar: one textbook algorithm per file, named after it, preceded by two files
//! about numbers themselves (`finite`, `precision`). Reasons for this implementation and comparisons with
//! libraries: docs/decisions/numerics.md.

pub(crate) mod finite; // first non-finite value
pub(crate) mod precision; // single and double precision
pub(crate) mod summed_area_table; // sums over rectangles of a map (integral image, box filter)
pub(crate) mod regula_falsi; // roots (Illinois)
pub(crate) mod incomplete_gamma; // P(M, x), Q(M, x)
pub(crate) mod incomplete_beta; // I_u(a, b)
pub(crate) mod symmetric_qr; // eigenvalues of small matrices (Householder, Wilkinson)
pub(crate) mod gauss_quadrature; // Lanczos, Golub and Welsch
pub(crate) mod saddle_point_inversion; // distributions of weighted sums of Gamma variables
pub(crate) mod cholesky; // normal equations of few unknowns
