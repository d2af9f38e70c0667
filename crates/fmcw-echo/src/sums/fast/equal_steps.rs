//! Chirps of a frame that follow each other at equal steps: all, or of a staggered frame every P-th.
//!
//! Staggered starts repeat after P chirps of a transmitter. What transforms need, equal steps, then holds for
//! chirps r, r + P, r + 2P, …: a staggered frame is P frames of equal steps laid into one another, exactly.

use artifact::Radar;
use artifact::radar::Multiplexing;
use std::ops::Range;

/// Chirps `first`, `first` + `every`, … of each transmitter, or of one slot of all blocks of codes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct EqualSteps {
    pub(crate) first: usize,
    pub(crate) every: usize,
    /// First channel of the cube whose rows these chirps are.
    pub(crate) first_channel: usize,
    /// Number of the chirps.
    pub(crate) chirps: usize,
    /// Step from one chirp to the next, s.
    pub(crate) step_s: f64,
    /// Start of the first of each transmitter, from the frame's first sample.
    first_s: Vec<f64>,
}

impl EqualSteps {
    /// All chirps of a frame, in sets of equal steps.
    pub(crate) fn of(radar: &Radar) -> Vec<Self> {
        let (every, chirps) = (chirps_to_repeat(radar), radar.waveform.chirps as usize);
        let [transmitters, receivers] = [radar.array.tx_m.len(), radar.array.rx_m.len()];
        let steps = |first: usize, first_channel: usize, first_s: Vec<f64>| Self {
            first,
            every,
            first_channel,
            chirps: (chirps - first).div_ceil(every),
            step_s: every as f64 * radar.repetition_interval_s(),
            first_s,
        };
        let firsts = 0..every.min(chirps);
        if radar.array.multiplexing != Multiplexing::Bpm {
            let starts_s = |first| (0..transmitters).map(|tx| radar.chirp_start_s(tx, first)).collect();
            return firsts.map(|first| steps(first, 0, starts_s(first))).collect();
        }
        // All transmitters send in every slot.
        let starts_s = |slot, first| vec![radar.chirp_start_s(slot, first); transmitters];
        let of_slot = |slot| firsts.clone().map(move |first| (slot, first));
        let all = (0..radar.slots()).flat_map(of_slot);
        all.map(|(slot, first)| steps(first, slot * receivers, starts_s(slot, first))).collect()
    }

    /// Start of chirp `chirp` of these, or of a part of one more.
    pub(crate) fn start_s(&self, tx: usize, chirp: f64) -> f64 {
        self.first_s[tx] + chirp * self.step_s
    }

    /// Some of these chirps.
    pub(crate) fn part(&self, chirps: &Range<usize>) -> Self {
        let first_s = (0..self.first_s.len()).map(|tx| self.start_s(tx, chirps.start as f64)).collect();
        let first = self.first + chirps.start * self.every;
        Self { first, chirps: chirps.len(), first_s, ..*self }
    }

    /// Channel and chirp in the cube of row `row` of these, chirp after chirp and channel after channel.
    pub(crate) fn place(&self, row: usize) -> [usize; 2] {
        [self.first_channel + row / self.chirps, self.first + row % self.chirps * self.every]
    }
}

/// Number of chirps P after which starts repeat: of n delays that take turns with every chirp in the
/// air, each transmitter meets n/gcd(n, chirps in the air from one of its to the next).
fn chirps_to_repeat(radar: &Radar) -> usize {
    if radar.schedule.is_uniform() {
        return 1;
    }
    let delays = radar.schedule.stagger_s.len();
    delays / greatest_common_divisor(delays, radar.slots())
}

fn greatest_common_divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}
