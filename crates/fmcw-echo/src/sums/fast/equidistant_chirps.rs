//! Chirps of a frame at equal steps: all of them, or every P-th of a staggered frame.
//!
//! Staggered starts repeat after P chirps of a transmitter. The equal steps needed by transforms then hold
//! for chirps r, r + P, r + 2P, …: a staggered frame is exactly P interleaved frames of equal steps.

use artifact::Radar;
use artifact::radar::Multiplexing;
use std::ops::Range;

/// Chirps `first`, `first` + `every`, … of each transmitter, or of one slot of all blocks of codes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct EquidistantChirps {
    pub(crate) first: usize,
    pub(crate) every: usize,
    /// First channel of the cube whose rows are these chirps.
    pub(crate) first_channel: usize,
    /// Number of chirps.
    pub(crate) chirps: usize,
    /// Time step between chirps, s.
    pub(crate) step_s: f64,
    /// Start of each transmitter's first chirp, from the frame's first sample.
    first_s: Vec<f64>,
}

impl EquidistantChirps {
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

    /// Start of chirp `chirp` of this set; may be fractional.
    pub(crate) fn start_s(&self, tx: usize, chirp: f64) -> f64 {
        self.first_s[tx] + chirp * self.step_s
    }

    /// A subset of these chirps.
    pub(crate) fn part(&self, chirps: &Range<usize>) -> Self {
        let first_s = (0..self.first_s.len()).map(|tx| self.start_s(tx, chirps.start as f64)).collect();
        let first = self.first + chirps.start * self.every;
        Self { first, chirps: chirps.len(), first_s, ..*self }
    }

    /// Channel and chirp in the cube for row `row` of this set, counted chirp by chirp within each channel.
    pub(crate) fn place(&self, row: usize) -> [usize; 2] {
        [self.first_channel + row / self.chirps, self.first + row % self.chirps * self.every]
    }
}

/// Number of chirps P after which starts repeat: of n delays that alternate with every chirp sent, each
/// transmitter meets n/gcd(n, number of chirps sent from one of its to the next).
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
