//! Physical optics over one lit polygon, for any number of mirrors before and after it (the node integral).
//!
//! ```text
//! S_pq = j√(4π)/λ ∫ R_tR_r/(L₁L₂) · e_p·[d₁(n·e_q) − e_q(n·d₁)] · e^{−jk(L₁+L₂−R_t−R_r)} dA
//! ```
//! p and q are v or h of the receiver's and transmitter's own legs, carried to the node by the mirrors; L, d
//! belong to the image antennas. The result is the amplitude `a` of a path whose node is a reference point of
//! the polygon: S without R_tR_r/(L₁L₂)·e^{−jk(L₁+L₂−R_t−R_r)} taken at that point, so that only small
//! differences enter. Over a curved facet x is the skin above the polygon's point, and n·dA its area vector.

use crate::integral::field::{Field, SurfacePoint};
use crate::integral::node::{Bracket, Estimate, Node};
use crate::integral::phasors::WAVENUMBERS_PER_BATCH;
use crate::integral::tiling::{self, Tile};
use artifact::paths::Amplitude;
use glam::{DVec2, DVec3};
use num_complex::Complex64;

/// Amplitudes of a node at several wavenumbers, on one tiling as fine as `accuracy` requires.
///
/// `accuracy` bounds the error of every element of the 2 × 2 amplitude as a fraction of √(4π)·area/λ at the
/// highest wavenumber, the largest amplitude that the polygon can have; `error` is the bound reached, in
/// metres. The accuracy is limited to 1e-12, where rounding begins.
pub(crate) fn node_amplitudes(
    node: &Node<'_>,
    reference_m: DVec3,
    wavenumbers_per_m: &[f64],
    accuracy: f64,
) -> Estimate<Vec<Amplitude>> {
    let field = Field::new(node, reference_m, accuracy);
    let highest = wavenumbers_per_m.iter().copied().fold(0.0, f64::max);
    let mut sums = vec![[0.0; 4].map(Complex64::from); wavenumbers_per_m.len()];
    let mut error_m2 = 0.0;
    for_each_tile(&field, highest, &mut |tile, error| {
        error_m2 += error * tile.area_m2();
        field.add(tile, wavenumbers_per_m, &mut sums);
    });
    let value = sums.iter().zip(wavenumbers_per_m).map(|(sum, k)| amplitude_of(sum, *k)).collect();
    Estimate { value, error: largest_amplitude(error_m2, highest) }
}

/// Largest amplitude, √(4π)·area/λ, that an area can have.
pub(crate) fn largest_amplitude(area_m2: f64, wavenumber_per_m: f64) -> f64 {
    area_m2 * wavenumber_per_m / std::f64::consts::PI.sqrt()
}

/// Calls `give` with the tiles of a node as used by [`node_amplitudes`], each with an error bound for
/// weight·phase.
pub(crate) fn for_each_tile(field: &Field<'_>, highest_per_m: f64, give: &mut dyn FnMut(&Tile<'_>, f64)) {
    tiling::cut(field, highest_per_m, field.accuracy.max(1e-12), give);
}

/// Approximate number of tiles, counted up to `most`.
pub(crate) fn count_tiles(field: &Field<'_>, highest_per_m: f64, most: u64) -> u64 {
    tiling::count(field, highest_per_m, field.accuracy.max(1e-12), most)
}

/// Amplitude j√(4π)/λ = jk/√π times the integrals.
fn amplitude_of(integrals_m2: &[Complex64; 4], wavenumber_per_m: f64) -> Amplitude {
    let factor = Complex64::new(0.0, wavenumber_per_m / std::f64::consts::PI.sqrt());
    let [vv, vh, hv, hh] = integrals_m2.map(|i| factor * i);
    [[vv, vh], [hv, hh]]
}

/// Sum of integrals, each times its weights.
pub(crate) fn weighed<const N: usize>(
    weights: &[[Complex64; 4]; N],
    integrals_m2: &[Complex64; N],
) -> [Complex64; 4] {
    let mut sum = [Complex64::ZERO; 4];
    for (weights, integral_m2) in weights.iter().zip(integrals_m2) {
        sum.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * integral_m2);
    }
    sum
}

impl Field<'_> {
    /// Bracket times 1/(L₁L₂), relative to 1/(L₁L₂) at the reference point: [vv, vh, hv, hh], receiver first.
    pub(crate) fn weights(&self, at: &SurfacePoint) -> [f64; 4] {
        let Node { transmit, receive, bracket, .. } = *self.node;
        let SurfacePoint { x_m, area: normal, .. } = *at;
        let [d1, d2] = self.directions(x_m);
        let [there, back] = self.spread(x_m);
        let spread = there * back;
        let sent = transmit.mirrors.fields_at_node(d1, transmit.zenith_h);
        let plain =
            |d: DVec3, e: DVec3, other: DVec3| other.dot(d) * normal.dot(e) - other.dot(e) * normal.dot(d);
        // If both legs are the same, so are their fields, and one direction is the other with exchanged ends.
        let (received, is_one_way) = if self.node.is_one_way() {
            (sent, true)
        } else {
            (receive.mirrors.fields_at_node(d2, receive.zenith_h), false)
        };
        let forth = |p: usize, q: usize| plain(d1, sent[q], received[p]);
        let [vv, vh, hv, hh] = [forth(0, 0), forth(0, 1), forth(1, 0), forth(1, 1)];
        let back = |p: usize, q: usize| plain(d2, received[p], sent[q]);
        let weights = match bracket {
            Bracket::Plain => [vv, vh, hv, hh],
            Bracket::Symmetrised if is_one_way => {
                [0.5 * (vv + vv), 0.5 * (vh + hv), 0.5 * (hv + vh), 0.5 * (hh + hh)]
            }
            Bracket::Symmetrised => [
                0.5 * (vv + back(0, 0)),
                0.5 * (vh + back(0, 1)),
                0.5 * (hv + back(1, 0)),
                0.5 * (hh + back(1, 1)),
            ],
        };
        weights.map(|weight| spread * weight)
    }

    /// Amplitudes of a part from its integrals of e^{−jkL}, each with the weight at its point.
    pub(crate) fn amplitudes_of<const N: usize>(
        &self,
        points: &[SurfacePoint; N],
        wavenumbers_per_m: &[f64],
        integrals_m2: &[[Complex64; N]],
    ) -> Vec<Amplitude> {
        let mut sums = vec![[Complex64::ZERO; 4]; wavenumbers_per_m.len()];
        if self.is_perfect() {
            let weights = points.map(|at| self.weights(&at).map(Complex64::from));
            for (sum, integrals_m2) in sums.iter_mut().zip(integrals_m2) {
                *sum = weighed(&weights, integrals_m2);
            }
        } else {
            self.weigh_lossy(points, wavenumbers_per_m, integrals_m2, &mut sums);
        }
        sums.iter().zip(wavenumbers_per_m).map(|(sum, k)| amplitude_of(sum, *k)).collect()
    }

    /// Calls `give` with the index of every wavenumber and the amplitude of a single tile, as in
    /// [`node_amplitudes`].
    pub(crate) fn for_each_amplitude(
        &self,
        tile: &Tile<'_>,
        wavenumbers_per_m: &[f64],
        give: &mut dyn FnMut(usize, &Amplitude),
    ) {
        // A few wavenumbers at a time need no heap memory.
        for (chunk, some) in wavenumbers_per_m.chunks(WAVENUMBERS_PER_BATCH).enumerate() {
            let mut sums = [[Complex64::ZERO; 4]; WAVENUMBERS_PER_BATCH];
            self.add(tile, some, &mut sums[..some.len()]);
            for (i, (sum, k)) in sums.iter().zip(some).enumerate() {
                give(chunk * WAVENUMBERS_PER_BATCH + i, &amplitude_of(sum, *k));
            }
        }
    }

    /// Adds a tile's integrals of weight·e^{−jkL} for every wavenumber.
    fn add(&self, tile: &Tile<'_>, wavenumbers_per_m: &[f64], sums: &mut [[Complex64; 4]]) {
        match tile {
            _ if !self.is_perfect() => self.add_lossy(tile, wavenumbers_per_m, sums),
            Tile::Whole { corners_m, centre_m } => {
                self.add_whole(corners_m, *centre_m, wavenumbers_per_m, sums)
            }
            Tile::Triangle(corners_m) => self.add_triangle(*corners_m, wavenumbers_per_m, sums),
        }
    }

    /// Weight and curvature of the phase taken from the centre: Gordon over the whole polygon.
    fn add_whole(
        &self,
        corners_m: &[DVec2],
        centre_m: DVec2,
        wavenumbers_per_m: &[f64],
        sums: &mut [[Complex64; 4]],
    ) {
        let whole = self.whole(corners_m, centre_m);
        let weights = self.weights(&whole.centre);
        whole.for_each_integral(wavenumbers_per_m, &mut |i, integral_m2| {
            sums[i].iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * integral_m2);
        });
    }

    /// Weight times the residual phase as the quadratic through six points, integrated exactly with the
    /// linear phase.
    fn add_triangle(&self, corners_m: [DVec2; 3], wavenumbers_per_m: &[f64], sums: &mut [[Complex64; 4]]) {
        let six = self.six_points(corners_m);
        let weights = six.points.map(|at| self.weights(&at));
        six.for_each_integral(wavenumbers_per_m, &mut |i, integrals_m2| {
            for (integral_m2, weights) in integrals_m2.into_iter().zip(weights) {
                sums[i].iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * integral_m2);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::antenna::Antenna;
    use crate::integral::leg_surfaces::LegSurfaces;
    use crate::integral::node::Leg;
    use crate::integral::polarization::Mirrors;
    use crate::integral::test_quadrature::gauss_legendre;
    use artifact::units::SPEED_OF_LIGHT_MPS;

    const WAVENUMBER_PER_M: f64 = std::f64::consts::TAU * 77e9 / SPEED_OF_LIGHT_MPS;

    /// A rectangle in the plane x = 0 around the origin, and two antennas as [along its first side, along its
    /// second, ahead].
    struct HardCase {
        name: &'static str,
        sides_m: [f64; 2],
        transmitter_m: DVec3,
        receiver_m: DVec3,
        /// Number of points, enough for 1e-13: a third of the phase's span in radians plus a margin.
        gauss_points: usize,
    }

    const fn case(
        name: &'static str,
        sides_m: [f64; 2],
        t: [f64; 3],
        r: [f64; 3],
        gauss_points: usize,
    ) -> HardCase {
        let [transmitter_m, receiver_m] = [DVec3::new(t[2], t[0], t[1]), DVec3::new(r[2], r[0], r[1])];
        HardCase { name, sides_m, transmitter_m, receiver_m, gauss_points }
    }

    const HARD_CASES: [HardCase; 8] = [
        case("broadside, 1 m away", [0.005, 0.005], [0.0, 0.001, 1.0], [0.0, 0.001, 1.0], 60),
        case("grazing, 1 m away", [0.005, 0.005], [0.9998, 0.0, 0.02], [0.9998, 0.0, 0.02], 80),
        case("sliver", [0.1, 1e-4], [15.0, 0.0, 20.0], [15.0, 0.0, 20.0], 200),
        case("one wavelength wide", [0.0039, 0.0039], [0.5, 0.3, 0.8], [0.5, 0.3, 0.8], 30),
        case("300 m away, broadside", [0.1, 0.1], [0.0, 1.0, 300.0], [0.0, 1.0, 300.0], 60),
        case("300 m away, oblique", [0.1, 0.1], [150.0, 80.0, 240.0], [150.0, 80.0, 240.0], 130),
        case("strip along the line of sight", [0.3, 0.02], [38.0, 0.5, 6.0], [38.0, 0.5, 6.0], 400),
        case("bistatic", [0.005, 0.01], [1.0, 0.4, 1.5], [-0.2, -2.0, 1.0], 120),
    ];

    impl HardCase {
        fn corners_m(&self) -> [DVec3; 4] {
            let [a, b] = self.sides_m.map(|s| 0.5 * s);
            [[-a, -b], [a, -b], [a, b], [-a, b]].map(|[y, z]| DVec3::new(0.0, y, z))
        }

        fn amplitude(&self, accuracy: f64) -> Estimate<Vec<Amplitude>> {
            let [transmit, receive] = [self.transmitter_m, self.receiver_m].map(leg);
            self.amplitude_by([&transmit, &receive], Bracket::Plain, accuracy)
        }

        fn amplitude_by(
            &self,
            [transmit, receive]: [&Leg; 2],
            bracket: Bracket,
            accuracy: f64,
        ) -> Estimate<Vec<Amplitude>> {
            let corners_m = &self.corners_m();
            let (normal, bend, material) = (DVec3::X, None, None);
            let node = Node { corners_m, normal, bend, material, transmit, receive, bracket };
            node_amplitudes(&node, DVec3::ZERO, &[WAVENUMBER_PER_M], accuracy)
        }

        /// Formula of the module documentation, point by point.
        fn exact(&self) -> Amplitude {
            let (nodes, weights) = gauss_legendre(self.gauss_points);
            let mut sum = [[Complex64::ZERO; 2]; 2];
            for (u, wu) in nodes.iter().zip(&weights) {
                for (v, wv) in nodes.iter().zip(&weights) {
                    let x = DVec3::new(0.0, 0.5 * self.sides_m[0] * u, 0.5 * self.sides_m[1] * v);
                    let at = self.integrand(x);
                    for (sum, at) in sum.iter_mut().flatten().zip(at.iter().flatten()) {
                        *sum += at * (0.25 * wu * wv * self.sides_m[0] * self.sides_m[1]);
                    }
                }
            }
            sum
        }

        fn integrand(&self, x: DVec3) -> Amplitude {
            let ways = [x - self.transmitter_m, x - self.receiver_m];
            let [l1, l2] = ways.map(DVec3::length);
            let [d1, d2] = [ways[0] / l1, ways[1] / l2];
            let at_origin = self.transmitter_m.length() + self.receiver_m.length();
            let factor = Complex64::new(0.0, WAVENUMBER_PER_M / std::f64::consts::PI.sqrt())
                * Complex64::cis(-WAVENUMBER_PER_M * (l1 + l2 - at_origin))
                * (self.transmitter_m.length() * self.receiver_m.length() / (l1 * l2));
            let fields = |r: DVec3| {
                let h = DVec3::Z.cross(r) / DVec3::Z.cross(r).length();
                [r.cross(h), h]
            };
            let (sent, received) = (fields(-d1), fields(-d2));
            [0, 1].map(|p| [0, 1].map(|q| factor * received[p].dot(d1 * sent[q].x - sent[q] * d1.x)))
        }

        /// Scale √(4π)·area/λ.
        fn scale_m(&self) -> f64 {
            self.sides_m[0] * self.sides_m[1] * WAVENUMBER_PER_M / std::f64::consts::PI.sqrt()
        }
    }

    fn leg(antenna_m: DVec3) -> Leg {
        Leg {
            image: Antenna::Point(antenna_m),
            mirrors: Mirrors::NONE,
            steps: LegSurfaces::default(),
            zenith_h: DVec3::Y,
        }
    }

    #[test]
    fn a_way_that_goes_back_as_it_came_is_two_ways_alike_to_the_bit() {
        for case in HARD_CASES {
            let [there, back] = [leg(case.transmitter_m), leg(case.transmitter_m)];
            for (bracket, accuracy) in [(Bracket::Plain, 1e-2), (Bracket::Symmetrised, 1e-6)] {
                let [one, two] =
                    [&there, &back].map(|back| case.amplitude_by([&there, back], bracket, accuracy));
                assert_eq!(one, two, "{} {bracket:?}", case.name);
            }
        }
    }

    fn distance(a: &Amplitude, b: &Amplitude) -> f64 {
        a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
    }

    #[test]
    fn error_stays_below_the_accuracy_asked_and_below_the_bound_printed_over_ten_decades() {
        for case in HARD_CASES {
            let exact = case.exact();
            for decade in 1..=10 {
                let asked = 10_f64.powi(-decade);
                let got = case.amplitude(asked);
                let error = distance(&got.value[0], &exact) / case.scale_m();
                println!(
                    "{}: asked {asked:.0e}, got {error:.1e}, printed {:.1e}",
                    case.name,
                    got.error / case.scale_m()
                );
                assert!(error <= asked, "{}: asked {asked:e}, got {error:e}", case.name);
                // Gauss–Legendre's own rounding is 1e-13.
                assert!(
                    error <= got.error / case.scale_m() + 1e-13,
                    "{}: {error:e} exceeds {:e}",
                    case.name,
                    got.error
                );
            }
        }
    }
}
