//! Both transforms of a channel: window, FFT over samples, window, FFT over chirps.
//!
//! Maps are computed in single precision, as cubes and maps are stored (the same code in double precision is
//! the reference): for N values of the same rms, a transform adds an error of about ε·√(log₂N)/2·rms to every
//! cell (Schatzman, SIAM J. Sci. Comput. 17 (1996) 1150), a further √N below the peak of a single tone: -180
//! dB of it in a map of 128 × 256, the same as the earlier rounding of the cube to single precision. Chirps
//! are transformed in place, Doppler columns in blocks that fit a core's L1 cache.

use crate::error::DspError;
use crate::numerics::precision::Precision;
use crate::spectrum::division::Division;
use crate::spectrum::doppler_transform::DopplerTransform;
use crate::spectrum::shapes::Shapes;
use crate::spectrum::window::taper;
use artifact::cube::CubeHeader;
use num_complex::{Complex, Complex32, Complex64};
use rustfft::num_traits::Zero;
use rustfft::{Fft, FftPlanner};
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::Arc;

/// Both FFTs and windows of a radar, for any number of channels, in single or double precision.
pub struct RangeDoppler<T = f32> {
    shapes: Shapes,
    division: Division,
    chirps: usize,
    samples: usize,
    /// Number of range cells: that of samples, or half of it for real samples.
    columns: usize,
    falling_slope: bool,
    range_taper: Vec<T>,
    doppler_taper: Vec<f64>,
    range_fft: Arc<dyn Fft<T>>,
    doppler: DopplerTransform<T>,
}

/// Buffers of one channel's transforms, reused for the next.
#[derive(Default)]
pub(crate) struct Workspace<T> {
    /// Spectra `[chirp, range]`.
    spectra: Vec<Complex<T>>,
    /// Whole spectrum of a chirp of which half is kept.
    whole: Vec<Complex<T>>,
    /// [`COLUMNS`] Doppler columns, one after the other.
    columns: Vec<Complex<T>>,
    scratch: Vec<Complex<T>>,
}

/// Number of range cells whose Doppler columns are transformed together: two cache lines of a row.
const COLUMNS: usize = 16;

impl<T: Precision> RangeDoppler<T> {
    /// Windows and transforms for a cube's header.
    pub fn new(header: &CubeHeader) -> Result<Self, DspError> {
        let shapes = Shapes::of(header)?;
        let [_, chirps, columns] = shapes.map;
        let samples = header.radar.waveform.samples as usize;
        let mut planner = FftPlanner::new();
        Ok(Self {
            shapes,
            division: Division::of(&header.radar),
            chirps,
            samples,
            columns,
            falling_slope: header.radar.waveform.slope_hz_per_s < 0.0,
            range_taper: taper(header.dsp.range_window, samples)?.into_iter().map(T::of).collect(),
            doppler_taper: taper(header.dsp.doppler_window, chirps)?,
            range_fft: planner.plan_fft_forward(samples),
            doppler: DopplerTransform::new(&header.radar, &mut planner)?,
        })
    }

    /// Map `[doppler, range]` from one channel's `[chirp, sample]`, unscaled, with zero velocity at N/2 and
    /// range growing.
    ///
    /// `turn_cycles` per chirp are removed first: the offset of a transmitter under Doppler division.
    pub fn channel(&self, samples: &[Complex32], turn_cycles: f64) -> Vec<Complex<T>> {
        self.channel_of(0, samples, turn_cycles)
    }

    /// [`Self::channel`] for any transmitter; staggered chirps differ between transmitters.
    pub fn channel_of(&self, transmitter: usize, samples: &[Complex32], turn_cycles: f64) -> Vec<Complex<T>> {
        let mut map = vec![Complex::zero(); self.cells()];
        let mut work = Workspace { spectra: vec![], whole: vec![], columns: vec![], scratch: vec![] };
        self.fill(transmitter, (samples, turn_cycles), &mut work, &mut map);
        map
    }

    /// [`Self::channel_of`] into an existing map.
    pub(crate) fn fill(
        &self,
        transmitter: usize,
        (samples, turn_cycles): (&[Complex32], f64),
        work: &mut Workspace<T>,
        map: &mut [Complex<T>],
    ) {
        let scratch = self.range_fft.get_inplace_scratch_len().max(self.doppler.scratch_len());
        work.scratch.resize(scratch, Complex::zero());
        work.spectra.resize(self.cells(), Complex::zero());
        work.columns.resize(COLUMNS * self.chirps, Complex::zero());
        self.range_spectra(samples, turn_cycles, work);
        for first in (0..self.columns).step_by(COLUMNS) {
            self.doppler_columns(transmitter, first..self.columns.min(first + COLUMNS), work, map);
        }
    }

    /// Shapes of cubes and maps.
    pub(crate) fn shapes(&self) -> &Shapes {
        &self.shapes
    }

    /// Division of the channels among transmitters and receivers.
    pub(crate) fn division(&self) -> &Division {
        &self.division
    }

    /// Number of cells of one channel.
    pub(crate) fn cells(&self) -> usize {
        self.chirps * self.columns
    }

    /// Number of samples of one channel.
    pub(crate) fn samples(&self) -> usize {
        self.chirps * self.samples
    }

    fn range_spectra(&self, samples: &[Complex32], turn_cycles: f64, work: &mut Workspace<T>) {
        if self.columns < self.samples {
            return self.half_spectra(samples, turn_cycles, work);
        }
        let rows = samples.chunks_exact(self.samples).zip(work.spectra.chunks_exact_mut(self.samples));
        for (chirp, (row, spectrum)) in rows.enumerate() {
            self.range_spectrum(row, (chirp, turn_cycles), spectrum, &mut work.scratch);
        }
    }

    /// Spectra of real samples, of which the frequencies of increasing range are kept: the others are their
    /// image.
    fn half_spectra(&self, samples: &[Complex32], turn_cycles: f64, work: &mut Workspace<T>) {
        work.whole.resize(self.samples, Complex::zero());
        let rows = samples.chunks_exact(self.samples).zip(work.spectra.chunks_exact_mut(self.columns));
        for (chirp, (row, half)) in rows.enumerate() {
            self.range_spectrum(row, (chirp, turn_cycles), &mut work.whole, &mut work.scratch);
            half.copy_from_slice(&work.whole[..self.columns]);
        }
    }

    /// Spectrum of one chirp, with range growing.
    fn range_spectrum(
        &self,
        row: &[Complex32],
        (chirp, turn_cycles): (usize, f64),
        spectrum: &mut [Complex<T>],
        scratch: &mut [Complex<T>],
    ) {
        self.tapered(row, chirp, turn_cycles, spectrum);
        self.range_fft.process_with_scratch(spectrum, scratch);
        if self.falling_slope {
            // A negative slope puts increasing ranges at decreasing frequencies.
            spectrum[1..].reverse();
        }
    }

    fn tapered(&self, row: &[Complex32], chirp: usize, turn_cycles: f64, tapered: &mut [Complex<T>]) {
        let values = tapered.iter_mut().zip(row.iter().map(|x| T::of_sample(*x))).zip(&self.range_taper);
        if turn_cycles == 0.0 {
            let weight = T::of(self.doppler_taper[chirp]);
            return values.for_each(|((tapered, x), w)| *tapered = x * (weight * *w));
        }
        let turn =
            Complex64::from_polar(self.doppler_taper[chirp], -TAU * (chirp as f64 * turn_cycles).fract());
        let weight = Complex::new(T::of(turn.re), T::of(turn.im));
        values.for_each(|((tapered, x), w)| *tapered = weight * (x * *w));
    }

    fn doppler_columns(
        &self,
        transmitter: usize,
        ranges: Range<usize>,
        work: &mut Workspace<T>,
        map: &mut [Complex<T>],
    ) {
        let columns = &mut work.columns[..ranges.len() * self.chirps];
        for (chirp, row) in work.spectra.chunks_exact(self.columns).enumerate() {
            let column = columns[chirp..].iter_mut().step_by(self.chirps);
            column.zip(&row[ranges.clone()]).for_each(|(to, from)| *to = *from);
        }
        self.doppler.process(transmitter, columns, &mut work.scratch);
        for bin in 0..self.chirps {
            let row = (bin + self.chirps / 2) % self.chirps * self.columns;
            let column = columns[bin..].iter().step_by(self.chirps);
            map[row..][ranges.clone()].iter_mut().zip(column).for_each(|(to, from)| *to = *from);
        }
    }
}
