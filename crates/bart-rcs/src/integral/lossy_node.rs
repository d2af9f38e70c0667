//! Node integral with surfaces other than perfect conductors on the path: complex, frequency-dependent
//! weights.
//!
//! It uses Kirchhoff's currents of a surface that reflects e_r of e (Beckmann, Spizzichino 1963;
//! `docs/physics.md` §5) in place of the bracket of [`crate::integral::physical_optics`]:
//!
//! ```text
//! ½{ e_p·[n×(d₁×e + d_r×e_r)] + (d₂×e_p)·[n×(e + e_r)] }
//! ```
//! For a conductor, e + e_r = 2n(n·e), this reduces to the other bracket.

use crate::integral::chebyshev::{self, Chebyshev, middle_and_half};
use crate::integral::field::{Field, SurfacePoint};
use crate::integral::node::{Bracket, Leg};
use crate::integral::physical_optics::weighed;
use crate::integral::tiling::Tile;
use crate::materials::surface_response::{reflected_fields, reflection, turning_length_m};
use artifact::material::Material;
use glam::{DVec2, DVec3};
use num_complex::Complex64;
use radar::complex_vector::ComplexVector;

/// Weights [vv, vh, hv, hh], receiver first.
type Weights = [Complex64; 4];

impl Field<'_> {
    /// Adds a tile like [`Field::add`], with weights at every frequency.
    pub(crate) fn add_lossy(&self, tile: &Tile<'_>, wavenumbers_per_m: &[f64], sums: &mut [Weights]) {
        match tile {
            Tile::Whole { corners_m, centre_m } => {
                self.add_lossy_whole(corners_m, *centre_m, wavenumbers_per_m, sums);
            }
            Tile::Triangle(corners_m) => self.add_lossy_triangle(*corners_m, wavenumbers_per_m, sums),
        }
    }

    fn add_lossy_whole(
        &self,
        corners_m: &[DVec2],
        centre_m: DVec2,
        wavenumbers_per_m: &[f64],
        sums: &mut [Weights],
    ) {
        let whole = self.whole(corners_m, centre_m);
        let weights = self.lossy_weights(&[whole.centre], wavenumbers_per_m);
        whole.for_each_integral(wavenumbers_per_m, &mut |i, integral_m2| {
            let [weights] = weights.at(wavenumbers_per_m[i], i);
            sums[i].iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * integral_m2);
        });
    }

    fn add_lossy_triangle(&self, corners_m: [DVec2; 3], wavenumbers_per_m: &[f64], sums: &mut [Weights]) {
        let six = self.six_points(corners_m);
        let weights = self.lossy_weights(&six.points, wavenumbers_per_m);
        six.for_each_integral(wavenumbers_per_m, &mut |i, integrals_m2| {
            for (integral_m2, weights) in integrals_m2.into_iter().zip(weights.at(wavenumbers_per_m[i], i)) {
                sums[i].iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * integral_m2);
            }
        });
    }

    /// Integrals of the phase times the weights at their points.
    pub(crate) fn weigh_lossy<const N: usize>(
        &self,
        points: &[SurfacePoint; N],
        wavenumbers_per_m: &[f64],
        integrals_m2: &[[Complex64; N]],
        sums: &mut [Weights],
    ) {
        let weights = self.lossy_weights(points, wavenumbers_per_m);
        for (i, (sum, integrals_m2)) in sums.iter_mut().zip(integrals_m2).enumerate() {
            *sum = weighed(&weights.at(wavenumbers_per_m[i], i), integrals_m2);
        }
    }

    /// Weights of several points at every wavenumber, evaluated at few if the materials' phases vary little
    /// over the band.
    ///
    /// Layers rotate the phase by their length; half-spaces are independent of frequency; the road's loss
    /// e^{−g²/2} is below 1 where |Im k| < Re k, so within ρ = k/Δk.
    fn lossy_weights<const N: usize>(
        &self,
        points: &[SurfacePoint; N],
        wavenumbers_per_m: &[f64],
    ) -> BandWeights<N> {
        let of = |k: &f64| points.map(|at| self.lossy_weight(&at, *k));
        let few = middle_and_half(wavenumbers_per_m).and_then(|(middle, half)| {
            let error = (WEIGHTS_ERROR * self.accuracy).max(f64::EPSILON);
            let turn_rad = half * self.turning_length_m();
            let count = chebyshev::points(turn_rad, middle / half, error, wavenumbers_per_m.len());
            count.map(|count| Chebyshev::over(middle, half, count))
        });
        let wavenumbers_per_m = few.as_ref().map_or(wavenumbers_per_m, |few| &few.nodes_per_m);
        BandWeights { samples: wavenumbers_per_m.iter().map(of).collect(), few }
    }

    /// Additional length, m, by which layers on the path rotate the phase with frequency beyond the path
    /// length, including internal echoes that are not negligible.
    pub(crate) fn turning_length_m(&self) -> f64 {
        let own = self.node.material.map_or(0.0, turning_length_m);
        let of = |leg: &Leg| leg.steps.turning_length_m();
        own + of(self.node.transmit) + of(self.node.receive)
    }

    /// Bracket times 1/(L₁L₂), relative to 1/(L₁L₂) at the reference point.
    fn lossy_weight(&self, at: &SurfacePoint, wavenumber_per_m: f64) -> Weights {
        let x_m = at.x_m;
        // Area of the skin per area of the polygon, and its unit normal.
        let size = at.area.length();
        let normal = at.area / size;
        let [transmit, receive] = [self.node.transmit, self.node.receive];
        let [d1, d2] = self.directions(x_m);
        let sent = transmit.arriving_fields(d1, wavenumber_per_m);
        // If both legs are the same, so are their fields and brackets.
        let is_one_way = self.node.is_one_way();
        let received = if is_one_way { sent } else { receive.arriving_fields(d2, wavenumber_per_m) };
        let [spread_there, spread_back] = self.spread(x_m);
        let spread = size * spread_there * spread_back;
        let forth = self.bracket(normal, (d1, sent), (d2, received), wavenumber_per_m);
        match self.node.bracket {
            Bracket::Plain => forth.map(|weight| spread * weight),
            Bracket::Symmetrised => {
                let [vv, vh, hv, hh] = if is_one_way {
                    forth
                } else {
                    self.bracket(normal, (d2, received), (d1, sent), wavenumber_per_m)
                };
                let back = [vv, hv, vh, hh];
                [0, 1, 2, 3].map(|i| 0.5 * spread * (forth[i] + back[i]))
            }
        }
    }

    /// Bracket from one end to the other, each with its direction of travel and its fields: [at the other][at
    /// the one].
    fn bracket(&self, normal: DVec3, from: LegField, to: LegField, wavenumber_per_m: f64) -> Weights {
        const PAIRS: [(usize, usize); 4] = [(0, 0), (0, 1), (1, 0), (1, 1)];
        let Some(material) = self.node.material else {
            let (along, across) = (to.1.map(|e| e.along(from.0)), from.1.map(|e| e.along(normal)));
            let facing = normal.dot(from.0);
            return PAIRS.map(|(p, q)| along[p] * across[q] - to.1[p].dot(from.1[q]) * facing);
        };
        let currents = surface_currents(material, normal, from, wavenumber_per_m);
        PAIRS.map(|(p, q)| currents[q].radiated(to.0, to.1[p]))
    }
}

/// Direction of travel, and the fields for v and h.
type LegField = (DVec3, [ComplexVector; 2]);

/// Share of the requested accuracy: weights are interpolated inside what [`crate::joins::band`] interpolates
/// again.
const WEIGHTS_ERROR: f64 = 1e-3;

/// Weights of N points over a band.
struct BandWeights<const N: usize> {
    samples: Vec<[Weights; N]>,
    /// Points at which they were evaluated; `None` if at every wavenumber.
    few: Option<Chebyshev>,
}

impl<const N: usize> BandWeights<N> {
    /// Weights at a wavenumber, the one at index `place` of those requested.
    fn at(&self, wavenumber_per_m: f64, place: usize) -> [Weights; N] {
        let Some(few) = &self.few else { return self.samples[place] };
        let mut total = [[Complex64::ZERO; 4]; N];
        few.shares(wavenumber_per_m, |i, share| {
            let terms = total.as_flattened_mut().iter_mut().zip(self.samples[i].as_flattened());
            terms.for_each(|(sum, sample)| *sum += share * sample);
        });
        total
    }
}

fn surface_currents(
    material: &Material,
    n: DVec3,
    (travel, e): LegField,
    wavenumber_per_m: f64,
) -> [Current; 2] {
    let r = reflection(material, n.dot(travel).abs(), wavenumber_per_m);
    let reflected = reflected_fields(e, travel, n, r);
    let onwards = travel - 2.0 * n.dot(travel) * n;
    [0, 1].map(|q| {
        let magnetic = e[q].crossed_by(travel) + reflected[q].crossed_by(onwards);
        Current { electric: magnetic.crossed_by(n), magnetic: (e[q] + reflected[q]).crossed_by(n) }
    })
}

/// Tangential fields n×H and n×E on the lit side.
#[derive(Clone, Copy)]
struct Current {
    electric: ComplexVector,
    magnetic: ComplexVector,
}

impl Current {
    fn radiated(self, travel: DVec3, e: ComplexVector) -> Complex64 {
        0.5 * (e.dot(self.electric) + e.crossed_by(travel).dot(self.magnetic))
    }
}
