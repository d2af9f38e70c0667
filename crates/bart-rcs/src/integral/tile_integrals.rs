//! Integrals of e^{−jkL} over a tile, to be weighted at a few of its points.

use crate::integral::field::{Field, SurfacePoint};
use crate::integral::phasors::{PhasorRotation, WAVENUMBERS_PER_BATCH, phasors};
use crate::integral::polygon_phase::{linear_phase_integrals, six_point_weights};
use glam::DVec2;
use num_complex::Complex64;

/// A polygon with a linear phase.
pub(crate) struct LinearPhasePolygon {
    /// Point at which the weight is evaluated.
    pub(crate) centre: SurfacePoint,
    /// Gradient of L₁ + L₂ at the centre, and its value.
    gradient: DVec2,
    length_m: f64,
    about_centre_m: Vec<DVec2>,
}

impl LinearPhasePolygon {
    /// Calls `give` with the index of every wavenumber and ∫ e^{−jkL} dA.
    pub(crate) fn for_each_integral(
        &self,
        wavenumbers_per_m: &[f64],
        give: &mut dyn FnMut(usize, Complex64),
    ) {
        for (chunk, some) in wavenumbers_per_m.chunks(WAVENUMBERS_PER_BATCH).enumerate() {
            let at_centre = phasors(self.length_m, some);
            let about_centre_m2 = linear_phase_integrals(&self.about_centre_m, self.gradient, some);
            (0..some.len())
                .for_each(|i| give(chunk * WAVENUMBERS_PER_BATCH + i, at_centre[i] * about_centre_m2[i]));
        }
    }
}

/// A triangle over which weight times the residual phase is quadratic.
pub(crate) struct QuadraticTriangle {
    /// Points at which the weights are evaluated: corners, and midpoints of the edges opposite to them.
    pub(crate) points: [SurfacePoint; 6],
    /// Lengths L₁ + L₂ at the points: the linear part, and the whole.
    linear_m: [f64; 6],
    lengths_m: [f64; 6],
    area_m2: f64,
}

impl QuadraticTriangle {
    /// Calls `give` with the index of every wavenumber and the factor of the weight at each point, which
    /// together give ∫ weight·e^{−jkL} dA.
    pub(crate) fn for_each_integral(
        &self,
        wavenumbers_per_m: &[f64],
        give: &mut dyn FnMut(usize, [Complex64; 6]),
    ) {
        for (chunk, some) in wavenumbers_per_m.chunks(WAVENUMBERS_PER_BATCH).enumerate() {
            let at_corners = [0, 1, 2].map(|i| PhasorRotation::of(self.linear_m[i], some));
            // The factors contain the linear part; the residual length rotates the sampled value.
            let beyond: [PhasorRotation; 6] =
                std::array::from_fn(|i| PhasorRotation::of(self.lengths_m[i] - self.linear_m[i], some));
            for (i, k) in some.iter().enumerate() {
                let phases = [0, 1, 2].map(|corner| -k * self.linear_m[corner]);
                let under_phase = six_point_weights(phases, at_corners.map(|turning| turning.at(*k)));
                let integrals_m2 =
                    std::array::from_fn(|point| under_phase[point] * beyond[point].at(*k) * self.area_m2);
                give(chunk * WAVENUMBERS_PER_BATCH + i, integrals_m2);
            }
        }
    }
}

impl Field<'_> {
    pub(crate) fn whole(&self, corners_m: &[DVec2], centre_m: DVec2) -> LinearPhasePolygon {
        let centre = self.surface_at(centre_m);
        LinearPhasePolygon {
            centre,
            gradient: self.length_gradient(&centre),
            length_m: self.length_m(centre.x_m),
            about_centre_m: corners_m.iter().map(|c| *c - centre_m).collect(),
        }
    }

    pub(crate) fn six_points(&self, [a, b, c]: [DVec2; 3]) -> QuadraticTriangle {
        let centre_m = (a + b + c) / 3.0;
        let points_m = [a, b, c, 0.5 * (b + c), 0.5 * (c + a), 0.5 * (a + b)];
        let gradient = self.length_gradient(&self.surface_at(centre_m));
        let points = points_m.map(|p| self.surface_at(p));
        QuadraticTriangle {
            points,
            linear_m: points_m.map(|p| gradient.dot(p - centre_m)),
            lengths_m: points.map(|at| self.length_m(at.x_m)),
            area_m2: 0.5 * (b - a).perp_dot(c - a),
        }
    }
}
