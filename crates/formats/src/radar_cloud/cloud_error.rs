//! Faults of the files of clouds.

/// A cloud's file that was refused.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CloudError {
    /// The head ends before its last line.
    #[error("it ends within its head, which has no line DATA")]
    EndsInHead,
    /// The head is not UTF-8.
    #[error("its head is no text")]
    NoText,
    /// A line without which the rows cannot be read.
    #[error("its head has no line {0}")]
    NoLine(&'static str),
    /// Rows are written as text, or packed.
    #[error("its DATA is not binary")]
    NotBinary,
    /// Lines of the head that contradict each other, or fields of several values.
    #[error("FIELDS, SIZE, TYPE and COUNT do not tell of the same fields of one value")]
    UnequalFields,
    /// The head does not say how many points there are.
    #[error("POINTS is no number")]
    NoPointCount,
    /// A type that fields of clouds do not have.
    #[error("a field of type {kind} and size {size} is not known")]
    UnknownField {
        /// Type as written.
        kind: String,
        /// Bytes as written.
        size: String,
    },
    /// A field without which a row is no detection.
    #[error("it has no field {0}")]
    NoField(&'static str),
    /// The rows end before the last point of the head.
    #[error("its head tells of {points} points, behind it are {bytes} bytes")]
    TooFewRows {
        /// Points that the head tells of.
        points: usize,
        /// Bytes behind the head.
        bytes: usize,
    },
    /// A file without a head that ends within a row.
    #[error("{0} bytes are no whole rows of seven float32")]
    PartOfRow(usize),
    /// The cloud has more detections than objects can be formed of.
    #[error("it has more than {limit} detections, the most that are read")]
    TooManyDetections {
        /// Most detections that are read.
        limit: usize,
    },
    /// A point, from 0, whose numbers are no detection's.
    #[error("point {0}: no detection has these numbers")]
    UnsoundPoint(usize),
    /// A row, from 0, whose numbers are no detection's.
    #[error("row {0}: no detection has these numbers")]
    UnsoundRow(usize),
}
