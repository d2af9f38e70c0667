//! Ranges of allowed numbers, with their text.

use crate::wording::number::WrittenNumber;
use std::fmt;

/// Range of allowed numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AllowedRange {
    /// Both ends included.
    Between(f64, f64),
    /// Above the first, up to and including the second.
    Above(f64, f64),
    /// Neither end included.
    Inside(f64, f64),
    /// The first included, the second not.
    Below(f64, f64),
}

impl AllowedRange {
    /// Whether `value` is allowed; never for NaN.
    pub fn holds(self, value: f64) -> bool {
        match self {
            Self::Between(low, high) => low <= value && value <= high,
            Self::Above(low, high) => low < value && value <= high,
            Self::Inside(low, high) => low < value && value < high,
            Self::Below(low, high) => low <= value && value < high,
        }
    }
}

impl fmt::Display for AllowedRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Between(low, high) if low == high => write!(f, "{}", WrittenNumber(low)),
            Self::Between(low, high) => write!(f, "from {} to {}", WrittenNumber(low), WrittenNumber(high)),
            Self::Above(low, high) => {
                write!(f, "above {}, up to {}", WrittenNumber(low), WrittenNumber(high))
            }
            Self::Inside(low, high) => {
                write!(f, "above {} and below {}", WrittenNumber(low), WrittenNumber(high))
            }
            Self::Below(low, high) => write!(f, "from {}, below {}", WrittenNumber(low), WrittenNumber(high)),
        }
    }
}
