//! Agreement of objects and tracks with the ground truth over a run. Only reports use it: no processing
//! behind the radar cube does.
//!
//! Truths of a frame are the bodies that return any echo from within the radar's range, without clutter:
//! detections of clutter count as false. Objects of single frames give the places of reflections, and are
//! paired with the nearest parts of bodies ([`Pairing`]); tracks give the places of bodies, and the middles
//! of their boxes are compared with the middles of bodies. Bodies whose echoes were removed as echoes at rest
//! do not count, nor do the tracks that still follow them, nor objects at rest that belong to nobody and
//! tracks that have no others.

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
    /// Share of found bodies in a lane whose estimate is in the same one; `None` without any, and where the
    /// array tells no azimuth.
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

/// Lanes in which these bodies should be found; none where the array tells no azimuth.
fn in_lanes(truth: &FrameTruth) -> impl Iterator<Item = Option<u8>> {
    let tells_azimuth = truth.pairing.limits.resolves_azimuth;
    expected(truth).map(move |body| body.lane.filter(|_| tells_azimuth))
}

impl Score {
    /// Adds one frame.
    pub fn add(&mut self, truth: &FrameTruth, objects: &[Object], tracks: &TracksFrame) {
        let tracks = confirmed_tracks(tracks);
        self.frames += 1;
        let Pairing { squares_m2, gospa: of_objects, stationary, removed, .. } = &truth.pairing;
        self.objects.add(squares_m2.view(), of_objects, GATE_M);
        self.objects.add_excluded(stationary.len(), removed.len());
        let lanes = of_objects.chosen.iter().zip(in_lanes(truth));
        self.objects.add_lanes(lanes.filter_map(|(o, lane)| Some((lane?, objects[(*o)?].lane))));
        let squares_m2 = of_tracks(truth, &tracks);
        let pairs = gospa(squares_m2.view(), CUTOFF_M);
        let is_free = |t: usize| !pairs.chosen.contains(&Some(t));
        let follows_removed = |t| truth.pairing.follows_removed(&truth.truths, tracks[t], CUTOFF_M);
        let is_removed = |t: usize| is_free(t) && follows_removed(t);
        let is_stationary = |t: usize| is_free(t) && !is_removed(t) && truth.pairing.is_stationary(tracks[t]);
        let stationary = (0..tracks.len()).filter(|t| is_stationary(*t)).count();
        let is_counted = |t: &usize| !is_stationary(*t) && !is_removed(*t);
        let kept: Vec<usize> = (0..tracks.len()).filter(is_counted).collect();
        let pairs = pairs.without(&[], tracks.len() - kept.len());
        self.tracks.add(squares_m2.select(Axis(1), &kept).view(), &pairs, CUTOFF_M);
        self.tracks.add_excluded(stationary, removed.len());
        let lanes = pairs.chosen.iter().zip(in_lanes(truth));
        self.tracks.add_lanes(lanes.filter_map(|(t, lane)| Some((lane?, tracks[(*t)?].lane))));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pairing::MeasurementLimits;
    use crate::test_object::{body, object_at};
    use artifact::tracks::Footprint;
    use glam::DVec3;

    fn track_at(centre_m: [f64; 2]) -> Track {
        let footprint = Footprint { centre_m, length_m: 4.0, width_m: 1.8, heading_rad: 0.0 };
        Track {
            id: 0,
            state: TrackState::Coasting,
            age_frames: 5,
            missed_frames: 1,
            position_m: centre_m,
            velocity_mps: [0.0; 2],
            covariance: [[0.0; 4]; 4],
            velocity_resolved: true,
            lane: None,
            footprint,
            objects: vec![],
        }
    }

    const LIMITS: MeasurementLimits = MeasurementLimits {
        position_m: DVec3::ZERO,
        range_max_m: 100.0,
        velocity_span_mps: 20.0,
        velocity_gate_mps: 1.0,
        resolves_azimuth: true,
        removed_to_mps: Some(0.25),
    };

    /// Metrics of one frame of these bodies, objects and tracks.
    fn scored(
        limits: &MeasurementLimits,
        truths: Vec<Truth>,
        objects: &[Object],
        tracks: Vec<Track>,
    ) -> Metrics {
        let pairing = Pairing::of(&truths, objects, limits);
        let truth = FrameTruth { truths, pairing, origins: vec![], bodies: vec![] };
        let mut score = Score::default();
        score.add(&truth, objects, &TracksFrame { index: 0, time_s: 0.0, tracks });
        score.metrics()
    }

    #[test]
    fn a_track_of_a_body_whose_echoes_were_removed_is_not_false_and_one_elsewhere_is() {
        let tracks = vec![track_at([2.0, 43.0]), track_at([2.0, 60.0])];
        let tracks = scored(&LIMITS, vec![body(4.0, [2.0, 42.0])], &[], tracks).tracks;
        assert_eq!((tracks.false_ones, tracks.removed, tracks.missed), (1, 1, 0));
    }

    #[test]
    fn a_track_beside_a_removed_body_is_false_if_it_moves_on_or_has_an_object_of_its_own() {
        let near = [2.0, 43.0];
        let false_ones = |track: Track, objects: &[Object]| {
            let tracks = scored(&LIMITS, vec![body(4.0, [2.0, 42.0])], objects, vec![track]).tracks;
            assert_eq!(tracks.removed, 1);
            tracks.false_ones
        };
        let moving = |y_mps| Track { velocity_mps: [0.0, y_mps], ..track_at(near) };
        assert_eq!(false_ones(moving(-0.9), &[]), 0, "the last velocity of a body that brakes");
        assert_eq!(false_ones(moving(-3.0), &[]), 1);
        assert_eq!(false_ones(moving(-20.0), &[]), 1, "20 m/s look like rest, and are known not to be");
        let unresolved = Track { velocity_resolved: false, ..moving(-20.0) };
        assert_eq!(false_ones(unresolved, &[]), 0, "which of both it is is not known");
        let elsewhere = [Object { radial_velocity_mps: -3.0, ..object_at([9.0, 43.0]) }];
        assert_eq!(false_ones(Track { objects: vec![0], ..track_at(near) }, &elsewhere), 1);
    }

    #[test]
    fn lanes_are_compared_where_the_array_tells_an_azimuth_and_nowhere_else() {
        let rates = |resolves_azimuth: bool| {
            let limits = MeasurementLimits { resolves_azimuth, removed_to_mps: None, ..LIMITS };
            let truths = vec![Truth { lane: Some(1), ..body(4.0, [0.0, 42.0]) }];
            let metrics = scored(&limits, truths, &[object_at([0.0, 40.0])], vec![track_at([0.0, 43.0])]);
            assert_eq!([metrics.objects.found, metrics.tracks.found], [1, 1]);
            [metrics.objects.lane_rate, metrics.tracks.lane_rate]
        };
        assert_eq!(rates(true), [Some(0.0); 2], "they are in no lane");
        assert_eq!(rates(false), [None; 2]);
    }
}
