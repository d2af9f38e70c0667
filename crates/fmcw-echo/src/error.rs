//! Errors of the echo, described by facts.

use artifact::paths::{ArraySide, ArraySpan};

/// Reason that no echo can be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EchoError {
    /// A waveform value from which no sample can be computed, or an interval shorter than the sampled part of
    /// a chirp.
    #[error("radar waveform: {quantity} is {value}, which makes no chirps that follow each other")]
    Waveform {
        /// Name of the value.
        quantity: &'static str,
        /// The value.
        value: f64,
    },
    /// Staggered chirps that overlap, or the first of which is delayed.
    #[error(
        "radar schedule: chirp {chirp} of the stagger starts {later_s} s late: the first must start at 0, none within another"
    )]
    Stagger {
        /// Index in the stagger.
        chirp: usize,
        /// Delay of that chirp, as given.
        later_s: f64,
    },
    /// A NaN or infinite power, gain, boresight or element position.
    #[error("radar: {quantity} is not finite")]
    NonFiniteRadar {
        /// Name of the value.
        quantity: &'static str,
    },
    /// An invalid antenna pattern.
    #[error(
        "radar array: the antenna pattern has numbers that are not finite, axes that do not grow, or not one value a direction"
    )]
    Pattern,
    /// Phase noise that is not a density over increasing offsets from the carrier.
    #[error("radar: phase noise needs finite levels at growing offsets above 0 Hz")]
    PhaseNoise,
    /// A frame too long to draw its phase noise at once.
    #[error("radar: with phase noise a frame lasts at most {limit} sample intervals, this one {samples:.0}")]
    OscillatorTooLong {
        /// Number of sample intervals in the frame.
        samples: f64,
        /// Largest number of sample intervals in a frame.
        limit: usize,
    },
    /// An interferer without consecutive chirps, or at the position of this radar.
    #[error("interferer {index}: {quantity}")]
    Interferer {
        /// Index in the list.
        index: usize,
        /// Property that is not sound, in words.
        quantity: &'static str,
    },
    /// An array without transmitters or without receivers.
    #[error(
        "radar array: {transmitters} transmitters and {receivers} receivers; at least one of each is needed"
    )]
    NoElements {
        /// Number of transmit elements.
        transmitters: usize,
        /// Number of receive elements.
        receivers: usize,
    },
    /// A cube that does not fit into one record of its file.
    #[error(
        "cube of {channels} channels × {chirps} chirps × {samples} samples takes {bytes} bytes; the limit is {limit}"
    )]
    CubeTooLarge {
        /// Number of channels.
        channels: usize,
        /// Number of chirps.
        chirps: usize,
        /// Number of samples per chirp.
        samples: usize,
        /// Size of the cube, bytes.
        bytes: u128,
        /// Maximum size of a record, bytes.
        limit: u64,
    },
    /// Too many ground patches for memory.
    #[error("the ground takes {patches} patches at this range resolution and beam; the limit is {limit}")]
    GroundTooFine {
        /// Number of patches: two per range cell, times two per beam.
        patches: usize,
        /// Maximum number of patches.
        limit: usize,
    },
    /// A noise setting that yields no power.
    #[error("noise: {quantity} is {value}")]
    Noise {
        /// Name of the setting.
        quantity: &'static str,
        /// The setting's value.
        value: f64,
    },
    /// A silent frame, where `snr_db` has no peak of the noise-free map to refer to.
    #[error("snr_db is set, but frame {frame} has no echo that it could refer to; use noise_figure_db")]
    NoPeak {
        /// Index of the frame.
        frame: u32,
    },
    /// A path with a NaN, an infinity, or a number too large for the echo's f32 samples.
    #[error("path {path} of frame {frame}: {quantity} is not finite")]
    NonFinitePath {
        /// Index of the frame.
        frame: u32,
        /// Index in the frame's list.
        path: usize,
        /// Name of the non-finite part of the path.
        quantity: &'static str,
    },
    /// A path for a moment that does not exist in its frame.
    #[error(
        "path {path} of frame {frame} stands for moment {moment} of {moments} from {first_s} s on every {step_s} s: there is none"
    )]
    NoSuchMoment {
        /// Index of the frame.
        frame: u32,
        /// Index in the frame's list.
        path: usize,
        /// Index of the moment, from 0.
        moment: u32,
        /// Number of moments in the frame.
        moments: u32,
        /// Time of the first moment, s.
        first_s: f64,
        /// Interval from one moment to the next, s.
        step_s: f64,
    },
    /// A path for a place of the array that does not exist in its frame.
    #[error(
        "path {path} of frame {frame} stands for place {} of {} from {} m on every {} m of the array: there is none",
        span.place, span.places, span.first_m, span.step_m
    )]
    NoSuchPlace {
        /// Index of the frame.
        frame: u32,
        /// Index in the frame's list.
        path: usize,
        /// Part of the array that the path represents.
        span: ArraySpan,
    },
    /// A path for pairs of elements on a side of no line through the array.
    #[error(
        "path {path} of frame {frame} stands for pairs of elements from {} m on, along {:?} and {:?}: there is no \
         such side",
        side.from_m, side.transmit, side.receive
    )]
    NoSuchSide {
        /// Index of the frame.
        frame: u32,
        /// Index in the frame's list.
        path: usize,
        /// Pairs that the path represents.
        side: ArraySide,
    },
    /// A path whose apparent point comes closer to an element than a wavelength, where 1/(L₁L₂) is
    /// meaningless.
    #[error(
        "path {path} of frame {frame} passes {distance_m} m from {element} element {index}: less than a wavelength"
    )]
    PathThroughAntenna {
        /// Index of the frame.
        frame: u32,
        /// Index in the frame's list.
        path: usize,
        /// Kind of element, "transmit" or "receive".
        element: &'static str,
        /// Index of the element.
        index: usize,
        /// Smallest distance from the element.
        distance_m: f64,
    },
    /// A speed beyond road traffic, for which the scattering time is not solved accurately.
    #[error("path {path} of frame {frame} moves at {speed_mps} m/s; the limit is {limit_mps} m/s")]
    TooFast {
        /// Index of the frame.
        frame: u32,
        /// Index in the frame's list.
        path: usize,
        /// Speed of the path.
        speed_mps: f64,
        /// Largest speed of a path.
        limit_mps: f64,
    },
    /// A sample beyond the range of f32.
    #[error("frame {frame}: sample {sample} of channel {channel}, chirp {chirp} does not fit into f32")]
    SampleOverflow {
        /// Index of the frame.
        frame: u32,
        /// Index of the sample's channel.
        channel: usize,
        /// Index of the sample's chirp.
        chirp: usize,
        /// Index of the sample in its chirp.
        sample: usize,
    },
    /// A table of a target that does not exist in the scene.
    #[error("RCS table {table} is of target {target}, but there are {targets} poses")]
    TargetMissing {
        /// Index of the table.
        table: usize,
        /// Index of the target named by it.
        target: u32,
        /// Number of targets.
        targets: usize,
    },
    /// A table whose polarization differs from the array's.
    #[error("RCS table {table} has polarization {found:?}, the array {wanted:?}")]
    TablePolarization {
        /// Index of the table.
        table: usize,
        /// Polarization of the table.
        found: artifact::radar::Polarization,
        /// Polarization of the array.
        wanted: artifact::radar::Polarization,
    },
    /// A table whose axes are empty, not increasing, or do not match its values.
    #[error(
        "RCS table {table}: {axis} is empty, not growing, not finite, or does not fit the number of values"
    )]
    TableShape {
        /// Index of the table.
        table: usize,
        /// Name of the axis, or "amplitude".
        axis: &'static str,
    },
    /// A frequency or aspect outside the table.
    #[error("RCS table {table}: {axis} {value} lies outside {first} … {last} by more than one step")]
    OutsideTable {
        /// Index of the table.
        table: usize,
        /// Name of the axis.
        axis: &'static str,
        /// Frequency or angle that is asked for.
        value: f64,
        /// Start of the axis.
        first: f64,
        /// End of the axis.
        last: f64,
    },
}

impl EchoError {
    /// Index of the refused path in its frame's list.
    pub fn path(&self) -> Option<usize> {
        match self {
            Self::NonFinitePath { path, .. }
            | Self::NoSuchMoment { path, .. }
            | Self::NoSuchPlace { path, .. }
            | Self::NoSuchSide { path, .. }
            | Self::PathThroughAntenna { path, .. }
            | Self::TooFast { path, .. } => Some(*path),
            _ => None,
        }
    }
}
