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
    /// The file, or an element that holds others, ends before an element does.
    #[error("it ends within an element")]
    EndsInElement,
    /// No element of the file is what is looked for.
    #[error("it has no complex array")]
    NoComplexArray,
    /// The array that is asked for has more bytes than can be counted.
    #[error("its sides are too long")]
    SidesTooLong,
    /// A packed element is damaged.
    #[error("an element does not unpack: {0}")]
    Damaged(#[source] io::Error),
    /// The parts of an array are not those of an array.
    #[error("an array has no sides or no name")]
    NoSidesOrName,
    /// The array is not as long as the radar's frames on some side.
    #[error("its array is {found:?}, the scene's radar has {asked:?}")]
    OtherSides {
        /// Sides in the file.
        found: Vec<u32>,
        /// Sides that are asked for.
        asked: [usize; 4],
    },
    /// The array holds fewer or more numbers than its sides ask for.
    #[error("{asked} numbers are asked for, it has {bytes} bytes of them")]
    OtherCount {
        /// Numbers that are asked for.
        asked: usize,
        /// Bytes of numbers.
        bytes: usize,
    },
    /// A type that numbers do not have.
    #[error("numbers of type {0} are not known")]
    UnknownNumbers(u32),
}
