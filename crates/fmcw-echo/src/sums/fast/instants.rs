//! Exact IF value of a path at any instant of a frame, for all transmit–receive pairs of an array.
//!
//! The formulas are those of [`mod@crate::sums::reference`]; an instant is a possibly fractional chirp and
//! sample. Quantities that do not depend on the pair are computed once per element: a leg's length, gain and
//! rate.

use crate::links::multiplexing::{Transmission, line_delay_s};
use crate::sums::fast::equidistant_chirps::EquidistantChirps;
use artifact::Radar;
use artifact::paths::Path;
use artifact::units::SPEED_OF_LIGHT_MPS;
use glam::DVec3;
use num_complex::Complex64;
use radar::aperture::{axes, pattern_amplitude};
use radar::beat::if_cycles;
use radar::link::link_amplitude;
use std::ops::Range;

/// A transmit element paired with a receive element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Link {
    pub(crate) tx: usize,
    pub(crate) rx: usize,
}

/// An instant of a frame: chirp (of those at equal steps) and sample, counted from 0, possibly fractional.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Instant {
    pub(crate) chirp: f64,
    pub(crate) sample: f64,
}

/// An IF value whose phase in cycles is not yet reduced modulo 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct IfValue {
    pub(crate) amplitude: Complex64,
    pub(crate) cycles: f64,
}

/// Phase rotation of a path's IF value per chirp and per sample at the frame's middle, cycles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tone {
    pub(crate) per_chirp: f64,
    pub(crate) per_sample: f64,
}

/// A radar that receives paths.
pub(crate) struct ReceivingRadar<'a> {
    pub(crate) radar: &'a Radar,
    pub(crate) centre_frequency_hz: f64,
    /// Chirps that are received.
    pub(crate) steps: EquidistantChirps,
    link_amplitude: f64,
    axes: [DVec3; 3],
}

/// A leg to one element.
#[derive(Clone, Copy)]
struct ElementLeg {
    length_m: f64,
    rate_mps: f64,
    /// Pattern gain over length, 1/m.
    gain_per_m: f64,
}

impl<'a> ReceivingRadar<'a> {
    pub(crate) fn new(radar: &'a Radar, centre_frequency_hz: f64, steps: EquidistantChirps) -> Self {
        let (link_amplitude, axes) = (link_amplitude(radar), axes(radar));
        Self { radar, centre_frequency_hz, steps, link_amplitude, axes }
    }

    /// The same radar for a subset of these chirps.
    pub(crate) fn during(&self, chirps: &Range<usize>) -> Self {
        Self { steps: self.steps.part(chirps), ..*self }
    }

    /// Transmission of a link at an integer or fractional chirp.
    pub(crate) fn transmission(&self, link: Link, chirp: f64) -> Transmission {
        Transmission::starting_at(self.radar, link.tx, link.rx, self.steps.start_s(link.tx, chirp))
    }

    /// Middle of the frame.
    pub(crate) fn middle(&self) -> Instant {
        Instant { chirp: (self.steps.chirps / 2) as f64, sample: f64::from(self.radar.waveform.samples / 2) }
    }

    /// Calls `give` with the index of every link, transmitter by transmitter, and the value of a path there.
    pub(crate) fn for_each_value(
        &self,
        path: &Path,
        links: &[Link],
        at: Instant,
        give: &mut dyn FnMut(usize, IfValue),
    ) {
        let t = at.sample / self.radar.waveform.sample_rate_hz;
        let mut place = 0;
        for of_tx in links.chunk_by(|a, b| a.tx == b.tx) {
            let time_s = self.steps.start_s(of_tx[0].tx, at.chirp) + t;
            let hardware = &self.radar.hardware;
            let arriving = |rx: usize| {
                let arrival_s = time_s - line_delay_s(&hardware.rx, rx);
                self.arriving(path, DVec3::from_array(self.radar.array.rx_m[rx]), arrival_s)
            };
            let first = arriving(of_tx[0].rx);
            // The scattering time differs by the delay to another element, over which a leg is linear.
            let departing = self.departing(
                path,
                DVec3::from_array(self.radar.array.tx_m[of_tx[0].tx]),
                time_s - line_delay_s(&hardware.rx, of_tx[0].rx) - first.length_m / C,
            );
            for link in of_tx {
                let arriving = arriving(link.rx);
                let line_s = line_delay_s(&hardware.rx, link.rx);
                let later_s = (first.length_m - arriving.length_m) / C
                    + line_delay_s(&hardware.rx, of_tx[0].rx)
                    - line_s;
                let way_s = (departing.length_m + departing.rate_mps * later_s + arriving.length_m) / C;
                let tau = way_s + line_delay_s(&hardware.tx, link.tx) + line_s;
                give(place, self.value(path, t, tau, departing.gain_per_m * arriving.gain_per_m));
                place += 1;
            }
        }
    }

    /// Tone of a path as seen from the array's position, at the frame's middle.
    pub(crate) fn tone(&self, path: &Path) -> Tone {
        let waveform = &self.radar.waveform;
        let at = self.middle();
        let t = at.sample / waveform.sample_rate_hz;
        let time_s = self.steps.start_s(0, at.chirp) + t;
        let position_m = DVec3::from_array(self.radar.position_m);
        let legs = [self.departing(path, position_m, time_s), self.arriving(path, position_m, time_s)];
        let (tau, rate) =
            ((legs[0].length_m + legs[1].length_m) / C, (legs[0].rate_mps + legs[1].rate_mps) / C);
        let beat_hz = waveform.slope_hz_per_s * tau;
        let doppler_hz = rate * (waveform.start_frequency_hz + waveform.slope_hz_per_s * (t - tau));
        Tone {
            per_chirp: doppler_hz * self.steps.step_s,
            per_sample: (beat_hz + doppler_hz) / waveform.sample_rate_hz,
        }
    }

    /// Value by eq. (13): √(P_tG_tG_r)·λ/(4π)^{3/2}·conj a(f)·gain, and f₀τ + μtτ − ½μτ².
    fn value(&self, path: &Path, t: f64, tau: f64, gain_per_m2: f64) -> IfValue {
        let waveform = &self.radar.waveform;
        let (receive, transmit) = self.radar.array.polarization.indices();
        let offset_hz =
            waveform.start_frequency_hz + waveform.slope_hz_per_s * (t - tau) - self.centre_frequency_hz;
        let amplitude_m =
            path.amplitude_m[receive][transmit] + offset_hz * path.slope_m_per_hz[receive][transmit];
        let amplitude = self.link_amplitude * gain_per_m2 * amplitude_m.conj();
        IfValue { amplitude, cycles: if_cycles(waveform, t, tau) }
    }

    fn departing(&self, path: &Path, element_m: DVec3, scattering_time_s: f64) -> ElementLeg {
        let (position_m, velocity_mps) =
            at(path.apparent_tx_m, path.apparent_tx_mps, path.curve.apparent_tx_mps2, scattering_time_s);
        let way_m = position_m - element_m;
        let length_m = way_m.length();
        self.leg(way_m / length_m, length_m, velocity_mps)
    }

    /// Arrival leg at the scattering time t_s = T − |x(t_s) − p|/c: |x(t_s) − p| = |x(T) − p|/(1 + v·d/c), up
    /// to (v/c)².
    fn arriving(&self, path: &Path, element_m: DVec3, time_s: f64) -> ElementLeg {
        let (position_m, velocity_mps) =
            at(path.apparent_rx_m, path.apparent_rx_mps, path.curve.apparent_rx_mps2, time_s);
        let way_m = position_m - element_m;
        let length_m = way_m.length();
        let direction = way_m / length_m;
        self.leg(direction, length_m / (1.0 + velocity_mps.dot(direction) / C), velocity_mps)
    }

    fn leg(&self, direction: DVec3, length_m: f64, velocity_mps: DVec3) -> ElementLeg {
        let pattern = pattern_amplitude(self.radar, &self.axes, direction);
        ElementLeg { length_m, rate_mps: velocity_mps.dot(direction), gain_per_m: pattern / length_m }
    }
}

/// Position and velocity of an apparent point.
fn at(point_m: [f64; 3], velocity_mps: [f64; 3], acceleration_mps2: [f64; 3], time_s: f64) -> (DVec3, DVec3) {
    let (velocity_mps, gained_mps) =
        (DVec3::from_array(velocity_mps), DVec3::from_array(acceleration_mps2) * time_s);
    (DVec3::from_array(point_m) + (velocity_mps + 0.5 * gained_mps) * time_s, velocity_mps + gained_mps)
}

const C: f64 = SPEED_OF_LIGHT_MPS;
