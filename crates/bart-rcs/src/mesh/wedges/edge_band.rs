//! Bands of frequency in which edges are the same.
//!
//! Whether a side is thin, a seam is closed or a wave over a face is worth following depends on the
//! wavelength. It is decided for a whole band of fixed limits, at its middle: S at a frequency then does not
//! depend on the other frequencies of a table, and within a band it has no steps.

use artifact::units::SPEED_OF_LIGHT_MPS;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::OnceLock;

/// A band by its number: the middle of band 0 is 77 GHz. The usual bands of radars, 76 to 81, 60 to 64 and 24
/// GHz, are each within one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct EdgeBand(i32);

/// Ratio of a band's highest wavenumber to its lowest.
const WIDTH: f64 = 1.25;
/// Geometric middle of band 0.
const MIDDLE_PER_M: f64 = TAU * 77e9 / SPEED_OF_LIGHT_MPS;

impl EdgeBand {
    /// Band of a wavenumber.
    pub(crate) fn of(wavenumber_per_m: f64) -> Self {
        let bands = (wavenumber_per_m.max(f64::MIN_POSITIVE) / MIDDLE_PER_M).ln() / WIDTH.ln();
        Self(bands.round() as i32)
    }

    /// Geometric middle, for which decisions are made.
    pub(crate) fn middle_per_m(self) -> f64 {
        MIDDLE_PER_M * WIDTH.powi(self.0)
    }

    /// Highest wavenumber.
    pub(crate) fn highest_per_m(self) -> f64 {
        self.middle_per_m() * WIDTH.sqrt()
    }
}

/// Indices of wavenumbers by their band, the lowest band first.
pub(crate) fn by_band(wavenumbers_per_m: &[f64]) -> Vec<Vec<usize>> {
    let mut bands: BTreeMap<EdgeBand, Vec<usize>> = BTreeMap::new();
    for (index, wavenumber_per_m) in wavenumbers_per_m.iter().enumerate() {
        bands.entry(EdgeBand::of(*wavenumber_per_m)).or_default().push(index);
    }
    bands.into_values().collect()
}

/// A value for each band, computed when first requested.
pub(crate) struct PerBand<T> {
    first: OnceLock<(EdgeBand, T)>,
    others: OnceLock<Box<Self>>,
}

impl<T> PerBand<T> {
    pub(crate) fn new() -> Self {
        Self { first: OnceLock::new(), others: OnceLock::new() }
    }

    /// Value of a band, made by `make` if it is not known.
    pub(crate) fn get(&self, band: EdgeBand, make: &impl Fn() -> T) -> &T {
        let (known, value) = self.first.get_or_init(|| (band, make()));
        if *known == band { value } else { self.others.get_or_init(|| Box::new(Self::new())).get(band, make) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn band_at(frequency_ghz: f64) -> EdgeBand {
        EdgeBand::of(TAU * frequency_ghz * 1e9 / SPEED_OF_LIGHT_MPS)
    }

    #[test]
    fn bands_of_radars_are_whole_and_hold_their_middles() {
        assert_eq!([76.0, 81.0, 60.0, 64.0, 90.0].map(band_at), [0, 0, -1, -1, 1].map(EdgeBand));
        assert_eq!(band_at(24.0), band_at(24.25));
        for frequency_ghz in [0.3, 5.9, 10.0, 24.0, 60.5, 77.0, 140.0] {
            let band = band_at(frequency_ghz);
            let just_below_the_end = (1.0 - 1e-9) * band.highest_per_m();
            assert_eq!([just_below_the_end, band.middle_per_m()].map(EdgeBand::of), [band; 2]);
        }
        assert!(EdgeBand::of(0.0).middle_per_m() > 0.0);
    }

    #[test]
    fn wavenumbers_keep_their_places_and_values_their_bands() {
        assert_eq!(by_band(&[1600.0, 510.0, 1610.0, 515.0]), [vec![1, 3], vec![0, 2]]);
        let values = PerBand::new();
        for (band, value, known) in [(2, 20, 20), (0, 0, 0), (2, 99, 20), (1, 10, 10), (0, 99, 0)] {
            assert_eq!(*values.get(EdgeBand(band), &|| value), known);
        }
    }
}
