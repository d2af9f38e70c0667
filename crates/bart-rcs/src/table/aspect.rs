//! Scattering at one aspect: trees, joins and integrals of every order, by the requested node rule and by the
//! other one.

mod by_order; // sums over orders, and means over frequency
mod left_out_edges; // change that edges would make
mod order_contribution; // S of one order

use crate::beams::beam::BeamTree;
use crate::bodies::stand_off::check_antenna_position;
use crate::bodies::world::World;
use crate::geometry::antenna::Antenna;
use crate::joins::join::tree_order;
use crate::joins::joint::Trees;
use crate::joins::scatterer::{Scatterer, ZenithH};
use crate::run_control::error::BartError;
use crate::run_control::progress::{NoProgress, Phase, Progress};
use crate::run_control::work_meter::{MeteredWork, WorkMeter};
use crate::table::aspect::by_order::{
    mean_over_frequencies, moved, of_bands, power_between, power_of, total,
};
use crate::table::aspect::left_out_edges::{left_out_edges, settings_with_edges};
use crate::table::aspect::order_contribution::{
    OrderContribution, edges_of_order, meetings, of_meeting, sums,
};
use crate::table::aspect_settings::{
    AspectSettings, Check, Checks, Finer, IntegralsCheck, compared_rule, left_out_order,
};
use crate::table::end_tree::EndTree;
use crate::table::order_joints::{LeftOutEdges, OrderJoints};
use crate::table::rcs_request::{Aspect, beside_faces};
use crate::table::small_mirrors::SmallMirrors;
use artifact::settings::{Edges, NodeRule};
use num_complex::Complex64;
use rayon::prelude::*;

/// Scattering amplitude S at one aspect.
#[derive(Debug, Clone)]
pub(crate) struct Scattering {
    /// Scattering by the requested rule, by order from 1, then frequency.
    pub(crate) chosen_m: Vec<Vec<Complex64>>,
    /// Scattering by the other rule, where it was measured.
    pub(crate) other_m: Option<Vec<Vec<Complex64>>>,
    /// Power over frequency of the error of the integrals, if measured.
    pub(crate) error_power: Option<f64>,
    /// Power |S|² over frequency of the first omitted order, if measured.
    pub(crate) left_out_power: Option<f64>,
    /// Change due to omitted edges, if measured.
    pub(crate) left_out_edges: Option<LeftOutEdges>,
    /// Power over frequency of the whole scattering matrix, all polarizations, summed order by order, m².
    pub(crate) whole_power: f64,
    pub(crate) beams: Vec<u64>,
    /// Accuracy of the integrals: that of the settings, or coarser.
    pub(crate) accuracy: f64,
    /// Amplitude of all dropped beams with independent phases.
    pub(crate) dropped_m: f64,
    /// Amplitude of all dropped beams with equal phases.
    pub(crate) dropped_at_most_m: f64,
    pub(crate) trace_seconds: f64,
    pub(crate) integrate_seconds: f64,
    pub(crate) check_seconds: f64,
}

/// Traces and integrates one aspect; polarization vectors have z as up, phases are referred to the world's
/// origin.
pub(crate) fn scattering(
    world: &World,
    aspect: &Aspect,
    settings: &AspectSettings,
    checks: Checks,
) -> Result<Scattering, BartError> {
    let meter = &WorkMeter::new(&|| 0.0);
    scattering_with(
        world,
        aspect,
        settings,
        checks,
        &AspectContext { received: None, progress: &NoProgress, meter },
    )
}

/// Context that an aspect shares with others.
#[derive(Clone, Copy)]
pub(crate) struct AspectContext<'a> {
    /// Receiver's tree, if traced before with the same settings up to their last order.
    pub(crate) received: Option<&'a BeamTree>,
    /// Receiver of the aspect's progress.
    pub(crate) progress: &'a dyn Progress,
    /// Meter of the aspect's share of the work.
    pub(crate) meter: &'a WorkMeter<'a>,
}

/// Like [`scattering`], in a shared context.
pub(crate) fn scattering_with(
    world: &World,
    aspect: &Aspect,
    settings: &AspectSettings,
    checks: Checks,
    context: &AspectContext<'_>,
) -> Result<Scattering, BartError> {
    let metered = context.meter.begin();
    let settings = &settings.seen_from(aspect);
    let mut ends = AspectTrees::new(world, aspect, context, settings)?;
    ends.grow_to(1)?;
    ends.check_open()?;
    ends.grow_to(settings.tree_order())?;
    let trace_seconds = metered.lap_s();
    let bands = settings.by_band().into_iter().map(|(indices, settings)| {
        Ok((indices, ends.scattering(aspect, &settings, checks, (context, &metered))?))
    });
    let bands = bands.collect::<Result<Vec<_>, BartError>>()?;
    Ok(Scattering { trace_seconds, beams: ends.beams(), ..Scattering::of_bands(bands) })
}

/// Trees of an aspect, grown as far as needed so far.
struct AspectTrees<'a> {
    world: &'a World,
    transmit: EndTree<'a>,
    receive: Option<EndTree<'a>>,
    zenith_h: ZenithH,
    /// Phase that the sums belong to, and the receiver of their progress.
    phase: Phase,
    progress: &'a dyn Progress,
}

impl<'a> AspectTrees<'a> {
    fn new(
        world: &'a World,
        aspect: &Aspect,
        &AspectContext { received, progress, .. }: &AspectContext<'a>,
        settings: &'a AspectSettings,
    ) -> Result<Self, BartError> {
        let tree = |antenna: Antenna| EndTree::growing(world, antenna, &settings.trace, progress);
        let transmit_h = aspect.transmit.1;
        let zenith_h =
            ZenithH { transmit: transmit_h, receive: aspect.receive.map_or(transmit_h, |(_, h)| h) };
        let of_receiver =
            |(antenna, _)| received.map_or_else(|| tree(antenna), |tree| Ok(EndTree::shared(tree)));
        let receive = aspect.receive.map(of_receiver).transpose()?;
        let wavelength_m = settings.longest_wave_m();
        let antennas = [Some(aspect.transmit), aspect.receive].into_iter().flatten();
        antennas
            .map(|(antenna, _)| antenna)
            .try_for_each(|antenna| check_antenna_position(world, antenna, wavelength_m))?;
        let transmit = tree(aspect.transmit.0)?;
        Ok(Self { world, transmit, receive, zenith_h, phase: Phase::Integrating, progress })
    }

    fn grow_to(&mut self, order: u8) -> Result<(), BartError> {
        self.transmit.grow_to(order)?;
        self.receive.as_mut().map_or(Ok(()), |tree| tree.grow_to(order))
    }

    /// Scattering in one band, without beams and the time of their trace.
    fn scattering(
        &mut self,
        aspect: &Aspect,
        settings: &AspectSettings,
        checks: Checks,
        (context, metered): (&AspectContext<'_>, &MeteredWork<'_>),
    ) -> Result<Scattering, BartError> {
        self.phase = Phase::Integrating;
        let is_measured = checks.integrals != IntegralsCheck::Skipped;
        let RequestedOrders { orders: chosen, mirrors, accuracy, finer } = self.chosen(settings, checks)?;
        let settings = &AspectSettings { accuracy, ..settings.clone() };
        let integrate_seconds = metered.lap_s();
        let [dropped_m, dropped_at_most_m] = self.dropped_m(&chosen, &mirrors, settings);
        self.phase = Phase::Checking;
        let finer_m = is_measured.then(|| self.finer(&chosen, aspect, (finer, settings))).transpose()?;
        let (other_m, left_out_power, left_out_edges) = match checks.model {
            Check::Measured => (
                Some(self.by_other_rule(&chosen, settings)?),
                self.left_out_power(settings),
                self.left_out_edges(aspect, settings, context)?,
            ),
            Check::Skipped => (None, None, None),
        };
        let whole_power = chosen.iter().map(|order| order.whole_power).sum();
        let chosen_m: Vec<Vec<Complex64>> = chosen.into_iter().map(|order| order.s_m).collect();
        let error_power = finer_m.as_ref().map(|finer_m| {
            let difference = power_between(&chosen_m, finer_m);
            checks.integrals.error_power((difference, finer), (accuracy, settings.edges), power_of(finer_m))
        });
        let taken = finer_m.filter(|_| checks.integrals == IntegralsCheck::Taken);
        // Both node rules are compared with integrals of equal fineness.
        let other_m = other_m.map(|other_m| match &taken {
            Some(finer_m) => moved(other_m, &chosen_m, finer_m),
            None => other_m,
        });
        Ok(Scattering {
            chosen_m: taken.unwrap_or(chosen_m),
            other_m,
            error_power,
            left_out_power,
            left_out_edges,
            whole_power,
            beams: Vec::new(),
            accuracy,
            dropped_m,
            dropped_at_most_m,
            trace_seconds: 0.0,
            integrate_seconds,
            check_seconds: metered.lap_s(),
        })
    }

    /// Refuses an enclosed antenna, once trees have their first order.
    fn check_open(&self) -> Result<(), BartError> {
        self.trees().into_iter().flatten().try_for_each(|tree| tree.check_open(self.world))
    }

    fn trees(&self) -> [Option<&BeamTree>; 2] {
        [Some(self.transmit.tree()), self.receive.as_ref().map(EndTree::tree)]
    }

    /// Beams by order, both ends together.
    fn beams(&self) -> Vec<u64> {
        let mut beams = Vec::new();
        for end in [Some(&self.transmit), self.receive.as_ref()].into_iter().flatten() {
            beams.resize(beams.len().max(end.beams().count()), 0);
            beams.iter_mut().zip(end.beams()).for_each(|(sum, beams)| *sum += beams);
        }
        beams
    }

    /// S by order from `from` on, then frequency.
    fn orders(
        &self,
        from: u8,
        rule: NodeRule,
        settings: &AspectSettings,
    ) -> Result<Vec<Vec<Complex64>>, BartError> {
        let scatterer = self.scatterer();
        sums(&scatterer, &meetings(&scatterer, from, rule, settings), rule, settings)
    }

    /// All orders by the requested rule, with the data for their errors.
    fn chosen(&self, settings: &AspectSettings, checks: Checks) -> Result<RequestedOrders, BartError> {
        let (scatterer, rule) = (self.scatterer(), settings.nodes);
        let needed = settings.tree_order();
        let mut mirrors = SmallMirrors::of(scatterer.trees, needed, settings.trace.least_mirror_area_m2);
        let meetings = meetings(&scatterer, 1, rule, settings);
        let settings = &settings.with_affordable_accuracy(&scatterer, &meetings, rule)?;
        let integration = settings.integration(rule);
        let of_order = |meeting: &OrderJoints| {
            let hits = mirrors.hits(&scatterer, meeting, &integration, settings.polarization);
            (of_meeting(&scatterer, meeting, rule, settings), hits)
        };
        // In parallel: while one order is weighted by one thread, others are integrated.
        let found: Vec<_> = meetings.par_iter().map(of_order).collect();
        let take = |(order, hits)| {
            mirrors.add(hits);
            order
        };
        let orders = found.into_iter().map(take).collect();
        let finer = match checks.integrals {
            IntegralsCheck::Skipped => Finer::TenTimes,
            _ => Finer::comparison(&scatterer, &meetings, &integration),
        };
        Ok(RequestedOrders { orders, mirrors, accuracy: settings.accuracy, finer })
    }

    fn scatterer(&self) -> Scatterer<'_> {
        Scatterer::new(self.world, self.joined_trees(), self.zenith_h)
            .with_progress(self.phase, self.progress)
    }

    fn joined_trees(&self) -> Trees<'_> {
        let transmit = self.transmit.tree();
        self.receive.as_ref().map_or(Trees::Shared(transmit), |tree| Trees::Apart(transmit, tree.tree()))
    }

    /// Amplitude of dropped parts, as in [`SmallMirrors::dropped_m`].
    fn dropped_m(
        &self,
        orders: &[OrderContribution],
        mirrors: &SmallMirrors,
        settings: &AspectSettings,
    ) -> [f64; 2] {
        let needed = settings.tree_order();
        let overlaps = orders.iter().map(|order| order.dropped_sections);
        mirrors.dropped_m(self.joined_trees(), overlaps, (needed, &settings.wavenumbers_per_m))
    }

    /// Whether facets are divided into tiles.
    fn are_cut(&self, aspect: &Aspect) -> bool {
        aspect.is_near() || self.world.skin_error() > 0.0
    }

    /// S by order, then frequency, with finer integrals; only with finer edges if facets are exact.
    fn finer(
        &self,
        chosen: &[OrderContribution],
        aspect: &Aspect,
        (finer, settings): (Finer, &AspectSettings),
    ) -> Result<Vec<Vec<Complex64>>, BartError> {
        // 10^⅔ times as many tiles, or somewhat more if they were few: never coarser again.
        let most_tiles = settings.most_tiles.saturating_mul(100);
        let finer =
            AspectSettings { accuracy: finer.bounds() * settings.accuracy, most_tiles, ..settings.clone() };
        if self.are_cut(aspect) {
            return self.orders(1, settings.nodes, &finer);
        }
        let scatterer = self.scatterer();
        let with_edges = |(order, of_order): (u8, &OrderContribution)| {
            let edges_m = edges_of_order(&scatterer, order, &finer);
            let both = of_order.s_m.iter().zip(of_order.edges_m.iter().zip(&edges_m));
            both.map(|(s, (coarse, fine))| s + (fine - coarse)).collect()
        };
        Ok((1..=settings.bounces).zip(chosen).map(with_edges).collect())
    }

    /// S by the other rule. Edges are no mirrors: their contribution is the same under any rule, as is what
    /// ends of double reflections take from their polygons.
    fn by_other_rule(
        &mut self,
        chosen: &[OrderContribution],
        settings: &AspectSettings,
    ) -> Result<Vec<Vec<Complex64>>, BartError> {
        let other = compared_rule(settings.nodes);
        self.grow_to(tree_order(settings.bounces, other))?;
        // A single bounce has one node.
        let mut other_m: Vec<_> = chosen.iter().take(1).map(|order| order.s_m.clone()).collect();
        let (scatterer, plain) =
            (self.scatterer(), AspectSettings { edges: Edges::Ignored, ..settings.clone() });
        let mut meetings = meetings(&scatterer, 2, other, &plain);
        if let (Some(meeting), Some(own)) = (meetings.first_mut(), chosen.get(1)) {
            own.separations.give_to(&scatterer, &mut meeting.facets);
        }
        let facets = sums(&scatterer, &meetings, other, &plain)?;
        let both = |(facets_m, order): (&Vec<Complex64>, &OrderContribution)| {
            facets_m.iter().zip(&order.edges_m).map(|(facets, edges)| facets + edges).collect()
        };
        other_m.extend(facets.iter().zip(chosen.iter().skip(1)).map(both));
        Ok(other_m)
    }

    /// Change by edges at the middle frequency, if they are omitted and cheap to compute; the trees then have
    /// the last order, since both rules have been evaluated.
    ///
    /// A face that contains the antenna in its plane has no lit polygon, and no lit edge: the antenna is then
    /// moved, as where edges are on.
    fn left_out_edges(
        &self,
        aspect: &Aspect,
        settings: &AspectSettings,
        context: &AspectContext<'_>,
    ) -> Result<Option<LeftOutEdges>, BartError> {
        let Some(settings) = settings_with_edges(settings, self.world.facets().len()) else {
            return Ok(None);
        };
        let edges = self.world.edges(settings.wavenumbers_per_m[0]);
        let Some(beside) = beside_faces(aspect, edges) else {
            return Ok(Some(left_out_edges(self.scatterer(), &settings)));
        };
        let settings = settings.seen_from(&beside);
        let context = AspectContext { received: None, ..*context };
        let mut trees = AspectTrees::new(self.world, &beside, &context, &settings)?;
        trees.grow_to(settings.tree_order())?;
        Ok(Some(left_out_edges(trees.scatterer(), &settings)))
    }

    /// Power |S|² over frequency of the order after the last, if the trees contain its nodes.
    fn left_out_power(&self, settings: &AspectSettings) -> Option<f64> {
        let order = left_out_order(settings.bounces, self.transmit.tree().audit.orders.len() as u8)?;
        let settings = AspectSettings { bounces: order, edges: Edges::Ignored, ..settings.clone() };
        let left_out_m = self.orders(order, NodeRule::Middle, &settings).ok()?.pop()?;
        Some(mean_over_frequencies(left_out_m.len(), |f| left_out_m[f]))
    }
}

/// All orders by the requested rule.
struct RequestedOrders {
    orders: Vec<OrderContribution>,
    /// Mirrors that were too small to be followed.
    mirrors: SmallMirrors,
    /// Accuracy of the integrals: the requested one, or a coarser, affordable one.
    accuracy: f64,
    /// Integrals with which these are compared: much finer ones if they have few tiles.
    finer: Finer,
}

impl Scattering {
    /// Scattering over all frequencies from that of bands, each with the indices of its frequencies.
    fn of_bands(mut bands: Vec<(Vec<usize>, Self)>) -> Self {
        if bands.len() == 1 {
            return bands.remove(0).1;
        }
        let count: usize = bands.iter().map(|(indices, _)| indices.len()).sum();
        let all = |of: fn(&Self) -> f64| bands.iter().map(move |(_, s)| of(s));
        let mean = |of: &dyn Fn(&Self) -> f64| {
            bands.iter().map(|(indices, s)| indices.len() as f64 * of(s)).sum::<f64>() / count as f64
        };
        let mean_if_known = |of: fn(&Self) -> Option<f64>| {
            bands.iter().all(|(_, s)| of(s).is_some()).then(|| mean(&|s| of(s).unwrap_or(0.0)))
        };
        let other: Option<Vec<_>> = bands.iter().map(|(i, s)| Some((i, s.other_m.as_ref()?))).collect();
        Self {
            chosen_m: of_bands(bands.iter().map(|(indices, s)| (indices, &s.chosen_m))),
            other_m: other.map(|other| of_bands(other.into_iter())),
            error_power: mean_if_known(|s| s.error_power),
            left_out_power: mean_if_known(|s| s.left_out_power),
            left_out_edges: None,
            whole_power: mean(&|s| s.whole_power),
            beams: Vec::new(),
            accuracy: all(|s| s.accuracy).fold(0.0, f64::max),
            dropped_m: mean(&|s| s.dropped_m * s.dropped_m).sqrt(),
            dropped_at_most_m: all(|s| s.dropped_at_most_m).fold(0.0, f64::max),
            trace_seconds: 0.0,
            integrate_seconds: all(|s| s.integrate_seconds).sum(),
            check_seconds: all(|s| s.check_seconds).sum(),
        }
    }

    /// Scattering amplitude of all orders at one frequency.
    pub(crate) fn total_m(&self, frequency: usize) -> Complex64 {
        total(&self.chosen_m, frequency)
    }

    /// Mean power |S|² over frequency.
    pub(crate) fn mean_power(&self) -> f64 {
        power_of(&self.chosen_m)
    }

    /// Power |S − S(other)|² over frequency.
    pub(crate) fn difference(&self, other: &Self) -> f64 {
        power_between(&self.chosen_m, &other.chosen_m)
    }

    /// Power |S − S(other)|² over frequency, first order.
    pub(crate) fn first_order_difference(&self, other: &Self) -> f64 {
        power_between(&self.chosen_m[..1], &other.chosen_m[..1])
    }

    /// Power |S(this rule) − S(the other)|² of one order (from 0) over frequency, if both are known; for
    /// double reflections including the change by evaluating them at their ends, if edges are omitted.
    pub(crate) fn order_spread_power(&self, order: usize) -> Option<f64> {
        let other_m = &self.other_m.as_ref()?[order];
        let ends_power = if order == 1 { self.ends_power() } else { 0.0 };
        let difference = |f: usize| self.chosen_m[order][f] - other_m[f];
        Some(mean_over_frequencies(other_m.len(), difference) + ends_power)
    }

    /// Power of the difference between both rules, like [`Self::order_spread_power`], for the sum over all
    /// orders.
    pub(crate) fn node_spread_power(&self) -> Option<f64> {
        self.other_m.as_ref().map(|other_m| power_between(&self.chosen_m, other_m) + self.ends_power())
    }

    fn ends_power(&self) -> f64 {
        self.left_out_edges.map_or(0.0, |edges| edges.ends_power)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::beam::TraceSettings;
    use crate::joins::scatterer::{Integration, bracket_of};
    use crate::table::joint_sum::sum_of_joints;
    use artifact::radar::Polarization;
    use artifact::scene::Mesh;
    use artifact::settings::Sides;
    use glam::DVec3;

    /// Two plates that reflect each other, seen from two positions.
    #[test]
    fn a_receiver_that_stands_still_is_traced_once_and_no_bit_changes() {
        let vertices_m =
            vec![[0.0, 0.0, 0.0], [0.4, 0.1, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.3], [0.1, 0.0, 0.6]];
        let triangles = vec![[0, 1, 2], [0, 2, 3], [0, 4, 1]];
        let world = World::of_mesh(&Mesh { vertices_m, triangles, ..Mesh::default() }).unwrap();
        let settings = |nodes: NodeRule| AspectSettings {
            trace: TraceSettings {
                max_order: 3,
                sides: Sides::Two,
                least_area_m2: 1e-9,
                least_mirror_area_m2: 1e-9,
            },
            wavenumbers_per_m: vec![1600.0, 1613.0],
            bounces: 3,
            nodes,
            edges: Edges::Ignored,
            polarization: Polarization::Vv,
            accuracy: 1e-3,
            most_tiles: u64::MAX,
        };
        let receiver = Antenna::Point(DVec3::new(3.0, 4.0, 5.0));
        for (nodes, edges) in [
            (NodeRule::Middle, Edges::Ignored),
            (NodeRule::OwnEdge, Edges::Ignored),
            (NodeRule::Exit, Edges::FirstOrder),
        ] {
            let settings = AspectSettings { edges, ..settings(nodes) };
            let tree = BeamTree::trace(&world, receiver, &settings.trace).unwrap();
            for (x, model) in [(3.0, Check::Measured), (3.5, Check::Skipped), (2.0, Check::Skipped)] {
                let transmitter = Antenna::Point(DVec3::new(x, 4.5, 4.0));
                let aspect = Aspect {
                    transmit: (transmitter, DVec3::Y),
                    receive: Some((receiver, DVec3::Y)),
                    is_along_face: false,
                };
                let checks = Checks { integrals: IntegralsCheck::Compared, model };
                let [own, shared] = [None, Some(&tree)].map(|received| {
                    let meter = &WorkMeter::new(&|| 0.0);
                    let context = AspectContext { received, progress: &NoProgress, meter };
                    let found = scattering_with(&world, &aspect, &settings, checks, &context).unwrap();
                    Scattering { trace_seconds: 0.0, integrate_seconds: 0.0, check_seconds: 0.0, ..found }
                });
                assert!(own.mean_power() > 0.0);
                assert_eq!(own.to_bytes(), shared.to_bytes(), "{nodes:?} {x} {model:?}");
            }
        }
    }

    /// D5: a body and its antenna moved by a kilometre; both the single precision of candidates and the
    /// double precision of clipping have other coordinates.
    #[test]
    fn a_scene_moved_by_a_kilometre_keeps_its_amplitude_to_1e_minus_7() {
        let corner = |shift: DVec3| {
            let at = |x: f64, y: f64, z: f64| (DVec3::new(x, y, z) + shift).to_array();
            let vertices_m =
                vec![at(0.0, 0.0, 0.0), at(0.1, 0.02, 0.0), at(0.0, 0.1, 0.01), at(0.01, 0.0, 0.1)];
            Mesh { vertices_m, triangles: vec![[0, 1, 2], [0, 2, 3], [0, 3, 1]], ..Mesh::default() }
        };
        let amplitude = |shift: DVec3| {
            let world = World::of_mesh(&corner(shift)).unwrap();
            let trace = TraceSettings {
                max_order: 2,
                sides: Sides::Two,
                least_area_m2: 1e-12,
                least_mirror_area_m2: 1e-12,
            };
            let antenna = Antenna::Point(shift + DVec3::new(14.0, 13.0, 15.0));
            let tree = BeamTree::trace(&world, antenna, &trace).unwrap();
            let h = ZenithH { transmit: DVec3::Y, receive: DVec3::Y };
            let scatterer = Scatterer::new(&world, Trees::Shared(&tree), h);
            let wavenumbers_per_m = &[1613.8];
            let integration =
                Integration { wavenumbers_per_m, accuracy: 1e-3, bracket: bracket_of(NodeRule::Middle) };
            let of = |order: u8| {
                let joints = scatterer.joints(order, NodeRule::Middle, 1e-12);
                sum_of_joints(&scatterer, &joints, shift, &integration)[0][0][0]
            };
            (1..=3).map(of).sum::<Complex64>()
        };
        let here = amplitude(DVec3::ZERO);
        let there = amplitude(DVec3::new(600.0, -800.0, 0.0));
        let error = (there - here).norm() / here.norm();
        println!("D5: asked 1e-7, got {error:.1e}");
        assert!(here.norm() > 1e-3 && error < 1e-7);
    }
}
