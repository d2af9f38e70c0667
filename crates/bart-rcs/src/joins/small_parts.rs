//! Small parts that meshes lack (grilles, lamps, gaps, axles), as random scatterers on the surface that both
//! ends see (`docs/decisions/small-parts.md`).
//!
//! A patch of area dA, whose normal is θ_t and θ_r from the directions to both ends, has the mean cross
//! section γ·√(cos θ_t cos θ_r)·dA, the constant-γ model of rough surfaces (Long, "Radar Reflectivity of Land
//! and Sea", 2001). Seen from one place, a body then has γ times the area of its silhouette in the mean,
//! whatever its mesh; phases are independent, in vv and hh too, so that |S|² is exponentially distributed.
//! Nothing is depolarized: no published share was found.

use crate::beams::beam::{Beam, BeamTree, TraceSettings};
use crate::bodies::world::World;
use crate::geometry::antenna::Antenna;
use crate::geometry::facet_geometry::FacetGeometry;
use crate::joins::joint::{Joint, Joints, Trees};
use crate::joins::scatterer::{Scatterer, ZenithH};
use crate::materials::surface_response::reflection;
use crate::run_control::error::BartError;
use artifact::paths::Amplitude;
use artifact::seed;
use artifact::settings::NodeRule;
use glam::DVec3;
use num_complex::Complex64;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Level of a car off its four flashes, 7.07 dBsm: G_max − σ_max of all faces in 3GPP TR 38.901 (Release 19),
/// Table 7.9.2.1-4, a passenger car from 0.5 to 100 GHz, m².
const FLOOR_M2: f64 = 5.093;
/// Mean silhouette of the project's three plain cars over all azimuths, seen from their own height, m².
const SILHOUETTE_M2: f64 = 4.67;
/// Mean cross section by area seen, γ.
const GAMMA: f64 = FLOOR_M2 / SILHOUETTE_M2;
/// Number of scatterers by area: some ten in a range cell of a car's side, enough for their sum to be
/// Gaussian.
const DENSITY_PER_M2: f64 = 20.0;
/// Maximum number of scatterers on a body; on larger ones they are fewer and stronger.
const MOST_ON_BODY: f64 = 50_000.0;

/// A small scatterer that both ends see.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SmallScatterer {
    /// Beams of the transmitter and of the receiver that light it.
    pub(crate) beams: [u32; 2],
    /// Position, world metres.
    pub(crate) at_m: DVec3,
    /// Amplitude `a` of a path record at all frequencies.
    pub(crate) amplitude_m: Amplitude,
}

/// The scatterers in the lit polygons of single reflections, drawn with `seed`: a function of body, facet and
/// seed alone, so that they move with their body from frame to frame and stay when it turns.
pub(crate) fn small_scatterers(
    scatterer: &Scatterer<'_>,
    joints: &Joints,
    (seed, wavenumber_per_m): (u64, f64),
) -> Vec<SmallScatterer> {
    let bodies = Bodies::of(scatterer.world);
    let facet_of = |joint: &Joint| scatterer.forward(joint).facet;
    // The parts of a facet are drawn once, in however many pieces it is lit.
    let of_facet = |joints_on: &[&Joint]| {
        let Some(facet) = joints_on.first().map(|joint| facet_of(joint)) else { return Vec::new() };
        let reflected = reflected_amplitude(scatterer.world, facet, wavenumber_per_m);
        let drawn = bodies.drawn(scatterer.world, facet, seed);
        let of_joint = |joint: &&Joint| {
            let (polygon_m, lit) = (joints.polygon(joint), scatterer.forward(joint));
            let scattering = LitFacet { scatterer, joint, lit, reflected };
            let inside = drawn.iter().filter(|part| is_inside(polygon_m, lit.lit_normal, part.at_m));
            inside.map(|part| scattering.of(part)).collect::<Vec<_>>()
        };
        joints_on.iter().flat_map(of_joint).collect()
    };
    let is_direct = |joint: &&Joint| !scatterer.goes_by_road(joint) && is_unobstructed(scatterer, joint);
    let direct: Vec<&Joint> = joints.list.iter().filter(is_direct).collect();
    let facets: Vec<&[&Joint]> = direct.chunk_by(|a, b| facet_of(a) == facet_of(b)).collect();
    facets.into_par_iter().flat_map_iter(of_facet).collect()
}

/// S over wavenumbers of what a transmitter and a receiver (`None` if it is the transmitter), each with its ĥ
/// straight above and below, see of the scatterers drawn with the seed 0; 2 × 2, with its phase referred to
/// the world's origin.
pub(crate) fn sum_of_small_parts(
    world: &World,
    (transmit, receive): ((Antenna, DVec3), Option<(Antenna, DVec3)>),
    trace: &TraceSettings,
    wavenumbers_per_m: &[f64],
) -> Result<Vec<Amplitude>, BartError> {
    let settings = TraceSettings { max_order: 1, ..*trace };
    let sent = BeamTree::trace(world, transmit.0, &settings)?;
    let received = receive.map(|receive| BeamTree::trace(world, receive.0, &settings)).transpose()?;
    let trees = received.as_ref().map_or(Trees::Shared(&sent), |received| Trees::Apart(&sent, received));
    let zenith_h = ZenithH { transmit: transmit.1, receive: receive.map_or(transmit.1, |receive| receive.1) };
    let scatterer = Scatterer::new(world, trees, zenith_h);
    let joints = scatterer.joints(1, NodeRule::Middle, settings.least_area_m2);
    let middle_per_m = wavenumbers_per_m.get(wavenumbers_per_m.len() / 2).copied().unwrap_or_default();
    let small = small_scatterers(&scatterer, &joints, (0, middle_per_m));
    Ok(summed(&scatterer, &small, wavenumbers_per_m))
}

fn summed(scatterer: &Scatterer<'_>, small: &[SmallScatterer], wavenumbers_per_m: &[f64]) -> Vec<Amplitude> {
    let mut sums = vec![Amplitude::default(); wavenumbers_per_m.len()];
    for part in small {
        let (spread, length_m) = scatterer.way_from(DVec3::ZERO, part.beams, [part.at_m; 2]);
        for (sum, k) in sums.iter_mut().zip(wavenumbers_per_m) {
            let factor = Complex64::from_polar(spread, -k * length_m);
            (0..2).for_each(|p| sum[p][p] += part.amplitude_m[p][p] * factor);
        }
    }
    sums
}

/// A lit facet, with the reflection of its material.
struct LitFacet<'a> {
    scatterer: &'a Scatterer<'a>,
    joint: &'a Joint,
    lit: &'a Beam,
    reflected: f64,
}

impl LitFacet<'_> {
    fn of(&self, part: &SmallPart) -> SmallScatterer {
        let legs = [self.scatterer.transmit_leg(self.joint), self.scatterer.receive_leg(self.joint)];
        let cosine =
            |end: usize| legs[end].image.towards(part.at_m).normalize_or_zero().dot(self.lit.lit_normal);
        let seen = (cosine(0) * cosine(1)).max(0.0).sqrt();
        let amplitude_m = self.reflected * (part.cross_section_m2 * seen).sqrt();
        let [vv, hh] = part.phases_rad.map(|phase| Complex64::from_polar(amplitude_m, phase));
        SmallScatterer {
            beams: [self.joint.forward, self.joint.backward],
            at_m: part.at_m,
            amplitude_m: [[vv, Complex64::ZERO], [Complex64::ZERO, hh]],
        }
    }
}

/// A small part on a facet, seen or not.
struct SmallPart {
    at_m: DVec3,
    /// Cross section along the facet's normal, of a conductor.
    cross_section_m2: f64,
    phases_rad: [f64; 2],
}

/// First facet and area of each body.
struct Bodies(BTreeMap<u32, (u32, f64)>);

impl Bodies {
    fn of(world: &World) -> Self {
        let mut bodies = BTreeMap::new();
        // Images below a road are no bodies of their own.
        for (index, facet) in (0..).zip(&world.facets()[..world.triangles()]) {
            bodies.entry(facet.id.body).or_insert((index, 0.0)).1 += facet.area_m2;
        }
        Self(bodies)
    }

    /// All small parts of a facet.
    fn drawn(&self, world: &World, facet: u32, seed: u64) -> Vec<SmallPart> {
        let geometry = world.facet(facet);
        let Some((first_facet, area_m2)) = self.0.get(&geometry.id.body) else { return Vec::new() };
        let density_per_m2 = DENSITY_PER_M2.min(MOST_ON_BODY / area_m2);
        let draw = Draw { seed, body: world.id_of_body(facet), facet: u64::from(facet - first_facet) };
        let expected = density_per_m2 * geometry.area_m2;
        let number = (expected + draw.shares(0)[0]) as u64;
        (1..=number).map(|index| draw.part(geometry, index, GAMMA / density_per_m2)).collect()
    }
}

/// Source of the random numbers of a facet.
struct Draw<'a> {
    seed: u64,
    body: &'a str,
    facet: u64,
}

impl Draw<'_> {
    fn shares(&self, index: u64) -> [f64; 4] {
        seed::shares(self.seed, &format!("bart-rcs/small parts/{}", self.body), &[self.facet, index])
    }

    /// A part at a place uniform over the facet, with an exponentially distributed cross section.
    fn part(&self, facet: &FacetGeometry, index: u64, mean_m2: f64) -> SmallPart {
        let [along, across, level, vv] = self.shares(2 * index - 1);
        let [hh, ..] = self.shares(2 * index);
        let [a, b, c] = facet.corners_m;
        let root = along.sqrt();
        SmallPart {
            at_m: a + root * ((1.0 - across) * (b - a) + across * (c - a)),
            cross_section_m2: -mean_m2 * (1.0 - level).ln(),
            phases_rad: [TAU * vv, TAU * hh],
        }
    }
}

/// Whether a point of the polygon's plane lies in it; its corners are counter-clockwise about the normal.
fn is_inside(polygon_m: &[DVec3], normal: DVec3, at_m: DVec3) -> bool {
    let next = polygon_m.iter().cycle().skip(1);
    polygon_m.iter().zip(next).all(|(a, b)| (*b - *a).cross(at_m - *a).dot(normal) >= 0.0)
}

/// Whether neither leg passes sheets.
fn is_unobstructed(scatterer: &Scatterer<'_>, joint: &Joint) -> bool {
    scatterer.transmit_leg(joint).steps.is_perfect() && scatterer.receive_leg(joint).steps.is_perfect()
}

/// Reflected share of the field at vertical incidence.
fn reflected_amplitude(world: &World, facet: u32, wavenumber_per_m: f64) -> f64 {
    let of = |material| reflection(material, 1.0, wavenumber_per_m).te.norm();
    world.lossy_material(facet).map_or(1.0, |material| of(material.as_ref()))
}
