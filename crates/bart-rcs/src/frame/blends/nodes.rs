//! Paths of some sequences of bodies, traced at the nodes of one axis.
//!
//! The nodes lie on a grid of equal steps h from the start of the axis to its end, refined until the measured
//! error meets the requested accuracy; results of a coarser grid are reused. Between two nodes a blend errs
//! by u(1−u)(1+u)(2−u)·h⁴f⁗/24, u from 0 to 1, in the first and last step by u(1−u)(2−u)(3−u)·h⁴f⁗/24. The
//! error of each of the grids at the moment of the check equals that over the frame to within 1.4 dB
//! (verified by a test).

use crate::beams::body_sequences::BodySequences;
use crate::frame::band_power::mean_difference;
use crate::frame::blends::axis::{BlendAxis, FINEST, LOOKED_AT, SHARE_OF_LOOKS};
use crate::frame::blends::changing_sequences::{FIELD_FREQUENCIES, bodies, changing_sequences, field};
use crate::frame::path_pruning::pruned_alike;
use crate::frame::path_sum::PathView;
use crate::frame::path_table::{paths_along, paths_bytes};
use crate::frame::snapshot::{BlendNode, TracedScene};
use crate::run_control::error::BartError;
use crate::run_control::progress::Phase;
use artifact::paths::{Fineness, Path};
use num_complex::Complex64;
use std::collections::BTreeMap;

/// Scene, fineness and dropped powers common to all nodes of a frame.
pub(super) struct BlendContext<'a> {
    pub(super) scenery: &'a TracedScene<'a>,
    pub(super) fineness: &'a Fineness,
    pub(super) strongest_dropped: &'a [f64],
    /// Number of the middle's paths.
    pub(super) of_middle: usize,
}

/// Paths of some sequences at the nodes of one axis.
pub(super) struct BlendNodes<'a> {
    context: &'a BlendContext<'a>,
    pub(super) axis: BlendAxis,
    /// Sequences traced at all nodes; all existing ones if none are named.
    pub(super) ways: BodySequences,
    /// Number of steps of the blended grid.
    pub(super) steps: u32,
    /// Paths by place, in units of 1/[`FINEST`] of the axis.
    at: BTreeMap<u32, Vec<Path>>,
    /// Peak memory of the tracing, bytes.
    pub(super) bytes: u64,
}

impl<'a> BlendNodes<'a> {
    /// Paths of some sequences at the middle, before any other node.
    pub(super) fn of(
        context: &'a BlendContext<'a>,
        axis: BlendAxis,
        ways: BodySequences,
        middle: &[Path],
    ) -> Self {
        let own = middle.iter().filter(|path| ways.contains(&bodies(path))).copied().collect();
        Self { context, axis, ways, steps: 0, at: BTreeMap::from([(FINEST / 2, own)]), bytes: 0 }
    }

    /// Traces two other nodes of an axis for the sequences that differ there from those in `middle`, with
    /// this number of paths of other nodes held.
    pub(super) fn probed(
        context: &'a BlendContext<'a>,
        axis: BlendAxis,
        middle: &[Path],
        (measured, others): (f64, usize),
    ) -> Result<Self, BartError> {
        let mut looks = Self::of(context, axis, BodySequences::default(), &[]);
        for place in LOOKED_AT {
            let paths = looks.traced(place, others)?;
            looks.at.insert(place, paths);
        }
        let others = LOOKED_AT.map(|place| (looks.view(place), looks.at[&place].as_slice()));
        let ways = changing_sequences(context.scenery.plan, middle, measured, others);
        let mut nodes = Self { bytes: looks.bytes, ..Self::of(context, axis, ways, middle) };
        for place in LOOKED_AT {
            let mut paths = looks.at.remove(&place).unwrap_or_default();
            paths.retain(|path| nodes.ways.contains(&bodies(path)));
            nodes.at.insert(place, paths);
        }
        Ok(nodes)
    }

    /// Traces the missing nodes of a grid, with this number of paths of other nodes held.
    pub(super) fn fill(&mut self, steps: u32, others: usize) -> Result<(), BartError> {
        for place in (0..=steps).map(|i| i * (FINEST / steps)) {
            if !self.at.contains_key(&place) {
                let paths = self.traced(place, others)?;
                self.at.insert(place, paths);
            }
        }
        self.steps = steps;
        Ok(())
    }

    /// Paths of a place, with this number of paths of other nodes held.
    fn traced(&mut self, place: u32, others: usize) -> Result<Vec<Path>, BartError> {
        let BlendContext { scenery, fineness, strongest_dropped, of_middle } = self.context;
        let plan = scenery.plan;
        let (seconds, ends_m) = self.axis.at(plan, place);
        let ways = (!self.ways.is_empty()).then_some(&self.ways);
        // Including the blends made of them, two of which are compared.
        let beside = scenery.with_held_bytes(3 * paths_bytes(self.paths() + others + of_middle));
        let node = BlendNode { ways, seconds, ends_m };
        let snapshot = beside.at_node(&node)?;
        self.bytes = self.bytes.max(snapshot.bytes());
        let paths = paths_along(&beside, &snapshot.scatterer(plan, Phase::Tracing), fineness, &node)?;
        Ok(pruned_alike(paths, plan, &snapshot.world, strongest_dropped))
    }

    /// Number of paths of all nodes.
    pub(super) fn paths(&self) -> usize {
        self.at.values().map(Vec::len).sum()
    }

    /// Number of the middle's paths.
    pub(super) fn of_middle(&self) -> usize {
        self.at.get(&(FINEST / 2)).map_or(0, Vec::len)
    }

    /// Mean power of the error of a grid's blend halfway between its nodes, where all are traced.
    pub(super) fn missed_halfway(&self, steps: u32) -> f64 {
        let places = (0..steps).map(|i| (2 * i + 1) * (FINEST / (2 * steps)));
        places.map(|place| self.missed(place, steps)).sum::<f64>() / f64::from(steps)
    }

    /// Mean power over the frame of the blend's error beyond that shown by the check, from the probed places:
    /// none if these are nodes of the grid.
    pub(super) fn missed_beside_check(&self) -> f64 {
        let between = LOOKED_AT.into_iter().filter(|place| place % (FINEST / self.steps) != 0);
        let missed: f64 = between.map(|place| self.missed(place, self.steps)).sum();
        SHARE_OF_LOOKS * missed / LOOKED_AT.len() as f64
    }

    /// Power of the error of a grid's blend at a traced place.
    fn missed(&self, place: u32, steps: u32) -> f64 {
        let view = self.view(place);
        let exact = field(self.at.get(&place), self.context.scenery.plan, &view);
        mean_difference(&exact, &self.blended_field(steps, &view))
    }

    /// S of a grid's blend over the band, from the nodes that have a share in it there.
    fn blended_field(&self, steps: u32, view: &PathView) -> Vec<Complex64> {
        let plan = self.context.scenery.plan;
        let mut total = vec![Complex64::ZERO; FIELD_FREQUENCIES];
        for node in 0..=steps {
            let share = self.axis.share(plan, view, (node, steps));
            if share != 0.0 {
                let of = field(self.at.get(&(node * (FINEST / steps))), plan, view);
                total.iter_mut().zip(of).for_each(|(total, of)| *total += share * of);
            }
        }
        total
    }

    /// Paths of the grid's nodes, node by node.
    pub(super) fn blended(&self) -> impl Iterator<Item = Path> {
        let plan = self.context.scenery.plan;
        (0..=self.steps).flat_map(move |node| {
            let paths = self.at.get(&(node * (FINEST / self.steps))).into_iter().flatten();
            paths.map(move |path| self.axis.part(plan, *path, (node, self.steps)))
        })
    }

    fn view(&self, place: u32) -> PathView {
        let plan = self.context.scenery.plan;
        let (seconds, ends_m) = self.axis.at(plan, place);
        plan.view_from(ends_m, seconds)
    }
}
