//! Meetings of both ends on paths of one order: on facets and, if requested, on edges.

use crate::beams::body_sequences::BodySequences;
use crate::edges::edge_scattering::sum_of_edges;
use crate::edges::lit_edge::{EdgeJoint, edge_joints};
use crate::edges::off_specular_sequences::separate_sequences;
use crate::edges::truncation::{Truncation, sum_of_truncations};
use crate::joins::band::add;
use crate::joins::joint::Joints;
use crate::joins::scatterer::{Integration, Scatterer, meets_several_vehicles, scaled, sequence};
use crate::joins::specular_separation::SpecularSeparation;
use crate::table::joint_sum::sum_of_joints;
use artifact::paths::Amplitude;
use artifact::settings::{Edges, NodeRule};
use glam::DVec3;
use num_complex::Complex64;

/// The joints of one order.
pub(crate) struct OrderJoints {
    pub(crate) facets: Joints,
    pub(crate) edges: Vec<EdgeJoint>,
    /// Own edges of the facets of double reflections off their specular direction.
    pub(crate) truncations: Vec<Truncation>,
}

/// Settings that select meetings.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointSettings {
    pub(crate) nodes: NodeRule,
    pub(crate) edges: Edges,
    /// Area below which overlaps of beams are dropped.
    pub(crate) least_area_m2: f64,
    /// Highest requested wavenumber: its band decides which sides are thin.
    pub(crate) wavenumber_per_m: f64,
}

impl OrderJoints {
    pub(crate) fn of(scatterer: &Scatterer<'_>, order: u8, settings: &JointSettings) -> Self {
        let mut facets = scatterer.joints(order, settings.nodes, settings.least_area_m2);
        let truncations = if order == 2 && settings.follows_ends() {
            separate_sequences(scatterer, &mut facets, settings.wavenumber_per_m)
        } else {
            Vec::new()
        };
        Self { facets, edges: edge_meetings(scatterer, order, settings), truncations }
    }

    /// Part of the meeting on edges.
    pub(crate) fn without_facets(self) -> Self {
        Self { facets: Joints::default(), ..self }
    }

    /// Part of the meeting with its node on one body.
    pub(crate) fn on_body(&self, scatterer: &Scatterer<'_>, body: usize) -> Self {
        self.filtered(|forward, _| scatterer.node_body(forward) == body)
    }

    /// Part of the meeting whose paths meet more than one vehicle.
    pub(crate) fn between_vehicles(&self, scatterer: &Scatterer<'_>) -> Self {
        self.filtered(|forward, backward| meets_several_vehicles(scatterer, forward, backward))
    }

    /// Part of the meeting selected by the beams of both ends.
    fn filtered(&self, is_meant: impl Fn(u32, u32) -> bool) -> Self {
        let edges = self.edges.iter().filter(|joint| is_meant(joint.forward, joint.backward));
        let ends = self.truncations.iter().filter(|end| is_meant(end.forward, end.backward));
        Self {
            facets: self.facets.filtered(|joint| is_meant(joint.forward, joint.backward)),
            edges: edges.copied().collect(),
            truncations: ends.cloned().collect(),
        }
    }

    /// Number of scattering polygons, edges and ends.
    pub(crate) fn count(&self) -> usize {
        self.facets.list.len() + self.edges()
    }

    /// Number of scattering edges and ends.
    pub(crate) fn edges(&self) -> usize {
        self.edges.len() + self.truncations.len()
    }

    /// Part of the meeting on some sequences of bodies.
    pub(crate) fn along(&self, scatterer: &Scatterer<'_>, ways: &BodySequences) -> Self {
        let body = |facet: u32| scatterer.world.facet(facet).id.body;
        self.filtered(|forward, backward| {
            let bodies: Vec<u32> = sequence(scatterer, forward, backward).into_iter().map(body).collect();
            ways.contains(&bodies)
        })
    }

    /// S over frequency, 2 × 2, with its phase referred to `origin_m`.
    pub(crate) fn sum(
        &self,
        scatterer: &Scatterer<'_>,
        origin_m: DVec3,
        integration: &Integration<'_>,
    ) -> Vec<Amplitude> {
        let [mut total, edges] = self.sums(scatterer, origin_m, integration);
        add(&mut total, &edges);
        total
    }

    /// Sums of facets and of edges, the latter including own edges of double reflections, each as in
    /// [`Self::sum`].
    pub(crate) fn sums(
        &self,
        scatterer: &Scatterer<'_>,
        origin_m: DVec3,
        integration: &Integration<'_>,
    ) -> [Vec<Amplitude>; 2] {
        let facets = sum_of_joints(scatterer, &self.facets, origin_m, integration);
        let mut edges = sum_of_edges(scatterer, &self.edges, origin_m, integration);
        if !self.truncations.is_empty() {
            add(&mut edges, &sum_of_truncations(scatterer, &self.truncations, origin_m, integration));
        }
        [facets, edges]
    }
}

impl JointSettings {
    /// Whether double reflections off their specular direction are evaluated at the own edges of their
    /// facets.
    fn follows_ends(&self) -> bool {
        self.edges == Edges::FirstOrder && self.nodes == NodeRule::OwnEdge
    }

    /// Meetings on edges alone, as in [`OrderJoints::of`].
    pub(crate) fn on_edges(&self, scatterer: &Scatterer<'_>, order: u8) -> OrderJoints {
        if order == 2 && self.follows_ends() {
            return OrderJoints::of(scatterer, order, self).without_facets();
        }
        let edges = edge_meetings(scatterer, order, self);
        OrderJoints { facets: Joints::default(), edges, truncations: Vec::new() }
    }

    /// Meeting on paths of `order` for [`OrderJoints::change_by_edges`].
    pub(crate) fn changed_by_edges(&self, scatterer: &Scatterer<'_>, order: u8) -> OrderJoints {
        match order {
            2 if self.follows_ends() => OrderJoints::of(scatterer, order, self),
            _ => self.on_edges(scatterer, order),
        }
    }
}

/// Powers |S|² of the change by edges where they are omitted, m².
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LeftOutEdges {
    /// Power of all orders together.
    pub(crate) power: f64,
    /// Power of the ends of double reflections, less the loss of their polygons to them.
    pub(crate) ends_power: f64,
}

impl OrderJoints {
    /// Change of S by edges over frequency: by their fringes, and by the ends of double reflections.
    pub(crate) fn change_by_edges(
        &self,
        scatterer: &Scatterer<'_>,
        integration: &Integration<'_>,
    ) -> [Vec<Amplitude>; 2] {
        let fringes = sum_of_edges(scatterer, &self.edges, DVec3::ZERO, integration);
        [fringes, self.ends_less_polygons(scatterer, integration)]
    }

    /// Ends at own edges, less the loss of polygons to them.
    fn ends_less_polygons(&self, scatterer: &Scatterer<'_>, integration: &Integration<'_>) -> Vec<Amplitude> {
        let sum = |joints: &Joints| sum_of_joints(scatterer, joints, DVec3::ZERO, integration);
        let parted = self.facets.filtered(|joint| joint.separation.clear > 0.0);
        let mut whole = parted.filtered(|_| true);
        whole.list.iter_mut().for_each(|joint| joint.separation = SpecularSeparation::NONE);
        let mut ends = sum_of_truncations(scatterer, &self.truncations, DVec3::ZERO, integration);
        add(&mut ends, &sum(&parted));
        let lost: Vec<Amplitude> = sum(&whole).iter().map(|s| scaled(s, Complex64::from(-1.0))).collect();
        add(&mut ends, &lost);
        ends
    }
}

/// Meetings of both ends on edges on paths of `order`; empty if edges are ignored.
fn edge_meetings(scatterer: &Scatterer<'_>, order: u8, settings: &JointSettings) -> Vec<EdgeJoint> {
    let world = scatterer.world;
    match settings.edges {
        Edges::FirstOrder => {
            edge_joints(world, world.edges(settings.wavenumber_per_m), scatterer.trees, order)
        }
        Edges::Ignored => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::beam::{BeamTree, TraceSettings};
    use crate::bodies::world::World;
    use crate::geometry::antenna::Antenna;
    use crate::integral::node::Bracket;
    use crate::integral::polarization::zenith_h;
    use crate::joins::joint::Trees;
    use crate::joins::scatterer::ZenithH;
    use artifact::scene::Mesh;
    use artifact::settings::Sides;
    use artifact::units::SPEED_OF_LIGHT_MPS;
    use po_sbr::{Aspect, iterative_po};
    use radar::standpoint::Standpoint;
    use std::f64::consts::TAU;

    const FREQUENCY_HZ: f64 = 77e9;
    const WAVELENGTH_M: f64 = SPEED_OF_LIGHT_MPS / FREQUENCY_HZ;

    /// Two rectangles sharing an edge on the z axis, `angle_deg` apart, with their bisector along x; sides
    /// and height in wavelengths.
    fn dihedral(angle_deg: f64, sides: [f64; 2], height: f64) -> Mesh {
        let half = 0.5 * height * WAVELENGTH_M;
        let mut mesh = Mesh::default();
        for (sign, side) in [(1.0, sides[0]), (-1.0, sides[1])] {
            let (sin, cos) = (sign * 0.5 * angle_deg).to_radians().sin_cos();
            let far = |z: f64| [side * WAVELENGTH_M * cos, side * WAVELENGTH_M * sin, z];
            let first = mesh.vertices_m.len() as u32;
            mesh.vertices_m.extend([[0.0, 0.0, -half], far(-half), far(half), [0.0, 0.0, half]]);
            mesh.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|i: u32| first + i)));
        }
        mesh
    }

    fn standpoint(az_deg: f64, el_deg: f64) -> Standpoint {
        let (azimuth_rad, elevation_rad) = (az_deg.to_radians(), el_deg.to_radians());
        Standpoint { azimuth_rad, elevation_rad, range_m: f64::INFINITY }
    }

    fn antenna(at: Standpoint) -> Antenna {
        let direction = at.direction();
        if at.range_m.is_finite() {
            Antenna::Point(at.range_m * direction)
        } else {
            Antenna::Direction(direction)
        }
    }

    /// S of the double reflection alone, without fringes: complete, and by its polygons alone.
    fn double_reflection(mesh: &Mesh, at: [Standpoint; 2]) -> [Amplitude; 2] {
        let world = World::of_mesh(mesh).unwrap();
        let settings = TraceSettings {
            max_order: 2,
            sides: Sides::Two,
            least_area_m2: 1e-12,
            least_mirror_area_m2: 1e-12,
        };
        let trees = at.map(|at| BeamTree::trace(&world, antenna(at), &settings).unwrap());
        let trees =
            if at[0] == at[1] { Trees::Shared(&trees[0]) } else { Trees::Apart(&trees[0], &trees[1]) };
        let [transmit, receive] = at.map(|at| zenith_h(at.azimuth_rad));
        let scatterer = Scatterer::new(&world, trees, ZenithH { transmit, receive });
        let wavenumbers_per_m = &[TAU / WAVELENGTH_M];
        let integration = Integration { wavenumbers_per_m, accuracy: 1e-6, bracket: Bracket::Symmetrised };
        [Edges::FirstOrder, Edges::Ignored].map(|edges| {
            let wavenumber_per_m = wavenumbers_per_m[0];
            let what =
                JointSettings { nodes: NodeRule::OwnEdge, edges, least_area_m2: 1e-12, wavenumber_per_m };
            let meeting = OrderJoints { edges: Vec::new(), ..OrderJoints::of(&scatterer, 2, &what) };
            meeting.sum(&scatterer, DVec3::ZERO, &integration)[0]
        })
    }

    /// Mean of iterated physical optics in both directions, the best that a reciprocal rule can achieve.
    fn iterated_mean(mesh: &Mesh, at: [Standpoint; 2], per_wavelength: f64) -> Amplitude {
        let one_way = |transmitter: Standpoint, receiver: Standpoint| {
            let aspect = Aspect { transmitter, receiver };
            iterative_po::double_bounce(mesh, &aspect, FREQUENCY_HZ, per_wavelength).unwrap()
        };
        let forth = one_way(at[0], at[1]);
        let back = if at[0] == at[1] { forth } else { one_way(at[1], at[0]) };
        [0, 1].map(|p| [0, 1].map(|q| 0.5 * (forth[p][q] + back[q][p])))
    }

    /// Error over field, dB, for vv and hh over several aspects.
    fn errors_db(got: &[Amplitude], asked: &[Amplitude]) -> [f64; 2] {
        [0, 1].map(|p| {
            let pairs = || got.iter().zip(asked).map(|(g, a)| (g[p][p], a[p][p]));
            let error: f64 = pairs().map(|(g, a)| (g - a).norm_sqr()).sum();
            10.0 * (error / pairs().map(|(_, a)| a.norm_sqr()).sum::<f64>()).log10()
        })
    }

    /// Errors of the complete result and of polygons alone.
    fn both_errors_db(mesh: &Mesh, seen: &[[Standpoint; 2]]) -> [[f64; 2]; 2] {
        let got: Vec<_> = seen.iter().map(|at| double_reflection(mesh, *at)).collect();
        let asked: Vec<_> = seen.iter().map(|at| iterated_mean(mesh, *at, 4.0)).collect();
        [0, 1].map(|i| errors_db(&got.iter().map(|g| g[i]).collect::<Vec<_>>(), &asked))
    }

    #[test]
    fn double_reflections_off_their_specular_are_those_of_iterated_physical_optics() {
        // The remainder is diffracted at two edges (corners), more of it the smaller the body.
        let bodies = [
            ("4 by 4, 90°", dihedral(90.0, [4.0, 4.0], 4.0), [-12.5, -13.5]),
            ("3 by 5, 80°", dihedral(80.0, [3.0, 5.0], 4.0), [-17.0, -16.0]),
            ("4 by 4, 100°", dihedral(100.0, [4.0, 4.0], 3.5), [-15.0, -7.0]),
        ];
        for (name, mesh, limits_db) in &bodies {
            for (el_deg, limit_db) in [0.0, 12.0].into_iter().zip(limits_db) {
                let seen: Vec<_> =
                    (0..5).map(|i| [standpoint(7.0 * f64::from(i) - 2.0, el_deg); 2]).collect();
                let [full, polygons] = both_errors_db(mesh, &seen);
                println!(
                    "{name}, el {el_deg}: asked {limit_db}, got {full:.1?} dB, by polygons {polygons:.1?}"
                );
                assert!((0..2).all(|p| full[p] < *limit_db && full[p] < polygons[p] + 0.1));
            }
        }
    }

    #[test]
    fn near_by_a_double_reflection_keeps_its_specular_and_has_its_ends_off_it() {
        let mesh = dihedral(90.0, [8.0, 8.0], 8.0);
        for (el_deg, limit_db) in [(0.0, -15.0), (15.0, -13.0)] {
            let near = |i: i32| Standpoint { range_m: 0.25, ..standpoint(11.0 * f64::from(i) - 4.0, el_deg) };
            let seen: Vec<_> = (0..3).map(|i| [near(i); 2]).collect();
            let [full, polygons] = both_errors_db(&mesh, &seen);
            println!("el {el_deg}: asked {limit_db}, got {full:.1?} dB, by polygons {polygons:.1?}");
            assert!((0..2).all(|p| full[p] < limit_db && full[p] < polygons[p] + 0.1));
        }
    }

    #[test]
    fn with_ends_a_double_reflection_is_reciprocal_and_has_no_jumps() {
        let mesh = dihedral(84.0, [6.0, 9.0], 7.0);
        let (near, other) = (standpoint(7.0, 11.0), standpoint(-12.0, 3.0));
        let [forth, _] = double_reflection(&mesh, [near, other]);
        let [back, polygons] = double_reflection(&mesh, [other, near]);
        let largest = forth.as_flattened().iter().map(|s| s.norm()).fold(0.0, f64::max);
        for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            // Integrals along edges have the requested accuracy, 1e-6 of the edge.
            assert!((forth[p][q] - back[q][p]).norm() < 1e-4 * largest, "{forth:?} {back:?}");
        }
        assert!((back[0][0] - polygons[0][0]).norm() > 0.1 * largest, "ends are asked here");
        let steps = (0..60).map(|i| {
            let at = standpoint(-44.0 + 1.5 * f64::from(i), 11.0);
            let beside = Standpoint { azimuth_rad: at.azimuth_rad + 1e-8, ..at };
            let [[one, _], [next, _]] = [at, beside].map(|at| double_reflection(&mesh, [at; 2]));
            (one[0][0] - next[0][0]).norm()
        });
        let largest_step = steps.fold(0.0, f64::max);
        println!("largest step over 1e-8 rad: {largest_step:.1e} of {largest:.1e}");
        assert!(largest_step < 1e-4 * largest);
    }

    #[test]
    fn ends_of_a_double_reflection_do_not_depend_on_the_tessellation() {
        let coarse = dihedral(86.0, [6.0, 9.0], 7.0);
        let mut fine = Mesh { vertices_m: coarse.vertices_m.clone(), ..Mesh::default() };
        for [a, b, c] in coarse.triangles.iter().copied() {
            let place = |i: u32| DVec3::from_array(coarse.vertices_m[i as usize]);
            let first = fine.vertices_m.len() as u32;
            let middles = [(a, b), (b, c), (c, a)].map(|(p, q)| (0.5 * (place(p) + place(q))).to_array());
            fine.vertices_m.extend(middles);
            let [ab, bc, ca] = [0, 1, 2].map(|i| first + i);
            fine.triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        for (az_deg, el_deg) in [(3.0, 0.0), (-20.0, 9.0), (31.0, 27.0)] {
            let at = [standpoint(az_deg, el_deg); 2];
            let [[one, _], [other, _]] = [&coarse, &fine].map(|mesh| double_reflection(mesh, at));
            let difference = (one[0][0] - other[0][0]).norm() / one[0][0].norm();
            println!("az {az_deg}, el {el_deg}: {difference:.1e} of {:.1e}", one[0][0].norm());
            assert!(difference < 1e-4);
        }
    }
}
