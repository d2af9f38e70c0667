//! Kinds of files for messages of OSI.

/// Kind of a file of OSI messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Container {
    /// One channel: a length of four bytes, little-endian, before each message.
    Osi,
    /// MCAP, with descriptors of the messages.
    Mcap,
}
