//! Error of using a far-field table at close range: comparison of the table with spherical waves, at a few of
//! its aspects.
//!
//! 2D²/λ of a car is 13 km at 77 GHz: at the ranges of a road its flat panels are wider than the Fresnel zone
//! √(λR/2), 0.2 m at 25 m, and the complex error is as large as the field. The table is correct as a far
//! field; this is the warning attached to it.

use crate::bodies::world::World;
use crate::run_control::cancellation::CancellationCheck;
use crate::run_control::error::BartError;
use crate::table::aspect::{Scattering, scattering};
use crate::table::aspect_settings::{AspectSettings, Check, Checks, IntegralsCheck};
use crate::table::measured_aspects::drawn_from_parts;
use crate::table::rcs_request::{Aspect, RcsRequest, traced_aspects};
use artifact::units::{amplitude_ratio, db_from_power};
use num_complex::Complex64;
use rayon::prelude::*;

/// A far-field table compared with the same body in spherical waves.
#[derive(Debug, Clone, PartialEq)]
pub struct FarFieldError {
    /// Ranges at which the table was applied; an infinitely distant receiver is placed there too.
    pub range_m: Vec<f64>,
    /// Complex error by range: at each aspect ‖S − S(range)‖ over ‖S(range)‖, over frequency.
    pub complex: Vec<Spread>,
    /// Level error by range: at each aspect the deviation of its level, |S|² over frequency, in dB, either
    /// way.
    pub level_db: Vec<Spread>,
    /// Number of aspects measured.
    pub aspects: usize,
    /// Number of the table's frequencies measured.
    pub frequencies: usize,
}

/// Distribution of the errors over aspects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Median error over aspects.
    pub median: f64,
    /// Maximum error over aspects.
    pub worst: f64,
}

/// Ranges of the paper's intersection: vehicles are at 25 to 60 m.
const RANGES_M: [f64; 4] = [25.0, 30.0, 40.0, 60.0];

/// Number of aspects per compared one: one in forty is traced at four more ranges, a tenth of the trees of
/// the table. Fewer than forty aspects have none.
const ASPECTS_PER_COMPARED: usize = 40;
/// Maximum number of compared aspects, enough for a median: its 95 % confidence interval lies between the 8th
/// and the 17th of 24.
const COMPARED_MOST: usize = 24;
/// Maximum number of compared frequencies: more would be correlated by the extent of a vehicle, as in
/// `frame_error`.
const FREQUENCIES_MOST: usize = 12;
/// Accuracy of the spherical waves: an error near 0 dB is needed to no better than 1 %.
const SPHERICAL_ACCURACY: f64 = 1e-2;

/// Far-field error; `None` for a table of finite range, and for one too small to justify the cost.
pub(crate) fn far_field_error(
    world: &World,
    request: &RcsRequest,
    settings: &AspectSettings,
    table: &[Scattering],
    cancellation: CancellationCheck<'_>,
) -> Result<Option<FarFieldError>, BartError> {
    let chosen = chosen_aspects(table.len());
    if request.range_m.is_finite() || chosen.is_empty() {
        return Ok(None);
    }
    let ranges_m = ranges_outside(world);
    if ranges_m.is_empty() {
        return Ok(None);
    }
    let frequencies = chosen_frequencies(request.frequency_hz.len());
    let settings = AspectSettings {
        wavenumbers_per_m: frequencies.iter().map(|&f| settings.wavenumbers_per_m[f]).collect(),
        accuracy: settings.accuracy.max(SPHERICAL_ACCURACY),
        ..settings.clone()
    };
    let cases: Vec<(usize, Aspect)> = ranges_m
        .iter()
        .map(|range_m| traced_aspects(&request.at_range(*range_m), world))
        .flat_map(|there| chosen.iter().map(move |&index| (index, there[index])))
        .collect();
    let compare = |&(index, aspect): &(usize, Aspect)| {
        cancellation.check()?;
        let checks = Checks { integrals: IntegralsCheck::Skipped, model: Check::Skipped };
        let spherical = scattering(world, &aspect, &settings, checks)?;
        let near: Vec<Complex64> = (0..frequencies.len()).map(|f| spherical.total_m(f)).collect();
        let far: Vec<Complex64> = frequencies.iter().map(|&f| table[index].total_m(f)).collect();
        Ok(Compared::of(&far, &near))
    };
    let compared =
        cases.par_iter().map(compare).collect::<Vec<_>>().into_iter().collect::<Result<Vec<_>, _>>()?;
    let by_range = || compared.chunks(chosen.len());
    Ok(Some(FarFieldError {
        range_m: ranges_m,
        complex: by_range().map(|of| spread(of.iter().map(Compared::complex))).collect(),
        level_db: by_range().map(|of| spread(of.iter().map(|c| c.level_db().abs()))).collect(),
        aspects: chosen.len(),
        frequencies: frequencies.len(),
    }))
}

/// Ranges outside the facets of a large body.
fn ranges_outside(world: &World) -> Vec<f64> {
    let corners_m = world.facets().iter().flat_map(|facet| facet.corners_m);
    let radius_m = corners_m.map(|corner| corner.length()).fold(0.0, f64::max);
    RANGES_M.into_iter().filter(|range_m| *range_m > 1.1 * radius_m).collect()
}

/// One random aspect from each of equal parts of the table.
fn chosen_aspects(aspects: usize) -> Vec<usize> {
    let count = (aspects / ASPECTS_PER_COMPARED).min(COMPARED_MOST);
    drawn_from_parts(aspects, count, "bart-rcs/far-field-error")
}

/// Centres of equal parts of the table's frequencies.
fn chosen_frequencies(frequencies: usize) -> Vec<usize> {
    let count = frequencies.min(FREQUENCIES_MOST);
    (0..count).map(|i| (2 * i + 1) * frequencies / (2 * count)).collect()
}

fn spread(values: impl Iterator<Item = f64>) -> Spread {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    let (below, above) = (values[(values.len() - 1) / 2], values[values.len() / 2]);
    Spread { median: 0.5 * (below + above), worst: values[values.len() - 1] }
}

/// A far field and the corresponding spherical wave, as powers over frequency.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Compared {
    pub(crate) difference: f64,
    far: f64,
    pub(crate) spherical: f64,
}

impl Compared {
    pub(crate) fn of(far: &[Complex64], spherical: &[Complex64]) -> Self {
        let power = |values: &[Complex64]| values.iter().map(|s| s.norm_sqr()).sum();
        let difference = far.iter().zip(spherical).map(|(a, b)| (a - b).norm_sqr()).sum();
        Self { difference, far: power(far), spherical: power(spherical) }
    }

    /// Complex error relative to the spherical wave, the true value; relative to the far field's power it
    /// would stop at 0 dB where the table is far too strong (a 1.5 m plate at 25 m: +35 dB). 0 if both are
    /// dark.
    fn complex(&self) -> f64 {
        if self.difference > 0.0 && self.spherical == 0.0 {
            f64::INFINITY
        } else {
            amplitude_ratio(self.difference, self.spherical)
        }
    }

    /// Level of the far field over that of the spherical wave, positive if the far field is too strong.
    fn level_db(&self) -> f64 {
        if self.far == self.spherical { 0.0 } else { db_from_power(self.far / self.spherical) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_aspect_in_forty_is_compared_each_in_its_own_part_of_the_table() {
        assert!(chosen_aspects(39).is_empty());
        for aspects in [40, 361, 5000] {
            let chosen = chosen_aspects(aspects);
            let count = (aspects / 40).min(24);
            assert_eq!(chosen.len(), count);
            let is_in_part = |(part, &at): (usize, &usize)| {
                (part * aspects / count..(part + 1) * aspects / count).contains(&at)
            };
            assert!(chosen.iter().enumerate().all(is_in_part), "{chosen:?}");
        }
    }

    #[test]
    fn frequencies_are_spread_over_the_table() {
        assert_eq!(chosen_frequencies(1), [0]);
        assert_eq!(chosen_frequencies(3), [0, 1, 2]);
        assert_eq!(chosen_frequencies(64).len(), 12);
        assert_eq!((chosen_frequencies(64)[0], chosen_frequencies(64)[11]), (2, 61));
    }

    #[test]
    fn an_error_is_told_over_the_truth_and_in_level() {
        let compared = Compared::of(&[Complex64::from(20.0)], &[Complex64::from(2.0)]);
        assert!((compared.complex() - 9.0).abs() < 1e-12 && (compared.level_db() - 20.0).abs() < 1e-12);
        let dark = Compared::of(&[Complex64::ZERO], &[Complex64::ZERO]);
        assert_eq!((dark.complex(), dark.level_db()), (0.0, 0.0));
        let of = spread([3.0, 1.0, 2.0, 8.0].into_iter());
        assert_eq!((of.median, of.worst), (2.5, 8.0));
    }
}
