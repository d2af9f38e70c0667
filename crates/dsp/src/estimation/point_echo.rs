//! Phase of an isolated point echo in every sample, and block sums of a cube's samples with this phase
//! removed.
//!
//! cycles = f₀τ + μtτ − ½μτ², cτ = 2R(T) plus the difference in path length of the channel's elements from
//! the array's centre (`docs/interface.md`; computed for the point's position at mid-frame). R(T) is linear,
//! so a chirp's phase is exactly a parabola in t.

use crate::direction::angle::Direction;
use crate::plan::Plan;
use crate::spectrum::division::Division;
use crate::spectrum::doppler_bands::source_of;
use artifact::radar::{Multiplexing, Waveform, code_sign};
use artifact::units::SPEED_OF_LIGHT_MPS;
use num_complex::{Complex32, Complex64};
use radar::beat::if_cycles;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Range and direction of a point at mid-frame, and its radial velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PointEcho {
    /// Range from the array's centre.
    pub(crate) range_m: f64,
    /// Radial velocity, without folding.
    pub(crate) radial_velocity_mps: f64,
    /// Direction, seen from the array.
    pub(crate) direction: Direction,
}

/// Sum over a block of samples and chirps of one channel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Block {
    /// Σ sample · e^{−j·phase of the point}.
    pub(crate) sum: Complex64,
    /// Number of samples in the block.
    pub(crate) weight: f64,
    /// Channel.
    pub(crate) channel: usize,
    /// Mean time into the sampled sweep.
    pub(crate) sweep_s: f64,
    /// Mean time from the frame's middle.
    pub(crate) frame_s: f64,
}

/// Number of blocks along each axis: the phase of a point half a cell off turns by 1/32 cycle within a block,
/// which costs 1.6e-3 of its amplitude.
const BLOCKS: usize = 16;

/// Blocks of all channels with the point's phase removed, in order of channel, chirp and sample.
pub(crate) fn blocks(plan: &Plan, samples: &[Complex32], point: &PointEcho) -> Vec<Block> {
    let excess_m = plan.array.excess_m(point.direction, point.range_m);
    let channels = 0..plan.array.division().pairs();
    let of_channels: Vec<Vec<Block>> =
        channels.into_par_iter().map(|c| blocks_of_channel(plan, samples, point, c, excess_m[c])).collect();
    of_channels.concat()
}

fn blocks_of_channel(
    plan: &Plan,
    samples: &[Complex32],
    point: &PointEcho,
    channel: usize,
    excess_m: f64,
) -> Vec<Block> {
    let radar = &plan.radar;
    let [_, all_chirps, length] = plan.transform.shapes().cube;
    let channel_sources = channel_sources(plan.array.division(), channel);
    let calibration = plan.settings.calibration.get(channel).copied().unwrap_or(Complex64::ONE);
    let [rows, columns] = [all_chirps.div_ceil(BLOCKS), length.div_ceil(BLOCKS)];
    let row_blocks = (0..all_chirps).step_by(rows).map(|first| first..(first + rows).min(all_chirps));
    row_blocks
        .flat_map(|chirps| {
            let mut sums = vec![Complex64::ZERO; length.div_ceil(columns)];
            let mut frame_s = 0.0;
            for (chirp, from) in
                chirps.clone().flat_map(|chirp| channel_sources.iter().map(move |from| (chirp, from)))
            {
                let start_s = radar.chirp_start_s(from.turn, chirp) - radar.frame_middle_s();
                let turn_cycles = from.cycles * chirp as f64;
                let phase = ChirpPhase::new(&radar.waveform, point, excess_m, start_s, turn_cycles);
                frame_s += start_s / (chirps.len() * channel_sources.len()) as f64;
                let row = &samples[(from.source * all_chirps + chirp) * length..][..length];
                add_chirp((row, from.share), columns, &phase, &mut sums);
            }
            let rate_hz = radar.waveform.sample_rate_hz;
            sums.into_iter().enumerate().map(move |(index, sum)| {
                let width = columns.min(length - index * columns);
                let sweep_s = (index as f64 * columns as f64 + 0.5 * (width - 1) as f64) / rate_hz;
                let weight = (width * chirps.len()) as f64;
                Block { sum: sum * calibration, weight, channel, sweep_s, frame_s: frame_s + sweep_s }
            })
        })
        .collect()
}

/// Location in a cube of the chirps of a transmit–receive pair.
struct ChannelSource {
    source: usize,
    /// Index of the transmitter or slot for [`Radar::chirp_start_s`](artifact::Radar::chirp_start_s).
    turn: usize,
    /// Cycles to remove per chirp.
    cycles: f64,
    /// Share of the chirps' samples in those of the pair.
    share: f64,
}

/// Location of one channel; with codes, every slot, since the contributions of other transmitters cancel in
/// sign.
fn channel_sources(division: &Division, channel: usize) -> Vec<ChannelSource> {
    let &Division { multiplexing, receivers, slots, .. } = division;
    let (tx, rx) = (channel / receivers, channel % receivers);
    if multiplexing != Multiplexing::Bpm {
        let (source, cycles) = source_of(division, channel);
        return vec![ChannelSource { source, turn: tx, cycles, share: 1.0 }];
    }
    let of_slot = |slot: usize| ChannelSource {
        source: slot * receivers + rx,
        turn: slot,
        cycles: 0.0,
        share: code_sign(tx, slot) / slots as f64,
    };
    (0..slots).map(of_slot).collect()
}

/// Adds a share of a chirp's samples.
fn add_chirp((row, share): (&[Complex32], f64), columns: usize, phase: &ChirpPhase, sums: &mut [Complex64]) {
    let (mut turn, mut step, step_of_step) = phase.turns();
    turn *= share;
    for (values, sum) in row.chunks(columns).zip(sums) {
        for value in values {
            *sum += Complex64::new(f64::from(value.re), f64::from(value.im)) * turn;
            turn *= step;
            step *= step_of_step;
        }
    }
}

/// Cycles of one chirp's samples: a parabola in the sample index.
struct ChirpPhase {
    start: f64,
    slope: f64,
    bend: f64,
}

impl ChirpPhase {
    fn new(waveform: &Waveform, point: &PointEcho, excess_m: f64, start_s: f64, turn_cycles: f64) -> Self {
        let (f0, mu) = (waveform.start_frequency_hz, waveform.slope_hz_per_s);
        let tau_s =
            (2.0 * (point.range_m + point.radial_velocity_mps * start_s) + excess_m) / SPEED_OF_LIGHT_MPS;
        let rate = 2.0 * point.radial_velocity_mps / SPEED_OF_LIGHT_MPS;
        let sample_s = 1.0 / waveform.sample_rate_hz;
        Self {
            start: if_cycles(waveform, 0.0, tau_s) + turn_cycles,
            slope: (f0 * rate + mu * tau_s * (1.0 - rate)) * sample_s,
            bend: mu * rate * (1.0 - 0.5 * rate) * sample_s * sample_s,
        }
    }

    /// Phase factors e^{−j·phase}: of the first sample, of the first step, and of the step's increment.
    fn turns(&self) -> (Complex64, Complex64, Complex64) {
        let turn = |cycles: f64| Complex64::from_polar(1.0, -TAU * cycles.fract());
        (turn(self.start), turn(self.slope + self.bend), turn(2.0 * self.bend))
    }
}
