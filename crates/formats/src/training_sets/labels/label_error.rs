//! Faults of labels and of the calibrations beside them.

use crate::radar_cloud::PLACE_LIMIT_M;

/// Largest side of a labelled body, m.
pub(super) const SIZE_LIMIT_M: f64 = 1000.0;
/// Largest number of labelled bodies of a frame.
pub(super) const BODY_LIMIT: usize = 1_024;

/// A refused label, or a refused calibration.
#[derive(Debug, thiserror::Error)]
pub(super) enum LabelError {
    /// A line with another number of columns.
    #[error("{0} columns are neither the 15 of a label nor the 16 of one with a score")]
    Columns(usize),
    /// A word that is no finite number.
    #[error("{column} `{word}` is no finite number")]
    NoNumber {
        /// Name of the column.
        column: &'static str,
        /// Word as written.
        word: String,
    },
    /// A box without extent, or with too large a one.
    #[error("length, width and height are not all from 0 to {limit} m", limit = SIZE_LIMIT_M)]
    Size,
    /// A box that no sensor sees.
    #[error("the box is not within {limit} m of the sensor", limit = PLACE_LIMIT_M)]
    Place,
    /// A frame with too many bodies to be paired.
    #[error("a frame has more than {limit} bodies, the most that are read", limit = BODY_LIMIT)]
    Bodies,
    /// A required line of a calibration is missing.
    #[error("it has no line {0}")]
    NoLine(&'static str),
    /// A line of a calibration with other numbers.
    #[error("{line} has not {count} finite numbers")]
    NotNumbers {
        /// Name of the line.
        line: &'static str,
        /// Required count of numbers.
        count: usize,
    },
    /// A matrix or quaternion that distorts.
    #[error("{0} is no rotation")]
    NoRotation(&'static str),
    /// A token without a row.
    #[error("{key} `{token}` is of no row")]
    NoRow {
        /// Name of the field.
        key: &'static str,
        /// Token as written.
        token: String,
    },
}
