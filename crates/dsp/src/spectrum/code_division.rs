//! Code division: in slot s of a block of M chirps, transmitter i has the sign H_is of Sylvester's Hadamard
//! matrix.
//!
//! The slots' maps are like those of time division, except that each slot receives all transmitters. In a
//! slot an echo of f cycles per block is rotated by f·(s − s̄)/M relative to the block's middle s̄. With this
//! removed, X_i = Σ_s H_is·Y_s/M is transmitter i alone, to rounding: the rows of H are orthogonal. A wrong f
//! moves echoes from code to code instead, but their total power, Σ_i |X_i|² = Σ_s |Y_s|²/M, is unchanged. A
//! map therefore uses each row's own f, keeps all M codes, including unused ones, and is detected on their
//! sum, which is independent of the fold; directions are estimated once the velocity of an echo is resolved,
//! with `in_phase`.

use crate::spectrum::division::Division;
use artifact::radar::code_sign;
use num_complex::{Complex32, Complex64};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Maps `[code·N_rx + rx, doppler, range]` from the slots' maps `[slot·N_rx + rx, doppler, range]`.
pub(crate) fn codes_of_slots(
    &Division { slots, receivers, .. }: &Division,
    [rows, columns]: [usize; 2],
    of_slots: &[Complex32],
) -> Vec<Complex32> {
    let mut codes = vec![Complex32::ZERO; of_slots.len()];
    codes.par_chunks_mut(columns).enumerate().for_each(|(r, cells)| {
        let (channel, row) = (r / rows, r % rows);
        let (code, rx) = (channel / receivers, channel % receivers);
        let cycles = cycles_per_slot(slots, [row, rows]);
        for slot in 0..slots {
            let share = turned_back(slots, slot, cycles) * code_sign(code, slot) / slots as f64;
            let share = Complex32::new(share.re as f32, share.im as f32);
            let values = &of_slots[((slot * receivers + rx) * rows + row) * columns..][..columns];
            cells.iter_mut().zip(values).for_each(|(sum, value)| *sum += share * value);
        }
    });
    codes
}

/// Values `[code·N_rx + rx]` of an echo that turns by `cycles` from slot to slot, from those of a cell, given
/// its row and the number of rows.
pub(crate) fn in_phase(
    &Division { slots, receivers, .. }: &Division,
    codes: &[Complex64],
    row: [usize; 2],
    cycles: f64,
) -> Vec<Complex64> {
    let more = cycles - cycles_per_slot(slots, row);
    let of_slot = |slot: usize, rx: usize| {
        let sum: Complex64 =
            (0..slots).map(|code| code_sign(code, slot) * codes[code * receivers + rx]).sum();
        sum * turned_back(slots, slot, more)
    };
    let of_slots: Vec<Complex64> = (0..codes.len()).map(|i| of_slot(i / receivers, i % receivers)).collect();
    let of_code = |i: usize| {
        let (code, rx) = (i / receivers, i % receivers);
        let sum: Complex64 =
            (0..slots).map(|slot| code_sign(code, slot) * of_slots[slot * receivers + rx]).sum();
        sum / slots as f64
    };
    (0..codes.len()).map(of_code).collect()
}

/// Values `[code·N_rx + rx]` of a cell of a row, separated by the turn of another row as if it lay there:
/// echoes between two rows then have one phase per code in both. Beside a row its own turn differs by 1/N of
/// a block, across the end of the axis by nearly a whole one.
pub(crate) fn separated_as(
    division: &Division,
    codes: &[Complex64],
    [row, other, rows]: [usize; 3],
) -> Vec<Complex64> {
    in_phase(division, codes, [row, rows], cycles_per_slot(division.slots, [other, rows]))
}

/// Cycles by which an echo in the middle of a row, `[row, rows]`, turns from slot to slot.
fn cycles_per_slot(slots: usize, [row, rows]: [usize; 2]) -> f64 {
    (row as f64 - (rows / 2) as f64) / (rows * slots) as f64
}

/// Rotation relative to the block's middle.
fn turned_back(slots: usize, slot: usize, cycles: f64) -> Complex64 {
    Complex64::from_polar(1.0, -TAU * cycles * (slot as f64 - 0.5 * (slots - 1) as f64))
}
