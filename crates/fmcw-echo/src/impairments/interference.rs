//! Interference by other FMCW radars: where a chirp of theirs crosses ours, the mixer turns it into a short
//! chirp of the IF.
//!
//! A wave of an interferer's chirp that began at t_j has the phase 2π(f₁s + ½μ₁s²), s = T − τ − t_j, τ = R/c
//! one way. Mixed with ours like every echo (transmit times conj receive) it is e^{j2π[f₀t + ½μt² − f₁s −
//! ½μ₁s²]}, of frequency f₀ + μt − f₁ − μ₁s. The IF filter is a brick wall that passes the echoes of every
//! range of the map: for complex samples beats from 0 to f_s, with the sign of μ like the echoes' (the image
//! band is filtered out: Ramasubramanian, Texas Instruments SPYY007 (2017)), for real ones beats within
//! ±f_s/2. Either is f_s wide, so a crossing is received for f_s/|μ − μ₁| seconds (Brooker, IEEE Trans. EMC
//! 49 (2007) 170). Its power is EIRP·G_r·λ²/(4πR)², with polarizations taken as equal.

use crate::links::multiplexing::{Transmission, receiver_factor, row as transmissions};
use artifact::radar::{Interferer, Sampling};
use artifact::units::{SPEED_OF_LIGHT_MPS, power_from_db};
use artifact::{Radar, Waveform};
use glam::DVec3;
use num_complex::{Complex32, Complex64};
use radar::aperture::{axes, pattern_amplitude};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// Adds the contribution of all interferers to a cube whose first sample is `time_s` after the scene's.
pub(crate) fn add(radar: &Radar, time_s: f64, samples: &mut [Complex32]) {
    if radar.hardware.interferers.is_empty() {
        return;
    }
    let (chirps, length) = (radar.waveform.chirps as usize, radar.waveform.samples as usize);
    samples.par_chunks_mut(length).enumerate().for_each(|(r, stored)| {
        for (sample, heard) in stored.iter_mut().zip(row(radar, time_s, r / chirps, r % chirps)) {
            *sample += Complex32::new(heard.re as f32, heard.im as f32);
        }
    });
}

/// Contribution of all interferers to one row of a cube, √W.
pub fn row(radar: &Radar, time_s: f64, channel: usize, chirp: usize) -> Vec<Complex64> {
    let mut samples = vec![Complex64::ZERO; radar.waveform.samples as usize];
    // All transmissions of a row start together and are received by the same element.
    let Some(transmission) = transmissions(radar, channel, chirp).first().copied() else { return samples };
    let element = receiver_factor(radar, channel % radar.array.rx_m.len());
    let receiver = Receiver { radar, axes: axes(radar), transmission, element, time_s };
    for interferer in &radar.hardware.interferers {
        receiver.add_interferer(interferer, &mut samples);
    }
    samples
}

/// Samples of a chirp between two positions. Casts saturate at both ends: negative values become 0.
fn span([from, to]: [f64; 2], samples: usize) -> Range<usize> {
    let (from, to) = (from.floor() as usize, to.ceil().max(-1.0) as usize);
    from.min(samples)..to.saturating_add(1).min(samples)
}

/// Number of an interferer's latest chirp started by `time_s` after the scene's first sample.
fn begun(interferer: &Interferer, time_s: f64) -> f64 {
    ((time_s - interferer.offset_s) / interferer.chirp_interval_s).floor()
}

/// Centre of the IF filter's passband, Hz; the band is as wide as the sample rate.
fn band_middle_hz(waveform: &Waveform) -> f64 {
    match waveform.sampling {
        Sampling::Complex => 0.5 * waveform.sample_rate_hz.copysign(waveform.slope_hz_per_s),
        Sampling::Real => 0.0,
    }
}

/// A receive element during one chirp.
struct Receiver<'a> {
    radar: &'a Radar,
    axes: [DVec3; 3],
    transmission: Transmission,
    element: Complex64,
    /// Time of the frame's first sample.
    time_s: f64,
}

impl Receiver<'_> {
    fn add_interferer(&self, interferer: &Interferer, samples: &mut [Complex64]) {
        let link = self.link_amplitude(interferer);
        let start_s = self.time_s + self.transmission.start_s;
        let duration_s = samples.len() as f64 / self.radar.waveform.sample_rate_hz;
        let delay_s = self.way_m(interferer, start_s).length() / SPEED_OF_LIGHT_MPS;
        // Interferer chirps that can arrive within ours: from one that began a sweep before the first
        // sample's departure to the last.
        let first = begun(interferer, start_s - delay_s - interferer.sweep_s);
        let last = begun(interferer, start_s - delay_s + duration_s) + 1.0;
        if last - first > samples.len() as f64 {
            return self.add_each_sample((interferer, link), samples);
        }
        let mut chirp = first;
        while chirp <= last {
            let since_s = self.since_s(interferer, chirp);
            for n in self.near_crossing(interferer, since_s, samples.len()) {
                samples[n] += self.chirp_sample((interferer, link), since_s, n);
            }
            chirp += 1.0;
        }
    }

    /// [`Self::add_interferer`] for chirps so short that more of them than samples arrive within ours: each
    /// sample receives at most one, whose number follows from its departure up to rounding.
    fn add_each_sample(&self, (interferer, link): (&Interferer, f64), samples: &mut [Complex64]) {
        for (n, sample) in samples.iter_mut().enumerate() {
            let time_s = self.arrival_s(n);
            let delay_s = self.way_m(interferer, time_s).length() / SPEED_OF_LIGHT_MPS;
            let number = begun(interferer, time_s - delay_s);
            for chirp in [number - 1.0, number, number + 1.0] {
                *sample += self.chirp_sample((interferer, link), self.since_s(interferer, chirp), n);
            }
        }
    }

    /// Time at which the element receives the wave of sample `n` of our chirp, after the scene's first
    /// sample.
    fn arrival_s(&self, n: usize) -> f64 {
        let t = n as f64 / self.radar.waveform.sample_rate_hz;
        self.time_s + self.transmission.start_s + t - self.transmission.receiver_delay_s
    }

    /// Time from the start of a chirp of the interferer to our first sample.
    ///
    /// Hours after the scene's first sample, times have steps of 2 ps, a seventh of a cycle at 77 GHz: the
    /// two large ones are subtracted first, then the product together with its rounding error.
    fn since_s(&self, interferer: &Interferer, chirp: f64) -> f64 {
        let begin_s = chirp * interferer.chirp_interval_s;
        let left_s = chirp.mul_add(interferer.chirp_interval_s, -begin_s);
        (self.time_s - begin_s) - left_s - interferer.offset_s + self.transmission.start_s
    }

    /// Contribution of one chirp, which began `since_s` before our first sample, to sample `n`.
    fn chirp_sample(&self, (interferer, link): (&Interferer, f64), since_s: f64, n: usize) -> Complex64 {
        let waveform = &self.radar.waveform;
        let t = n as f64 / waveform.sample_rate_hz;
        let way_m = self.way_m(interferer, self.arrival_s(n));
        let length_m = way_m.length();
        let s = since_s + t - self.transmission.receiver_delay_s - length_m / SPEED_OF_LIGHT_MPS;
        let frequency_hz = waveform.start_frequency_hz + waveform.slope_hz_per_s * t
            - interferer.start_frequency_hz
            - interferer.slope_hz_per_s * s;
        let is_passed = (frequency_hz - band_middle_hz(waveform)).abs() < 0.5 * waveform.sample_rate_hz;
        if !(0.0..interferer.sweep_s).contains(&s) || !is_passed {
            return Complex64::ZERO;
        }
        let own = (waveform.start_frequency_hz + 0.5 * waveform.slope_hz_per_s * t) * t;
        let other = (interferer.start_frequency_hz + 0.5 * interferer.slope_hz_per_s * s) * s;
        let gain = link * pattern_amplitude(self.radar, &self.axes, way_m / length_m) / length_m;
        self.element * gain * Complex64::cis(TAU * (own.fract() - other.fract()))
    }

    /// Samples that can lie in the band and within the interferer's chirp, with a margin of two on either
    /// side, plus the shift of the crossing by the interferer's motion within our chirp.
    fn near_crossing(&self, interferer: &Interferer, since_s: f64, samples: usize) -> Range<usize> {
        let waveform = &self.radar.waveform;
        let (f_s, start_s) = (waveform.sample_rate_hz, self.time_s + self.transmission.start_s);
        let line_s = self.transmission.receiver_delay_s;
        let delay_s = self.way_m(interferer, start_s).length() / SPEED_OF_LIGHT_MPS + line_s;
        let begin = (delay_s - since_s) * f_s;
        let arriving = span([begin - 2.0, begin + interferer.sweep_s * f_s + 2.0], samples);
        let slope = waveform.slope_hz_per_s - interferer.slope_hz_per_s;
        if slope == 0.0 {
            return arriving;
        }
        let first_hz = waveform.start_frequency_hz
            - interferer.start_frequency_hz
            - interferer.slope_hz_per_s * (since_s - delay_s);
        let speed_mps = DVec3::from_array(interferer.velocity_mps).length();
        let moved_s = speed_mps / SPEED_OF_LIGHT_MPS * (samples as f64 / f_s + line_s);
        let half_hz = 0.5 * f_s + interferer.slope_hz_per_s.abs() * moved_s;
        let (middle, half) =
            ((band_middle_hz(waveform) - first_hz) / slope * f_s, half_hz / slope.abs() * f_s + 2.0);
        let crossing = span([middle - half, middle + half], samples);
        crossing.start.max(arriving.start)..crossing.end.min(arriving.end)
    }

    /// Link amplitude √(EIRP·G_r)·λ/4π, √W·m, at boresight.
    fn link_amplitude(&self, interferer: &Interferer) -> f64 {
        let gain = power_from_db(self.radar.link.antenna_gain_db);
        (interferer.eirp_w * gain).sqrt() * self.radar.waveform.wavelength_m() / (4.0 * PI)
    }

    /// Vector from the element to the interferer at the departure of the wave that arrives `time_s` after the
    /// scene's first sample.
    fn way_m(&self, interferer: &Interferer, time_s: f64) -> DVec3 {
        let velocity_mps = DVec3::from_array(interferer.velocity_mps);
        let at = |time_s: f64| {
            DVec3::from_array(interferer.position_m) + velocity_mps * time_s - self.transmission.rx_m
        };
        // Each step reduces the error by c/v: after two it is 1e-15 of the distance at 10 m/s.
        let earlier_s = |way_m: DVec3| way_m.length() / SPEED_OF_LIGHT_MPS;
        at(time_s - earlier_s(at(time_s - earlier_s(at(time_s)))))
    }
}
