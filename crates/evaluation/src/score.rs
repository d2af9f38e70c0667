//! Agreement of objects and tracks with the ground truth over a run. Only reports use it: no processing
//! behind the radar cube does.
//!
//! Truths of a frame are the bodies that return any echo from within the radar's range, without clutter:
//! detections of clutter count as false. Objects of single frames give the places of reflections, and are
//! paired with the nearest parts of bodies ([`Pairing`]); tracks give the places of bodies, and the middles
//! of their boxes are compared with the middles of bodies. Bodies whose echoes were removed as echoes at rest
//! do not count, nor do objects at rest that belong to nobody and tracks that have no others.

use crate::frame_truth::FrameTruth;
use crate::metrics::distances::squares_m2;
use crate::metrics::gospa::{Gospa, gospa};
use crate::metrics::identities::Identities;
use crate::metrics::ospa::ospa_m;
use crate::pairing::{GATE_M, Pairing};
use crate::truth::Truth;
use artifact::points::Object;
use artifact::tracks::{Track, TrackState, TracksFrame};
use glam::DVec2;
use ndarray::{Array2, ArrayView2, Axis};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// Cut-off c of GOSPA and OSPA of tracks: the largest distance between the middles of a track's box and its
/// body. Half a bus is 6 m.
pub const CUTOFF_M: f64 = 6.0;

/// Sums over all frames so far.
#[derive(Debug, Clone, Default)]
pub struct Score {
    frames: u32,
    objects: Sums,
    tracks: Sums,
    identities: Identities,
    ids: BTreeSet<u32>,
}

/// Agreement of objects and tracks with the truth: `metrics` of `summary.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Metrics {
    /// Cut-off c of GOSPA and OSPA of tracks, m.
    pub cutoff_m: f64,
    /// Objects of single frames.
    pub objects: Agreement,
    /// Confirmed and coasted tracks.
    pub tracks: Agreement,
    /// Whether bodies keep their tracks.
    pub identities: IdentityMetrics,
}

/// Agreement of one kind of estimates with the truth; means are over frames and `None` without frames.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Agreement {
    /// Cut-off c of these metrics, m.
    pub cutoff_m: f64,
    /// Mean GOSPA, m.
    pub gospa_m: Option<f64>,
    /// Mean OSPA, m.
    pub ospa_m: Option<f64>,
    /// Root mean square distance of pairs, m.
    pub localisation_rms_m: Option<f64>,
    /// Truths with an estimate, over all frames.
    pub found: usize,
    /// Truths without one.
    pub missed: usize,
    /// Estimates without a truth.
    #[serde(rename = "false")]
    pub false_ones: usize,
    /// Estimates at rest that belong to nobody and do not count as false.
    pub stationary: usize,
    /// Truths whose echoes were removed as echoes at rest, which do not count as missed.
    pub removed: usize,
    /// Share of found bodies in a lane whose estimate is in the same one.
    pub lane_rate: Option<f64>,
}

/// Track continuity: whether a body keeps its track and a track its body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IdentityMetrics {
    /// Bodies that had a track in some frame.
    pub bodies: usize,
    /// Confirmed and coasting tracks.
    pub tracks: usize,
    /// Frames in which a body has another track than it last had.
    pub switches: u32,
    /// Share of the frames of tracks in which they follow the body that they follow most.
    pub purity: Option<f64>,
}

/// Sums over frames.
#[derive(Debug, Clone, Default)]
struct Sums {
    gospa_m: f64,
    ospa_m: f64,
    localisation_m2: f64,
    pairs: usize,
    missed: usize,
    false_ones: usize,
    stationary: usize,
    removed: usize,
    lanes: usize,
    lanes_right: usize,
}

/// Confirmed and coasting tracks.
pub fn confirmed_tracks(tracks: &TracksFrame) -> Vec<&Track> {
    tracks.tracks.iter().filter(|t| t.state != TrackState::Tentative).collect()
}

/// Index of each such track's body among the truths, as paired by the metric.
pub fn bodies_of_tracks(truth: &FrameTruth, tracks: &[&Track]) -> Vec<Option<usize>> {
    let pairs = gospa(of_tracks(truth, tracks).view(), CUTOFF_M).chosen;
    let body_of =
        |track: usize| pairs.iter().position(|t| *t == Some(track)).map(|row| truth.pairing.expected[row]);
    (0..tracks.len()).map(body_of).collect()
}

/// Squared distances between the middles of boxes and of bodies, `[body, track]`.
fn of_tracks(truth: &FrameTruth, tracks: &[&Track]) -> Array2<f64> {
    let bodies: Vec<DVec2> = expected(truth).map(|body| body.position_m.truncate()).collect();
    let boxes: Vec<DVec2> = tracks.iter().map(|t| DVec2::from(t.footprint.centre_m)).collect();
    squares_m2(&bodies, &boxes)
}

/// Bodies that should be found.
fn expected(truth: &FrameTruth) -> impl Iterator<Item = &Truth> {
    truth.pairing.expected.iter().map(|index| &truth.truths[*index])
}

impl Score {
    /// Adds one frame.
    pub fn add(&mut self, truth: &FrameTruth, objects: &[Object], tracks: &TracksFrame) {
        let tracks = confirmed_tracks(tracks);
        self.frames += 1;
        let Pairing { squares_m2, gospa: of_objects, stationary, removed, .. } = &truth.pairing;
        self.objects.add(squares_m2.view(), of_objects, GATE_M);
        self.objects.add_excluded(stationary.len(), removed.len());
        let lanes = of_objects.chosen.iter().zip(expected(truth));
        self.objects.add_lanes(lanes.filter_map(|(o, body)| Some((body.lane?, objects[(*o)?].lane))));
        let squares_m2 = of_tracks(truth, &tracks);
        let pairs = gospa(squares_m2.view(), CUTOFF_M);
        let is_apart =
            |t: &usize| !pairs.chosen.contains(&Some(*t)) && truth.pairing.is_stationary(tracks[*t]);
        let (apart, kept): (Vec<usize>, Vec<usize>) = (0..tracks.len()).partition(is_apart);
        let pairs = pairs.without(&[], apart.len());
        self.tracks.add(squares_m2.select(Axis(1), &kept).view(), &pairs, CUTOFF_M);
        self.tracks.add_excluded(apart.len(), removed.len());
        let lanes = pairs.chosen.iter().zip(expected(truth));
        self.tracks.add_lanes(lanes.filter_map(|(t, body)| Some((body.lane?, tracks[(*t)?].lane))));
        for (track, body) in pairs.chosen.iter().zip(&truth.pairing.expected) {
            if let Some(track) = track {
                self.identities.pair(truth.number_of(*body), tracks[*track].id);
            }
        }
        self.ids.extend(tracks.iter().map(|t| t.id));
    }

    /// Metrics of all frames so far.
    pub fn metrics(&self) -> Metrics {
        Metrics {
            cutoff_m: CUTOFF_M,
            objects: self.objects.agreement(self.frames, GATE_M),
            tracks: self.tracks.agreement(self.frames, CUTOFF_M),
            identities: IdentityMetrics {
                bodies: self.identities.bodies(),
                tracks: self.ids.len(),
                switches: self.identities.switches(),
                purity: self.identities.purity(),
            },
        }
    }
}

impl Sums {
    fn add(&mut self, squares_m2: ArrayView2<f64>, parts: &Gospa, cutoff_m: f64) {
        self.gospa_m += parts.distance_m();
        self.ospa_m += ospa_m(squares_m2, cutoff_m);
        self.localisation_m2 += parts.localisation_m2;
        self.pairs += squares_m2.nrows() - parts.missed;
        self.missed += parts.missed;
        self.false_ones += parts.false_ones;
    }

    /// Counts what the metrics leave out: estimates at rest that belong to nobody, and truths whose echoes
    /// were removed.
    fn add_excluded(&mut self, stationary: usize, removed: usize) {
        self.stationary += stationary;
        self.removed += removed;
    }

    /// Adds pairs of a true and an estimated lane, without bodies outside all lanes.
    fn add_lanes(&mut self, pairs: impl Iterator<Item = (u8, Option<u8>)>) {
        for (asked, got) in pairs {
            self.lanes += 1;
            self.lanes_right += usize::from(got == Some(asked));
        }
    }

    fn agreement(&self, frames: u32, cutoff_m: f64) -> Agreement {
        let mean = |sum: f64, count: f64| (count > 0.0).then(|| sum / count);
        Agreement {
            cutoff_m,
            gospa_m: mean(self.gospa_m, f64::from(frames)),
            ospa_m: mean(self.ospa_m, f64::from(frames)),
            localisation_rms_m: mean(self.localisation_m2, self.pairs as f64).map(f64::sqrt),
            found: self.pairs,
            missed: self.missed,
            false_ones: self.false_ones,
            stationary: self.stationary,
            removed: self.removed,
            lane_rate: mean(self.lanes_right as f64, self.lanes as f64),
        }
    }
}
