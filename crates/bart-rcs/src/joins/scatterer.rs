//! Joints with their legs: the result of one trace for every frequency and polarization.

use crate::beams::beam::{Beam, BeamTree};
use crate::beams::image_tree::{goes_by_road, origin};
use crate::bodies::body_gains::BodyGains;
use crate::bodies::road::{HalfSpace, half_of};
use crate::bodies::world::World;
use crate::geometry::antenna::Antenna;
use crate::integral::field::{Field, length_difference_m};
use crate::integral::leg_surfaces::{LegSurface, LegSurfaces};
use crate::integral::node::{Bracket, Estimate, Leg, Node};
use crate::integral::phasors::PhasorRotation;
use crate::integral::physical_optics::{count_tiles, for_each_tile, node_amplitudes};
use crate::integral::polarization::Mirrors;
use crate::integral::tiling::Tile;
use crate::joins::group::Group;
use crate::joins::join::joints;
use crate::joins::joint::{Joint, Joints, Reverse, Trees};
use crate::run_control::error::BartError;
use crate::run_control::progress::{NoProgress, Phase, Progress};
use artifact::paths::Amplitude;
use artifact::settings::NodeRule;
use glam::DVec3;
use num_complex::Complex64;
use std::sync::Arc;

/// A world, the beams of both ends and the leg to each beam.
pub(crate) struct Scatterer<'a> {
    pub(crate) world: &'a World,
    pub(crate) trees: Trees<'a>,
    /// Transmitter and receiver.
    ends: [Antenna; 2],
    transmit_legs: Vec<Leg>,
    receive_legs: Vec<Leg>,
    progress: (Phase, &'a dyn Progress),
    /// Gains that weight sums over joints; `None` if all are one.
    gains: Option<&'a BodyGains>,
    /// Extent to which edge waves are followed.
    pub(crate) edge_waves: EdgeWaves,
}

/// Extent to which waves launched by edges over their faces are followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EdgeWaves {
    /// Over further faces, as long as they are strong enough.
    OverFaces,
    /// Up to the ends of the edge's own faces: the total level of all edges is that of [`Self::OverFaces`]
    /// within a decibel (docs/planning.md).
    OverOwnFaces,
}

/// Vectors ĥ straight above and below, at each end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ZenithH {
    pub(crate) transmit: DVec3,
    pub(crate) receive: DVec3,
}

impl<'a> Scatterer<'a> {
    pub(crate) fn new(world: &'a World, trees: Trees<'a>, zenith_h: ZenithH) -> Self {
        let transmit_legs = legs(world, trees.transmit(), zenith_h.transmit);
        let receive_legs = match trees {
            Trees::Shared(_) => Vec::new(),
            Trees::Apart(..) | Trees::ByRoad(..) => legs(world, trees.receive(), zenith_h.receive),
        };
        let ends = [trees.transmit().antenna, trees.receive().antenna];
        Self {
            world,
            trees,
            ends,
            transmit_legs,
            receive_legs,
            progress: (Phase::Integrating, &NoProgress),
            gains: None,
            edge_waves: EdgeWaves::OverFaces,
        }
    }

    /// The scatterer with progress reports of its sums, which belong to `phase`.
    pub(crate) fn with_progress(self, phase: Phase, progress: &'a dyn Progress) -> Self {
        Self { progress: (phase, progress), ..self }
    }

    /// The scatterer with antenna gains: S of every path is weighted by them.
    pub(crate) fn with_gains(self, gains: &'a BodyGains) -> Self {
        Self { gains: (!gains.are_one()).then_some(gains), ..self }
    }

    /// The scatterer with edge waves only over the edges' own faces.
    pub(crate) fn with_waves_over_own_faces(self) -> Self {
        Self { edge_waves: EdgeWaves::OverOwnFaces, ..self }
    }

    /// Reports the progress of a sum.
    pub(crate) fn at(&self, done: usize, of: usize) {
        self.progress.1.at(self.progress.0, done, of);
    }

    /// The same beams with plane waves from another direction: lit parts stay lit.
    ///
    /// For a single antenna, and directions close enough to the traced one for the motion of shadows to be
    /// negligible.
    pub(crate) fn turned_to(&self, direction: DVec3) -> Self {
        let turned = |leg: &Leg| Leg {
            image: Antenna::Direction(leg.mirrors.image_direction(direction)),
            ..leg.clone()
        };
        Self {
            ends: [Antenna::Direction(direction); 2],
            transmit_legs: self.transmit_legs.iter().map(turned).collect(),
            receive_legs: Vec::new(),
            ..*self
        }
    }

    /// Joints of one order not smaller than `least_area_m2`.
    pub(crate) fn joints(&self, order: u8, rule: NodeRule, least_area_m2: f64) -> Joints {
        joints(self.world, self.trees, order, rule, least_area_m2)
    }

    /// Body of the last facet of a transmitter's beam, where its paths have their node.
    pub(crate) fn node_body(&self, forward: u32) -> usize {
        self.world.facet(self.trees.transmit().beams[forward as usize].facet).id.body as usize
    }

    pub(crate) fn forward(&self, joint: &Joint) -> &'a Beam {
        &self.trees.transmit().beams[joint.forward as usize]
    }

    /// Whether a leg of the joint's path meets the road.
    pub(crate) fn goes_by_road(&self, joint: &Joint) -> bool {
        let backward = &self.trees.receive().beams[joint.backward as usize];
        goes_by_road(self.world, self.trees.transmit(), self.forward(joint))
            || goes_by_road(self.world, self.trees.receive(), backward)
    }

    pub(crate) fn transmit_leg(&self, joint: &Joint) -> &Leg {
        &self.transmit_legs[joint.forward as usize]
    }

    pub(crate) fn receive_leg(&self, joint: &Joint) -> &Leg {
        let legs = if self.receive_legs.is_empty() { &self.transmit_legs } else { &self.receive_legs };
        &legs[joint.backward as usize]
    }

    /// Amplitudes of a part of a joint's polygon referred to `reference_m`, including its weight but not the
    /// reverse.
    pub(crate) fn amplitudes(
        &self,
        joint: &Joint,
        part: &PolygonPart<'_>,
        wavenumbers_per_m: &[f64],
        accuracy: f64,
    ) -> Estimate<Vec<Amplitude>> {
        let node = self.node(joint, part);
        let accuracy = self.accuracy(joint.forward, &node, part.reference_m, (wavenumbers_per_m, accuracy));
        let mut estimate = node_amplitudes(&node, part.reference_m, wavenumbers_per_m, accuracy);
        Self::weigh(joint, wavenumbers_per_m, &mut estimate);
        estimate
    }

    /// Multiplies amplitudes by a joint's weight.
    pub(crate) fn weigh(joint: &Joint, wavenumbers_per_m: &[f64], estimate: &mut Estimate<Vec<Amplitude>>) {
        estimate.error *= joint.weight;
        for (amplitude, k) in estimate.value.iter_mut().zip(wavenumbers_per_m) {
            amplitude.iter_mut().flatten().for_each(|a| *a *= joint.weight_at(*k));
        }
    }

    /// Integrand over a part of a joint's polygon, with the accuracy requested at some wavenumbers.
    pub(crate) fn with_field<T>(
        &self,
        joint: &Joint,
        part: &PolygonPart<'_>,
        asked: (&[f64], f64),
        of: impl FnOnce(&Field<'_>) -> T,
    ) -> T {
        let node = self.node(joint, part);
        let accuracy = self.accuracy(joint.forward, &node, part.reference_m, asked);
        of(&Field::new(&node, part.reference_m, accuracy))
    }

    /// Contribution of a joint to S, including its reverse: every amplitude with
    /// R_tR_r/(L₁L₂)·e^{−jk(L₁+L₂−R_t−R_r)}, R to `origin_m`.
    pub(crate) fn scattering(
        &self,
        joint: &Joint,
        corners_m: &[DVec3],
        origin_m: DVec3,
        request: &Integration<'_>,
    ) -> Estimate<Vec<Amplitude>> {
        let reference_m = corners_m.iter().sum::<DVec3>() / corners_m.len() as f64;
        let part = PolygonPart { corners_m, reference_m, bracket: request.bracket };
        let mut estimate = self.amplitudes(joint, &part, request.wavenumbers_per_m, request.accuracy);
        let ends = [joint.forward, joint.backward];
        let (spread, length_m) = self.way_from(origin_m, ends, self.apparent_m(joint, reference_m));
        for (amplitude, k) in estimate.value.iter_mut().zip(request.wavenumbers_per_m) {
            let factor = Complex64::from_polar(spread, -k * length_m);
            *amplitude = scaled(&with_reverse(joint.reverse, amplitude), factor);
        }
        estimate.error *= spread * f64::from(joint.reverse.ways());
        estimate
    }

    /// Whether all waves are plane.
    pub(crate) fn is_far(&self) -> bool {
        self.ends.iter().all(|end| matches!(end, Antenna::Direction(_)))
    }

    /// Calls `give` with every tile of a joint's polygon, subdivided for `highest_per_m`: their sum is
    /// [`Self::scattering`].
    pub(crate) fn for_each_tile(
        &self,
        joint: &Joint,
        corners_m: &[DVec3],
        origin_m: DVec3,
        highest_per_m: f64,
        request: &Integration<'_>,
        give: &mut dyn FnMut(&JointTile<'_>),
    ) {
        let reference_m = corners_m.iter().sum::<DVec3>() / corners_m.len() as f64;
        let node = self.node(joint, &PolygonPart { corners_m, reference_m, bracket: request.bracket });
        let asked = (request.wavenumbers_per_m, request.accuracy);
        let accuracy = self.accuracy(joint.forward, &node, reference_m, asked);
        let field = Field::new(&node, reference_m, accuracy);
        let ends = [joint.forward, joint.backward];
        let (spread, length_m) = self.way_from(origin_m, ends, self.apparent_m(joint, reference_m));
        for_each_tile(&field, highest_per_m, &mut |tile, _| {
            give(&JointTile { field: &field, tile, joint, spread, length_m });
        });
    }

    /// Approximate number of the joint's tiles, counted up to `most`.
    pub(crate) fn tiles(
        &self,
        joint: &Joint,
        corners_m: &[DVec3],
        request: &Integration<'_>,
        most: u64,
    ) -> u64 {
        let reference_m = corners_m.iter().sum::<DVec3>() / corners_m.len() as f64;
        let node = self.node(joint, &PolygonPart { corners_m, reference_m, bracket: request.bracket });
        let asked = (request.wavenumbers_per_m, request.accuracy);
        let accuracy = self.accuracy(joint.forward, &node, reference_m, asked);
        let highest_per_m = request.wavenumbers_per_m.iter().copied().fold(0.0, f64::max);
        count_tiles(&Field::new(&node, reference_m, accuracy), highest_per_m, most)
    }

    /// [`Node::accuracy`] for a node on a beam at some wavenumbers; looser on facets smaller than the curved
    /// ones of their body ([`Node::allowance`]).
    fn accuracy(&self, forward: u32, node: &Node<'_>, at_m: DVec3, asked: (&[f64], f64)) -> f64 {
        let accuracy = node.accuracy(at_m, asked.0, asked.1);
        if node.bend.is_none() {
            return accuracy;
        }
        let facet = self.trees.transmit().beams[forward as usize].facet;
        node.allowance(self.world.bent_area_m2(facet)) * accuracy
    }

    fn node<'p>(&'p self, joint: &Joint, part: &PolygonPart<'p>) -> Node<'p> {
        Node {
            corners_m: part.corners_m,
            normal: self.forward(joint).lit_normal,
            material: self.world.lossy_material(self.forward(joint).facet).map(Arc::as_ref),
            bend: self.world.bend(self.forward(joint).facet),
            transmit: self.transmit_leg(joint),
            receive: self.receive_leg(joint),
            bracket: part.bracket,
        }
    }

    /// Integrand over a part of a transmitter's beam, as if it returned the same way.
    pub(crate) fn with_field_of_beam<T>(
        &self,
        beam: u32,
        part: &PolygonPart<'_>,
        asked: (&[f64], f64),
        of: impl FnOnce(&Field<'_>) -> T,
    ) -> T {
        let (lit, leg) = (&self.trees.transmit().beams[beam as usize], &self.transmit_legs[beam as usize]);
        let node = Node {
            corners_m: part.corners_m,
            normal: lit.lit_normal,
            material: self.world.lossy_material(lit.facet).map(Arc::as_ref),
            bend: self.world.bend(lit.facet),
            transmit: leg,
            receive: leg,
            bracket: part.bracket,
        };
        let accuracy = self.accuracy(beam, &node, part.reference_m, asked);
        of(&Field::new(&node, part.reference_m, accuracy))
    }

    /// R_tR_r/(L₁L₂), times the gains, and L₁ + L₂ − R_t − R_r for a node on a transmitter's and a receiver's
    /// beam with these apparent points, R to `origin_m`.
    pub(crate) fn way_from(&self, origin_m: DVec3, ends: [u32; 2], apparent_m: [DVec3; 2]) -> (f64, f64) {
        let length_m = (0..2).map(|i| length_difference_m(self.ends[i], apparent_m[i], origin_m)).sum();
        let spread: f64 = (0..2).map(|i| spread(self.ends[i], apparent_m[i], origin_m)).product();
        (self.gain(ends) * spread, length_m)
    }

    /// Both ends' gains towards the first and last body of a path.
    fn gain(&self, [forward, backward]: [u32; 2]) -> f64 {
        let first_body = |tree: &BeamTree, beam: u32| {
            let beam = &tree.beams[beam as usize];
            let first = tree.mirror_chain(beam).last().unwrap_or(beam);
            self.world.facet(first.facet).id.body
        };
        let (transmit, receive) = (self.trees.transmit(), self.trees.receive());
        self.gains
            .map_or(1.0, |gains| gains.of_way([first_body(transmit, forward), first_body(receive, backward)]))
    }

    /// Legs of a transmitter's and of a receiver's beam.
    pub(crate) fn legs(&self, forward: u32, backward: u32) -> [&Leg; 2] {
        let receive = if self.receive_legs.is_empty() { &self.transmit_legs } else { &self.receive_legs };
        [&self.transmit_legs[forward as usize], &receive[backward as usize]]
    }

    /// Apparent positions of a node from the transmitter and from the receiver.
    pub(crate) fn apparent_m(&self, joint: &Joint, x_m: DVec3) -> [DVec3; 2] {
        [self.transmit_leg(joint).mirrors.unfolded(x_m), self.receive_leg(joint).mirrors.unfolded(x_m)]
    }
}

/// A tile of a joint's polygon.
pub(crate) struct JointTile<'a> {
    field: &'a Field<'a>,
    tile: &'a Tile<'a>,
    joint: &'a Joint,
    /// R_tR_r/(L₁L₂) and L₁ + L₂ − R_t − R_r at the polygon's reference point.
    spread: f64,
    length_m: f64,
}

/// Path length over a tile.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PathLengthRange {
    /// Length L₁ + L₂ − R_t − R_r halfway between its minimum and maximum, m.
    pub(crate) length_m: f64,
    /// Maximum difference of any point's length from that, m.
    pub(crate) extent_m: f64,
}

impl JointTile<'_> {
    pub(crate) fn path_length_range(&self) -> PathLengthRange {
        let (middle_m, reach_m) = self.tile.middle_and_reach_m();
        let middle = self.field.surface_at(middle_m);
        let at_middle_m = self.field.length_m(middle.x_m);
        let gradient = self.field.length_gradient(&middle);
        // Linear part of the length: its minimum and maximum are at corners.
        let lengths_m = self.tile.corners_m().iter().map(|corner| gradient.dot(*corner - middle_m));
        let [low_m, high_m] = lengths_m.fold([0.0_f64; 2], |[low, high], l| [low.min(l), high.max(l)]);
        // Beyond its tangent plane a length grows by reach²/2L at most, L of the nearest point; there are
        // two.
        let ranges_m = self.field.ranges_m(middle.x_m);
        let curved_m: f64 =
            ranges_m.map(|l| 0.5 * reach_m * reach_m / (l - reach_m).max(f64::MIN_POSITIVE)).iter().sum();
        // A skin deviates from it by half its second derivative, two-way.
        let bent_m =
            if self.field.is_bent() { self.field.along(self.tile.steps_m().into_iter()).rise_m } else { 0.0 };
        PathLengthRange {
            length_m: self.length_m + at_middle_m + 0.5 * (low_m + high_m),
            extent_m: 0.5 * (high_m - low_m)
                + curved_m
                + bent_m
                + self.field.turning_length_m()
                + self.joint.separation.turning_m(),
        }
    }

    /// Adds the tile's contribution to S, including its reverse.
    pub(crate) fn add_to(&self, group: &mut Group<'_>) {
        let turning = PhasorRotation::of(self.length_m - group.length_m, group.wavenumbers_per_m);
        self.field.for_each_amplitude(self.tile, group.wavenumbers_per_m, &mut |index, amplitude| {
            let k = group.wavenumbers_per_m[index];
            let factor = self.spread * self.joint.weight_at(k) * turning.at(k);
            let total = &mut group.sums[index];
            *total = sum(total, &scaled(&with_reverse(self.joint.reverse, amplitude), factor));
        });
    }
}

/// A part of a joint's polygon.
pub(crate) struct PolygonPart<'a> {
    pub(crate) corners_m: &'a [DVec3],
    pub(crate) reference_m: DVec3,
    pub(crate) bracket: Bracket,
}

/// Parameters of an integral: wavenumbers, bracket and accuracy.
#[derive(Clone, Copy)]
pub(crate) struct Integration<'a> {
    pub(crate) wavenumbers_per_m: &'a [f64],
    /// Accuracy, as in [`node_amplitudes`].
    pub(crate) accuracy: f64,
    pub(crate) bracket: Bracket,
}

/// Bracket that belongs to a rule: rays shot from the transmitter know the current that they excite at the
/// exit.
pub(crate) fn bracket_of(rule: NodeRule) -> Bracket {
    match rule {
        NodeRule::Middle | NodeRule::OwnEdge => Bracket::Symmetrised,
        NodeRule::Exit => Bracket::Plain,
    }
}

/// Transposed amplitude, that of the reverse path.
pub(crate) fn transposed(a: &Amplitude) -> Amplitude {
    [[a[0][0], a[1][0]], [a[0][1], a[1][1]]]
}

pub(crate) fn sum(a: &Amplitude, b: &Amplitude) -> Amplitude {
    [0, 1].map(|p| [0, 1].map(|q| a[p][q] + b[p][q]))
}

pub(crate) fn scaled(a: &Amplitude, factor: Complex64) -> Amplitude {
    a.map(|row| row.map(|x| x * factor))
}

pub(crate) fn with_reverse(reverse: Reverse, a: &Amplitude) -> Amplitude {
    match reverse {
        Reverse::Included => sum(a, &transposed(a)),
        Reverse::Apart => *a,
    }
}

/// Ratio R/L; 1 at infinite range.
fn spread(end: Antenna, x_m: DVec3, origin_m: DVec3) -> f64 {
    match end {
        Antenna::Point(p) => p.distance(origin_m) / p.distance(x_m),
        Antenna::Direction(_) => 1.0,
    }
}

/// Legs to every beam of a tree: parents come first.
fn legs(world: &World, tree: &BeamTree, zenith_h: DVec3) -> Vec<Leg> {
    let mut legs: Vec<Leg> = Vec::with_capacity(tree.beams.len());
    for beam in &tree.beams {
        let first =
            || if origin(tree, beam) == HalfSpace::Above { Mirrors::NONE } else { Mirrors::BELOW_ROAD };
        let mirrors = beam.parent.map_or_else(first, |parent| {
            let mirror = tree.beams[parent as usize].facet;
            legs[parent as usize].mirrors.and(&world.facet(mirror).plane)
        });
        legs.push(Leg { image: beam.image, mirrors, steps: steps(world, tree, beam), zenith_h });
    }
    legs
}

/// Surfaces met by a beam before it reaches its facet.
fn steps(world: &World, tree: &BeamTree, beam: &Beam) -> LegSurfaces {
    if world.is_conductor() {
        return LegSurfaces::default();
    }
    let mut half = origin(tree, beam);
    let mut steps: Vec<LegSurface> =
        (half == HalfSpace::Below).then(LegSurface::started_below).into_iter().collect();
    let mut beams: Vec<&Beam> = tree.mirror_chain(beam).collect();
    beams.reverse();
    for (i, of_leg) in beams.iter().enumerate() {
        // On a leg with both, the road is taken before the sheets: another order mixes polarizations slightly
        // differently.
        if half_of(world, of_leg.facet) != half {
            half = half_of(world, of_leg.facet);
            steps.extend(world.road().map(LegSurface::crossed));
        }
        steps.extend(of_leg.sheets.iter().map(|&sheet| LegSurface::passed(world, sheet)));
        if i + 1 < beams.len() {
            steps.push(LegSurface::reflected(world, of_leg.facet));
        }
    }
    LegSurfaces::over(&steps)
}

/// Facets of a path in the order of travel, from the beams of both ends.
pub(crate) fn sequence(scatterer: &Scatterer<'_>, forward: u32, backward: u32) -> Vec<u32> {
    let of = |tree: &BeamTree, beam: u32| tree.sequence(&tree.beams[beam as usize]);
    let mut facets = of(scatterer.trees.transmit(), forward);
    let back = of(scatterer.trees.receive(), backward);
    facets.extend(back.into_iter().rev().skip(1));
    facets
}

/// Whether a path meets more than one vehicle, from the beams of both ends.
pub(crate) fn meets_several_vehicles(scatterer: &Scatterer<'_>, forward: u32, backward: u32) -> bool {
    let vehicle = |facet: u32| scatterer.world.vehicle(scatterer.world.facet(facet).id.body);
    let vehicles: Vec<u32> = sequence(scatterer, forward, backward).into_iter().map(vehicle).collect();
    vehicles.windows(2).any(|pair| pair[0] != pair[1])
}

/// Refuses numbers of bounces that a path record cannot hold.
pub(crate) fn check_order(bounces: u8) -> Result<(), BartError> {
    let most = artifact::paths::MAX_ORDER as u8;
    if bounces > most { Err(BartError::TooManyBounces { bounces, most }) } else { Ok(()) }
}
