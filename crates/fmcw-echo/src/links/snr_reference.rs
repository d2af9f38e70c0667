//! Reference of a scene's `snr_db`: the peak cell of one channel's noise-free range-Doppler map.

use artifact::Radar;
use artifact::cube::CubeHeader;
use artifact::radar::{Multiplexing, Sampling};
use num_complex::{Complex32, Complex64};
use radar::window::{noise_bandwidth_bins, taper};
use rustfft::{Fft, FftPlanner};
use std::f64::consts::TAU;

/// Power of the peak cell of channel 0 relative to that of a cell of white noise with unit power per sample;
/// `None` if the channel is silent. With codes, the mean over transmitters as received by the first receiver.
///
/// A cell of the map contains noise of N_s·N_c·ENBW_r·ENBW_d times the power of a sample (physics.md §8:
/// windows of unit coherent gain, FFTs without scaling). With Doppler division the map of receiver 0 before
/// its bands are separated has the same peak and the same noise. Separating codes divides the power of the M
/// slots' maps among N_tx transmitters, whatever the velocity: a cell has an (M·N_tx)-th of their sum, and an
/// M-th of a slot's noise.
pub fn peak_cell_over_noise(header: &CubeHeader, samples: &[Complex32]) -> Option<f64> {
    let [_, chirps, length] = header.shape();
    let range_weights = taper(header.dsp.range_window, length).ok()?;
    let doppler_weights = taper(header.dsp.doppler_window, chirps).ok()?;
    let receivers = header.radar.array.rx_m.len();
    let (heard, among): (Vec<usize>, usize) = match header.radar.array.multiplexing {
        Multiplexing::Simultaneous | Multiplexing::Tdm | Multiplexing::Ddm => (vec![0], 1),
        Multiplexing::Bpm => {
            ((0..header.radar.slots()).map(|slot| slot * receivers).collect(), header.radar.array.tx_m.len())
        }
    };
    let mut power = vec![0.0; chirps * length];
    for channel in heard {
        let own = samples.get(channel * chirps * length..)?.get(..chirps * length)?;
        let of_channel = power_of_channel(header, own, [&range_weights, &doppler_weights]);
        power.iter_mut().zip(of_channel).for_each(|(sum, power)| *sum += power / among as f64);
    }
    let peak = power.into_iter().fold(0.0, f64::max);
    // A real mixer receives half of the noise.
    let arrives = if header.radar.waveform.sampling == Sampling::Real { 0.5 } else { 1.0 };
    let noise = arrives
        * (chirps * length) as f64
        * noise_bandwidth_bins(&range_weights)
        * noise_bandwidth_bins(&doppler_weights);
    (peak > 0.0).then_some(peak / noise)
}

/// Powers of one channel's cells, with the chirps' own times; in a real mixer's samples an echo has two
/// lines, of which one counts.
fn power_of_channel(header: &CubeHeader, samples: &[Complex32], [range, doppler]: [&[f64]; 2]) -> Vec<f64> {
    let real: Vec<Complex32>;
    let samples = match header.radar.waveform.sampling {
        Sampling::Complex => samples,
        Sampling::Real => {
            real = samples.iter().map(|sample| sample.re.into()).collect();
            &real
        }
    };
    range_doppler(&header.radar, samples, [range, doppler]).iter().map(|cell| cell.norm_sqr()).collect()
}

/// Windowed two-dimensional transform of `[chirp, sample]`, stored as `[range, doppler]`.
fn range_doppler(radar: &Radar, samples: &[Complex32], windows: [&[f64]; 2]) -> Vec<Complex64> {
    let [range_weights, doppler_weights] = windows;
    let (length, chirps) = (range_weights.len(), doppler_weights.len());
    let mut rows: Vec<Complex64> = samples
        .iter()
        .enumerate()
        .map(|(i, x)| {
            Complex64::new(x.re.into(), x.im.into()) * range_weights[i % length] * doppler_weights[i / length]
        })
        .collect();
    let mut planner = FftPlanner::new();
    planner.plan_fft_forward(length).process(&mut rows);
    let columns: Vec<Complex64> = (0..length)
        .flat_map(|n| (0..chirps).map(move |m| (m, n)))
        .map(|(m, n)| rows[m * length + n])
        .collect();
    doppler(radar, columns, &*planner.plan_fft_forward(chirps))
}

/// Doppler rows from columns of chirps. If chirp m starts δ_m after m·T, row k is Σ_m x_m·e^{−j2πk(mT +
/// δ_m)/NT}: an FFT over the chirps with equal delay, rotated row by row, as in the map.
fn doppler(radar: &Radar, mut columns: Vec<Complex64>, fft: &dyn Fft<f64>) -> Vec<Complex64> {
    if radar.schedule.is_uniform() {
        fft.process(&mut columns);
        return columns;
    }
    let chirps = fft.len();
    let delays = radar.schedule.stagger_s.len().min(chirps);
    let mut sums = vec![Complex64::ZERO; columns.len()];
    for first in 0..delays {
        let is_own = |i: usize| i % chirps % delays == first;
        let own = columns.iter().enumerate().map(|(i, x)| if is_own(i) { *x } else { Complex64::ZERO });
        let mut own: Vec<Complex64> = own.collect();
        fft.process(&mut own);
        let turns = turns(radar, first);
        own.iter().zip(turns.iter().cycle()).zip(&mut sums).for_each(|((x, turn), sum)| *sum += x * turn);
    }
    sums
}

/// Factors of the first transmitter's rows for a chirp's delay; rows count from −N/2, since a rotation for a
/// fraction of an interval is not periodic in them.
fn turns(radar: &Radar, chirp: usize) -> Vec<Complex64> {
    let rows = radar.waveform.chirps as usize;
    let late_s = radar.chirp_start_s(0, chirp) - radar.chirp_start_s(0, 0);
    let late_cycles = (late_s / radar.repetition_interval_s() - chirp as f64) / rows as f64;
    let signed = |row: usize| if row < rows.div_ceil(2) { row as f64 } else { row as f64 - rows as f64 };
    (0..rows).map(|row| Complex64::cis(-TAU * late_cycles * signed(row))).collect()
}
