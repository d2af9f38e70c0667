//! Which facets make the level: one aspect's scattering by facet sequence, with the points that its rays touch.

use crate::beams::beam::{Beam, BeamTree};
use crate::bodies::world::World;
use crate::error::BartError;
use crate::geometry::antenna::Antenna;
use crate::joins::join::{Joint, Trees};
use crate::joins::scatterer::{Integration, Scatterer, ZenithH, bracket_of, sequence};
use crate::table::aspect::Aspect;
use crate::table::rcs_table::{RcsRequest, aspect_settings, aspects, check, skin};
use artifact::scene::Mesh;
use glam::DVec3;
use num_complex::Complex64;
use rayon::prelude::*;

/// A facet sequence and what it adds to S.
#[derive(Debug, Clone, PartialEq)]
pub struct Contribution {
    /// Triangles of the mesh in the order of travel.
    pub triangles: Vec<u32>,
    /// Where the ray through the strongest polygon's middle touches them, body axes.
    pub points_m: Vec<DVec3>,
    /// Its share of S, the way back included, at the request's first frequency; metres, phase at the origin.
    pub amplitude_m: Complex64,
}

/// S of the request's aspect number `aspect` (elevation by elevation, azimuth by azimuth) at its first frequency, by facet
/// sequence, the strongest first. Their sum is [`crate::rcs`]'s value without edges.
pub fn contributions(mesh: &Mesh, request: &RcsRequest, aspect: usize) -> Result<Vec<Contribution>, BartError> {
    check(request)?;
    let world = World::of_skin(mesh, skin(request))?;
    let aspects = aspects(request);
    let Some(aspect) = aspects.get(aspect) else { return Ok(Vec::new()) };
    let settings = aspect_settings(request, &world, request.accuracy.amplitude());
    let transmit = BeamTree::trace(&world, aspect.transmit.0, &settings.trace)?;
    let receive = aspect.receive.map(|(antenna, _)| BeamTree::trace(&world, antenna, &settings.trace)).transpose()?;
    let trees = receive.as_ref().map_or(Trees::Shared(&transmit), |tree| Trees::Apart(&transmit, tree));
    let scatterer = Scatterer::new(&world, trees, zenith_h(aspect));
    let mut found = Vec::new();
    for order in 1..=request.bounces {
        let joints = scatterer.joints(order, request.nodes, settings.trace.least_area_m2);
        let of = |joint: &Joint| contribution(&scatterer, joint, joints.polygon(joint), request);
        found.extend(joints.list.par_iter().map(of).collect::<Vec<_>>());
    }
    Ok(by_sequence(found))
}

fn zenith_h(aspect: &Aspect) -> ZenithH {
    ZenithH { transmit: aspect.transmit.1, receive: aspect.receive.map_or(aspect.transmit.1, |(_, h)| h) }
}

fn contribution(scatterer: &Scatterer<'_>, joint: &Joint, corners_m: &[DVec3], request: &RcsRequest) -> Contribution {
    let wavenumbers = request.wavenumbers_per_m();
    let accuracy = request.accuracy.amplitude();
    let integration = Integration {
        wavenumbers_per_m: &wavenumbers[..wavenumbers.len().min(1)],
        accuracy,
        bracket: bracket_of(request.nodes),
    };
    let (p, q) = request.polarization.indices();
    let amplitudes = scatterer.scattering(joint, corners_m, DVec3::ZERO, &integration).value;
    let triangle = |facet: u32| scatterer.world.facet(facet).id.triangle;
    Contribution {
        triangles: sequence(scatterer, joint.forward, joint.backward).into_iter().map(triangle).collect(),
        points_m: touched_m(scatterer, joint, corners_m.iter().sum::<DVec3>() / corners_m.len() as f64),
        amplitude_m: amplitudes.first().map_or(Complex64::ZERO, |s| s[p][q]),
    }
}

/// Points of the ray through `node_m`, in the order of travel.
fn touched_m(scatterer: &Scatterer<'_>, joint: &Joint, node_m: DVec3) -> Vec<DVec3> {
    let (world, trees) = (scatterer.world, scatterer.trees);
    let mut points = back_to_antenna(world, trees.transmit(), scatterer.forward(joint), node_m);
    points.reverse();
    points.extend(back_to_antenna(world, trees.receive(), scatterer.backward(joint), node_m).into_iter().skip(1));
    points
}

/// From a point of a beam's polygon over its mirrors towards the antenna: straight to each image until the mirror's plane.
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

fn meeting_m(x_m: DVec3, image: Antenna, mirror: &crate::bodies::world::FacetGeometry) -> DVec3 {
    let towards = image.towards(x_m);
    let share = -mirror.plane.distance_m(x_m) / mirror.normal().dot(towards);
    if share.is_finite() { x_m + share * towards } else { x_m }
}

/// Pieces of one sequence added up; the strongest piece's ray stands for all.
fn by_sequence(mut found: Vec<Contribution>) -> Vec<Contribution> {
    found.sort_by(|a, b| a.triangles.cmp(&b.triangles));
    let sum = |group: &[Contribution]| {
        let strongest = group.iter().fold(&group[0], |best, c| if power(c) > power(best) { c } else { best });
        Contribution { amplitude_m: group.iter().map(|c| c.amplitude_m).sum(), ..strongest.clone() }
    };
    let mut sums: Vec<Contribution> = found.chunk_by(|a, b| a.triangles == b.triangles).map(sum).collect();
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
    use artifact::radar::Polarization;
    use artifact::settings::{Edges, NodeRule, Sides, Surface};

    fn corner() -> Mesh {
        let vertices_m =
            vec![[0.0; 3], [0.2, 0.0, 0.0], [0.2, 0.0, 0.2], [0.0, 0.0, 0.2], [0.0, 0.2, 0.2], [0.0, 0.2, 0.0]];
        Mesh { vertices_m, triangles: vec![[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]], ..Mesh::default() }
    }

    fn request() -> RcsRequest {
        RcsRequest {
            frequency_hz: vec![77e9, 78e9],
            elevation_rad: vec![0.1],
            azimuth_rad: vec![0.7, 0.9],
            range_m: 25.0,
            receiver: None,
            polarization: Polarization::Vv,
            bounces: 2,
            nodes: NodeRule::Middle,
            sides: Sides::Two,
            edges: Edges::Ignored,
            surface: Surface::Flat,
            accuracy: Accuracy::from_db(-60.0),
        }
    }

    #[test]
    fn contributions_add_up_to_the_scattering_amplitude() {
        let sum: Complex64 = contributions(&corner(), &request(), 1).unwrap().iter().map(|c| c.amplitude_m).sum();
        let whole = rcs(&corner(), &request(), &|_, _| {}).unwrap().amplitude_m[1];
        println!("asked {whole}, got {sum}");
        // Integrals of finite range are as exact as was asked, −60 dB.
        assert!((sum - whole).norm() < 1e-3 * whole.norm());
    }

    #[test]
    fn the_touched_points_make_a_mirrored_way() {
        let antenna = 25.0 * DVec3::new(0.1_f64.cos() * 0.9_f64.cos(), 0.1_f64.cos() * 0.9_f64.sin(), 0.1_f64.sin());
        let all = contributions(&corner(), &request(), 1).unwrap();
        let double = all.iter().find(|c| c.triangles.len() == 2).unwrap();
        let [a, b] = double.points_m[..] else { panic!("{double:?}") };
        let (came, left) = ((a - antenna).normalize_or_zero(), (b - a).normalize_or_zero());
        // One mirror is the plane y = 0, the other x = 0; the way turns in the first one only, the second is the node.
        assert!((came.z - left.z).abs() < 1e-12 && (came.x.abs() - left.x.abs()).abs() < 1e-12, "{came} {left}");
        assert!(a.x.abs().min(a.y.abs()) < 1e-12 && b.x.abs().min(b.y.abs()) < 1e-12);
    }
}
