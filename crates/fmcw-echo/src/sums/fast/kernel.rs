//! Kernel that spreads a tone to nearby cells of a regular grid: the "exponential of a semicircle".
//!
//! φ(z) = e^{β(√(1 − z²) − 1)} for |z| ≤ 1, over w cells of a grid with twice as many cells as modes
//! (Barnett, Magland, af Klinteberg, SIAM J. Sci. Comput. 41 (2019) C479). A tone leaks into the modes that
//! alias with its own: φ̂(k ± M)/φ̂(k) for mode k. The kernel chosen is the narrowest whose largest leak is
//! within the requested error, with the β, of a few around 2.3w, that leaks least.

use crate::sums::fast::scalar::Scalar;
use std::f64::consts::PI;

/// Kernel φ over a number of cells.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kernel {
    pub(crate) cells: usize,
    shape: f64,
}

/// Maximum number of cells, beyond which f64 rounding dominates.
pub(crate) const CELLS_MAX: usize = 16;

impl Kernel {
    /// Kernel for an error of a two-dimensional transform, relative to the root sum of squares of the
    /// strengths.
    pub(crate) fn for_error(error: f64) -> Self {
        // β = 2.3w leaves an error of 10^{1−w}.
        let about = (-error.log10()).floor().clamp(2.0, CELLS_MAX as f64) as usize;
        let best = |cells: usize| {
            let shapes =
                [2.20, 2.26, 2.32, 2.38].map(|per_cell| Self { cells, shape: per_cell * cells as f64 });
            shapes.into_iter().map(|kernel| (kernel.leak(), kernel)).min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let kernels = (about..=CELLS_MAX).filter_map(best);
        let mut narrow = kernels.clone().filter(|(leak, _)| 2.0_f64.sqrt() * leak <= error);
        narrow.next().map_or(Self { cells: CELLS_MAX, shape: 2.32 * CELLS_MAX as f64 }, |(_, kernel)| kernel)
    }

    /// Leak of the nearest aliases into the most affected mode, along one axis.
    fn leak(&self) -> f64 {
        let of = |part: f64| {
            let own = self.transform(part, 2);
            [part - 2.0, part + 2.0].map(|alias| (self.transform(alias, 2) / own).powi(2)).iter().sum::<f64>()
        };
        // Modes are half of the cells, from −½ to ½ for M = 2; the last of them leaks most.
        let parts = [0.05, 0.15, 0.25, 0.35, 0.42, 0.46, 0.5];
        parts.map(of).iter().copied().fold(0.0, f64::max).sqrt()
    }

    /// First cell reached by a tone at `at` cells.
    pub(crate) fn first(&self, at: f64) -> f64 {
        (at - 0.5 * self.cells as f64).ceil()
    }

    /// Weights of the cells from the first one on.
    pub(crate) fn weigh<T: Scalar>(&self, at: f64, weights: &mut [T]) {
        let (half, first) = (0.5 * self.cells as f64, self.first(at));
        for (i, weight) in weights.iter_mut().enumerate().take(self.cells) {
            *weight = T::of(self.value((first + i as f64 - at) / half));
        }
    }

    /// Transform ∫φ(u/half)·cos(2πku/M) du over the w cells: the weight of mode `mode` on a grid of M
    /// `cells`.
    ///
    /// With z = sin θ the integrand is smooth; the trapezoidal rule errs by less than e^{−β}.
    pub(crate) fn transform(&self, mode: f64, grid_cells: usize) -> f64 {
        let half = 0.5 * self.cells as f64;
        let at = |i: i32| {
            let theta = 0.5 * PI * f64::from(i) / f64::from(TRAPEZOIDS);
            let (z, cosine) = theta.sin_cos();
            (self.shape * (cosine - 1.0)).exp()
                * cosine
                * (2.0 * PI * mode * half * z / grid_cells as f64).cos()
        };
        let sum: f64 = (-TRAPEZOIDS..=TRAPEZOIDS).map(at).sum();
        sum * 0.5 * PI / f64::from(TRAPEZOIDS) * half
    }

    fn value(&self, z: f64) -> f64 {
        (self.shape * ((1.0 - z * z).max(0.0).sqrt() - 1.0)).exp()
    }
}

/// Number of trapezoids on each side.
const TRAPEZOIDS: i32 = 64;
