//! Exact answers for small bodies: closed forms, series, and converged integrals (docs/physics.md §11).

use crate::study::rcs_solvers::{K, WAVELENGTH_M};
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI};

/// Factor j√(4π)/λ before every integral of physical optics.
pub(super) fn front() -> Complex64 {
    Complex64::new(0.0, (4.0 * PI).sqrt() / WAVELENGTH_M)
}

/// S of a square plate in the far field at this azimuth, elevation 0 (P1).
pub(super) fn plate_far(side_m: f64, azimuth_rad: f64) -> Complex64 {
    let x = K * side_m * azimuth_rad.sin();
    let sinc = if x.abs() < 1e-4 { 1.0 - x * x / 6.0 } else { x.sin() / x };
    front() * side_m * side_m * azimuth_rad.cos() * sinc
}

/// S of a square plate at `range_m` and this azimuth, elevation 0: the integral of interface.md, with at most
/// 1 rad of phase between four Gauss points, which leaves 1e-8.
pub(super) fn plate_near(side_m: f64, range_m: f64, azimuth_rad: f64) -> Complex64 {
    let antenna = [range_m * azimuth_rad.cos(), range_m * azimuth_rad.sin()];
    let across = nodes(side_m, 2.0 * K * (azimuth_rad.sin().abs() + side_m / range_m));
    let upwards = nodes(side_m, 2.0 * K * side_m / range_m);
    let mut sum = Complex64::ZERO;
    for (y, wy) in &across {
        let square = antenna[0] * antenna[0] + (antenna[1] - y) * (antenna[1] - y);
        for (z, wz) in &upwards {
            let r = (square + z * z).sqrt();
            let weight = wy * wz * antenna[0] / r * (range_m / r).powi(2);
            sum += weight * Complex64::cis(-2.0 * K * (r - range_m));
        }
    }
    front() * sum
}

/// Gauss points and weights over −side/2 … side/2 for a phase that changes by this many radians per metre.
pub(super) fn nodes(side_m: f64, turn_per_m: f64) -> Vec<(f64, f64)> {
    // Four-point Gauss–Legendre rule (Abramowitz and Stegun, table 25.4).
    const FOUR: [(f64, f64); 4] = [
        (-0.861_136_311_594_052_6, 0.347_854_845_137_453_8),
        (-0.339_981_043_584_856_3, 0.652_145_154_862_546_2),
        (0.339_981_043_584_856_3, 0.652_145_154_862_546_2),
        (0.861_136_311_594_052_6, 0.347_854_845_137_453_8),
    ];
    let panels = (side_m * turn_per_m).ceil().max(8.0) as u32;
    let half = 0.5 * side_m / f64::from(panels);
    let panel = |p: u32| FOUR.map(|(x, w)| (-0.5 * side_m + half * (f64::from(2 * p + 1) + x), half * w));
    (0..panels).flat_map(panel).collect()
}

/// S of an upright cylinder perpendicular to the line of sight: physical optics of its round wall.
pub(super) fn cylinder(radius_m: f64, height_m: f64) -> Complex64 {
    let steps = (40.0 * K * radius_m).ceil() as u32;
    let step = PI / f64::from(steps);
    let at = |i: u32| {
        let cosine = (-FRAC_PI_2 + (f64::from(i) + 0.5) * step).cos();
        step * cosine * Complex64::cis(2.0 * K * radius_m * cosine)
    };
    front() * height_m * radius_m * (0..steps).map(at).sum::<Complex64>()
}

/// |S| of a perfectly conducting sphere by Mie's series (docs/physics.md P4).
pub(super) fn mie_sphere(radius_m: f64) -> f64 {
    let x = K * radius_m;
    let orders = (x + 4.0 * x.cbrt() + 10.0).ceil() as usize;
    let (j, y) = (bessel_j(x, orders), bessel_y(x, orders));
    let h = |n: usize| Complex64::new(j[n], -y[n]);
    let term = |n: usize| {
        let order = n as f64;
        let electric = (x * j[n - 1] - order * j[n]) / (x * h(n - 1) - order * h(n));
        let sign = if n.is_multiple_of(2) { 1.0 } else { -1.0 };
        sign * (2.0 * order + 1.0) * (j[n] / h(n) - electric)
    };
    PI.sqrt() / K * (1..=orders).map(term).sum::<Complex64>().norm()
}

/// Spherical Bessel functions of the first kind, downwards (Miller), for orders 0 to `last`.
fn bessel_j(x: f64, last: usize) -> Vec<f64> {
    let start = last + 40;
    let mut values = vec![0.0; start + 2];
    values[start] = 1e-100;
    for n in (1..=start).rev() {
        values[n - 1] = (2 * n + 1) as f64 / x * values[n] - values[n + 1];
        if values[n - 1].abs() > 1e100 {
            values.iter_mut().for_each(|v| *v *= 1e-100);
        }
    }
    // j₀² + … = 1 with weights 2n + 1 fixes the size; the sign is that of j₀ or j₁, whichever is larger.
    let size = values.iter().enumerate().map(|(n, v)| (2 * n + 1) as f64 * v * v).sum::<f64>().sqrt();
    let (j0, j1) = (x.sin() / x, x.sin() / (x * x) - x.cos() / x);
    let same = if j0.abs() > j1.abs() { values[0] * j0 > 0.0 } else { values[1] * j1 > 0.0 };
    let scale = if same { 1.0 / size } else { -1.0 / size };
    values[..=last].iter().map(|v| v * scale).collect()
}

/// Spherical Bessel functions of the second kind, upwards, for orders 0 to `last`.
fn bessel_y(x: f64, last: usize) -> Vec<f64> {
    let mut values = vec![-x.cos() / x, -x.cos() / (x * x) - x.sin() / x];
    for n in 1..last {
        values.push((2 * n + 1) as f64 / x * values[n] - values[n - 1]);
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dbsm(amplitude: f64) -> f64 {
        20.0 * amplitude.log10()
    }

    /// P4 of docs/physics.md, printed with four decimals.
    #[test]
    fn a_sphere_of_ten_centimetres_has_its_mie_level() {
        assert!((dbsm(mie_sphere(0.1)) + 15.0280).abs() < 6e-5);
    }

    /// P2 of docs/physics.md: the Fresnel integral, within 1e-3 dB of this one.
    #[test]
    fn a_near_plate_has_the_level_of_its_fresnel_integral() {
        for (range_m, level) in [(100.0, 38.1685), (30.0, 37.1288)] {
            assert!((dbsm(plate_near(0.3, range_m, 0.0).norm()) - level).abs() < 1e-3);
        }
    }

    /// P6: kρL² within 0.1 dB for kρ above 50.
    #[test]
    fn a_cylinder_is_close_to_its_stationary_phase() {
        assert!((dbsm(cylinder(0.5, 0.1).norm()) - 10.0 * (K * 0.5 * 0.01).log10()).abs() < 0.1);
    }
}
