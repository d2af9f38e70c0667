//! BART's amplitudes, as they are put beside the references.

use artifact::Accuracy;
use artifact::paths::Amplitude;
use artifact::radar::Polarization;
use artifact::scene::Mesh;
use artifact::settings::{Edges, NodeRule};
use bart_rcs::{RcsRequest, Standpoint, rcs};
use num_complex::Complex64;

/// The frequency of most references.
pub(crate) const FREQUENCY_HZ: f64 = 77e9;

/// Relative error asked: the tightest gate on S, 1e-3 of a cut's peak.
const ACCURACY_DB: f64 = -60.0;

/// An antenna at azimuth, elevation and range.
pub(crate) fn antenna(az_deg: f64, el_deg: f64, range_m: f64) -> Standpoint {
    Standpoint { azimuth_rad: az_deg.to_radians(), elevation_rad: el_deg.to_radians(), range_m }
}

/// S of bounce orders 1 to `bounces` in vv and hh (and vh where `cross`), `[antenna][order − 1]`; one antenna
/// sends and receives.
pub(crate) struct Bart<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) frequency_hz: f64,
    pub(crate) bounces: u8,
    pub(crate) nodes: NodeRule,
    pub(crate) edges: Edges,
    pub(crate) accuracy_db: f64,
}

impl<'a> Bart<'a> {
    /// First order at 77 GHz.
    pub(crate) fn first_order(mesh: &'a Mesh) -> Self {
        Self::bounces(mesh, 1)
    }

    /// Orders up to `bounces` at 77 GHz, middle nodes.
    pub(crate) fn bounces(mesh: &'a Mesh, bounces: u8) -> Self {
        Self {
            mesh,
            frequency_hz: FREQUENCY_HZ,
            bounces,
            nodes: NodeRule::Middle,
            edges: Edges::Ignored,
            accuracy_db: ACCURACY_DB,
        }
    }

    /// First order with edges, as exact as a mean over decibels asks for.
    pub(crate) fn with_edges(mesh: &'a Mesh) -> Self {
        Self { edges: Edges::FirstOrder, accuracy_db: -50.0, ..Self::first_order(mesh) }
    }

    /// S in vv and hh at every antenna: `[antenna][order − 1]`; vh and hv stay 0.
    pub(crate) fn orders(&self, antennas: &[Standpoint]) -> Vec<Vec<Amplitude>> {
        self.elements(antennas, &[Polarization::Vv, Polarization::Hh])
    }

    /// S as [`Self::orders`] gives it, of the elements asked for.
    pub(crate) fn elements(&self, antennas: &[Standpoint], elements: &[Polarization]) -> Vec<Vec<Amplitude>> {
        let mut all = vec![vec![Amplitude::default(); usize::from(self.bounces)]; antennas.len()];
        let mut start = 0;
        for run in antennas.chunk_by(|a, b| (a.elevation_rad, a.range_m) == (b.elevation_rad, b.range_m)) {
            for polarization in elements {
                let (p, q) = polarization.indices();
                for (order, of_run) in self.by_order(run, *polarization).iter().enumerate() {
                    of_run.iter().enumerate().for_each(|(i, s)| all[start + i][order][p][q] = *s);
                }
            }
            start += run.len();
        }
        all
    }

    /// `[order − 1][antenna]` of antennas at one elevation and range.
    fn by_order(&self, run: &[Standpoint], polarization: Polarization) -> Vec<Vec<Complex64>> {
        let request = RcsRequest {
            range_m: run[0].range_m,
            polarization,
            bounces: self.bounces,
            nodes: self.nodes,
            edges: self.edges,
            accuracy: Accuracy::from_db(self.accuracy_db),
            ..RcsRequest::over(
                vec![self.frequency_hz],
                vec![run[0].elevation_rad],
                run.iter().map(|a| a.azimuth_rad).collect(),
            )
        };
        rcs(self.mesh, &request, &|_, _| {}).unwrap().by_order_m
    }

    /// First order in vv.
    pub(crate) fn vv(&self, antennas: &[Standpoint]) -> Vec<Complex64> {
        self.elements(antennas, &[Polarization::Vv]).iter().map(|orders| orders[0][0][0]).collect()
    }
}

/// Sum over orders.
pub(crate) fn sum(orders: &[Amplitude]) -> Amplitude {
    let mut total = Amplitude::default();
    for order in orders {
        total.iter_mut().flatten().zip(order.iter().flatten()).for_each(|(to, from)| *to += from);
    }
    total
}
