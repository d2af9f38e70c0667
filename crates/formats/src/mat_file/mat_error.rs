//! Faults of MATLAB's files.

use std::io;

/// A file that was refused.
#[derive(Debug, thiserror::Error)]
pub(crate) enum MatError {
    /// The head is that of another kind of file.
    #[error(
        "it is no little-endian MAT-file of level 5; a file of MATLAB 7.3 (HDF5) or of the other order of \
         bytes is not read"
    )]
    NotLevel5,
    /// The file, or a nested element, ends within an element.
    #[error("it ends within an element")]
    EndsInElement,
    /// The file has no such array.
    #[error("it has no complex array")]
    NoComplexArray,
    /// The array has more bytes than can be counted.
    #[error("its sides are too long")]
    SidesTooLong,
    /// A packed element is damaged.
    #[error("an element does not unpack: {0}")]
    Damaged(#[source] io::Error),
    /// The array lacks required parts.
    #[error("an array has no sides or no name")]
    NoSidesOrName,
    /// The sides of the array differ from the radar's frames.
    #[error("its array is {found:?}, the scene's radar has {asked:?}")]
    OtherSides {
        /// Sides of the array in the file.
        found: Vec<u32>,
        /// Sides that the radar's frames have.
        asked: [usize; 4],
    },
    /// The array holds fewer or more numbers than its sides require.
    #[error("{asked} numbers are asked for, it has {bytes} bytes of them")]
    OtherCount {
        /// Expected number of values.
        asked: usize,
        /// Bytes of the values.
        bytes: usize,
    },
    /// A type that is not numeric.
    #[error("numbers of type {0} are not known")]
    UnknownNumbers(u32),
}
