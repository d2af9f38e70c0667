//! The radar: waveform, antenna array and link, as every stage needs them.

pub use crate::descriptions::pattern::{Pattern, PatternTable};
use crate::quantities::units::SPEED_OF_LIGHT_MPS;
use serde::{Deserialize, Serialize};

/// A radar in its place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Radar {
    /// Centre of the transmit row and of the receive row, world metres.
    pub position_m: [f64; 3],
    /// Azimuth of the boresight, from +y towards +x.
    pub boresight_az_rad: f64,
    /// Elevation of the boresight above the horizon.
    pub boresight_el_rad: f64,
    /// Waveform that is sent.
    pub waveform: Waveform,
    /// Schedule of the chirps, where they do not follow each other at one interval.
    pub schedule: Schedule,
    /// Antenna elements that send and receive.
    pub array: Array,
    /// Power and gain.
    pub link: Link,
    /// Imperfections of the radar.
    pub hardware: Hardware,
}

/// Linear chirps. Sampled time runs from the start of the sampled part of a chirp (`docs/conventions.md`).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Waveform {
    /// Start frequency f₀: instantaneous frequency at the first sample.
    pub start_frequency_hz: f64,
    /// Slope μ of a chirp.
    pub slope_hz_per_s: f64,
    /// Sample rate f_s, of complex or of real samples.
    pub sample_rate_hz: f64,
    /// Part of the mixer's product that is sampled.
    pub sampling: Sampling,
    /// Samples of a chirp, N_s.
    pub samples: u32,
    /// Chirp interval T_c, from one chirp of any transmitter to the next; the mean where there are several
    /// ([`Schedule`]).
    pub chirp_interval_s: f64,
    /// Chirps that each transmitter sends in a frame, N_c; with codes blocks of chirps.
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

    /// Range at which the beat frequency folds: at f_s where samples are complex, c·f_s/2|μ|; at half of it
    /// where they are real.
    pub fn range_max_m(&self) -> f64 {
        let band_hz = match self.sampling {
            Sampling::Complex => self.sample_rate_hz,
            Sampling::Real => 0.5 * self.sample_rate_hz,
        };
        SPEED_OF_LIGHT_MPS * band_hz / (2.0 * self.slope_hz_per_s.abs())
    }

    /// Range cells of a map: with real samples the half of the spectrum that is not the other's image.
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
    /// Both parts, of an I and a Q channel.
    Complex,
    /// The real part alone; imaginary parts of a cube's samples are 0. Noise of the image band folds in (3
    /// dB).
    Real,
}

/// Starts of chirps that do not follow each other at one interval; by default they do.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Schedule {
    /// T_c of each sub-frame, which follow each other without a pause; each is a frame record of its own
    /// ([`Radar::in_frame`]). Empty: there is one, of the waveform's T_c.
    pub sub_frame_intervals_s: Vec<f64>,
    /// Delay of chirp k of any transmitter after k·T_c, s, at the index k modulo their number; the first is
    /// 0. Empty: no chirp is late.
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

/// Imperfections of a radar, and of the air that it listens to; by default none. The headers of cubes
/// that a scene is made into leave it out: a detector knows it no more than that of a real radar.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Hardware {
    /// Error of each transmit element; empty: ideal.
    pub tx: Vec<ElementError>,
    /// Error of each receive element; empty: ideal.
    pub rx: Vec<ElementError>,
    /// Spread of the random errors that are added to those of every element, drawn from the scene's seed.
    pub spread: ElementSpread,
    /// Converter of the samples; `None`: they are not rounded.
    pub adc: Option<Adc>,
    /// Phase noise of the oscillator that all elements share, growing in offset; empty: none.
    pub phase_noise: Vec<PhaseNoise>,
    /// Other radars that are heard.
    pub interferers: Vec<Interferer>,
}

/// Another FMCW radar: chirps that follow each other at one interval, before the scene's first sample too.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Interferer {
    /// Position at the scene's first sample, world metres.
    pub position_m: [f64; 3],
    /// Velocity in world axes, constant.
    pub velocity_mps: [f64; 3],
    /// Transmit power times antenna gain, in our direction.
    pub eirp_w: f64,
    /// Frequency at which its chirps begin.
    pub start_frequency_hz: f64,
    /// Slope of the chirps; 0 is a tone.
    pub slope_hz_per_s: f64,
    /// Length of a chirp.
    pub sweep_s: f64,
    /// Time from the beginning of one chirp to that of the next.
    pub chirp_interval_s: f64,
    /// Beginning of one of the chirps after the scene's first sample.
    pub offset_s: f64,
}

/// Sample intervals of the longest frame of which an oscillator's phase is drawn at once, pauses included.
pub const OSCILLATOR_SAMPLES_LIMIT: usize = 1 << 20;

/// Single-sideband phase noise at an offset from the carrier: straight in dB over the offset's logarithm from
/// one to the next, constant before the first and behind the last.
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
    /// Delay of its line.
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

/// Multiplexing: how the transmitters share the air.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Multiplexing {
    /// Ideal orthogonal transmitters (the paper's).
    Simultaneous,
    /// One transmitter at a time: chirp m of transmitter i starts at (m·N_tx + i)·T_c.
    Tdm,
    /// All transmitters at once, told apart by Doppler: transmitter i turns by e^{+j2πim/M} in the IF, M =
    /// N_tx + 1.
    Ddm,
    /// All transmitters at once, told apart by binary codes over a block of M chirps, M the power of two
    /// from N_tx on: transmitter i has the sign [`code_sign`] in chirp s of block m, which starts at (m·M +
    /// s)·T_c.
    Bpm,
}

/// Sylvester's Hadamard matrix, (−1)^(ones that `code` and `slot` share): rows are orthogonal over slots 0 …
/// M − 1.
pub fn code_sign(code: usize, slot: usize) -> f64 {
    if (code & slot).count_ones().is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// Polarization of transmission and reception: the first letter receives, the second transmits (`vh`: h sent,
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

    /// Whether the other polarization is received than is sent.
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
    /// The transmit elements in half wavelengths [right, up] as seen along the boresight, as the scene gave
    /// them.
    pub tx_half_wavelengths: Vec<[f64; 2]>,
    /// The receive elements in half wavelengths [right, up] as seen along the boresight, as the scene gave
    /// them.
    pub rx_half_wavelengths: Vec<[f64; 2]>,
    /// Multiplexing of the transmitters.
    pub multiplexing: Multiplexing,
    /// Polarization of all elements.
    pub polarization: Polarization,
    /// Pattern of all elements.
    pub pattern: Pattern,
}

/// Power and gain; linear where computed with, decibels where a person gave them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Link {
    /// P_t of each transmitter, W.
    pub transmit_power_w: f64,
    /// G_t = G_r of each element at boresight, dBi.
    pub antenna_gain_db: f64,
}

impl Radar {
    /// Transmit–receive pairs: the elements of the virtual array, channel = tx·N_rx + rx.
    pub fn virtual_channels(&self) -> usize {
        self.array.tx_m.len() * self.array.rx_m.len()
    }

    /// Channels of a range-Doppler map: the transmit–receive pairs, and with codes behind them code·N_rx + rx
    /// of the codes that no transmitter has.
    pub fn map_channels(&self) -> usize {
        match self.array.multiplexing {
            Multiplexing::Bpm => self.slots() * self.array.rx_m.len(),
            Multiplexing::Simultaneous | Multiplexing::Tdm | Multiplexing::Ddm => self.virtual_channels(),
        }
    }

    /// Channels of a radar cube: with Doppler division the receivers, with codes slot·N_rx + rx, else the
    /// transmit–receive pairs.
    pub fn cube_channels(&self) -> usize {
        match self.array.multiplexing {
            Multiplexing::Ddm => self.array.rx_m.len(),
            Multiplexing::Simultaneous | Multiplexing::Tdm | Multiplexing::Bpm => self.map_channels(),
        }
    }

    /// Chirps in the air from one chirp of a cube's channel to its next.
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

    /// Maximum unambiguous velocity λ/4T, T the repetition of one channel, m/s.
    pub fn velocity_max_mps(&self) -> f64 {
        self.waveform.wavelength_m() / (4.0 * self.repetition_interval_s())
    }

    /// Velocity resolution λ/2N_cT, one Doppler cell, m/s.
    pub fn velocity_resolution_mps(&self) -> f64 {
        2.0 * self.velocity_max_mps() / f64::from(self.waveform.chirps)
    }

    /// Start of chirp `chirp` of transmitter `turn`, with codes of slot `turn` of block `chirp`, from the
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

    /// The moment, from the frame's first sample, that truth and frozen paths refer to, s.
    pub fn frame_middle_s(&self) -> f64 {
        0.5 * self.frame_duration_s()
    }

    /// The radar as it is in frame record `index`: its sub-frame's chirp interval, and no sub-frames beside
    /// it.
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
        (0..index % self.schedule.sub_frames()).map(|earlier| self.in_frame(earlier).frame_duration_s()).sum()
    }

    /// Time from the first sample of a cycle's first sub-frame to the end of its last, s.
    pub fn cycle_duration_s(&self) -> f64 {
        (0..self.schedule.sub_frames()).map(|index| self.in_frame(index).frame_duration_s()).sum()
    }

    /// Start of the chirp that any transmitter sends as number `slot`, s.
    fn slot_start_s(&self, slot: usize) -> f64 {
        let stagger_s = &self.schedule.stagger_s;
        let later_s = if stagger_s.is_empty() { 0.0 } else { stagger_s[slot % stagger_s.len()] };
        slot as f64 * self.waveform.chirp_interval_s + later_s
    }
}
