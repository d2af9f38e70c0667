//! Sources of the heights of points, in words, for formats that have a z but no place for its source.

use artifact::Reader;
use artifact::points::{Height, Point, Points, PointsHeader};
use pipeline::host::failure::Failure;
use std::path::Path;

/// Source of the heights of a file of points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HeightSource {
    /// Measured heights, or no points.
    Measured,
    /// Assumed heights, m, if all are equal to that of the settings.
    Assumed(Option<f64>),
    /// The radar's own height, because not even an assumed one fits.
    RadarsOwn,
}

/// Tolerance of heights: coordinates are products of directions and ranges, so heights differ from the
/// settings' by rounding.
const SAME_HEIGHT_M: f64 = 1e-6;

impl HeightSource {
    /// Source of the heights of a file, by the first point with one: the array has elevation rows or none,
    /// for all points.
    ///
    /// # Errors
    /// A frame before that point is damaged.
    pub fn of(file: &Path) -> Result<Self, Failure> {
        let reader = Reader::<Points>::open(file)?;
        let header = reader.header().clone();
        let mut heights = Self::Measured;
        for frame in reader {
            for point in frame?.points {
                heights = Self::of_point(&header, &point);
                if heights != Self::RadarsOwn {
                    return Ok(heights);
                }
            }
        }
        Ok(heights)
    }

    fn of_point(header: &PointsHeader, point: &Point) -> Self {
        match point.height {
            Height::Measured => Self::Measured,
            Height::None => Self::RadarsOwn,
            Height::Assumed => {
                let told_m = header.cube.as_ref().map(|cube| cube.dsp.assumed_height_m);
                let is_there = |told_m: &f64| (point.position_m[2] - told_m).abs() <= SAME_HEIGHT_M;
                Self::Assumed(told_m.filter(is_there))
            }
        }
    }

    /// Source of the height, in words.
    pub(crate) fn words(self) -> String {
        match self {
            Self::Measured => "measured".to_owned(),
            Self::Assumed(Some(at_m)) => format!("assumed at {at_m} m"),
            Self::Assumed(None) => "assumed".to_owned(),
            Self::RadarsOwn => "the radar's own".to_owned(),
        }
    }

    /// The remark for an exported file whose heights were not measured.
    pub fn note(self, file: &Path) -> Option<String> {
        let text = || format!("note: {}: heights are {}, not measured", file.display(), self.words());
        (self != Self::Measured).then(text)
    }
}
