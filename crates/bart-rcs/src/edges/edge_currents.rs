//! The fringe integral along an edge: what an edge scatters beyond physical optics, as the amplitude of a
//! path whose node is a point of the edge.
//!
//! Three parts: the fringe currents of both faces without end; less what of them lies beyond the end of each
//! face; plus, where that end is an edge, what the wave that arrives along the face gives rise to there
//! (second order; for H ∥ only, the wave of E ∥ vanishes on the face).
//!
//! S_pq = ∫ R_tR_r/(L₁L₂)·K_pq e^{−jk(L₁+L₂−R_t−R_r)} dl, K the mean of both directions of travel, ½(K(tx →
//! rx) + K(rx → tx)ᵀ): nature has S(tx, rx) = S(rx, tx)ᵀ, the fringe currents have it at right angles to the
//! edge only (docs/physics.md §4).

use crate::edges::end_current::EndCurrent;
use crate::edges::fringe::FaceView;
use crate::edges::line_integral::{Integrand, Piece, for_each_piece};
use crate::geometry::antenna::Antenna;
use crate::integral::field::length_difference_m;
use crate::integral::node::{Estimate, Leg};
use crate::joins::scatterer::Way;
use crate::mesh::wedges::face_end::{FaceEnds, Met};
use crate::mesh::wedges::wedge::Wedge;
use crate::mesh::wedges::world_edges::{EdgeGeometry, WorldEdges};
use artifact::paths::Amplitude;
use glam::{DVec2, DVec3};
use num_complex::Complex64;

/// A part of an edge with its two legs.
#[derive(Clone, Copy)]
pub(crate) struct EdgeNode<'a> {
    pub(crate) edge: &'a EdgeGeometry,
    /// Edges of the world, which its faces end at.
    pub(crate) edges: &'a WorldEdges,
    pub(crate) span_m: [f64; 2],
    pub(crate) transmit: &'a Leg,
    pub(crate) receive: &'a Leg,
}

impl EdgeNode<'_> {
    /// The reference point of its amplitudes.
    pub(crate) fn middle_m(&self) -> DVec3 {
        self.edge.point_m(0.5 * (self.span_m[0] + self.span_m[1]))
    }

    fn legs(&self) -> [&Leg; 2] {
        [self.transmit, self.receive]
    }

    /// Whether the way back is the way there.
    fn has_one_leg(&self) -> bool {
        std::ptr::eq(self.transmit, self.receive)
    }
}

/// Amplitudes about `reference_m` at several wavenumbers.
///
/// `accuracy` bounds the error of every element as a fraction of length/√π, the amplitude of an edge that is
/// seen square; `error` is the bound reached, m.
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

/// Calls `give` with the parts of an edge's integrals, cut for `highest_per_m`, and a bound of the error of
/// each, √π·m: together they are [`edge_amplitudes`].
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
    for face in 0..2 {
        let Wedge { along, inward, .. } = node.edge.wedge;
        let ends_of_face = node.edges.ends_of_face(node.edge, face);
        let ends = FaceEnds::seen_from(node.edge.from_m, along, inward[face], ends_of_face);
        for sense in fringe.senses() {
            let beyond = BeyondEnd { fringe: &fringe, face, ends: &ends, sense };
            for span_m in beyond.pieces() {
                for_each_piece(&beyond, span_m, highest_per_m, accuracy, &mut |piece, error| {
                    give(piece, error)
                });
            }
        }
    }
}

/// A part of an edge's integrals.
pub(crate) trait EdgePart {
    /// Length L₁ + L₂ of its middle, less that of the reference point.
    fn way(&self) -> Way;
    /// Adds √π·S without the way of the reference point: [vv, vh, hv, hh].
    fn add_to(&self, wavenumbers_per_m: &[f64], sums: &mut [[Complex64; 4]]);
}

impl<I: Integrand> EdgePart for Piece<'_, I> {
    fn way(&self) -> Way {
        Way { length_m: self.length_m(), extent_m: self.extent_m() }
    }

    fn add_to(&self, wavenumbers_per_m: &[f64], sums: &mut [[Complex64; 4]]) {
        Piece::add_to(self, wavenumbers_per_m, sums);
    }
}

/// Factor 1/√π.
pub(crate) const PER_ROOT_PI: f64 = std::f64::consts::FRAC_2_SQRT_PI * 0.5;

/// Amplitude of the sum that [`EdgePart::add_to`] adds to.
pub(crate) fn amplitude_of(sum: &[Complex64; 4]) -> Amplitude {
    let [vv, vh, hv, hh] = sum.map(|s| s * PER_ROOT_PI);
    [[vv, vh], [hv, hh]]
}

/// Fringe currents of both faces, each without end.
struct Fringe<'a> {
    node: &'a EdgeNode<'a>,
    reference_m: DVec3,
}

/// Length from the reference point and √π·K over the spread.
#[derive(Clone, Copy)]
struct Sample {
    length_m: f64,
    weights: [f64; 4],
}

impl Integrand for Fringe<'_> {
    type Sample = Sample;

    fn sample(&self, at_m: f64) -> Sample {
        let x_m = self.node.edge.point_m(at_m);
        let length_m = self.node.legs().map(|leg| length_difference_m(leg.image, x_m, self.reference_m));
        let spread: f64 =
            self.node.legs().map(|leg| spread(leg.image, x_m, self.reference_m)).iter().product();
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
    /// Kernel √π·K: [vv, vh, hv, hh], receiver first.
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

    /// Field received for the field sent, from one end to the other: [field received][field sent].
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

/// Direction of travel along a way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sense {
    /// The wave runs from the transmitter to the receiver.
    Forth,
    /// The wave runs from the receiver to the transmitter, transposed.
    Back,
    /// Both directions with one antenna: back is forth, transposed.
    Both,
}

impl Fringe<'_> {
    fn senses(&self) -> impl Iterator<Item = Sense> {
        let senses: &[Sense] =
            if self.node.has_one_leg() { &[Sense::Both] } else { &[Sense::Forth, Sense::Back] };
        senses.iter().copied()
    }
}

/// Amplitude of the currents beyond the ends of a face; it is taken away.
struct BeyondEnd<'a> {
    fringe: &'a Fringe<'a>,
    face: usize,
    ends: &'a FaceEnds,
    sense: Sense,
}

/// The ray along the face to its end, and the currents beyond.
#[derive(Clone)]
struct Beyond {
    length_m: f64,
    /// Edge wave at the end; `None` where the face has no end or the edge is not lit.
    current: Option<AtEnd>,
}

/// The edge wave at the end of a face.
#[derive(Clone)]
struct AtEnd {
    way_m: f64,
    current: EndCurrent,
    spread: f64,
    /// Kernel √π·K of the edge there for a current along the ray of one, by what is received.
    next: [f64; 2],
}

impl BeyondEnd<'_> {
    /// Legs of the wave: where it comes from and where it goes.
    fn legs(&self) -> [&Leg; 2] {
        let EdgeNode { transmit, receive, .. } = *self.fringe.node;
        if self.sense == Sense::Back { [receive, transmit] } else { [transmit, receive] }
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

    /// Kernel √π·K of the edge where the face ends, for a wave that arrives along the face with a current
    /// of one, per length of the first edge; by what is received.
    ///
    /// A wave that grazes a conductor has the current 2H: E = ½J·n. Its own current up to the edge is there
    /// already, so the fringe of grazing incidence is what the edge adds.
    fn next_edge(&self, edge: u32, face: &FaceView, to: &Leg, end_m: DVec3) -> [f64; 2] {
        let wedge = &self.fringe.node.edges.edges[edge as usize].wedge;
        let (travel, back) = (face.along_face(), to.image.travel_direction_at(end_m));
        let Some(faces) = wedge.faces_from_face(travel, face.normal, -back) else { return [0.0; 2] };
        let width = face.sin_in / travel.cross(wedge.along).length();
        let received = to.mirrors.fields_at_node(back, to.zenith_h);
        let [one, other] =
            faces.map(|f| f.coefficients([f.incident(travel, 0.5 * face.normal)], -back, received));
        [0, 1].map(|p| width * (one[p][0] + other[p][0]))
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
        let met = |face: FaceView| Some((self.ends.nearest(at_m, self.direction(&face))?, face));
        let Some((Met { way_m, edge }, face)) = self.face_at(x_m).and_then(met) else {
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
        let current = EndCurrent::new(&face, travel, &sent, &received);
        let next = edge.map_or([0.0; 2], |edge| self.next_edge(edge, &face, to, end_m));
        Beyond { length_m, current: Some(AtEnd { way_m, current, spread, next }) }
    }

    fn length_m(sample: &Beyond) -> f64 {
        sample.length_m
    }

    fn weights(&self, sample: &Beyond, wavenumber_per_m: f64) -> [Complex64; 4] {
        let Some(AtEnd { way_m, current, spread, next }) = &sample.current else {
            return [Complex64::ZERO; 4];
        };
        let (beyond, falloff) = current.beyond(*way_m, wavenumber_per_m);
        let second = |p: usize, q: usize| next[p] * current.along_ray[q] * falloff;
        let [vv, vh, hv, hh] =
            [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(p, q)| 0.5 * spread * (second(p, q) - beyond[2 * p + q]));
        match self.sense {
            Sense::Forth => [vv, vh, hv, hh],
            Sense::Back => [vv, hv, vh, hh],
            Sense::Both => [2.0 * vv, vh + hv, vh + hv, 2.0 * hh],
        }
    }
}

/// Ratio L(reference)/L.
fn spread(image: Antenna, x_m: DVec3, reference_m: DVec3) -> f64 {
    match image {
        Antenna::Point(p) => p.distance(reference_m) / p.distance(x_m),
        Antenna::Direction(_) => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::world::World;
    use crate::edges::line_integral::add_line_integral;
    use crate::integral::polarization::Mirrors;
    use crate::integral::steps::Steps;
    use artifact::scene::Mesh;
    use std::f64::consts::{PI, TAU};

    /// Lengths in wavelengths: x = 0…3, 2 long along z; the long edges alone, their currents without end.
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
            steps: Steps::default(),
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
