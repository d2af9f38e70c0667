//! Double reflections off their specular direction: the separation of their polygons from it, and the own
//! edges that take over.
//!
//! This applies to sequences of two flat conducting patches of at least a square wavelength, without the
//! road, sheets or curved skin, from which no third facet rises and whose line of sight is clear: the lit
//! polygons, seen from the mirror's image in the mirror's plane, are as large as the overlap of both patches
//! there.

use crate::beams::beam::{Beam, BeamTree};
use crate::bodies::world::World;
use crate::edges::mirror_window::FlatPatch;
use crate::edges::truncation::Truncation;
use crate::geometry::antenna::Antenna;
use crate::geometry::clip::doubled_area;
use crate::geometry::convex_intersection::{bounds, intersection};
use crate::geometry::nearest_point::{is_over, on_segment_m, sides};
use crate::geometry::plane_frame::area_m2;
use crate::joins::joint::{Joint, Joints, Trees};
use crate::joins::scatterer::Scatterer;
use crate::joins::specular_separation::{NodeSeparation, SpecularSeparation};
use crate::mesh::wedges::edge_band::EdgeBand;
use glam::{DMat3, DVec2, DVec3};
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

/// Sets the separation of all joints of order two from their specular point, and returns the own edges that
/// take over, by sequence, in the band of a wavenumber.
pub(crate) fn separate_sequences(
    scatterer: &Scatterer<'_>,
    joints: &mut Joints,
    wavenumber_per_m: f64,
) -> Vec<Truncation> {
    let world = scatterer.world;
    if world.has_sheets() || world.skin_error() > 0.0 {
        return Vec::new();
    }
    let band = EdgeBand::of(wavenumber_per_m);
    let highest_per_m = band.highest_per_m();
    let mut patches = FlatPatches::of(world, std::f64::consts::TAU / band.middle_per_m());
    let mut truncations = Vec::new();
    for (sequence, members) in sequences(scatterer, joints) {
        let Some(pair) = patches.pair(&sequence) else { continue };
        let nodes = [0, 1].map(|node| {
            LitNode::of(scatterer, joints, members.iter().filter(|m| m.node == node).map(|m| m.joint))
        });
        if has_third_facet(world, &sequence, &pair) {
            continue;
        }
        let clear = clear_sight(world, scatterer, joints, &members, &pair);
        let separation =
            SpecularSeparation { nodes: nodes.map(|node| node.separation()), clear, highest_per_m };
        if clear > 0.0 {
            members.iter().for_each(|member| joints.list[member.joint].separation = separation);
            truncations.extend(truncations_of(joints, &members, &pair, separation, scatterer));
        }
    }
    truncations
}

/// Separations of sequences of two patches from their specular point.
#[derive(Default)]
pub(crate) struct SequenceSeparations(BTreeMap<[LitPatch; 2], SpecularSeparation>);

impl SequenceSeparations {
    /// Separations already set on joints of order two.
    pub(crate) fn of(scatterer: &Scatterer<'_>, joints: &Joints) -> Self {
        let is_parted = |joint: &Joint| joint.separation.clear > 0.0;
        if !joints.list.iter().any(is_parted) {
            return Self::default();
        }
        let of_members = |members: &[Member]| joints.list[members[0].joint].separation;
        let all = sequences(scatterer, joints).into_iter();
        let known = all.map(|(sequence, members)| (sequence, of_members(&members)));
        Self(known.filter(|(_, separation)| separation.clear > 0.0).collect())
    }

    /// Sets the separations of joints of order two, for any node, to those of the same sequences.
    pub(crate) fn give_to(&self, scatterer: &Scatterer<'_>, joints: &mut Joints) {
        if self.0.is_empty() {
            return;
        }
        for (sequence, members) in sequences(scatterer, joints) {
            let Some(separation) = self.0.get(&sequence) else { continue };
            members.iter().for_each(|member| joints.list[member.joint].separation = *separation);
        }
    }
}

/// A side of a patch that is lit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct LitPatch {
    patch: u32,
    /// Whether the lit side is that of counter-clockwise winding.
    is_front: bool,
}

/// A joint of a sequence, and which of its two patches holds its node.
#[derive(Clone, Copy)]
struct Member {
    joint: usize,
    node: usize,
}

/// Joints of every sequence of two patches, in the order of their names; if both ends are one antenna a
/// sequence is its own reverse.
fn sequences(scatterer: &Scatterer<'_>, joints: &Joints) -> BTreeMap<[LitPatch; 2], Vec<Member>> {
    let mut all: BTreeMap<[LitPatch; 2], Vec<Member>> = BTreeMap::new();
    let direct = joints.list.iter().enumerate().filter(|(_, joint)| !scatterer.goes_by_road(joint));
    for (index, joint) in direct {
        let (mirror, _) = mirror_of(scatterer, joint);
        let node = lit_patch(scatterer.world, scatterer.forward(joint));
        let mirror = lit_patch(scatterer.world, mirror);
        let is_first = match scatterer.trees {
            Trees::Apart(..) => scatterer.forward(joint).order == 1,
            Trees::Shared(_) | Trees::ByRoad(..) => node < mirror,
        };
        let (sequence, node) = if is_first { ([node, mirror], 0) } else { ([mirror, node], 1) };
        all.entry(sequence).or_default().push(Member { joint: index, node });
    }
    all
}

/// Beam that a joint of order two has on its mirror, and the antenna that lights it.
fn mirror_of<'a>(scatterer: &'a Scatterer<'_>, joint: &Joint) -> (&'a Beam, Antenna) {
    let (transmit, receive) = (scatterer.trees.transmit(), scatterer.trees.receive());
    let of = |tree: &'a BeamTree, beam: u32| {
        tree.beams[beam as usize].parent.map(|parent| &tree.beams[parent as usize])
    };
    let mirror = of(transmit, joint.forward).or_else(|| of(receive, joint.backward));
    let mirror = mirror.unwrap_or_else(|| scatterer.forward(joint));
    (mirror, mirror.image)
}

fn lit_patch(world: &World, beam: &Beam) -> LitPatch {
    let is_front = beam.lit_normal.dot(world.facet(beam.facet).normal()) > 0.0;
    LitPatch { patch: world.patch(beam.facet), is_front }
}

/// Flat patches by name, constructed when first requested.
struct FlatPatches<'a> {
    world: &'a World,
    facets: HashMap<u32, Vec<u32>>,
    known: HashMap<u32, Option<Arc<FlatPatch>>>,
    /// Minimum area of a mirror, m².
    least_m2: f64,
}

impl<'a> FlatPatches<'a> {
    fn of(world: &'a World, wavelength_m: f64) -> Self {
        let mut facets: HashMap<u32, Vec<u32>> = HashMap::new();
        for facet in 0..world.facets().len() as u32 {
            facets.entry(world.patch(facet)).or_default().push(facet);
        }
        Self { world, facets, known: HashMap::new(), least_m2: wavelength_m * wavelength_m }
    }

    fn pair(&mut self, sequence: &[LitPatch; 2]) -> Option<[Arc<FlatPatch>; 2]> {
        let [first, second] = sequence.map(|lit| self.get(lit.patch));
        Some([first?, second?])
    }

    fn get(&mut self, patch: u32) -> Option<Arc<FlatPatch>> {
        let Self { world, facets, known, least_m2 } = self;
        let make = || {
            let facets = facets.get(&patch)?;
            let is_plain =
                |&facet: &u32| world.lossy_material(facet).is_none() && world.curvature_per_m(facet) == 0.0;
            let made = facets.iter().all(is_plain).then(|| FlatPatch::of(world, facets.clone()))?;
            (made.area_m2 >= *least_m2).then(|| Arc::new(made))
        };
        known.entry(patch).or_insert_with(make).clone()
    }
}

/// Lit part of one node, all pieces together.
struct LitNode {
    area_m2: f64,
    across_m2: f64,
    /// Area integrals of position and of its square, about the first corner.
    moment_m3: DVec3,
    second_moment_m4: DMat3,
    /// Minimum gradient of the length, and the bend there.
    gradient: Option<(DVec3, f64)>,
    origin_m: DVec3,
}

impl LitNode {
    const NOTHING: Self = Self {
        area_m2: 0.0,
        across_m2: 0.0,
        moment_m3: DVec3::ZERO,
        second_moment_m4: DMat3::ZERO,
        gradient: None,
        origin_m: DVec3::ZERO,
    };

    fn of(scatterer: &Scatterer<'_>, joints: &Joints, members: impl Iterator<Item = usize>) -> Self {
        let mut lit = Self::NOTHING;
        for joint in members.map(|index| &joints.list[index]) {
            lit.add(scatterer, joint, joints.polygon(joint));
        }
        lit
    }

    fn add(&mut self, scatterer: &Scatterer<'_>, joint: &Joint, corners_m: &[DVec3]) {
        let images = [scatterer.transmit_leg(joint).image, scatterer.receive_leg(joint).image];
        let normal = scatterer.forward(joint).lit_normal;
        if self.area_m2 == 0.0 {
            self.origin_m = corners_m[0];
        }
        for pair in corners_m[1..].windows(2) {
            self.add_triangle([corners_m[0], pair[0], pair[1]].map(|x| x - self.origin_m), normal);
        }
        let nearest_m = nearest_to_specular_m(images, normal, corners_m);
        let travel = images.map(|image| image.travel_direction_at(nearest_m));
        let both = travel[0] + travel[1];
        let gradient = both - both.dot(normal) * normal;
        let bend_per_m = images.map(|image| image.range_m(nearest_m).recip()).iter().sum();
        if self.gradient.is_none_or(|(least, _)| gradient.length_squared() < least.length_squared()) {
            self.gradient = Some((gradient, bend_per_m));
        }
        let cosine = 0.5 * travel.iter().map(|d| d.dot(normal).abs()).sum::<f64>();
        self.across_m2 += cosine * 0.5 * doubled_area(corners_m.iter().copied()).dot(normal);
    }

    fn add_triangle(&mut self, [a, b, c]: [DVec3; 3], normal: DVec3) {
        let area_m2 = 0.5 * (b - a).cross(c - a).dot(normal);
        let sum = a + b + c;
        let squares = |x: DVec3| DMat3::from_cols(x * x.x, x * x.y, x * x.z);
        self.area_m2 += area_m2;
        self.moment_m3 += area_m2 / 3.0 * sum;
        self.second_moment_m4 += (squares(a) + squares(b) + squares(c) + squares(sum)) * (area_m2 / 12.0);
    }

    fn separation(&self) -> NodeSeparation {
        let Some((gradient, bend_per_m)) = self.gradient.filter(|_| self.area_m2 > 0.0) else {
            return NodeSeparation::default();
        };
        let along = gradient.try_normalize().unwrap_or(DVec3::ZERO);
        let mean_m = self.moment_m3.dot(along) / self.area_m2;
        let square_m2 = (self.second_moment_m4 * along).dot(along) / self.area_m2;
        NodeSeparation {
            gradient_squared: gradient.length_squared(),
            variance_m2: (square_m2 - mean_m * mean_m).max(0.0),
            bend_per_m,
            across_m2: self.across_m2,
        }
    }
}

/// Point of a convex polygon nearest to where its plane mirrors one image into the other; any, if both waves
/// are plane.
fn nearest_to_specular_m(images: [Antenna; 2], normal: DVec3, corners_m: &[DVec3]) -> DVec3 {
    let height = |image: Antenna| image.towards(corners_m[0]).dot(normal);
    let (Antenna::Point(p), Antenna::Point(q)) = (images[0], images[1]) else { return corners_m[0] };
    let specular_m = p.lerp(q, height(images[0]) / (height(images[0]) + height(images[1])));
    let foot_m = specular_m - (specular_m - corners_m[0]).dot(normal) * normal;
    nearest_m(corners_m, normal, foot_m)
}

/// Point of a convex polygon nearest to a point of its plane.
fn nearest_m(corners_m: &[DVec3], normal: DVec3, x_m: DVec3) -> DVec3 {
    if is_over(x_m, corners_m, normal) {
        return x_m;
    }
    let nearer = |a: DVec3, b: DVec3| if b.distance(x_m) < a.distance(x_m) { b } else { a };
    sides(corners_m).map(|(a, b)| on_segment_m(x_m, a, b)).reduce(nearer).unwrap_or(corners_m[0])
}

/// Hidden share, of the area that both patches alone would show each other, from which polygons are left
/// unchanged.
const MISSED: f64 = 0.05;

/// Clearness of the line of sight via both nodes of a sequence.
fn clear_sight(
    world: &World,
    scatterer: &Scatterer<'_>,
    joints: &Joints,
    members: &[Member],
    pair: &[Arc<FlatPatch>; 2],
) -> f64 {
    let of_node = |node: usize| {
        let (on, mirror) = (&pair[node], &pair[1 - node]);
        let first = members.iter().find(|member| member.node == node)?;
        let (_, antenna) = mirror_of(scatterer, &joints.list[first.joint]);
        let image = antenna.mirrored(&mirror.plane);
        let polygons = members.iter().filter(|member| member.node == node);
        let lit = polygons.map(|member| joints.polygon(&joints.list[member.joint]));
        let lit_m2: f64 = lit.map(|polygon| through_m2(mirror, image, polygon)).sum();
        let all_m2 = overlap_m2(world, on, mirror, image);
        Some((1.0 - (all_m2 - lit_m2).abs() / (MISSED * all_m2)).max(0.0)).filter(|clear| clear.is_finite())
    };
    of_node(0).zip(of_node(1)).map_or(0.0, |(a, b)| a * b)
}

/// A polygon projected on the plane of the mirror through which it is seen.
fn seen_through(mirror: &FlatPatch, image: Antenna, corners_m: &[DVec3]) -> Option<Vec<DVec2>> {
    let place = |x: &DVec3| Some(mirror.frame.plane_from_world(mirror.mirror_point_m(image, *x)?));
    corners_m.iter().map(place).collect()
}

fn through_m2(mirror: &FlatPatch, image: Antenna, corners_m: &[DVec3]) -> f64 {
    seen_through(mirror, image, corners_m).map_or(0.0, |seen| area_m2(&seen).abs())
}

/// Area of a patch visible through its mirror from an image, in the mirror's plane; infinite if the patch is
/// partly behind.
fn overlap_m2(world: &World, on: &FlatPatch, mirror: &FlatPatch, image: Antenna) -> f64 {
    let counter_clockwise = |mut polygon: Vec<DVec2>| {
        if area_m2(&polygon) < 0.0 {
            polygon.reverse();
        }
        polygon
    };
    let windows = mirror.facets.iter().map(|&facet| {
        let corners_m = world.facet(facet).corners_m;
        counter_clockwise(corners_m.map(|x| mirror.frame.plane_from_world(x)).to_vec())
    });
    let windows: Vec<Vec<DVec2>> = windows.collect();
    let of_facet = |&facet: &u32| {
        let Some(seen) = seen_through(mirror, image, &world.facet(facet).corners_m) else {
            return f64::INFINITY;
        };
        let seen = counter_clockwise(seen);
        let meets = |window: &&Vec<DVec2>| overlap(bounds(&seen), bounds(window));
        windows.iter().filter(meets).map(|window| area_m2(&intersection(&seen, window))).sum()
    };
    on.facets.iter().map(of_facet).sum()
}

fn overlap([low, high]: [DVec2; 2], [other_low, other_high]: [DVec2; 2]) -> bool {
    low.cmplt(other_high).all() && other_low.cmplt(high).all()
}

/// Whether a third facet rises from the lit side of either patch, as in a trihedral corner: what ends at its
/// fold continues in sequences with that facet.
fn has_third_facet(world: &World, sequence: &[LitPatch; 2], pair: &[Arc<FlatPatch>; 2]) -> bool {
    (0..2).any(|node| {
        let (patch, other) = (&pair[node], &pair[1 - node]);
        let up = if sequence[node].is_front { 1.0 } else { -1.0 };
        let rises = |&facet: &u32| {
            let heights_m = world.facet(facet).corners_m.map(|x| up * patch.plane.distance_m(x));
            heights_m.into_iter().fold(0.0, f64::max) > ONE_PLANE * world.tolerance_m()
        };
        let beyond = patch.outline.iter().filter_map(|side| side.beyond);
        beyond.filter(|facet| !other.facets.contains(facet)).any(|facet| rises(&facet))
    })
}

/// Factor on the tolerance within which a neighbour lies in a patch's plane.
const ONE_PLANE: f64 = 1e4;

/// Own edges of both patches of a sequence.
fn truncations_of(
    joints: &Joints,
    members: &[Member],
    pair: &[Arc<FlatPatch>; 2],
    separation: SpecularSeparation,
    scatterer: &Scatterer<'_>,
) -> Vec<Truncation> {
    let of_node = |node: usize| {
        let joint =
            members.iter().find(|member| member.node == node).map(|member| &joints.list[member.joint]);
        joint.into_iter().flat_map(move |joint| {
            let (_, mirrored) = mirror_of(scatterer, joint);
            let &Joint { forward, backward, reverse, .. } = joint;
            let mirror = &pair[1 - node];
            pair[node].outline.iter().map(move |&side| Truncation {
                forward,
                backward,
                reverse,
                side,
                mirror: mirror.clone(),
                mirrored,
                separation,
            })
        })
    };
    (0..2).flat_map(of_node).collect()
}
