//! Errors of the echo, told as facts.

use artifact::paths::ArraySpan;

/// Reason why no echo is made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EchoError {
    /// A waveform value that no sample can be made from, or an interval shorter than the sampled part of a
    /// chirp.
    #[error("radar waveform: {quantity} is {value}, which makes no chirps that follow each other")]
    Waveform {
        /// Name of the value.
        quantity: &'static str,
        /// The value.
        value: f64,
    },
    /// Staggered chirps of which one would start within another, or the first not at 0.
    #[error(
        "radar schedule: chirp {chirp} of the stagger starts {later_s} s late: the first must start at 0, none within another"
    )]
    Stagger {
        /// Index in the stagger.
        chirp: usize,
        /// Lateness of that chirp, as given.
        later_s: f64,
    },
    /// Power, gain, boresight or an element position that is NaN or infinite.
    #[error("radar: {quantity} is not finite")]
    NonFiniteRadar {
        /// Name of the value.
        quantity: &'static str,
    },
    /// An antenna pattern that does not tell a gain.
    #[error(
        "radar array: the antenna pattern has numbers that are not finite, axes that do not grow, or not one value a direction"
    )]
    Pattern,
    /// Phase noise that is no density over growing offsets from the carrier.
    #[error("radar: phase noise needs finite levels at growing offsets above 0 Hz")]
    PhaseNoise,
    /// Phase noise is drawn for a whole frame at once.
    #[error("radar: with phase noise a frame lasts at most {limit} sample intervals, this one {samples:.0}")]
    OscillatorTooLong {
        /// Sample intervals in the frame.
        samples: f64,
        /// Most of them.
        limit: usize,
    },
    /// Another radar that sends no chirps one after the other, or from where ours stands.
    #[error("interferer {index}: {quantity}")]
    Interferer {
        /// Index in the list.
        index: usize,
        /// Property that is broken.
        quantity: &'static str,
    },
    /// An array without a transmitter or without a receiver.
    #[error(
        "radar array: {transmitters} transmitters and {receivers} receivers; at least one of each is needed"
    )]
    NoElements {
        /// Transmit elements given.
        transmitters: usize,
        /// Receive elements given.
        receivers: usize,
    },
    /// The cube would not fit into one record of its file.
    #[error(
        "cube of {channels} channels × {chirps} chirps × {samples} samples takes {bytes} bytes; the limit is {limit}"
    )]
    CubeTooLarge {
        /// Channels.
        channels: usize,
        /// Chirps.
        chirps: usize,
        /// Samples of a chirp.
        samples: usize,
        /// Bytes that the cube would take.
        bytes: u128,
        /// Most bytes that a record may take.
        limit: u64,
    },
    /// Patches of the ground beyond any memory.
    #[error("the ground takes {patches} patches at this range resolution and beam; the limit is {limit}")]
    GroundTooFine {
        /// Two to a range cell, times two to a beam.
        patches: usize,
        /// Most that are made.
        limit: usize,
    },
    /// A noise setting that gives no power.
    #[error("noise: {quantity} is {value}")]
    Noise {
        /// Name of the setting.
        quantity: &'static str,
        /// The setting's value.
        value: f64,
    },
    /// `snr_db` refers to the peak of the noise-free map, and there is none.
    #[error("snr_db is set, but frame {frame} has no echo that it could refer to; use noise_figure_db")]
    NoPeak {
        /// Frame.
        frame: u32,
    },
    /// A path with NaN, infinity, or a number too large for the echo's f32 samples.
    #[error("path {path} of frame {frame}: {quantity} is not finite")]
    NonFinitePath {
        /// Frame.
        frame: u32,
        /// Index in the frame's list.
        path: usize,
        /// Name of the part of the path that is not finite.
        quantity: &'static str,
    },
    /// A path that stands for a moment that is none of its frame's.
    #[error(
        "path {path} of frame {frame} stands for moment {moment} of {moments} from {first_s} s on every {step_s} s: there is none"
    )]
    NoSuchMoment {
        /// Frame.
        frame: u32,
        /// Index in the frame's list.
        path: usize,
        /// Counted from 0.
        moment: u32,
        /// Number of moments in the frame.
        moments: u32,
        /// The first.
        first_s: f64,
        /// Interval from one moment to the next.
        step_s: f64,
    },
    /// A path that stands for a place of the array that is none of its frame's.
    #[error(
        "path {path} of frame {frame} stands for place {} of {} from {} m on every {} m of the array: there is none",
        span.place, span.places, span.first_m, span.step_m
    )]
    NoSuchPlace {
        /// Frame.
        frame: u32,
        /// Index in the frame's list.
        path: usize,
        /// The part of the array.
        span: ArraySpan,
    },
    /// A path's apparent point comes closer to an element than a wavelength, where 1/(L₁L₂) means nothing.
    #[error(
        "path {path} of frame {frame} passes {distance_m} m from {element} element {index}: less than a wavelength"
    )]
    PathThroughAntenna {
        /// Frame.
        frame: u32,
        /// Index in the frame's list.
        path: usize,
        /// "transmit" or "receive".
        element: &'static str,
        /// Index of the element.
        index: usize,
        /// Closest approach.
        distance_m: f64,
    },
    /// A speed that nothing on a road has and that the scattering time is not solved for.
    #[error("path {path} of frame {frame} moves at {speed_mps} m/s; the limit is {limit_mps} m/s")]
    TooFast {
        /// Frame.
        frame: u32,
        /// Index in the frame's list.
        path: usize,
        /// The path's speed.
        speed_mps: f64,
        /// The limit.
        limit_mps: f64,
    },
    /// A sample left the range of f32.
    #[error("frame {frame}: sample {sample} of channel {channel}, chirp {chirp} does not fit into f32")]
    SampleOverflow {
        /// Frame.
        frame: u32,
        /// Channel.
        channel: usize,
        /// Chirp.
        chirp: usize,
        /// Sample.
        sample: usize,
    },
    /// A table of a target that the scene does not have.
    #[error("RCS table {table} is of target {target}, but there are {targets} poses")]
    TargetMissing {
        /// Index of the table.
        table: usize,
        /// The target it names.
        target: u32,
        /// Number of targets.
        targets: usize,
    },
    /// A table of another polarization than the array's.
    #[error("RCS table {table} has polarization {found:?}, the array {wanted:?}")]
    TablePolarization {
        /// Index of the table.
        table: usize,
        /// The table's.
        found: artifact::radar::Polarization,
        /// The array's.
        wanted: artifact::radar::Polarization,
    },
    /// A table whose axes do not grow, are empty or do not fit its values.
    #[error(
        "RCS table {table}: {axis} is empty, not growing, not finite, or does not fit the number of values"
    )]
    TableShape {
        /// Index of the table.
        table: usize,
        /// Name of the axis, or "amplitude".
        axis: &'static str,
    },
    /// A frequency or aspect that the table does not hold.
    #[error("RCS table {table}: {axis} {value} lies outside {first} … {last} by more than one step")]
    OutsideTable {
        /// Index of the table.
        table: usize,
        /// Name of the axis.
        axis: &'static str,
        /// Value that was asked for.
        value: f64,
        /// Start of the axis.
        first: f64,
        /// End of the axis.
        last: f64,
    },
}

impl EchoError {
    /// Index of the path that is refused, in its frame's list.
    pub fn path(&self) -> Option<usize> {
        match self {
            Self::NonFinitePath { path, .. }
            | Self::NoSuchMoment { path, .. }
            | Self::NoSuchPlace { path, .. }
            | Self::PathThroughAntenna { path, .. }
            | Self::TooFast { path, .. } => Some(*path),
            _ => None,
        }
    }
}
