//! Shares of S whose ways are about as long, added up at a few frequencies.

use artifact::paths::Amplitude;

/// A group that a share is to be added to.
pub(crate) struct Group<'g> {
    /// Sums by wavenumber, each without e^{−jk·length}.
    pub(crate) sums: &'g mut [Amplitude],
    pub(crate) wavenumbers_per_m: &'g [f64],
    pub(crate) length_m: f64,
}
