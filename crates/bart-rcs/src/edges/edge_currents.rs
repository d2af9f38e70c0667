//! Fringe integral along an edge: scattering of an edge beyond physical optics, as the amplitude of a path
//! whose node is a point of the edge.
//!
//! It has two parts: the fringe currents on both faces taken as unbounded, and the effects at the ends of the
//! faces, where these currents stop and excite others ([`crate::edges::face_waves`]).
//!
//! S_pq = ∫ R_tR_r/(L₁L₂)·K_pq e^{−jk(L₁+L₂−R_t−R_r)} dl, K the mean over both directions of travel, ½(K(tx →
//! rx) + K(rx → tx)ᵀ): physically S(tx, rx) = S(rx, tx)ᵀ, which the fringe currents satisfy only at right
//! angles to the edge (docs/physics.md §4).

use crate::edges::edge_node::{EdgeNode, EdgePart, PER_ROOT_PI, amplitude_of, spread};
use crate::edges::face_waves;
use crate::edges::fields_over_surfaces::{over_surfaces, turning_length_m};
use crate::edges::line_integral::{Integrand, for_each_piece};
use crate::integral::field::length_difference_m;
use crate::integral::node::Estimate;
use artifact::paths::Amplitude;
use glam::DVec3;
use num_complex::Complex64;

/// Amplitudes referred to `reference_m` at several wavenumbers.
///
/// `accuracy` bounds the error of every element as a fraction of length/√π, the amplitude of an edge at
/// normal incidence; `error` is the bound reached, m.
pub(crate) fn edge_amplitudes(
    node: &EdgeNode<'_>,
    reference_m: DVec3,
    wavenumbers_per_m: &[f64],
    accuracy: f64,
) -> Estimate<Vec<Amplitude>> {
    let highest = wavenumbers_per_m.iter().copied().fold(0.0, f64::max);
    let mut sums = vec![[Complex64::ZERO; 4]; wavenumbers_per_m.len()];
    let mut error_m = 0.0;
    for_each_part(node, reference_m, highest, accuracy, &mut |part, error| {
        error_m += error;
        part.add_to(wavenumbers_per_m, &mut sums);
    });
    Estimate { value: sums.iter().map(amplitude_of).collect(), error: error_m * PER_ROOT_PI }
}

/// Calls `give` with the parts of an edge's integrals, divided for `highest_per_m`, and an error bound for
/// each, √π·m: their sum is [`edge_amplitudes`].
pub(crate) fn for_each_part(
    node: &EdgeNode<'_>,
    reference_m: DVec3,
    highest_per_m: f64,
    accuracy: f64,
    give: &mut dyn FnMut(&dyn EdgePart, f64),
) {
    let accuracy = accuracy.max(1e-12);
    let fringe = Fringe { node, reference_m };
    for_each_piece(&fringe, node.span_m, highest_per_m, accuracy, &mut |piece, error| give(piece, error));
    face_waves::for_each_part(node, reference_m, highest_per_m, accuracy, give);
}

/// Fringe currents on both faces, taken as unbounded.
struct Fringe<'a> {
    node: &'a EdgeNode<'a>,
    reference_m: DVec3,
}

/// Length from the reference point, √π·K over the spread for fields over perfect mirrors, and directions of
/// travel.
#[derive(Clone, Copy)]
struct FringeSample {
    length_m: f64,
    weights: [f64; 4],
    travel: [DVec3; 2],
}

impl Integrand for Fringe<'_> {
    type Sample = FringeSample;

    fn sample(&self, at_m: f64) -> FringeSample {
        let x_m = self.node.edge.point_m(at_m);
        let length_m = self.node.legs().map(|leg| length_difference_m(leg.image, x_m, self.reference_m));
        let spread: f64 =
            self.node.legs().map(|leg| spread(leg.image, x_m, self.reference_m)).iter().product();
        FringeSample {
            length_m: length_m[0] + length_m[1],
            weights: self.kernel(x_m).map(|k| spread * k),
            travel: self.node.legs().map(|leg| leg.image.travel_direction_at(x_m)),
        }
    }

    fn length_m(sample: &FringeSample) -> f64 {
        sample.length_m
    }

    fn weights(&self, sample: &FringeSample, wavenumber_per_m: f64) -> [Complex64; 4] {
        let weights = sample.weights.map(Complex64::from);
        over_surfaces(weights, self.node.legs(), sample.travel, wavenumber_per_m)
    }

    fn turning_m(&self) -> f64 {
        turning_length_m(self.node.legs())
    }
}

impl Fringe<'_> {
    /// Kernel √π·K for the fields over perfect mirrors: [vv, vh, hv, hh], receiver first.
    fn kernel(&self, x_m: DVec3) -> [f64; 4] {
        let ends = self.node.legs().map(|leg| {
            let travel = leg.image.travel_direction_at(x_m);
            (travel, leg.mirrors.fields_at_node(travel, leg.zenith_h))
        });
        let forth = self.one_way(&ends[0], &ends[1]);
        let back = if self.node.has_one_leg() { forth } else { self.one_way(&ends[1], &ends[0]) };
        [forth[0] + back[0], forth[1] + back[2], forth[2] + back[1], forth[3] + back[3]]
            .map(|twice| 0.5 * twice)
    }

    /// Received field per transmitted field in one direction of travel: [field received][field sent].
    fn one_way(&self, sent: &(DVec3, [DVec3; 2]), received: &(DVec3, [DVec3; 2])) -> [f64; 4] {
        let (travel, out) = (sent.0, -received.0);
        let Some(faces) = self.node.edge.wedge.faces(travel, out) else { return [0.0; 4] };
        let [one, other] = faces.map(|face| {
            let incident = sent.1.map(|field| face.incident(travel, field));
            face.coefficients(incident, out, received.1)
        });
        [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(p, q)| one[p][q] + other[p][q])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::world::World;
    use crate::edges::line_integral::add_line_integral;
    use crate::geometry::antenna::Antenna;
    use crate::integral::leg_surfaces::LegSurfaces;
    use crate::integral::node::Leg;
    use crate::integral::polarization::Mirrors;
    use crate::joins::scatterer::EdgeWaves;
    use artifact::scene::Mesh;
    use std::f64::consts::{PI, TAU};

    /// Lengths in wavelengths: x = 0…3, 2 long along z; only the long edges, with unbounded currents.
    #[test]
    fn e3_a_strip_with_its_two_long_edges_has_the_known_amplitude() {
        let vertices_m = vec![[0.0, 0.0, -1.0], [3.0, 0.0, -1.0], [3.0, 0.0, 1.0], [0.0, 0.0, 1.0]];
        let mesh = Mesh { vertices_m, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
        let world = World::of_mesh(&mesh).unwrap();
        let angle: f64 = 0.6;
        let r = DVec3::new(angle.cos(), angle.sin(), 0.0);
        let leg = Leg {
            image: Antenna::Direction(r),
            mirrors: Mirrors::NONE,
            steps: LegSurfaces::default(),
            zenith_h: DVec3::Y,
        };
        let mut sum = [Complex64::ZERO; 4];
        let mut long = 0;
        for edge in world.edges(TAU).edges.iter().filter(|e| e.wedge.along.z.abs() > 0.5) {
            let node = EdgeNode {
                edge,
                edges: world.edges(TAU),
                span_m: [0.0, edge.length_m],
                transmit: &leg,
                receive: &leg,
                waves: EdgeWaves::OverFaces,
            };
            let mut share = [[Complex64::ZERO; 4]];
            add_line_integral(
                &Fringe { node: &node, reference_m: DVec3::ZERO },
                node.span_m,
                &[TAU],
                1e-10,
                &mut share,
            );
            sum.iter_mut().zip(share[0]).for_each(|(sum, s)| *sum += s / PI.sqrt());
            long += 1;
        }
        assert_eq!(long, 2);
        // j√(4π)·A·cosθ/λ with the phase integral over x; n·r̂ = sin φ.
        let u = 2.0 * TAU * angle.cos();
        let across = (Complex64::cis(3.0 * u) - 1.0) / Complex64::new(0.0, u);
        let optics = Complex64::I * (4.0 * PI).sqrt() * angle.sin() * 2.0 * across;
        let known = [Complex64::new(1.072092, -0.370539), Complex64::new(-1.133765, -0.035457)];
        for p in 0..2 {
            let got = optics + sum[3 * p];
            println!("E3: known {}, got {got:.6}", known[p]);
            assert!((got - known[p]).norm() < 1e-5);
        }
        assert!(sum[1].norm() < 1e-12);
    }
}
