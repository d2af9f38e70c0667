//! How well objects and tracks agree with the truth over a run. Only reports come here: nothing behind the
//! radar cube reads it.
//!
//! Truths of a frame are the bodies that send back any echo from within the radar's range, clutter left out:
//! what is found of it counts as false. Objects of single frames say where something reflects, and are paired
//! with the nearest parts of bodies ([`crate::evaluation::pairing`]); tracks say where a body stands, and the
//! middles of their boxes are compared with the middles of bodies. Neither bodies whose echoes were removed
//! as echoes at rest count, nor objects at rest that are nobody's and tracks that have no others.

mod distances;
pub(crate) mod gospa;
mod identities;
mod ospa;

use crate::evaluation::frame_truth::FrameTruth;
use crate::evaluation::pairing::{GATE_M, Pairing};
use crate::evaluation::truth::Truth;
use artifact::points::Object;
use artifact::tracks::{Track, TrackState, TracksFrame};
use distances::squares_m2;
use glam::DVec2;
use gospa::{Gospa, gospa};
use identities::Identities;
use ndarray::{Array2, ArrayView2, Axis};
use ospa::ospa_m;
use serde::{Deserialize, Serialize};

/// c of GOSPA and OSPA of tracks: a box whose middle is further from a body's middle than this is another's.
/// Half of a bus is 6 m.
const CUTOFF_M: f64 = 6.0;

/// How well objects and tracks agree with the truth over all frames.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Metrics {
    /// That of the tracks, m.
    pub cutoff_m: f64,
    /// Of single frames.
    pub objects: Agreement,
    /// Those that are believed.
    pub tracks: Agreement,
    /// Whether a body keeps its track.
    pub identities: IdentityMetrics,
}

/// How well estimates agree with bodies: means over frames, and numbers added up over frames.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Agreement {
    /// c of GOSPA and OSPA, m.
    pub cutoff_m: f64,
    /// m, with α = 2 and p = 2; `None` without frames.
    pub gospa_m: Option<f64>,
    /// m, with p = 2; `None` without frames.
    pub ospa_m: Option<f64>,
    /// Distance in pairs, rms over all of them, m; `None` without any.
    pub localisation_rms_m: Option<f64>,
    /// Pairs.
    pub found: usize,
    /// Bodies without an estimate.
    pub missed: usize,
    /// Estimates without a body.
    #[serde(rename = "false")]
    pub false_ones: usize,
    /// Estimates at rest that are nobody's; they do not count as false.
    pub stationary: usize,
    /// Bodies whose echoes were removed as echoes at rest; they do not count as missed.
    pub removed: usize,
    /// Share in the right lane of the pairs whose body is in a lane; `None` where none is.
    pub lane_rate: Option<f64>,
}

/// Whether a body keeps its track and a track its body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IdentityMetrics {
    /// Bodies that had a track in some frame.
    pub bodies: usize,
    /// Tracks that were believed in some frame.
    pub tracks: usize,
    /// How often a body changed its track.
    pub switches: u32,
    /// Share of a track's frames that belong to its commonest body, over all tracks; `None` without pairs.
    pub purity: Option<f64>,
}

/// What was found over all frames so far.
#[derive(Debug, Clone, Default)]
pub(crate) struct Score {
    frames: u32,
    objects: Sums,
    tracks: Sums,
    identities: Identities,
    ids: std::collections::BTreeSet<u32>,
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

/// Tracks that are believed.
pub(crate) fn believed(tracks: &TracksFrame) -> Vec<&Track> {
    tracks.tracks.iter().filter(|t| t.state != TrackState::Tentative).collect()
}

/// For each believed track the place of its body among the truths, as the metric pairs them.
pub(crate) fn bodies_of_tracks(truth: &FrameTruth, tracks: &[&Track]) -> Vec<Option<usize>> {
    let pairs = gospa(of_tracks(truth, tracks).view(), CUTOFF_M).chosen;
    let body_of =
        |track: usize| pairs.iter().position(|t| *t == Some(track)).map(|row| truth.pairing.shown[row]);
    (0..tracks.len()).map(body_of).collect()
}

/// Squared distances of the middles of boxes from those of bodies, `[body, track]`.
fn of_tracks(truth: &FrameTruth, tracks: &[&Track]) -> Array2<f64> {
    let bodies: Vec<DVec2> = shown(truth).map(|body| body.position_m.truncate()).collect();
    let boxes: Vec<DVec2> = tracks.iter().map(|t| DVec2::from(t.footprint.centre_m)).collect();
    squares_m2(&bodies, &boxes)
}

/// Bodies that are to be found.
fn shown(truth: &FrameTruth) -> impl Iterator<Item = &Truth> {
    truth.pairing.shown.iter().map(|index| &truth.truths[*index])
}

impl Score {
    /// Takes in one frame; `body_of` numbers the bodies of its truths through the whole run.
    pub(crate) fn add(
        &mut self,
        truth: &FrameTruth,
        body_of: impl Fn(usize) -> u32,
        objects: &[Object],
        tracks: &TracksFrame,
    ) {
        let tracks = believed(tracks);
        self.frames += 1;
        let Pairing { squares_m2, gospa: of_objects, standing, removed, .. } = &truth.pairing;
        self.objects.add(squares_m2.view(), of_objects, GATE_M);
        self.objects.add_apart(standing.len(), removed.len());
        let lanes = of_objects.chosen.iter().zip(shown(truth));
        self.objects.add_lanes(lanes.filter_map(|(o, body)| Some((body.lane?, objects[(*o)?].lane))));
        let squares_m2 = of_tracks(truth, &tracks);
        let pairs = gospa(squares_m2.view(), CUTOFF_M);
        let is_apart = |t: &usize| !pairs.chosen.contains(&Some(*t)) && truth.pairing.is_standing(tracks[*t]);
        let (apart, kept): (Vec<usize>, Vec<usize>) = (0..tracks.len()).partition(is_apart);
        let pairs = pairs.without(&[], apart.len());
        self.tracks.add(squares_m2.select(Axis(1), &kept).view(), &pairs, CUTOFF_M);
        self.tracks.add_apart(apart.len(), removed.len());
        let lanes = pairs.chosen.iter().zip(shown(truth));
        self.tracks.add_lanes(lanes.filter_map(|(t, body)| Some((body.lane?, tracks[(*t)?].lane))));
        for (track, body) in pairs.chosen.iter().zip(&truth.pairing.shown) {
            if let Some(track) = track {
                self.identities.pair(body_of(*body), tracks[*track].id);
            }
        }
        self.ids.extend(tracks.iter().map(|t| t.id));
    }

    /// As `summary.json` has it.
    pub(crate) fn told(&self) -> Metrics {
        Metrics {
            cutoff_m: CUTOFF_M,
            objects: self.objects.told(self.frames, GATE_M),
            tracks: self.tracks.told(self.frames, CUTOFF_M),
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

    /// What does not count: estimates at rest that are nobody's, and truths whose echoes were removed.
    fn add_apart(&mut self, stationary: usize, removed: usize) {
        self.stationary += stationary;
        self.removed += removed;
    }

    /// Pairs of a true and an estimated lane; bodies in no lane are not asked for.
    fn add_lanes(&mut self, pairs: impl Iterator<Item = (u8, Option<u8>)>) {
        for (asked, got) in pairs {
            self.lanes += 1;
            self.lanes_right += usize::from(got == Some(asked));
        }
    }

    fn told(&self, frames: u32, cutoff_m: f64) -> Agreement {
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
