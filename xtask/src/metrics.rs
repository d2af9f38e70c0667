//! How well objects and tracks agree with the truth over a run. Only reports come here: nothing behind the radar cube reads it.
//!
//! Truths of a frame are the bodies that send back any echo from within the radar's range, at the middle of their outline on the
//! ground, clutter left out: what is found of it counts as false; estimates are the middles of the boxes of believed tracks, and beside them the places of the frame's objects.

mod gospa;
mod identities;
mod ospa;

use crate::truth::Truth;
use artifact::points::Object;
use artifact::scene::Role;
use artifact::tracks::{Track, TrackState, TracksFrame};
use glam::DVec2;
use gospa::{Gospa, gospa};
use identities::Identities;
use ospa::ospa_m;
use serde_json::{Value, json};

/// c of GOSPA and OSPA: an estimate further from a body's middle than this is another's. Half of a bus is 6 m.
const CUTOFF_M: f64 = 6.0;

/// A body of a frame, as it is compared with estimates.
#[derive(Debug, Clone, Copy)]
struct Shown {
    body: u32,
    place_m: DVec2,
    lane: Option<u8>,
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
    lanes: usize,
    lanes_right: usize,
}

/// Tracks that are believed.
pub(crate) fn believed(tracks: &TracksFrame) -> Vec<&Track> {
    tracks.tracks.iter().filter(|t| t.state != TrackState::Tentative).collect()
}

/// For each believed track the place of its body in `truths`, as the metric pairs them.
pub(crate) fn bodies_of_tracks(truths: &[Truth], range_max_m: f64, tracks: &[&Track]) -> Vec<Option<usize>> {
    let shown = shown(truths, |i| i as u32, range_max_m);
    let pairs = gospa(&places(&shown), &middles(tracks), CUTOFF_M).chosen;
    let body_of = |track: usize| pairs.iter().position(|t| *t == Some(track)).map(|i| shown[i].body as usize);
    (0..tracks.len()).map(body_of).collect()
}

impl Score {
    /// Takes in one frame; `body_of` numbers the bodies of `truths` through the whole run.
    pub(crate) fn add(
        &mut self,
        truths: &[Truth],
        body_of: impl Fn(usize) -> u32,
        range_max_m: f64,
        objects: &[Object],
        tracks: &TracksFrame,
    ) {
        let (shown, tracks) = (shown(truths, body_of, range_max_m), believed(tracks));
        let truths = places(&shown);
        self.frames += 1;
        let of_objects: Vec<DVec2> = objects.iter().map(|o| DVec2::new(o.position_m[0], o.position_m[1])).collect();
        let pairs = self.objects.add(&truths, &of_objects);
        let lanes = pairs.chosen.iter().zip(&shown).filter_map(|(o, s)| Some((s.lane?, objects[(*o)?].lane)));
        self.objects.add_lanes(lanes);
        let pairs = self.tracks.add(&truths, &middles(&tracks));
        let lanes = pairs.chosen.iter().zip(&shown).filter_map(|(t, s)| Some((s.lane?, tracks[(*t)?].lane)));
        self.tracks.add_lanes(lanes);
        for (track, shown) in pairs.chosen.iter().zip(&shown) {
            if let Some(track) = track {
                self.identities.pair(shown.body, tracks[*track].id);
            }
        }
        self.ids.extend(tracks.iter().map(|t| t.id));
    }

    /// As `summary.json` has it.
    pub(crate) fn told(&self) -> Value {
        json!({
            "cutoff_m": CUTOFF_M,
            "objects": self.objects.told(self.frames),
            "tracks": self.tracks.told(self.frames),
            "identities": {
                "bodies": self.identities.bodies(),
                "tracks": self.ids.len(),
                "switches": self.identities.switches(),
                "purity": self.identities.purity(),
            },
        })
    }
}

impl Sums {
    fn add(&mut self, truths: &[DVec2], estimates: &[DVec2]) -> Gospa {
        let parts = gospa(truths, estimates, CUTOFF_M);
        self.gospa_m += parts.distance_m();
        self.ospa_m += ospa_m(truths, estimates, CUTOFF_M);
        self.localisation_m2 += parts.localisation_m2;
        self.pairs += truths.len() - parts.missed;
        self.missed += parts.missed;
        self.false_ones += parts.false_ones;
        parts
    }

    /// Pairs of a true and an estimated lane; bodies in no lane are not asked for.
    fn add_lanes(&mut self, pairs: impl Iterator<Item = (u8, Option<u8>)>) {
        for (asked, got) in pairs {
            self.lanes += 1;
            self.lanes_right += usize::from(got == Some(asked));
        }
    }

    fn told(&self, frames: u32) -> Value {
        let mean = |sum: f64, count: f64| (count > 0.0).then(|| sum / count);
        json!({
            "gospa_m": mean(self.gospa_m, f64::from(frames)),
            "ospa_m": mean(self.ospa_m, f64::from(frames)),
            "localisation_rms_m": mean(self.localisation_m2, self.pairs as f64).map(f64::sqrt),
            "found": self.pairs,
            "missed": self.missed,
            "false": self.false_ones,
            "lane_rate": mean(self.lanes_right as f64, self.lanes as f64),
        })
    }
}

fn shown(truths: &[Truth], body_of: impl Fn(usize) -> u32, range_max_m: f64) -> Vec<Shown> {
    let range_m = |t: &Truth| t.echo.map_or(t.range_m, |e| e.range_m);
    let is_shown = |t: &Truth| t.role == Role::Target && t.sends_back && range_m(t) <= range_max_m;
    let of = |(i, t): (usize, &Truth)| Shown { body: body_of(i), place_m: t.position_m.truncate(), lane: t.lane };
    truths.iter().enumerate().filter(|(_, t)| is_shown(t)).map(of).collect()
}

fn places(shown: &[Shown]) -> Vec<DVec2> {
    shown.iter().map(|s| s.place_m).collect()
}

fn middles(tracks: &[&Track]) -> Vec<DVec2> {
    tracks.iter().map(|t| DVec2::from(t.footprint.centre_m)).collect()
}
