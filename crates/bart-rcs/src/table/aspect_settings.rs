//! Settings for tracing and integrating aspects, and the measurements made in addition to S.

use crate::beams::beam::TraceSettings;
use crate::bodies::stand_off::distance_and_diagonal_m;
use crate::edges::lit_edge::tree_order_with;
use crate::joins::affordable_accuracy::{FAR_FINER, affordable_accuracy, are_few_tiles};
use crate::joins::join::tree_order;
use crate::joins::scatterer::{Integration, Scatterer, bracket_of};
use crate::mesh::wedges::edge_band::by_band;
use crate::run_control::error::BartError;
use crate::table::order_joints::{JointSettings, OrderJoints};
use crate::table::rcs_request::Aspect;
use artifact::radar::Polarization;
use artifact::settings::{Edges, NodeRule};

/// Settings common to all aspects.
#[derive(Debug, Clone)]
pub(crate) struct AspectSettings {
    pub(crate) trace: TraceSettings,
    pub(crate) wavenumbers_per_m: Vec<f64>,
    pub(crate) bounces: u8,
    pub(crate) nodes: NodeRule,
    pub(crate) edges: Edges,
    pub(crate) polarization: Polarization,
    /// Accuracy of every node integral.
    pub(crate) accuracy: f64,
    /// Maximum number of tiles of an aspect's integrals, beyond which they are coarser: their error is
    /// measured, and if it exceeds the request they are made finer, with more tiles.
    pub(crate) most_tiles: u64,
}

impl AspectSettings {
    /// Settings for tracing an aspect: along a face no sliver is dropped.
    pub(crate) fn seen_from(&self, aspect: &Aspect) -> Self {
        let least_area_m2 = if aspect.is_along_face { 0.0 } else { self.trace.least_area_m2 };
        Self { trace: TraceSettings { least_area_m2, ..self.trace }, ..self.clone() }
    }

    /// Settings for each band in which edges are the same, with the indices of its frequencies; all together
    /// without edges.
    pub(crate) fn by_band(&self) -> Vec<(Vec<usize>, Self)> {
        let mut bands = by_band(&self.wavenumbers_per_m);
        if self.edges == Edges::Ignored || bands.is_empty() {
            bands = vec![(0..self.wavenumbers_per_m.len()).collect()];
        }
        let of_band = |indices: Vec<usize>| {
            let wavenumbers_per_m = indices.iter().map(|index| self.wavenumbers_per_m[*index]).collect();
            (indices, Self { wavenumbers_per_m, ..self.clone() })
        };
        bands.into_iter().map(of_band).collect()
    }

    /// Maximum order of beams needed by the requested rule.
    pub(crate) fn tree_order(&self) -> u8 {
        tree_order_with(self.edges, self.bounces, self.nodes)
    }

    /// Wavelength at the lowest frequency.
    pub(crate) fn longest_wave_m(&self) -> f64 {
        std::f64::consts::TAU / self.wavenumbers_per_m.iter().copied().fold(f64::INFINITY, f64::min)
    }

    pub(crate) fn meeting(&self, nodes: NodeRule) -> JointSettings {
        let wavenumber_per_m = self.wavenumbers_per_m.iter().copied().fold(0.0, f64::max);
        let least_area_m2 = self.trace.least_area_m2;
        JointSettings { nodes, edges: self.edges, least_area_m2, wavenumber_per_m }
    }

    /// Settings with coarser integrals if these would have too many tiles.
    pub(crate) fn with_affordable_accuracy(
        &self,
        scatterer: &Scatterer<'_>,
        meetings: &[OrderJoints],
        rule: NodeRule,
    ) -> Result<Self, BartError> {
        // A plane wave over a flat polygon is integrated as a whole.
        let is_flat = scatterer.world.skin_error() == 0.0;
        if is_flat && (scatterer.is_far() || self.is_cheap(scatterer)) {
            return Ok(self.clone());
        }
        let joints = meetings.iter().map(|meeting| &meeting.facets);
        let accuracy = affordable_accuracy(scatterer, joints, &self.integration(rule), self.most_tiles)?;
        Ok(Self { accuracy, ..self.clone() })
    }

    /// Whether antennas are so far away that flat facets never have too many tiles, which then need not be
    /// counted: there are about as many tiles as Fresnel zones, kD²/r, and a hundred at most for each at this
    /// accuracy.
    fn is_cheap(&self, scatterer: &Scatterer<'_>) -> bool {
        const FRESNEL_ZONES: f64 = 2e4;
        const ACCURACY: f64 = 1e-3;
        const DIAGONALS: f64 = 2.0;
        let highest_per_m = self.wavenumbers_per_m.iter().copied().fold(0.0, f64::max);
        let ends = [scatterer.trees.transmit().antenna, scatterer.trees.receive().antenna];
        self.accuracy >= ACCURACY
            && ends.into_iter().all(|antenna| {
                let (distance_m, diagonal_m) = distance_and_diagonal_m(scatterer.world, antenna);
                let zones = highest_per_m * diagonal_m * (diagonal_m / distance_m);
                distance_m >= DIAGONALS * diagonal_m && zones <= FRESNEL_ZONES
            })
    }

    pub(crate) fn integration(&self, nodes: NodeRule) -> Integration<'_> {
        Integration {
            wavenumbers_per_m: &self.wavenumbers_per_m,
            accuracy: self.accuracy,
            bracket: bracket_of(nodes),
        }
    }
}

/// Measurements at an aspect in addition to S.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Checks {
    /// Comparison of the integrals with ones ten times finer.
    pub(crate) integrals: IntegralsCheck,
    /// Comparison of the node rule with the other one, and the contribution of the order after the last.
    pub(crate) model: Check,
}

/// Maximum number of edges for much finer integrals.
const FAR_FINER_EDGES: usize = 1024;

/// Integrals with which those of an aspect are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Finer {
    /// Bounds of a tenth.
    TenTimes,
    /// Bounds of [`FAR_FINER`], for few tiles.
    Far,
}

impl Finer {
    /// Comparison integrals for some meetings: much finer ones if facets have few tiles.
    pub(crate) fn comparison(
        scatterer: &Scatterer<'_>,
        meetings: &[OrderJoints],
        integration: &Integration<'_>,
    ) -> Self {
        let facets = meetings.iter().map(|meeting| &meeting.facets);
        let edges: usize = meetings.iter().map(OrderJoints::edges).sum();
        // A plane wave over a flat polygon is integrated as a whole.
        let is_cut = !scatterer.is_far() || scatterer.world.skin_error() > 0.0;
        let are_few = if is_cut {
            edges <= FAR_FINER_EDGES && are_few_tiles(scatterer, facets, integration)
        } else {
            (1..=FAR_FINER_EDGES).contains(&edges)
        };
        if are_few { Self::Far } else { Self::TenTimes }
    }

    /// Ratio of the bounds to those of the coarser ones.
    pub(crate) fn bounds(self) -> f64 {
        match self {
            Self::TenTimes => 0.1,
            Self::Far => FAR_FINER,
        }
    }
}

/// Use of finer integrals.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum IntegralsCheck {
    /// Finer integrals are not computed.
    Skipped,
    /// Finer integrals measure the error of the coarser ones.
    Compared,
    /// Finer integrals are the result, with its error from the difference to the coarser ones.
    Taken,
}

impl IntegralsCheck {
    /// Power of the error of a result with power `power`, from that of the difference between both integrals,
    /// the coarser with bounds of `accuracy` on every tile.
    ///
    /// If everything that errs is made finer, the coarser err by 1/(1 − 0.1) of the difference at most. For
    /// the finer ones half of it is taken, and with edges three quarters: over random vehicles they erred by
    /// 7 to 27 dB less than the difference, with edges by 3 dB and more; the coarser then err by 1.75 of it.
    /// Polygons whose bounds were already a tenth of `accuracy` are unchanged and err in both: by a twentieth
    /// of their bounds, since bounds exceed errors by that much. Much finer ones over facets alone err by ten
    /// times the ratio of the bounds at most (plates in their sidelobes: by less than that ratio), with few
    /// edges by an eighth of the difference and less, at near range by a third (plates, boxes, wedges and
    /// assemblies of them, 600 in all): a half is taken.
    pub(crate) fn error_power(
        self,
        (difference, finer): (f64, Finer),
        (accuracy, edges): (f64, Edges),
        power: f64,
    ) -> f64 {
        const IN_BOTH: f64 = 0.1 * 0.05;
        let over_difference = match (self, edges) {
            (Self::Taken, Edges::Ignored) if finer == Finer::Far => 10.0 * FAR_FINER,
            (Self::Taken, Edges::Ignored) => 0.5,
            (Self::Taken, Edges::FirstOrder) if finer == Finer::Far => 0.5,
            (Self::Taken, Edges::FirstOrder) => 0.75,
            (_, Edges::Ignored) => 1.0 / (1.0 - 0.1),
            (_, Edges::FirstOrder) => 1.75,
        };
        over_difference * over_difference * difference + (IN_BOTH * accuracy).powi(2) * power
    }
}

/// Whether a measurement is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Check {
    Measured,
    Skipped,
}

/// Order after the last requested one, if trees of `tree_orders` contain its middle nodes: after every order
/// but the first.
pub(crate) fn left_out_order(bounces: u8, tree_orders: u8) -> Option<u8> {
    Some(bounces + 1).filter(|order| bounces > 0 && tree_order(*order, NodeRule::Middle) <= tree_orders)
}

/// Rule with which a run is compared.
pub(crate) fn compared_rule(rule: NodeRule) -> NodeRule {
    match rule {
        NodeRule::Middle | NodeRule::OwnEdge => NodeRule::Exit,
        NodeRule::Exit => NodeRule::Middle,
    }
}
