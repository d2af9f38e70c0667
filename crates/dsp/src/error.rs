//! Errors in a cube, in a map, or in what is asked of them.

use artifact::settings::FALSE_ALARM_RATES;
use radar::lattice::TooManyDirections;
use std::fmt;

/// Reason why a cube or a map could not be processed; every field is a fact about the input.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum DspError {
    /// Samples said to be real that have an imaginary part.
    #[error(
        "sample {sample} of channel {channel}, chirp {chirp} has an imaginary part; the radar's sampling is real"
    )]
    NotReal {
        /// Channel.
        channel: usize,
        /// Chirp.
        chirp: usize,
        /// Sample.
        sample: usize,
    },
    /// Calibration of another array.
    #[error("the calibration has {found} channels, the array {expected}")]
    Calibration {
        /// Transmit–receive pairs.
        expected: usize,
        /// Factors, or finite ones.
        found: usize,
    },
    /// An object that the frame does not have.
    #[error("the frame has no object {object}")]
    NoSuchObject {
        /// Index among its objects.
        object: u32,
    },
    /// A place that no cell holds.
    #[error("a reflector {range_m} m away lies outside the map, which ends at {limit_m} m")]
    ReflectorRange {
        /// Distance from the array's centre.
        range_m: f64,
        /// Range at which the map of the waveform ends.
        limit_m: f64,
    },
    /// An echo that tells no phases.
    #[error(
        "the weakest channel at {range_m:.2} m and rest is {snr_db:.1} dB over its noise; calibration needs {least_db} dB"
    )]
    WeakReflector {
        /// Range at which the reflector was looked for.
        range_m: f64,
        /// Signal over noise of the weakest channel.
        snr_db: f64,
        /// Least signal over noise that calibration needs.
        least_db: f64,
    },
    /// Refinement on samples that are not one tone an echo.
    #[error("peaks are refined on complex samples whose transmitters are told apart without codes")]
    Refinement,
    /// The cube's length is not that of its radar.
    #[error("a frame holds {found} samples, its radar makes {expected} (channels × chirps × samples)")]
    SampleCount {
        /// Samples that the header asks for.
        expected: usize,
        /// Samples in the frame.
        found: usize,
    },
    /// The map's length is not that of its radar.
    #[error("a map holds {found} {what}, its radar makes {expected}")]
    MapSize {
        /// Values or mask cells.
        what: &'static str,
        /// Values that the header asks for.
        expected: usize,
        /// Values in the frame.
        found: usize,
    },
    /// A NaN or an infinite sample.
    #[error("channel {channel}, chirp {chirp}, sample {sample} is not finite")]
    SampleNotFinite {
        /// Channel of the cube.
        channel: usize,
        /// Chirp.
        chirp: usize,
        /// Sample.
        sample: usize,
    },
    /// A value of the map that is no number, or does not fit single precision.
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
        /// Samples, chirps, transmitters or receivers.
        what: &'static str,
    },
    /// A cube of more values than any stage holds.
    #[error("channels × chirps × samples of the radar are more than {}", artifact::cube::CUBE_LIMIT)]
    TooLarge,
    /// An array of more directions than are looked at.
    #[error("{0}")]
    Directions(#[source] TooManyDirections),
    /// A property of the radar that no axis can be made from.
    #[error("{quantity} must be finite, not zero and, but for a slope, not negative; it is {value}")]
    Radar {
        /// Named with its unit.
        quantity: &'static str,
        /// The value as found.
        value: f64,
    },
    /// Chirps at changing intervals, transmitters told apart by Doppler or by codes.
    #[error(
        "staggered chirps exclude Doppler and code division: no constant turn from chirp to chirp is a velocity then"
    )]
    StaggeredDivision,
    /// A map whose samples do not follow from it by Fourier transforms alone.
    #[error("samples follow from maps of complex samples and chirps at one interval alone")]
    NoInverse,
    /// A false-alarm rate without a threshold.
    #[error("false_alarm_rate must lie from {least:e} to {most}, is {0:e}", least = FALSE_ALARM_RATES.start(), most = FALSE_ALARM_RATES.end())]
    FalseAlarmRate(f64),
    /// Nothing to estimate the noise from.
    #[error("training_cells are [0, 0]: no cell is left to estimate the noise from")]
    NoTrainingCells,
    /// Guard and training cells do not fit the map.
    #[error("guard and training cells need {needed} cells along {axis}, the map has {cells}")]
    CfarWindow {
        /// Side of the map that is too short.
        axis: Axis,
        /// 2·(guard + training) + 1.
        needed: u64,
        /// Cells of the map.
        cells: usize,
    },
    /// A Chebyshev window that cannot be made.
    #[error("chebyshev sidelobes must lie between 10 and 300 dB below the peak, asked are {0}")]
    Sidelobes(f64),
    /// A crop without pixels or extent, or one of more cells than any stage holds.
    #[error(
        "a crop needs a side of 1 to 8192 pixels, positive spans of no more than {} cells and a ceiling above \
         its floor",
        artifact::cube::CUBE_LIMIT
    )]
    CropFormat,
    /// An object that no crop can be centred on and no track can follow.
    #[error("the object's {quantity} is not finite")]
    ObjectNotFinite {
        /// Range, velocity or position.
        quantity: &'static str,
    },
    /// A frame that cannot follow the one before it.
    #[error("a frame at {found_s} s cannot follow one at {last_s:?} s: tracks go forward in time")]
    FrameTime {
        /// Time of the frame before, if there was one.
        last_s: Option<f64>,
        /// Time of the frame.
        found_s: f64,
    },
}

/// An axis of a range-Doppler map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// Rows.
    Doppler,
    /// Columns.
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
