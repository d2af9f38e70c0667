//! The radar: waveform, antenna array and link, as used by every stage.

pub use crate::descriptions::pattern::{Pattern, PatternTable};
use crate::quantities::units::SPEED_OF_LIGHT_MPS;
use serde::{Deserialize, Serialize};

/// A radar at its position.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Radar {
    /// Centre of the transmit row and of the receive row, world metres.
    pub position_m: [f64; 3],
    /// Azimuth of the boresight, from +y towards +x.
    pub boresight_az_rad: f64,
    /// Elevation of the boresight above the horizon.
    pub boresight_el_rad: f64,
    /// Transmitted waveform.
    pub waveform: Waveform,
    /// Schedule of the chirps, where they do not follow at one constant interval.
    pub schedule: Schedule,
    /// Transmit and receive antenna elements.
    pub array: Array,
    /// Power and gain.
    pub link: Link,
    /// Imperfections of the radar.
    pub hardware: Hardware,
}

/// Linear chirps; sampled time runs from the start of the sampled part of a chirp (`docs/conventions.md`).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Waveform {
    /// Start frequency f₀: instantaneous frequency at the first sample.
    pub start_frequency_hz: f64,
    /// Slope μ of a chirp.
    pub slope_hz_per_s: f64,
    /// Sample rate f_s, of complex or real samples.
    pub sample_rate_hz: f64,
    /// Part of the mixer's product that is sampled.
    pub sampling: Sampling,
    /// Samples of a chirp, N_s.
    pub samples: u32,
    /// Chirp interval T_c, from one chirp of any transmitter to the next; the mean where there are several
    /// intervals ([`Schedule`]).
    pub chirp_interval_s: f64,
    /// Chirps that each transmitter sends in a frame, N_c; blocks of chirps for [`Multiplexing::Bpm`].
    pub chirps: u32,
}

impl Waveform {
    /// Bandwidth of the sampled sweep, B = μ·N_s/f_s (Table 2).
    pub fn bandwidth_hz(&self) -> f64 {
        self.slope_hz_per_s * f64::from(self.samples) / self.sample_rate_hz
    }

    /// Centre of the sampled sweep, f₀ + B/2.
    pub fn centre_frequency_hz(&self) -> f64 {
        self.start_frequency_hz + 0.5 * self.bandwidth_hz()
    }

    /// Wavelength at the centre of the sampled sweep.
    pub fn wavelength_m(&self) -> f64 {
        SPEED_OF_LIGHT_MPS / self.centre_frequency_hz()
    }

    /// Range resolution ΔR = c/2|B|, one range cell.
    pub fn range_resolution_m(&self) -> f64 {
        SPEED_OF_LIGHT_MPS / (2.0 * self.bandwidth_hz().abs())
    }

    /// Range at which the beat frequency aliases: at f_s for complex samples, c·f_s/2|μ|; at half of it for
    /// real ones.
    pub fn range_max_m(&self) -> f64 {
        let band_hz = match self.sampling {
            Sampling::Complex => self.sample_rate_hz,
            Sampling::Real => 0.5 * self.sample_rate_hz,
        };
        SPEED_OF_LIGHT_MPS * band_hz / (2.0 * self.slope_hz_per_s.abs())
    }

    /// Range cells of a map; for real samples one half of the spectrum, since the other is its image.
    pub fn range_cells(&self) -> usize {
        match self.sampling {
            Sampling::Complex => self.samples as usize,
            Sampling::Real => self.samples.div_ceil(2) as usize,
        }
    }
}

/// Part of the mixer's product that is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sampling {
    /// Complex samples, from an I and a Q channel.
    Complex,
    /// The real part alone; imaginary parts of a cube's samples are 0. Noise of the image band folds in (3
    /// dB).
    Real,
}

/// Start times of chirps that do not follow at one interval; uniform by default.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Schedule {
    /// T_c of each sub-frame; sub-frames follow each other without a pause, each as a frame record of its own
    /// ([`Radar::in_frame`]). If empty, there is one sub-frame, with the waveform's T_c.
    pub sub_frame_intervals_s: Vec<f64>,
    /// Delay of chirp k of any transmitter after k·T_c, s, at index k modulo the length; the first is 0. If
    /// empty, no chirp is delayed.
    pub stagger_s: Vec<f64>,
}

impl Schedule {
    /// Sub-frames of a cycle, at least one.
    pub fn sub_frames(&self) -> u32 {
        self.sub_frame_intervals_s.len().max(1) as u32
    }

    /// Whether all intervals of a frame are equal.
    pub fn is_uniform(&self) -> bool {
        self.stagger_s.iter().all(|later_s| *later_s == 0.0)
    }
}

/// Imperfections of a radar and its interference environment; none by default. The headers of cubes
/// synthesised from a scene omit them: a detector knows them no more than those of a real radar.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Hardware {
    /// Error of each transmit element; if empty, all are ideal.
    pub tx: Vec<ElementError>,
    /// Error of each receive element; if empty, all are ideal.
    pub rx: Vec<ElementError>,
    /// Spread of the random errors added to every element's, drawn from the scene's seed.
    pub spread: ElementSpread,
    /// Analogue-to-digital converter; `None` if samples are not quantized.
    pub adc: Option<Adc>,
    /// Phase noise of the oscillator shared by all elements, in order of increasing offset; if empty, none.
    pub phase_noise: Vec<PhaseNoise>,
    /// Other radars that are received.
    pub interferers: Vec<Interferer>,
}

/// Another FMCW radar: its chirps follow at one interval, also before the scene's first sample.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Interferer {
    /// Position at the scene's first sample, world metres.
    pub position_m: [f64; 3],
    /// Velocity in world axes, constant.
    pub velocity_mps: [f64; 3],
    /// Transmit power times antenna gain towards this radar.
    pub eirp_w: f64,
    /// Start frequency of the chirps.
    pub start_frequency_hz: f64,
    /// Slope of the chirps; 0 for a tone.
    pub slope_hz_per_s: f64,
    /// Length of a chirp.
    pub sweep_s: f64,
    /// Time from the start of one chirp to the start of the next.
    pub chirp_interval_s: f64,
    /// Start of one of the chirps after the scene's first sample.
    pub offset_s: f64,
}

/// Maximum number of sample intervals of a frame, pauses included, over which an oscillator's phase is drawn
/// at once.
pub const OSCILLATOR_SAMPLES_LIMIT: usize = 1 << 20;

/// Single-sideband phase noise at an offset from the carrier; linearly interpolated in dB over the logarithm
/// of the offset, constant outside the first and last offset.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PhaseNoise {
    /// Offset from the carrier.
    pub offset_hz: f64,
    /// Phase noise L, dBc/Hz: half the one-sided density of the phase in rad²/Hz.
    pub dbc_per_hz: f64,
}

/// Deviation of an antenna element from an ideal one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ElementError {
    /// Error of the amplitude.
    pub gain_db: f64,
    /// Error of the phase of the IF value of its echoes.
    pub phase_rad: f64,
    /// Delay of the element's feed line.
    pub delay_s: f64,
}

/// Standard deviations of elements' errors.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ElementSpread {
    /// Standard deviation of the amplitude error.
    pub gain_db: f64,
    /// Standard deviation of the phase error of echoes' IF values.
    pub phase_rad: f64,
}

/// An analogue-to-digital converter for each part of a complex sample.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Adc {
    /// Number of bits b: 2^b codes.
    pub bits: u8,
    /// Largest part of a sample, √W.
    pub full_scale: f64,
}

/// Multiplexing: how the transmitters share the medium.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Multiplexing {
    /// Ideal orthogonal transmitters (the paper's).
    Simultaneous,
    /// One transmitter at a time: chirp m of transmitter i starts at (m·N_tx + i)·T_c.
    Tdm,
    /// All transmitters at once, separated by Doppler: transmitter i is rotated in phase by e^{+j2πim/M} in
    /// the IF, M = N_tx + 1.
    Ddm,
    /// All transmitters at once, separated by binary codes over a block of M chirps, M the smallest power of
    /// two that is at least N_tx: transmitter i has the sign [`code_sign`] in chirp s of block m, which
    /// starts at (m·M + s)·T_c.
    Bpm,
}

/// Sylvester's Hadamard matrix, (−1)^(number of ones that `code` and `slot` share); its rows are orthogonal
/// over slots 0 … M − 1.
pub fn code_sign(code: usize, slot: usize) -> f64 {
    if (code & slot).count_ones().is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// Polarization of reception and transmission: the first letter receives, the second transmits (`vh`: h sent,
/// v received).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Polarization {
    /// Sends v and receives v.
    Vv,
    /// Sends h and receives h.
    Hh,
    /// Sends h and receives v.
    Vh,
    /// Sends v and receives h.
    Hv,
}

impl Polarization {
    /// Indices (receive, transmit) into a 2 × 2 amplitude, v = 0, h = 1.
    pub fn indices(self) -> (usize, usize) {
        match self {
            Self::Vv => (0, 0),
            Self::Hh => (1, 1),
            Self::Vh => (0, 1),
            Self::Hv => (1, 0),
        }
    }

    /// Whether the received polarization differs from the transmitted one.
    pub fn is_crossed(self) -> bool {
        let (receive, transmit) = self.indices();
        receive != transmit
    }
}

/// Antenna elements.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Array {
    /// Transmit elements, world metres.
    pub tx_m: Vec<[f64; 3]>,
    /// Receive elements, world metres.
    pub rx_m: Vec<[f64; 3]>,
    /// Transmit elements in half wavelengths [right, up] as seen along the boresight, as given by the scene.
    pub tx_half_wavelengths: Vec<[f64; 2]>,
    /// Receive elements in half wavelengths [right, up] as seen along the boresight, as given by the scene.
    pub rx_half_wavelengths: Vec<[f64; 2]>,
    /// Multiplexing of the transmitters.
    pub multiplexing: Multiplexing,
    /// Polarization of all elements.
    pub polarization: Polarization,
    /// Pattern of all elements.
    pub pattern: Pattern,
}

/// Power and gain; linear where used in computations, in decibels where entered by a user.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Link {
    /// Transmit power P_t of each transmitter, W.
    pub transmit_power_w: f64,
    /// Gain G_t = G_r of each element at boresight, dBi.
    pub antenna_gain_db: f64,
}

impl Radar {
    /// Number of transmit–receive pairs: the elements of the virtual array, channel = tx·N_rx + rx.
    pub fn virtual_channels(&self) -> usize {
        self.array.tx_m.len() * self.array.rx_m.len()
    }

    /// Number of channels of a range-Doppler map: the transmit–receive pairs, followed with codes by
    /// code·N_rx + rx of the codes that no transmitter uses.
    pub fn map_channels(&self) -> usize {
        match self.array.multiplexing {
            Multiplexing::Bpm => self.slots() * self.array.rx_m.len(),
            Multiplexing::Simultaneous | Multiplexing::Tdm | Multiplexing::Ddm => self.virtual_channels(),
        }
    }

    /// Number of channels of a radar cube: the receivers with Doppler division, slot·N_rx + rx with codes,
    /// else the transmit–receive pairs.
    pub fn cube_channels(&self) -> usize {
        match self.array.multiplexing {
            Multiplexing::Ddm => self.array.rx_m.len(),
            Multiplexing::Simultaneous | Multiplexing::Tdm | Multiplexing::Bpm => self.map_channels(),
        }
    }

    /// Number of chirps sent from one chirp of a cube's channel to its next.
    pub fn slots(&self) -> usize {
        match self.array.multiplexing {
            Multiplexing::Tdm => self.array.tx_m.len(),
            Multiplexing::Bpm => self.array.tx_m.len().next_power_of_two(),
            Multiplexing::Simultaneous | Multiplexing::Ddm => 1,
        }
    }

    /// Time from one chirp of a cube's channel to its next, s.
    pub fn repetition_interval_s(&self) -> f64 {
        self.waveform.chirp_interval_s * self.slots() as f64
    }

    /// Maximum unambiguous velocity λ/4T, with T the repetition interval of one channel, m/s.
    pub fn velocity_max_mps(&self) -> f64 {
        self.waveform.wavelength_m() / (4.0 * self.repetition_interval_s())
    }

    /// Velocity resolution λ/2N_cT, one Doppler cell, m/s.
    pub fn velocity_resolution_mps(&self) -> f64 {
        2.0 * self.velocity_max_mps() / f64::from(self.waveform.chirps)
    }

    /// Start of chirp `chirp` of transmitter `turn` (with codes: of slot `turn` of block `chirp`) after the
    /// frame's first sample, s.
    pub fn chirp_start_s(&self, turn: usize, chirp: usize) -> f64 {
        self.slot_start_s(match self.array.multiplexing {
            Multiplexing::Tdm | Multiplexing::Bpm => chirp * self.slots() + turn,
            Multiplexing::Simultaneous | Multiplexing::Ddm => chirp,
        })
    }

    /// Time from the frame's first sample to the end of its last chirp and its idle time, s.
    pub fn frame_duration_s(&self) -> f64 {
        self.slot_start_s(self.waveform.chirps as usize * self.slots())
    }

    /// Reference time of truth and frozen paths, from the frame's first sample, s.
    pub fn frame_middle_s(&self) -> f64 {
        0.5 * self.frame_duration_s()
    }

    /// The radar of frame record `index`: with the chirp interval of that sub-frame and no other sub-frames.
    pub fn in_frame(&self, index: u32) -> Self {
        let mut radar = self.clone();
        let intervals_s = std::mem::take(&mut radar.schedule.sub_frame_intervals_s);
        if let Some(interval_s) = intervals_s.get((index % self.schedule.sub_frames()) as usize) {
            radar.waveform.chirp_interval_s = *interval_s;
        }
        radar
    }

    /// Time from the first sample of a cycle's first sub-frame to that of record `index`, s.
    pub fn sub_frame_start_s(&self, index: u32) -> f64 {
        // A sum of no numbers would be -0.0.
        let earlier = 0..index % self.schedule.sub_frames();
        earlier.map(|earlier| self.in_frame(earlier).frame_duration_s()).fold(0.0, |sum, next| sum + next)
    }

    /// Time from the first sample of a cycle's first sub-frame to the end of its last, s.
    pub fn cycle_duration_s(&self) -> f64 {
        (0..self.schedule.sub_frames()).map(|index| self.in_frame(index).frame_duration_s()).sum()
    }

    /// Start of chirp number `slot`, counted over all transmitters, s.
    fn slot_start_s(&self, slot: usize) -> f64 {
        let stagger_s = &self.schedule.stagger_s;
        let later_s = if stagger_s.is_empty() { 0.0 } else { stagger_s[slot % stagger_s.len()] };
        slot as f64 * self.waveform.chirp_interval_s + later_s
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One channel, two chirps a frame, in cycles of two sub-frames of 20 and 40 µs a chirp.
    fn in_turn() -> Radar {
        let waveform = Waveform {
            start_frequency_hz: 77e9,
            slope_hz_per_s: 12.5e12,
            sample_rate_hz: 5.12e6,
            sampling: Sampling::Complex,
            samples: 64,
            chirp_interval_s: 20e-6,
            chirps: 2,
        };
        let array = Array {
            tx_m: vec![[0.0; 3]],
            rx_m: vec![[0.0; 3]],
            tx_half_wavelengths: vec![[0.0; 2]],
            rx_half_wavelengths: vec![[0.0; 2]],
            multiplexing: Multiplexing::Simultaneous,
            polarization: Polarization::Vv,
            pattern: Pattern::Isotropic,
        };
        Radar {
            position_m: [0.0; 3],
            boresight_az_rad: 0.0,
            boresight_el_rad: 0.0,
            waveform,
            schedule: Schedule { sub_frame_intervals_s: vec![20e-6, 40e-6], stagger_s: vec![] },
            array,
            link: Link { transmit_power_w: 1.0, antenna_gain_db: 0.0 },
            hardware: Hardware::default(),
        }
    }

    #[test]
    fn a_cycle_s_first_sub_frame_starts_at_zero_without_a_sign_and_the_next_after_its_chirps() {
        let radar = in_turn();
        for cycle in [0, 2] {
            assert_eq!(format!("{:.4}", radar.sub_frame_start_s(cycle) * 1e3), "0.0000");
            assert_eq!(format!("{:.4}", radar.sub_frame_start_s(cycle + 1) * 1e3), "0.0400");
        }
    }
}
