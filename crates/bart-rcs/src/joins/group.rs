//! Contributions to S with similar path lengths, summed at a few frequencies.

use artifact::paths::Amplitude;

/// Group to which a contribution is added.
pub(crate) struct Group<'g> {
    /// Sums by wavenumber, each without e^{−jk·length}.
    pub(crate) sums: &'g mut [Amplitude],
    pub(crate) wavenumbers_per_m: &'g [f64],
    pub(crate) length_m: f64,
}
