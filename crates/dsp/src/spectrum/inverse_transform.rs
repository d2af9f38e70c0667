//! Samples from a map: the inverse of both transforms of a channel.
//!
//! For chirps at one interval and complex samples a map consists of two Fourier transforms of windowed
//! samples, so that the inverse transforms recover the tapered samples. These, transformed with rectangular
//! windows, give the same map.

use crate::error::DspError;
use crate::spectrum::shapes::Shapes;
use artifact::cube::CubeHeader;
use artifact::radar::Sampling;
use num_complex::Complex32;
use rustfft::{Fft, FftPlanner};
use std::sync::Arc;

/// Both inverse FFTs of a radar, for any number of channels.
pub struct InverseRangeDoppler {
    chirps: usize,
    samples: usize,
    falling_slope: bool,
    range_fft: Arc<dyn Fft<f32>>,
    doppler_fft: Arc<dyn Fft<f32>>,
}

impl InverseRangeDoppler {
    /// Inverse transforms of the maps for a cube's header.
    ///
    /// # Errors
    /// Staggered chirps, real samples, and a radar from which no map can be made.
    pub fn new(header: &CubeHeader) -> Result<Self, DspError> {
        let [_, chirps, samples] = Shapes::of(header)?.cube;
        let (schedule, waveform) = (&header.radar.schedule, &header.radar.waveform);
        if !schedule.is_uniform() || waveform.sampling == Sampling::Real {
            return Err(DspError::NoInverse);
        }
        let mut planner = FftPlanner::new();
        Ok(Self {
            chirps,
            samples,
            falling_slope: waveform.slope_hz_per_s < 0.0,
            range_fft: planner.plan_fft_inverse(samples),
            doppler_fft: planner.plan_fft_inverse(chirps),
        })
    }

    /// Samples `[chirp, sample]` from one channel's map `[doppler, range]` with zero velocity at N/2, tapered
    /// like the map's.
    pub fn channel(&self, map: &[Complex32]) -> Vec<Complex32> {
        let mut spectra = self.range_spectra(map);
        for row in spectra.chunks_exact_mut(self.samples) {
            if self.falling_slope {
                row[1..].reverse();
            }
            self.range_fft.process(row);
        }
        spectra
    }

    /// Range spectra `[chirp, range]`.
    fn range_spectra(&self, map: &[Complex32]) -> Vec<Complex32> {
        let mut spectra = vec![Complex32::ZERO; self.chirps * self.samples];
        let scale = 1.0 / spectra.len() as f32;
        for range in 0..self.samples {
            let row = |bin: usize| (bin + self.chirps / 2) % self.chirps;
            let mut column: Vec<Complex32> =
                (0..self.chirps).map(|bin| map[row(bin) * self.samples + range]).collect();
            self.doppler_fft.process(&mut column);
            let places = spectra[range..].iter_mut().step_by(self.samples);
            places.zip(column).for_each(|(place, value)| *place = value * scale);
        }
        spectra
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::map_transform::RangeDoppler;
    use artifact::settings::{DspSettings, Noise, Window};
    use radar::{aperture::Preset, paper};

    fn header(samples: u32, chirps: u32, slope: f64) -> CubeHeader {
        let mut radar =
            paper::radar([0.0; 3], paper::waveform(samples, chirps), Preset::OneByFour.elements());
        radar.waveform.slope_hz_per_s *= slope;
        let windows = (Window::Rect, Window::Rect);
        let dsp = DspSettings { range_window: windows.0, doppler_window: windows.1, ..paper::processing() };
        CubeHeader { radar, noise: Noise::Absent, dsp, unit: Default::default() }
    }

    #[test]
    fn a_map_s_samples_are_those_that_it_was_made_of() {
        for (samples, chirps, slope) in [(16, 8, 1.0), (15, 7, 1.0), (16, 9, -1.0), (13, 1, -1.0)] {
            let header = header(samples, chirps, slope);
            let sent: Vec<Complex32> = (0..samples * chirps)
                .map(|i| Complex32::from_polar(1.0 + (i % 5) as f32, (i * i % 97) as f32))
                .collect();
            let map = RangeDoppler::<f32>::new(&header).unwrap().channel(&sent, 0.0);
            let found = InverseRangeDoppler::new(&header).unwrap().channel(&map);
            let worst = found.iter().zip(&sent).map(|(a, b)| (a - b).norm()).fold(0.0, f32::max);
            assert!(worst < 1e-5, "{samples} × {chirps}: {worst}");
        }
    }

    #[test]
    fn maps_that_are_not_two_fourier_transforms_have_no_inverse() {
        let mut real = header(16, 8, 1.0);
        real.radar.waveform.sampling = Sampling::Real;
        let mut staggered = header(16, 8, 1.0);
        staggered.radar.schedule.stagger_s = vec![0.0, 1e-6];
        for header in [real, staggered] {
            assert_eq!(InverseRangeDoppler::new(&header).err(), Some(DspError::NoInverse));
        }
    }
}
