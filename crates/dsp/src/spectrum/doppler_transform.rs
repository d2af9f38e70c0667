//! Transform from the chirps of a range cell to its Doppler rows.
//!
//! For chirps at one interval T this is an FFT. If chirp m starts δ_m later than m·T, with δ_m the same for
//! every P-th chirp, row k of N is Σ_r e^{−j2πkδ_r/NT}·Σ_{m = r, r + P, …} x_m·e^{−j2πkm/N}: P transforms of
//! the same length, each rotated row by row, without approximation. k counts from −N/2, since a rotation for
//! a fraction of an interval is not periodic in k.

use crate::error::DspError;
use crate::numerics::precision::Precision;
use artifact::Radar;
use artifact::radar::Multiplexing;
use num_complex::{Complex, Complex64};
use rustfft::num_traits::Zero;
use rustfft::{Fft, FftPlanner};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The transform of one radar's chirps.
pub(crate) struct DopplerTransform<T> {
    fft: Arc<dyn Fft<T>>,
    /// Phase factors by transmitter, chirp modulo P, row; empty if all intervals are equal.
    turns: Vec<Vec<Vec<Complex<T>>>>,
}

impl<T: Precision> DopplerTransform<T> {
    /// Prepares the transform; refuses staggered chirps with Doppler or code division, where a velocity is
    /// not a constant rotation per chirp.
    pub(crate) fn new(radar: &Radar, planner: &mut FftPlanner<T>) -> Result<Self, DspError> {
        let fft = planner.plan_fft_forward(radar.waveform.chirps as usize);
        if radar.schedule.is_uniform() {
            return Ok(Self { fft, turns: vec![] });
        }
        if matches!(radar.array.multiplexing, Multiplexing::Ddm | Multiplexing::Bpm) {
            return Err(DspError::StaggeredDivision);
        }
        let turns = (0..radar.array.tx_m.len()).map(|tx| turns_of(radar, tx)).collect();
        Ok(Self { fft, turns })
    }

    /// Scratch length required by [`Self::process`].
    pub(crate) fn scratch_len(&self) -> usize {
        self.fft.get_inplace_scratch_len()
    }

    /// Transforms columns of a transmitter's chirps into its rows, in FFT order: 0, 1, … then the negative
    /// ones.
    pub(crate) fn process(&self, transmitter: usize, columns: &mut [Complex<T>], scratch: &mut [Complex<T>]) {
        let Some(turns) = self.turns.get(transmitter) else {
            return self.fft.process_with_scratch(columns, scratch);
        };
        let chirps = columns.to_vec();
        columns.fill(Complex::zero());
        let delays = turns.len();
        for (first, turns) in turns.iter().enumerate() {
            let mut some = vec![Complex::zero(); chirps.len()];
            for (some, chirps) in some.chunks_exact_mut(turns.len()).zip(chirps.chunks_exact(turns.len())) {
                (first..turns.len()).step_by(delays).for_each(|m| some[m] = chirps[m]);
            }
            self.fft.process_with_scratch(&mut some, scratch);
            let turned = some.iter().zip(turns.iter().cycle()).map(|(value, turn)| *value * *turn);
            columns.iter_mut().zip(turned).for_each(|(sum, value)| *sum = *sum + value);
        }
    }
}

/// Phase factors `[chirp modulo the number of delays][row]`; the delays repeat at the latest after that many
/// chirps of one transmitter.
fn turns_of<T: Precision>(radar: &Radar, tx: usize) -> Vec<Vec<Complex<T>>> {
    let (rows, interval_s) = (radar.waveform.chirps as usize, radar.repetition_interval_s());
    let delay_cycles = |chirp: usize| {
        let start_s = radar.chirp_start_s(tx, chirp) - radar.chirp_start_s(tx, 0);
        (start_s / interval_s - chirp as f64) / rows as f64
    };
    let signed = |row: usize| if row < rows.div_ceil(2) { row as f64 } else { row as f64 - rows as f64 };
    let of_chirp = |chirp: usize| {
        let delay_cycles = delay_cycles(chirp);
        let turn = |row: usize| Complex64::from_polar(1.0, -TAU * delay_cycles * signed(row));
        (0..rows).map(turn).map(|turn| Complex::new(T::of(turn.re), T::of(turn.im))).collect()
    };
    (0..radar.schedule.stagger_s.len().min(rows)).map(of_chirp).collect()
}
