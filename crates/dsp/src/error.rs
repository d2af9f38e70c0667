//! Errors in a cube, in a map, or in the settings of their processing.

use artifact::settings::FALSE_ALARM_RATES;
use radar::lattice::TooManyDirections;
use std::fmt;

/// Reason that a cube or a map could not be processed; every field is a fact about the input.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum DspError {
    /// Samples declared as real with an imaginary part.
    #[error(
        "sample {sample} of channel {channel}, chirp {chirp} has an imaginary part; the radar's sampling is real"
    )]
    NotReal {
        /// Index of the sample's channel.
        channel: usize,
        /// Index of the sample's chirp.
        chirp: usize,
        /// Index of the sample in its chirp.
        sample: usize,
    },
    /// Calibration that belongs to another array.
    #[error("the calibration has {found} channels, the array {expected}")]
    Calibration {
        /// Number of transmit–receive pairs.
        expected: usize,
        /// Number of factors, or of finite ones.
        found: usize,
    },
    /// An object that the frame does not have.
    #[error("the frame has no object {object}")]
    NoSuchObject {
        /// Index among the frame's objects.
        object: u32,
    },
    /// Reflector position outside all cells.
    #[error("a reflector {range_m} m away lies outside the map, which ends at {limit_m} m")]
    ReflectorRange {
        /// Distance from the array's centre.
        range_m: f64,
        /// Maximum range of the waveform's map.
        limit_m: f64,
    },
    /// Echo too weak to measure phases.
    #[error(
        "the weakest channel at {range_m:.2} m and rest is {snr_db:.1} dB over its noise; calibration needs {least_db} dB"
    )]
    WeakReflector {
        /// Range at which the reflector was searched.
        range_m: f64,
        /// SNR of the weakest channel.
        snr_db: f64,
        /// Minimum SNR for calibration.
        least_db: f64,
    },
    /// Refinement on samples where an echo is not a single tone.
    #[error("peaks are refined on complex samples whose transmitters are told apart without codes")]
    Refinement,
    /// Length of a cube that does not match its radar.
    #[error("a frame holds {found} samples, its radar makes {expected} (channels × chirps × samples)")]
    SampleCount {
        /// Number of samples required by the header.
        expected: usize,
        /// Number of samples in the frame.
        found: usize,
    },
    /// Length of a map that does not match its radar.
    #[error("a map holds {found} {what}, its radar makes {expected}")]
    MapSize {
        /// Affected array: values or mask cells.
        what: &'static str,
        /// Number of values required by the header.
        expected: usize,
        /// Number of values in the frame.
        found: usize,
    },
    /// A NaN or an infinite sample.
    #[error("channel {channel}, chirp {chirp}, sample {sample} is not finite")]
    SampleNotFinite {
        /// Index of the sample's channel.
        channel: usize,
        /// Index of the sample's chirp.
        chirp: usize,
        /// Index of the sample in its chirp.
        sample: usize,
    },
    /// A non-finite value of the map, or one beyond single precision.
    #[error(
        "frame {frame}: channel {channel}, Doppler cell {doppler}, range cell {range} of the map is not \
         finite"
    )]
    ValueNotFinite {
        /// Index of the frame.
        frame: u32,
        /// Channel of the map.
        channel: usize,
        /// Row of the map.
        doppler: usize,
        /// Column of the map.
        range: usize,
    },
    /// A map without cells or without channels.
    #[error("the radar has no {what}")]
    Missing {
        /// Missing items: samples, chirps, transmitters or receivers.
        what: &'static str,
    },
    /// A cube with more values than any stage can hold.
    #[error("channels × chirps × samples of the radar are more than {}", artifact::cube::CUBE_LIMIT)]
    TooLarge,
    /// An array with too many directions to search.
    #[error("{0}")]
    Directions(#[source] TooManyDirections),
    /// A property of the radar from which no axis can be computed.
    #[error("{quantity} must be finite, not zero and, but for a slope, not negative; it is {value}")]
    Radar {
        /// Name of the property with its unit.
        quantity: &'static str,
        /// Value of the property.
        value: f64,
    },
    /// Staggered chirps combined with Doppler or code division.
    #[error(
        "staggered chirps exclude Doppler and code division: no constant turn from chirp to chirp is a velocity then"
    )]
    StaggeredDivision,
    /// A map that is not a plain Fourier transform of its samples.
    #[error("samples follow from maps of complex samples and chirps at one interval alone")]
    NoInverse,
    /// A false-alarm rate outside the range of thresholds.
    #[error(
        "false_alarm_rate must lie from {least:e} to {most}, is {0:e}",
        least = FALSE_ALARM_RATES.start(),
        most = FALSE_ALARM_RATES.end()
    )]
    FalseAlarmRate(f64),
    /// No cells to estimate the noise from.
    #[error("training_cells are [0, 0]: no cell is left to estimate the noise from")]
    NoTrainingCells,
    /// Guard and training cells that do not fit the map.
    #[error("guard and training cells need {needed} cells along {axis}, the map has {cells}")]
    CfarWindow {
        /// Axis of the map that is too short.
        axis: Axis,
        /// Number of cells needed, 2·(guard + training) + 1.
        needed: u64,
        /// Number of cells of the map.
        cells: usize,
    },
    /// An infeasible Chebyshev window.
    #[error("chebyshev sidelobes must lie between 10 and 300 dB below the peak, asked are {0}")]
    Sidelobes(f64),
    /// A crop without pixels or extent, or with more cells than any stage can hold.
    #[error(
        "a crop needs a side of 1 to 8192 pixels, positive spans of no more than {} cells and a ceiling above \
         its floor",
        artifact::cube::CUBE_LIMIT
    )]
    CropFormat,
    /// An object with a non-finite value, which cannot be cropped or tracked.
    #[error("the object's {quantity} is not finite")]
    ObjectNotFinite {
        /// Affected quantity: range, velocity or position.
        quantity: &'static str,
    },
    /// A frame that is not later than the one before it.
    #[error("a frame at {found_s} s cannot follow one at {last_s:?} s: tracks go forward in time")]
    FrameTime {
        /// Time of the preceding frame, if any.
        last_s: Option<f64>,
        /// Time of the frame.
        found_s: f64,
    },
}

/// An axis of a range-Doppler map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// Doppler axis, the rows.
    Doppler,
    /// Range axis, the columns.
    Range,
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Doppler => "doppler",
            Self::Range => "range",
        })
    }
}
