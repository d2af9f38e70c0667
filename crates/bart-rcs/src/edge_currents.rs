//! The fringe integral along an edge: what an edge scatters beyond physical optics, as the amplitude of a path whose node
//! is a point of the edge.
//!
//! S_pq = ∫ R_tR_r/(L₁L₂)·K_pq e^{−jk(L₁+L₂−R_t−R_r)} dl, K the mean of both directions of travel, ½(K(tx → rx) + K(rx → tx)ᵀ): nature has
//! S(tx, rx) = S(rx, tx)ᵀ, the fringe currents have it at right angles to the edge only (docs/physics.md §4).

use crate::antenna::Antenna;
use crate::end_current::EndCurrent;
use crate::face_end::FaceEnds;
use crate::fringe::{FaceView, Wedge};
use crate::line_integral::{Integrand, add_line_integral};
use crate::physical_optics::{Estimate, Leg, length_difference_m};
use crate::world_edges::EdgeGeometry;
use artifact::paths::Amplitude;
use glam::{DVec2, DVec3};
use num_complex::Complex64;

/// A part of an edge with its two legs.
#[derive(Clone, Copy)]
pub(crate) struct EdgeNode<'a> {
    pub(crate) edge: &'a EdgeGeometry,
    /// Where currents on its two faces end.
    pub(crate) ends_m: [&'a [[DVec3; 2]]; 2],
    pub(crate) span_m: [f64; 2],
    pub(crate) transmit: &'a Leg,
    pub(crate) receive: &'a Leg,
}

/// Amplitudes about `reference_m` at several wavenumbers.
///
/// `accuracy` bounds the error of every element as a fraction of length/√π, the amplitude of an edge that is seen square;
/// `error` is the bound reached, m.
pub(crate) fn edge_amplitudes(
    node: &EdgeNode<'_>,
    reference_m: DVec3,
    wavenumbers_per_m: &[f64],
    accuracy: f64,
) -> Estimate<Vec<Amplitude>> {
    let accuracy = accuracy.max(1e-12);
    let mut sums = vec![[Complex64::ZERO; 4]; wavenumbers_per_m.len()];
    let fringe = Fringe { node, reference_m };
    let mut error_m = add_line_integral(&fringe, node.span_m, wavenumbers_per_m, accuracy, &mut sums);
    for (face, ends_m) in node.ends_m.into_iter().enumerate() {
        let Wedge { along, inward, .. } = node.edge.wedge;
        let ends = FaceEnds::seen_from(node.edge.from_m, along, inward[face], ends_m);
        for way in fringe.ways() {
            let beyond = BeyondEnd { fringe: &fringe, face, ends: &ends, way };
            for span_m in beyond.pieces() {
                error_m += add_line_integral(&beyond, span_m, wavenumbers_per_m, accuracy, &mut sums);
            }
        }
    }
    let per_root_pi = std::f64::consts::FRAC_2_SQRT_PI * 0.5;
    let of = |sum: &[Complex64; 4]| {
        let [vv, vh, hv, hh] = sum.map(|s| s * per_root_pi);
        [[vv, vh], [hv, hh]]
    };
    Estimate { value: sums.iter().map(of).collect(), error: error_m * per_root_pi }
}

/// Fringe currents of both faces, each without end.
struct Fringe<'a> {
    node: &'a EdgeNode<'a>,
    reference_m: DVec3,
}

/// Length from the reference point and √π·K over the spread.
struct Sample {
    length_m: f64,
    weights: [f64; 4],
}

impl Integrand for Fringe<'_> {
    type Sample = Sample;

    fn sample(&self, at_m: f64) -> Sample {
        let x_m = self.node.edge.point_m(at_m);
        let [transmit, receive] = [self.node.transmit, self.node.receive];
        let length_m = [transmit, receive].map(|leg| length_difference_m(leg.image, x_m, self.reference_m));
        let spread: f64 = [transmit, receive].map(|leg| spread(leg.image, x_m, self.reference_m)).iter().product();
        Sample { length_m: length_m[0] + length_m[1], weights: self.kernel(x_m).map(|k| spread * k) }
    }

    fn length_m(sample: &Sample) -> f64 {
        sample.length_m
    }

    fn weights(&self, sample: &Sample, _: f64) -> [Complex64; 4] {
        sample.weights.map(Complex64::from)
    }
}

impl Fringe<'_> {
    /// √π·K: [vv, vh, hv, hh], receiver first.
    fn kernel(&self, x_m: DVec3) -> [f64; 4] {
        let ends = [self.node.transmit, self.node.receive].map(|leg| {
            let travel = leg.image.travel_direction_at(x_m);
            (travel, leg.mirrors.fields_at_node(travel, leg.zenith_h))
        });
        let [forth, back] = [self.one_way(&ends[0], &ends[1]), self.one_way(&ends[1], &ends[0])];
        [forth[0] + back[0], forth[1] + back[2], forth[2] + back[1], forth[3] + back[3]].map(|twice| 0.5 * twice)
    }

    /// From one end to the other: [field received][field sent].
    fn one_way(&self, sent: &(DVec3, [DVec3; 2]), received: &(DVec3, [DVec3; 2])) -> [f64; 4] {
        let (travel, out) = (sent.0, -received.0);
        let Some(faces) = self.node.edge.wedge.faces(travel, out) else { return [0.0; 4] };
        [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(p, q)| {
            let of =
                |face: &crate::fringe::FaceView| face.coefficient(face.incident(travel, sent.1[q]), out, received.1[p]);
            faces.iter().map(of).sum()
        })
    }
}

/// From which end the wave comes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    /// From the transmitter to the receiver.
    Forth,
    /// From the receiver to the transmitter, transposed.
    Back,
    /// One antenna: back is forth, transposed.
    Both,
}

impl Fringe<'_> {
    fn ways(&self) -> impl Iterator<Item = Way> {
        let shared = std::ptr::eq(self.node.transmit, self.node.receive);
        let ways: &[Way] = if shared { &[Way::Both] } else { &[Way::Forth, Way::Back] };
        ways.iter().copied()
    }
}

/// What the currents beyond the ends of a face would add; it is taken away.
struct BeyondEnd<'a> {
    fringe: &'a Fringe<'a>,
    face: usize,
    ends: &'a FaceEnds,
    way: Way,
}

/// The ray along the face to its end, and the currents beyond.
struct Beyond {
    length_m: f64,
    /// Length along the face, current, spread; `None` where the face has no end or the edge is not lit.
    current: Option<(f64, EndCurrent, f64)>,
}

impl BeyondEnd<'_> {
    /// Where the wave comes from, where it goes.
    fn legs(&self) -> [&Leg; 2] {
        let EdgeNode { transmit, receive, .. } = *self.fringe.node;
        if self.way == Way::Back { [receive, transmit] } else { [transmit, receive] }
    }

    /// The face as the wave meets it at a point.
    fn face_at(&self, x_m: DVec3) -> Option<FaceView> {
        let [from, to] = self.legs().map(|leg| leg.image.travel_direction_at(x_m));
        Some(self.fringe.node.edge.wedge.faces(from, -to)?[self.face])
    }

    /// Direction of the wave along the face in the coordinates of its ends.
    fn direction(&self, face: &FaceView) -> DVec2 {
        DVec2::new(face.sin_in, face.along_face().dot(self.fringe.node.edge.wedge.along))
    }

    /// The span between the places where rays along the face change from one end to the next.
    fn pieces(&self) -> Vec<[f64; 2]> {
        let span_m = self.fringe.node.span_m;
        let middle_m = self.fringe.node.edge.point_m(0.5 * (span_m[0] + span_m[1]));
        let Some(face) = self.face_at(middle_m) else { return Vec::new() };
        let mut cuts = vec![span_m[0]];
        cuts.extend(self.ends.changes_m(self.direction(&face), span_m));
        cuts.push(span_m[1]);
        cuts.windows(2).map(|pair| [pair[0], pair[1]]).collect()
    }
}

impl Integrand for BeyondEnd<'_> {
    type Sample = Beyond;

    fn sample(&self, at_m: f64) -> Beyond {
        let (x_m, reference_m) = (self.fringe.node.edge.point_m(at_m), self.fringe.reference_m);
        let [from, to] = self.legs();
        let lit = self.face_at(x_m).map(|face| (self.ends.way_m(at_m, self.direction(&face)), face));
        let Some((way_m, face)) = lit.filter(|(way_m, _)| way_m.is_finite()) else {
            return Beyond { length_m: 0.0, current: None };
        };
        let end_m = x_m + way_m * face.along_face();
        let [travel, back] = [from, to].map(|leg| leg.image.travel_direction_at(x_m));
        let sent = from.mirrors.fields_at_node(travel, from.zenith_h);
        let received = to.mirrors.fields_at_node(back, to.zenith_h);
        let length_m = length_difference_m(from.image, x_m, reference_m)
            + way_m
            + length_difference_m(to.image, end_m, reference_m);
        let spread = spread(from.image, x_m, reference_m) * spread(to.image, end_m, reference_m);
        Beyond { length_m, current: Some((way_m, EndCurrent::new(&face, travel, &sent, &received), spread)) }
    }

    fn length_m(sample: &Beyond) -> f64 {
        sample.length_m
    }

    fn weights(&self, sample: &Beyond, wavenumber_per_m: f64) -> [Complex64; 4] {
        let Some((way_m, current, spread)) = &sample.current else { return [Complex64::ZERO; 4] };
        let [vv, vh, hv, hh] = current.beyond(*way_m, wavenumber_per_m).map(|w| -0.5 * spread * w);
        match self.way {
            Way::Forth => [vv, vh, hv, hh],
            Way::Back => [vv, hv, vh, hh],
            Way::Both => [2.0 * vv, vh + hv, vh + hv, 2.0 * hh],
        }
    }
}

/// L(reference)/L.
fn spread(image: Antenna, x_m: DVec3, reference_m: DVec3) -> f64 {
    match image {
        Antenna::Point(p) => p.distance(reference_m) / p.distance(x_m),
        Antenna::Direction(_) => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::polarization::Mirrors;
    use crate::world::World;
    use artifact::scene::Mesh;
    use std::f64::consts::{PI, TAU};

    /// Lengths in wavelengths: x = 0…3, 2 long along z; the long edges alone.
    #[test]
    fn e3_a_strip_with_its_two_long_edges_has_the_known_amplitude() {
        let vertices_m = vec![[0.0, 0.0, -1.0], [3.0, 0.0, -1.0], [3.0, 0.0, 1.0], [0.0, 0.0, 1.0]];
        let mesh = Mesh { vertices_m, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
        let world = World::of_mesh(&mesh).unwrap();
        let angle: f64 = 0.6;
        let r = DVec3::new(angle.cos(), angle.sin(), 0.0);
        let leg = Leg { image: Antenna::Direction(r), mirrors: Mirrors::NONE, zenith_h: DVec3::Y };
        let mut sum = Amplitude::default();
        let mut long = 0;
        for edge in world.edges().edges.iter().filter(|e| e.wedge.along.z.abs() > 0.5) {
            let node = EdgeNode { edge, ends_m: [&[]; 2], span_m: [0.0, edge.length_m], transmit: &leg, receive: &leg };
            let share = edge_amplitudes(&node, DVec3::ZERO, &[TAU], 1e-10).value[0];
            sum = [0, 1].map(|p| [0, 1].map(|q| sum[p][q] + share[p][q]));
            long += 1;
        }
        assert_eq!(long, 2);
        // j√(4π)·A·cosθ/λ with the phase integral over x; n·r̂ = sin φ.
        let u = 2.0 * TAU * angle.cos();
        let across = (Complex64::cis(3.0 * u) - 1.0) / Complex64::new(0.0, u);
        let optics = Complex64::I * (4.0 * PI).sqrt() * angle.sin() * 2.0 * across;
        let known = [Complex64::new(1.072092, -0.370539), Complex64::new(-1.133765, -0.035457)];
        for p in 0..2 {
            let got = optics + sum[p][p];
            println!("E3: known {}, got {got:.6}", known[p]);
            assert!((got - known[p]).norm() < 1e-5);
        }
        assert!(sum[0][1].norm() < 1e-12);
    }
}
