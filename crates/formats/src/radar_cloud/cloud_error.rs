//! Faults of files of clouds.

/// A refused file of a cloud.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CloudError {
    /// The head ends before its last line.
    #[error("it ends within its head, which has no line DATA")]
    EndsInHead,
    /// The head is not UTF-8.
    #[error("its head is no text")]
    NoText,
    /// A required line of the head is missing.
    #[error("its head has no line {0}")]
    NoLine(&'static str),
    /// Rows are text, or compressed.
    #[error("its DATA is not binary")]
    NotBinary,
    /// Contradictory lines of the head, or fields with several values.
    #[error("FIELDS, SIZE, TYPE and COUNT do not tell of the same fields of one value")]
    UnequalFields,
    /// The head lacks the number of points.
    #[error("POINTS is no number")]
    NoPointCount,
    /// A type that is not supported for fields.
    #[error("a field of type {kind} and size {size} is not known")]
    UnknownField {
        /// Letter of the field's type in the head.
        kind: String,
        /// Size of the field in the head, bytes.
        size: String,
    },
    /// A required field of a detection is missing.
    #[error("it has no field {0}")]
    NoField(&'static str),
    /// The rows end before the last point of the head.
    #[error("its head tells of {points} points, behind it are {bytes} bytes")]
    TooFewRows {
        /// Number of points in the head.
        points: usize,
        /// Bytes after the head.
        bytes: usize,
    },
    /// A file without a head ends within a row.
    #[error("{0} bytes are no whole rows of seven float32")]
    PartOfRow(usize),
    /// The cloud has too many detections for clustering.
    #[error("it has more than {limit} detections, the most that are read")]
    TooManyDetections {
        /// Largest number of detections.
        limit: usize,
    },
    /// A point, from 0, with invalid numbers.
    #[error("point {0}: no detection has these numbers")]
    UnsoundPoint(usize),
    /// A row, from 0, with invalid numbers.
    #[error("row {0}: no detection has these numbers")]
    UnsoundRow(usize),
}
