//! Retracing, with smaller mirrors, of aspects where the dropped parts scatter more than the accuracy
//! permits.
//!
//! Minimum areas are chosen before a trace, and determine what is dropped: for a weak body it may exceed the
//! request. If mirrors are equally numerous in every octave of area, as among large facets, Σa² of the
//! unfollowed ones falls with the square of the minimum area; if all facets are small it falls with the area
//! itself. The second, slower law is used.

use crate::run_control::error::BartError;
use crate::table::aspect::Scattering;
use crate::table::aspect_settings::AspectSettings;
use artifact::units::amplitude_ratio;

/// Minimum areas of the aspects of a table.
pub(crate) struct FinerMirrors {
    aspects: Vec<MirrorFineness>,
    times: u32,
}

#[derive(Clone, Copy)]
struct MirrorFineness {
    /// Ratio to the table's initial minimum areas.
    share: f64,
    before: f64,
    limit: Limit,
}

/// Whether an aspect may be traced with still smaller mirrors.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Limit {
    Open,
    Reached,
}

/// Maximum number of times that an aspect is retraced.
const MOST_TIMES: u32 = 3;
/// Minimum factor of the ratio per step: mirrors become at most a tenth as long, since the estimate is based
/// on those near the threshold and may be wrong far below.
const SMALLEST_STEP: f64 = 1e-2;
/// Minimum ratio: mirrors become at most a hundredth as long in all. With −60 dB requested that is a
/// micrometre, a hundred thousand times the rounding of coordinates.
const SMALLEST: f64 = 1e-4;

/// Factor of a Rayleigh-distributed sum of independent phases: in 95 of 100 cases it is below √(ln 20) of its
/// root mean square.
const RAYLEIGH_95: f64 = 1.730_818;

/// Scattering of the dropped beams over the table's root mean square |S|, exceeded in 5 of 100 cases;
/// infinite if everything was dropped.
pub(crate) fn dropped_error(table: &[Scattering]) -> f64 {
    let dropped_m2: f64 = table.iter().map(|s| s.dropped_m.powi(2)).sum();
    let kept_m2: f64 = table.iter().map(Scattering::mean_power).sum();
    if kept_m2 == 0.0 && dropped_m2 > 0.0 {
        return f64::INFINITY;
    }
    RAYLEIGH_95 * amplitude_ratio(dropped_m2, kept_m2)
}

impl FinerMirrors {
    /// Initial state, with all aspects traced with the requested areas.
    pub(crate) fn of_none(aspects: usize) -> Self {
        Self {
            aspects: vec![MirrorFineness { share: 1.0, before: 1.0, limit: Limit::Open }; aspects],
            times: 0,
        }
    }

    /// Aspects to be retraced, ascending: those that drop more than `asked` of the table's level, if the
    /// total does.
    pub(crate) fn aspects_to_retrace(&mut self, table: &[Scattering], asked: f64) -> Vec<usize> {
        if dropped_error(table) <= asked || self.times == MOST_TIMES {
            return Vec::new();
        }
        self.times += 1;
        let power = table.iter().map(Scattering::mean_power).sum::<f64>() / table.len() as f64;
        let allowed_m = asked / RAYLEIGH_95 * power.sqrt();
        let mut again = Vec::new();
        for (index, (aspect, s)) in self.aspects.iter_mut().zip(table).enumerate() {
            if s.dropped_m > allowed_m && aspect.limit == Limit::Open {
                aspect.before = aspect.share;
                aspect.share *= (allowed_m / s.dropped_m).powi(2).max(SMALLEST_STEP);
                if aspect.share <= SMALLEST {
                    (aspect.share, aspect.limit) = (SMALLEST, Limit::Reached);
                }
                again.push(index);
            }
        }
        again
    }

    /// Settings for tracing an aspect.
    pub(crate) fn settings(&self, aspect: usize, settings: &AspectSettings) -> AspectSettings {
        let share = self.aspects[aspect].share;
        let mut finer = settings.clone();
        finer.trace.least_area_m2 *= share;
        finer.trace.least_mirror_area_m2 *= share;
        finer
    }

    /// Whether an aspect is traced with the initial settings.
    pub(crate) fn is_first(&self, aspect: usize) -> bool {
        self.aspects[aspect].share == 1.0
    }

    /// Takes the result of a retraced aspect. One whose beams do not fit into memory keeps its previous
    /// result; any other error is returned.
    pub(crate) fn take(
        &mut self,
        aspect: usize,
        found: Result<Scattering, BartError>,
        table: &mut [Scattering],
    ) -> Result<(), BartError> {
        let is_too_large = |e: &BartError| {
            matches!(e, BartError::BeamsTakeTooMuchMemory { .. } | BartError::TreeTooLarge { .. })
        };
        match found {
            Err(error) if is_too_large(&error) && !self.is_first(aspect) => {
                let MirrorFineness { before, .. } = self.aspects[aspect];
                self.aspects[aspect] = MirrorFineness { share: before, before, limit: Limit::Reached };
            }
            Err(error) => return Err(error),
            Ok(found) => table[aspect] = found,
        }
        Ok(())
    }

    /// Number of aspects that ended with smaller mirrors than initially, and the smallest ratio of the
    /// minimum areas.
    pub(crate) fn reached(&self) -> (u64, f64) {
        let finer = self.aspects.iter().filter(|aspect| aspect.share < 1.0);
        (finer.clone().count() as u64, finer.map(|aspect| aspect.share).fold(1.0, f64::min))
    }
}
