//! Chirps of a frame that follow each other at equal steps: all, or of a staggered frame every P-th.
//!
//! Staggered starts repeat after P chirps of a transmitter. What transforms need, equal steps, then holds for chirps r, r + P,
//! r + 2P, …: a staggered frame is P frames of equal steps laid into one another, exactly.

use artifact::Radar;
use artifact::radar::Multiplexing;

/// Chirps `first`, `first` + `every`, … of each transmitter.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct EqualSteps {
    pub(crate) first: usize,
    pub(crate) every: usize,
    /// How many there are.
    pub(crate) chirps: usize,
    /// From one to the next, s.
    pub(crate) step_s: f64,
    /// Start of the first of each transmitter, from the frame's first sample.
    first_s: Vec<f64>,
}

impl EqualSteps {
    /// All chirps of a frame.
    pub(crate) fn of(radar: &Radar) -> Vec<Self> {
        let (every, chirps) = (chirps_to_repeat(radar), radar.waveform.chirps as usize);
        let steps = |first: usize| Self {
            first,
            every,
            chirps: (chirps - first).div_ceil(every),
            step_s: every as f64 * radar.repetition_interval_s(),
            first_s: (0..radar.array.tx_m.len()).map(|tx| radar.chirp_start_s(tx, first)).collect(),
        };
        (0..every.min(chirps)).map(steps).collect()
    }

    /// Start of chirp `chirp` of these, or of a part of one more.
    pub(crate) fn start_s(&self, tx: usize, chirp: f64) -> f64 {
        self.first_s[tx] + chirp * self.step_s
    }

    /// Number of chirp `chirp` of these in the frame.
    pub(crate) fn in_frame(&self, chirp: usize) -> usize {
        self.first + chirp * self.every
    }
}

/// P: of n delays that take turns with every chirp in the air, each transmitter meets n/gcd(n, chirps in the air from one of its to
/// the next).
fn chirps_to_repeat(radar: &Radar) -> usize {
    if radar.schedule.is_uniform() {
        return 1;
    }
    let in_the_air = match radar.array.multiplexing {
        Multiplexing::Tdm => radar.array.tx_m.len(),
        Multiplexing::Simultaneous | Multiplexing::Ddm => 1,
    };
    let delays = radar.schedule.stagger_s.len();
    delays / greatest_common_divisor(delays, in_the_air)
}

fn greatest_common_divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}
