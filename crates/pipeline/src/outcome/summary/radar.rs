//! The radar's parameters and the names of its lanes.

use crate::outcome::summary::words::SamplingWord;
use artifact::radar::{ElementError, Sampling};
use artifact::scene::SceneHeader;
use artifact::settings::Noise;
use radar::lattice::resolves_azimuth;
use serde::{Deserialize, Serialize};

/// Parameters of the radar in standard terms.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RadarSummary {
    /// Centre frequency of the sampled sweep, Hz.
    pub carrier_hz: f64,
    /// Bandwidth of the sampled sweep, Hz.
    pub bandwidth_hz: f64,
    /// Time from one chirp of any transmitter to the next, s.
    pub chirp_interval_s: f64,
    /// Number of samples of a chirp in one receiver.
    pub samples_per_chirp: u32,
    /// Whether the mixer's output is sampled as complex or as real values.
    #[serde(with = "SamplingWord")]
    pub sampling: Sampling,
    /// Number of chirps of each transmitter in a frame.
    pub chirps: u32,
    /// Number of virtual channels: transmitters times receivers.
    pub channels: usize,
    /// Whether the array measures azimuths: it has elements at more than one place along the row.
    #[serde(default = "by_older_summaries")]
    pub tells_azimuth: bool,
    /// Whether echoes have noise; without noise a floor below the map's peak replaces it.
    #[serde(default = "by_older_summaries")]
    pub has_noise: bool,
    /// Errors of the array's elements; `None` for an ideal array.
    pub element_errors: Option<ElementErrors>,
    /// Range resolution of the sampled sweep, m.
    pub range_resolution_m: f64,
    /// The maximum unambiguous range, m.
    pub range_max_m: f64,
    /// Velocity resolution of the frame, m/s.
    pub velocity_resolution_mps: f64,
    /// The maximum unambiguous velocity to either side, m/s.
    pub velocity_max_mps: f64,
    /// Sample rate of the analogue-to-digital converter, Hz.
    pub sample_rate_hz: f64,
}

/// Errors of the array's elements: the listed and the drawn errors together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ElementErrors {
    /// Errors of each transmitter.
    pub tx: Vec<ElementErrorSummary>,
    /// Errors of each receiver.
    pub rx: Vec<ElementErrorSummary>,
}

/// Errors of an element of the array.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ElementErrorSummary {
    /// Error of the element's amplitude, dB.
    pub gain_db: f64,
    /// Error of the phase of the element's IF values, degrees.
    pub phase_deg: f64,
    /// Error of the delay of the element's line, ps.
    pub delay_ps: f64,
}

/// Lane with its number, its name and its width.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LaneSummary {
    /// Number of the lane, as used in estimates and truths.
    pub number: u8,
    /// Name of the lane in a network; `None` without a network.
    pub id: Option<String>,
    /// Width of the lane, m.
    pub width_m: f64,
}

/// Default for older summaries without these keys: arrays measure azimuths and echoes have noise.
fn by_older_summaries() -> bool {
    true
}

impl RadarSummary {
    /// Summarizes the radar of a scene.
    pub fn of(header: &SceneHeader) -> Self {
        let (radar, waveform) = (&header.radar, &header.radar.waveform);
        Self {
            carrier_hz: waveform.centre_frequency_hz(),
            bandwidth_hz: waveform.bandwidth_hz().abs(),
            chirp_interval_s: waveform.chirp_interval_s,
            samples_per_chirp: waveform.samples,
            sampling: waveform.sampling,
            chirps: waveform.chirps,
            channels: radar.virtual_channels(),
            tells_azimuth: resolves_azimuth(radar),
            has_noise: header.noise != Noise::Absent,
            element_errors: ElementErrors::of(header),
            range_resolution_m: waveform.range_resolution_m(),
            range_max_m: waveform.range_max_m(),
            velocity_resolution_mps: radar.velocity_resolution_mps(),
            velocity_max_mps: radar.velocity_max_mps(),
            sample_rate_hz: waveform.sample_rate_hz,
        }
    }
}

impl ElementErrors {
    fn of(header: &SceneHeader) -> Option<Self> {
        let hardware = fmcw_echo::element_errors::with_drawn_errors(&header.radar, header.seed).hardware;
        let of = |errors: &[ElementError]| errors.iter().map(ElementErrorSummary::of).collect::<Vec<_>>();
        let all = Self { tx: of(&hardware.tx), rx: of(&hardware.rx) };
        (!all.tx.is_empty() || !all.rx.is_empty()).then_some(all)
    }
}

impl ElementErrorSummary {
    fn of(error: &ElementError) -> Self {
        Self {
            gain_db: error.gain_db,
            phase_deg: error.phase_rad.to_degrees(),
            delay_ps: error.delay_s * 1e12,
        }
    }
}

impl LaneSummary {
    pub(super) fn all(header: &SceneHeader) -> Vec<Self> {
        let road = &header.dsp.road;
        let straight = road.lanes.iter().map(|l| Self { number: l.number, id: None, width_m: l.width_m });
        let of_net = road.courses.iter();
        let of_net = of_net.map(|c| Self { number: c.number, id: Some(c.name.clone()), width_m: c.width_m });
        straight.chain(of_net).collect()
    }
}
