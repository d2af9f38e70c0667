//! Contributions of facets and edges: one aspect's scattering by facet sequence, with the points met by its
//! rays.

use crate::beams::beam::{Beam, BeamTree};
use crate::bodies::world::World;
use crate::edges::edge_scattering::edge_share;
use crate::edges::lit_edge::EdgeJoint;
use crate::edges::truncation::{Truncation, truncation_share};
use crate::geometry::antenna::Antenna;
use crate::geometry::facet_geometry::FacetGeometry;
use crate::joins::affordable_accuracy::affordable_accuracy;
use crate::joins::joint::{Joint, Joints, Trees};
use crate::joins::scatterer::{Integration, Scatterer, ZenithH, bracket_of, sequence};
use crate::run_control::error::BartError;
use crate::table::order_joints::{JointSettings, OrderJoints};
use crate::table::rcs_request::{Aspect, RcsRequest, traced_aspects};
use crate::table::rcs_table::{aspect_settings, check};
use crate::table::skin_comparison::skin;
use artifact::paths::Amplitude;
use artifact::radar::Polarization;
use artifact::scene::Mesh;
use glam::DVec3;
use num_complex::Complex64;
use rayon::prelude::*;

/// A facet sequence, or an edge in one, and its contribution to S.
#[derive(Debug, Clone, PartialEq)]
pub struct Contribution {
    /// Triangles of the mesh in the order of travel; an edge is represented by one of its own or, if the two
    /// ends light it via different ones, by two.
    pub triangles: Vec<u32>,
    /// Edge that scatters in place of a facet, from end to end, body axes.
    pub edge_m: Option<[DVec3; 2]>,
    /// Points of the sequence met by the ray through the centre of the strongest polygon or part, body axes.
    pub points_m: Vec<DVec3>,
    /// Contribution to S, including the reverse path, at the request's first frequency; metres, phase at the
    /// origin.
    pub amplitude_m: Complex64,
}

/// S at the request's aspect number `aspect` (elevation by elevation, azimuth by azimuth) at its first
/// frequency, by facet sequence and edge, strongest first. Their sum is the value of [`crate::rcs`].
pub fn contributions(
    mesh: &Mesh,
    request: &RcsRequest,
    aspect: usize,
) -> Result<Vec<Contribution>, BartError> {
    check(request)?;
    let world = World::of_skin(mesh, skin(request))?;
    let aspects = traced_aspects(request, &world);
    let Some(aspect) = aspects.get(aspect) else { return Ok(Vec::new()) };
    let settings = aspect_settings(request, &world, request.accuracy.amplitude()).seen_from(aspect);
    let transmit = BeamTree::trace(&world, aspect.transmit.0, &settings.trace)?;
    let receive =
        aspect.receive.map(|(antenna, _)| BeamTree::trace(&world, antenna, &settings.trace)).transpose()?;
    let trees = receive.as_ref().map_or(Trees::Shared(&transmit), |tree| Trees::Apart(&transmit, tree));
    let scatterer = Scatterer::new(&world, trees, zenith_h(aspect));
    let wavenumbers_per_m = request.wavenumbers_per_m();
    let what = JointSettings {
        nodes: request.nodes,
        edges: request.edges,
        least_area_m2: settings.trace.least_area_m2,
        wavenumber_per_m: wavenumbers_per_m.first().copied().unwrap_or(0.0),
    };
    let integration = Integration {
        wavenumbers_per_m: &wavenumbers_per_m[..wavenumbers_per_m.len().min(1)],
        accuracy: request.accuracy.amplitude(),
        bracket: bracket_of(request.nodes),
    };
    let facets = |order: u8| scatterer.joints(order, request.nodes, settings.trace.least_area_m2);
    let all: Vec<Joints> = (1..=request.bounces).map(facets).collect();
    let accuracy = affordable_accuracy(&scatterer, all.iter(), &integration, settings.most_tiles)?;
    let integration = Integration { accuracy, ..integration };
    let teller = AspectContributions { scatterer, what, integration, polarization: request.polarization };
    Ok(by_sequence((1..=request.bounces).flat_map(|order| teller.of_order(order)).collect()))
}

fn zenith_h(aspect: &Aspect) -> ZenithH {
    ZenithH { transmit: aspect.transmit.1, receive: aspect.receive.map_or(aspect.transmit.1, |(_, h)| h) }
}

/// Data for the contributions at one aspect.
struct AspectContributions<'a> {
    scatterer: Scatterer<'a>,
    what: JointSettings,
    /// Integration at the first frequency.
    integration: Integration<'a>,
    polarization: Polarization,
}

/// Contribution with the number of its edge, if any.
type NumberedContribution = (Option<u32>, Contribution);

impl AspectContributions<'_> {
    fn of_order(&self, order: u8) -> Vec<NumberedContribution> {
        let OrderJoints { facets, edges, truncations } = OrderJoints::of(&self.scatterer, order, &self.what);
        let of_facets =
            facets.list.par_iter().map(|joint| (None, self.of_joint(joint, facets.polygon(joint))));
        let of_edges = edges.par_iter().map(|joint| (Some(joint.edge), self.of_edge(joint)));
        let of_end = |(i, end)| (Some(u32::MAX - i as u32), self.of_truncation(end));
        of_facets.chain(of_edges).chain(truncations.par_iter().enumerate().map(of_end)).collect()
    }

    fn of_joint(&self, joint: &Joint, corners_m: &[DVec3]) -> Contribution {
        let amplitudes = self.scatterer.scattering(joint, corners_m, DVec3::ZERO, &self.integration).value;
        let middle_m = corners_m.iter().sum::<DVec3>() / corners_m.len() as f64;
        Contribution {
            triangles: self.triangles(sequence(&self.scatterer, joint.forward, joint.backward)),
            edge_m: None,
            points_m: touched_m(&self.scatterer, (joint.forward, joint.backward), middle_m),
            amplitude_m: self.element(&amplitudes),
        }
    }

    fn of_edge(&self, joint: &EdgeJoint) -> Contribution {
        let Scatterer { world, trees, .. } = self.scatterer;
        let edge = &world.edges_in(joint.band).edges[joint.edge as usize];
        let of = |tree: &BeamTree, beam: u32| tree.sequence(&tree.beams[beam as usize]);
        let back = of(trees.receive(), joint.backward).into_iter().rev();
        let mut facets: Vec<u32> = of(trees.transmit(), joint.forward).into_iter().chain(back).collect();
        facets.dedup();
        let middle_m = edge.point_m(0.5 * (joint.span_m[0] + joint.span_m[1]));
        Contribution {
            triangles: self.triangles(facets),
            edge_m: Some([edge.from_m, edge.point_m(edge.length_m)]),
            points_m: touched_m(&self.scatterer, (joint.forward, joint.backward), middle_m),
            amplitude_m: self
                .element(&edge_share(&self.scatterer, joint, DVec3::ZERO, &self.integration).value),
        }
    }

    fn of_truncation(&self, end: &Truncation) -> Contribution {
        let amplitudes = truncation_share(&self.scatterer, end, DVec3::ZERO, &self.integration);
        let middle_m = end.point_m(0.5 * end.length_m());
        Contribution {
            triangles: self.triangles(sequence(&self.scatterer, end.forward, end.backward)),
            edge_m: Some(end.side.ends_m),
            points_m: touched_m(&self.scatterer, (end.forward, end.backward), middle_m),
            amplitude_m: self.element(&amplitudes),
        }
    }

    fn triangles(&self, facets: Vec<u32>) -> Vec<u32> {
        facets.into_iter().map(|facet| self.scatterer.world.facet(facet).id.triangle).collect()
    }

    fn element(&self, amplitudes: &[Amplitude]) -> Complex64 {
        let (p, q) = self.polarization.indices();
        amplitudes.first().map_or(Complex64::ZERO, |s| s[p][q])
    }
}

/// Points of the ray through `node_m` along the beams of both ends, in the order of travel.
fn touched_m(scatterer: &Scatterer<'_>, (forward, backward): (u32, u32), node_m: DVec3) -> Vec<DVec3> {
    let way = |tree: &BeamTree, beam: u32| {
        back_to_antenna(scatterer.world, tree, &tree.beams[beam as usize], node_m)
    };
    let mut points = way(scatterer.trees.transmit(), forward);
    points.reverse();
    points.extend(way(scatterer.trees.receive(), backward).into_iter().skip(1));
    points
}

/// Points from one of a beam's polygon via its mirrors towards the antenna: straight towards each image up to
/// the mirror's plane.
fn back_to_antenna(world: &World, tree: &BeamTree, beam: &Beam, node_m: DVec3) -> Vec<DVec3> {
    let mut points = vec![node_m];
    let (mut beam, mut x_m) = (beam, node_m);
    while let Some(parent) = beam.parent {
        let mirror = &tree.beams[parent as usize];
        x_m = meeting_m(x_m, beam.image, world.facet(mirror.facet));
        points.push(x_m);
        beam = mirror;
    }
    points
}

fn meeting_m(x_m: DVec3, image: Antenna, mirror: &FacetGeometry) -> DVec3 {
    let towards = image.towards(x_m);
    let share = -mirror.plane.distance_m(x_m) / mirror.normal().dot(towards);
    if share.is_finite() { x_m + share * towards } else { x_m }
}

/// Sums the pieces of one sequence and edge; the strongest piece provides the ray.
fn by_sequence(mut found: Vec<NumberedContribution>) -> Vec<Contribution> {
    fn key((edge, contribution): &NumberedContribution) -> (&[u32], Option<u32>) {
        (&contribution.triangles, *edge)
    }
    found.sort_by(|a, b| key(a).cmp(&key(b)));
    let sum = |group: &[NumberedContribution]| {
        let strongest =
            group.iter().fold(&group[0].1, |best, (_, c)| if power(c) > power(best) { c } else { best });
        Contribution { amplitude_m: group.iter().map(|(_, c)| c.amplitude_m).sum(), ..strongest.clone() }
    };
    let mut sums: Vec<Contribution> = found.chunk_by(|a, b| key(a) == key(b)).map(sum).collect();
    sums.sort_by(|a, b| power(b).total_cmp(&power(a)).then_with(|| a.triangles.cmp(&b.triangles)));
    sums
}

fn power(contribution: &Contribution) -> f64 {
    contribution.amplitude_m.norm_sqr()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rcs;
    use artifact::Accuracy;
    use artifact::settings::{Edges, NodeRule};

    fn corner() -> Mesh {
        let vertices_m = vec![
            [0.0; 3],
            [0.2, 0.0, 0.0],
            [0.2, 0.0, 0.2],
            [0.0, 0.0, 0.2],
            [0.0, 0.2, 0.2],
            [0.0, 0.2, 0.0],
        ];
        Mesh { vertices_m, triangles: vec![[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]], ..Mesh::default() }
    }

    fn request() -> RcsRequest {
        RcsRequest {
            range_m: 25.0,
            bounces: 2,
            nodes: NodeRule::Middle,
            accuracy: Accuracy::from_db(-60.0),
            ..RcsRequest::over(vec![77e9, 78e9], vec![0.1], vec![0.7, 0.9])
        }
    }

    #[test]
    fn contributions_add_up_to_the_scattering_amplitude() {
        let sum: Complex64 =
            contributions(&corner(), &request(), 1).unwrap().iter().map(|c| c.amplitude_m).sum();
        let whole = rcs(&corner(), &request(), &|_, _| {}).unwrap().amplitude_m[1];
        println!("asked {whole}, got {sum}");
        // Finite-range integrals have the requested accuracy, −60 dB.
        assert!((sum - whole).norm() < 1e-3 * whole.norm());
    }

    #[test]
    fn contributions_of_facets_and_edges_add_up_to_the_scattering_amplitude_in_every_element() {
        for (polarization, aspect) in [(Polarization::Vv, 0), (Polarization::Hh, 1), (Polarization::Vh, 1)] {
            let asked = RcsRequest { edges: Edges::FirstOrder, bounces: 3, polarization, ..request() };
            let parts = contributions(&corner(), &asked, aspect).unwrap();
            let (sum, of_edges) = parts.iter().fold((Complex64::ZERO, 0.0), |(sum, edges), part| {
                (sum + part.amplitude_m, edges + part.edge_m.map_or(0.0, |_| part.amplitude_m.norm()))
            });
            let whole = rcs(&corner(), &asked, &|_, _| {}).unwrap().amplitude_m[aspect];
            println!("{polarization:?}: asked {whole:.6}, got {sum:.6}, of edges up to {of_edges:.6}");
            // Finite-range integrals have the requested accuracy, −60 dB of the largest possible contribution
            // of facets and edges.
            let scale = parts.iter().map(|part| part.amplitude_m.norm()).sum::<f64>();
            assert!((sum - whole).norm() < 1e-3 * scale && of_edges > 1e-2 * scale);
        }
    }

    #[test]
    fn an_edge_is_told_by_its_ends_and_by_the_facets_that_lead_to_it() {
        let asked = RcsRequest { edges: Edges::FirstOrder, bounces: 1, ..request() };
        let parts = contributions(&corner(), &asked, 1).unwrap();
        // The corner's six outer sides and the fold, which is a wedge from behind, each once.
        let is_fold = |part: &&Contribution| {
            part.edge_m.is_some_and(|ends| ends.iter().all(|x| x.x == 0.0 && x.y == 0.0))
        };
        let edges = parts.iter().filter(|part| part.edge_m.is_some());
        assert_eq!((edges.clone().filter(is_fold).count(), edges.count()), (1, 7));
        for part in parts.iter().filter(|part| part.edge_m.is_some()) {
            let [from, to] = part.edge_m.unwrap();
            let off_m = (part.points_m[0] - from).cross(to - from).length() / (to - from).length();
            assert!(off_m < 1e-12 && part.triangles.len() == 1, "{part:?}");
        }
    }

    #[test]
    fn the_touched_points_make_a_mirrored_way() {
        let antenna =
            25.0 * DVec3::new(0.1_f64.cos() * 0.9_f64.cos(), 0.1_f64.cos() * 0.9_f64.sin(), 0.1_f64.sin());
        let all = contributions(&corner(), &request(), 1).unwrap();
        let double = all.iter().find(|c| c.triangles.len() == 2).unwrap();
        let [a, b] = double.points_m[..] else { panic!("{double:?}") };
        let (came, left) = ((a - antenna).normalize_or_zero(), (b - a).normalize_or_zero());
        // One mirror is the plane y = 0, the other x = 0; the path turns only in the first, the second is the
        // node.
        assert!(
            (came.z - left.z).abs() < 1e-12 && (came.x.abs() - left.x.abs()).abs() < 1e-12,
            "{came} {left}"
        );
        assert!(a.x.abs().min(a.y.abs()) < 1e-12 && b.x.abs().min(b.y.abs()) < 1e-12);
    }
}
