//! Track continuity: whether a body keeps its track and a track its body.
//!
//! A *switch* is a frame in which a body has another track than it last had (as in CLEAR MOT, Bernardin and
//! Stiefelhagen, J. Image Video Process. 2008, 246309). *Purity* is the share of a track's frames in which it
//! follows the body that it follows most, over all tracks.

use std::collections::BTreeMap;

/// Pairs of bodies and tracks, frame by frame.
#[derive(Debug, Clone, Default)]
pub struct Identities {
    last_track_of: BTreeMap<u32, u32>,
    frames_of: BTreeMap<u32, BTreeMap<u32, u32>>,
    switches: u32,
}

impl Identities {
    /// Records that a body has this track in a frame.
    pub fn pair(&mut self, body: u32, track: u32) {
        if self.last_track_of.insert(body, track).is_some_and(|last| last != track) {
            self.switches += 1;
        }
        *self.frames_of.entry(track).or_default().entry(body).or_insert(0) += 1;
    }

    /// Number of times that a body changed its track.
    pub fn switches(&self) -> u32 {
        self.switches
    }

    /// Number of bodies that had a track in some frame.
    pub fn bodies(&self) -> usize {
        self.last_track_of.len()
    }

    /// Purity; `None` without any pair.
    pub fn purity(&self) -> Option<f64> {
        let most = |bodies: &BTreeMap<u32, u32>| bodies.values().copied().max().unwrap_or(0);
        let frames: u32 = self.frames_of.values().flat_map(BTreeMap::values).sum();
        let pure: u32 = self.frames_of.values().map(most).sum();
        (frames > 0).then(|| f64::from(pure) / f64::from(frames))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_swap_of_two_bodies_is_two_switches_and_a_pause_is_none() {
        let mut pairs = Identities::default();
        for _ in 0..3 {
            pairs.pair(0, 7);
            pairs.pair(1, 8);
        }
        assert_eq!((pairs.switches(), pairs.purity()), (0, Some(1.0)));
        pairs.pair(0, 8);
        pairs.pair(1, 7);
        // Each track followed another body in one of its four frames.
        assert_eq!((pairs.switches(), pairs.purity(), pairs.bodies()), (2, Some(0.75), 2));
    }
}
