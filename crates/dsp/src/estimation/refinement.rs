//! Joint maximum-likelihood estimate of range, velocity and direction of an isolated point echo, by Fisher
//! scoring on unwindowed samples.
//!
//! The interpolated peak is the starting point. Its phase is removed from the samples, which are then summed
//! over blocks; the residual phase turns slowly from block to block, and the score's zero is found on a few
//! thousand sums instead of a million samples (Kay, Fundamentals of Statistical Signal Processing (1993),
//! §7.7). Two passes remove the error of linearising the phase about the start. For an isolated echo in white
//! noise this reaches the Cramér–Rao bound (`docs/validation/estimates.md`); the model has one echo only, so
//! peaks biased by others are left unrefined ([`crate::estimation::isolation`]).

use crate::direction::angle::Direction;
use crate::estimation::point_echo::{Block, PointEcho, blocks};
use crate::numerics::cholesky::solve;
use crate::plan::Plan;
use artifact::units::SPEED_OF_LIGHT_MPS;
use num_complex::{Complex32, Complex64};
use std::f64::consts::TAU;

/// Range, velocity, direction cosines along right and up.
const PARAMETERS: usize = 4;
/// Passes over the samples.
const PASSES: usize = 2;
/// Scoring steps per pass. From a tenth of a cell each squares the error: 0.3 rad becomes 1e-6 in four.
const SCORING_STEPS: usize = 6;

/// Echo that fits the samples best, near `start`; `None` if the iteration does not settle within a cell of
/// it.
pub(crate) fn refined(plan: &Plan, samples: &[Complex32], start: PointEcho) -> Option<PointEcho> {
    let mut point = start;
    for _ in 0..PASSES {
        let blocks = blocks(plan, samples, &point);
        let step = best_step(plan, &blocks, &point)?;
        point = moved(&point, step);
        is_near(plan, &start, &point).then_some(())?;
    }
    Some(point)
}

/// Step of the parameters that maximises |Σ blocks · e^{−j·residual phase}|.
fn best_step(plan: &Plan, blocks: &[Block], at: &PointEcho) -> Option<[f64; PARAMETERS]> {
    let slopes = centred(phase_slopes(plan, blocks, at), blocks);
    let mut step = [0.0; PARAMETERS];
    for _ in 0..SCORING_STEPS {
        let turned: Vec<Complex64> = blocks
            .iter()
            .zip(&slopes)
            .map(|(b, g)| b.sum * Complex64::from_polar(1.0, -dot(g, &step)))
            .collect();
        let sum: Complex64 = turned.iter().sum();
        let in_phase = sum.conj() / sum.norm();
        let weight: f64 = blocks.iter().map(|b| b.weight).sum();
        let amplitude = sum.norm() / weight;
        let (mut score, mut information) = ([0.0; PARAMETERS], [[0.0; PARAMETERS]; PARAMETERS]);
        for ((block, slope), value) in blocks.iter().zip(&slopes).zip(&turned) {
            for i in 0..PARAMETERS {
                score[i] += slope[i] * (value * in_phase).im;
                (0..PARAMETERS)
                    .for_each(|j| information[i][j] += amplitude * block.weight * slope[i] * slope[j]);
            }
        }
        let change = solve(information, score)?;
        (0..PARAMETERS).for_each(|i| step[i] += change[i]);
    }
    step.iter().all(|s| s.is_finite()).then_some(step)
}

/// Radians of each block per metre, metre per second and unit cosines; 0 along axes that the array lacks.
fn phase_slopes(plan: &Plan, blocks: &[Block], at: &PointEcho) -> Vec<[f64; PARAMETERS]> {
    let waveform = &plan.radar.waveform;
    let tau_s = 2.0 * at.range_m / SPEED_OF_LIGHT_MPS;
    let of_cosines = plan.array.excess_slopes_m(at.direction, at.range_m);
    let slope = |block: &Block| {
        let frequency_hz = waveform.start_frequency_hz + waveform.slope_hz_per_s * (block.sweep_s - tau_s);
        let per_metre = TAU * frequency_hz / SPEED_OF_LIGHT_MPS;
        let [right, up] = of_cosines[block.channel];
        [2.0, 2.0 * block.frame_s, right, up].map(|metres| per_metre * metres)
    };
    blocks.iter().map(slope).collect()
}

/// Removes the mean: the echo's own phase is unknown, so only differences between blocks carry information.
fn centred(mut slopes: Vec<[f64; PARAMETERS]>, blocks: &[Block]) -> Vec<[f64; PARAMETERS]> {
    let weight: f64 = blocks.iter().map(|b| b.weight).sum();
    for i in 0..PARAMETERS {
        let mean =
            slopes.iter().zip(blocks).map(|(slope, block)| slope[i] * block.weight).sum::<f64>() / weight;
        slopes.iter_mut().for_each(|slope| slope[i] -= mean);
    }
    slopes
}

fn dot(a: &[f64; PARAMETERS], b: &[f64; PARAMETERS]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn moved(point: &PointEcho, step: [f64; PARAMETERS]) -> PointEcho {
    PointEcho {
        range_m: point.range_m + step[0],
        radial_velocity_mps: point.radial_velocity_mps + step[1],
        direction: Direction {
            right: point.direction.right + step[2],
            up: point.direction.up.map(|up| up + step[3]),
        },
    }
}

/// Whether the point lies within a cell of range and velocity, and in front of the array.
fn is_near(plan: &Plan, start: &PointEcho, point: &PointEcho) -> bool {
    let axes = plan.array.cells();
    let up = point.direction.up.unwrap_or(0.0);
    (point.range_m - start.range_m).abs() < axes.range_cell_m
        && (point.radial_velocity_mps - start.radial_velocity_mps).abs() < axes.velocity_cell_mps
        && point.direction.right.powi(2) + up.powi(2) < 1.0
}
