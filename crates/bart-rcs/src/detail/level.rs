//! Selection of the cheapest level of detail whose error, measured in the run and added to the frame's
//! others, is within the requested accuracy.

use crate::detail::detail_cost::{centres_s, echo_s, merging_s};
use crate::detail::merged_paths::merged;
use crate::detail::sampled_chirps::{SampledChirps, difference, power};
use crate::detail::scattering_centres::centres;
use crate::detail::statistical_points::PointModel;
use artifact::paths::{Path, PathsFrame, TargetDetail, TraceStatistics};
use artifact::scene::SceneHeader;
use artifact::settings::Detail;
use artifact::{ErrorBudget, Radar};
use num_complex::Complex64;

/// Reduces a frame's paths to the detail that the scene requests: fewer paths for the same echo.
///
/// Each target has its own level, and none loses a larger share of itself than the frame may. `Detail::Auto`
/// reduces where that is cheaper than the echo of all paths, by no more than what the frame's other errors
/// leave of the requested accuracy; if these exceed it already, by a fifth of them, which adds 2 %. A level
/// requested by name may take at least 0.3 of the accuracy, statistical points as much as they need. Point
/// targets are unchanged. `error.detail` is measured by comparing reduced paths with all of them, at pairs of
/// elements, moments and frequencies other than those used in making them. `trace.detail` reports each
/// target's level.
pub fn reduce_detail(header: &SceneHeader, frame: PathsFrame) -> PathsFrame {
    let asked = header.fidelity.detail;
    let left = remaining_error(header, &frame.error);
    let allowed = match asked {
        Detail::Paths => return frame,
        Detail::Auto => left,
        Detail::Merged | Detail::Centres | Detail::Statistical => {
            left.max(LEAST_SHARE * header.fidelity.accuracy.amplitude())
        }
    };
    let of_target = |target: u32| {
        let paths: Vec<Path> = frame.paths.iter().filter(|path| path.target == target).copied().collect();
        LevelChoice::new(&header.radar, paths, allowed).reduce(asked, header.seed, target)
    };
    let targets: Vec<ReducedPaths> = (0..header.targets.len() as u32).map(of_target).collect();
    with(targets, frame)
}

/// Minimum share of the requested accuracy that a level requested by name may take.
const LEAST_SHARE: f64 = 0.3;

/// Error that the other errors of a frame leave of the requested accuracy, as an amplitude.
fn remaining_error(header: &SceneHeader, error: &ErrorBudget) -> f64 {
    let asked = header.fidelity.accuracy.amplitude();
    let others = error.total().unwrap_or(0.0);
    if others < asked { (asked.powi(2) - others.powi(2)).sqrt() } else { BEYOND_SHARE * others }
}

/// Share of the other errors allotted to a level if they already exceed the accuracy: √(1 + 0.2²) is 1.02.
const BEYOND_SHARE: f64 = 0.2;

fn with(targets: Vec<ReducedPaths>, frame: PathsFrame) -> PathsFrame {
    let of = |target: &ReducedPaths| TargetDetail {
        level: target.level,
        traced: target.traced as u64,
        kept: target.paths.len() as u64,
        error: target.measured.map(MissedPower::error),
    };
    let trace = TraceStatistics { detail: targets.iter().map(of).collect(), ..frame.trace };
    let measured: Vec<MissedPower> = targets.iter().filter_map(|target| target.measured).collect();
    if measured.is_empty() {
        return PathsFrame { trace, ..frame };
    }
    let all = MissedPower {
        missed: measured.iter().map(|m| m.missed).sum(),
        power: measured.iter().map(|m| m.power).sum(),
    };
    let error = ErrorBudget { detail: Some(all.error()), ..frame.error };
    PathsFrame { paths: targets.into_iter().flat_map(|target| target.paths).collect(), error, trace, ..frame }
}

/// A target's paths at a level of detail.
struct ReducedPaths {
    level: Detail,
    traced: usize,
    paths: Vec<Path>,
    /// Measured error of the level; `None` for all paths.
    measured: Option<MissedPower>,
}

/// Power missed by reduced paths, and power of all paths.
#[derive(Debug, Clone, Copy)]
struct MissedPower {
    missed: f64,
    power: f64,
}

/// Margin of a measured error. The ratio of two mean powers of n complex Gaussian samples follows the F
/// distribution with (2n, 2n) degrees of freedom. Chirps are spread over the whole frame: of their 192
/// samples about 32 are independent if a vehicle fills few cells of range and angle, and 95 of 100 ratios
/// stay below F(0.95; 64, 64) = 1.51, as an amplitude 1.23.
const MARGIN: f64 = 1.23;
const CHIRPS: usize = 12;
const INSTANTS: usize = 16;

impl MissedPower {
    /// Relative amplitude error, with the margin of the measurement; 0 if nothing scatters.
    fn error(self) -> f64 {
        if self.power > 0.0 { MARGIN * (self.missed / self.power).sqrt() } else { 0.0 }
    }
}

/// Paths of one target, and the error allowed for a level.
struct LevelChoice<'a> {
    radar: &'a Radar,
    paths: Vec<Path>,
    chirps: SampledChirps<'a>,
    allowed: f64,
}

/// A level with its error.
struct LevelWithError {
    level: Detail,
    paths: Vec<Path>,
    measured: MissedPower,
}

/// Target of the next attempt relative to the allowed error, a little lower: a level's error falls about as
/// fast as its setting.
const AIM: f64 = 0.7;

impl<'a> LevelChoice<'a> {
    fn new(radar: &'a Radar, paths: Vec<Path>, allowed: f64) -> Self {
        Self { radar, paths, chirps: SampledChirps::new(radar, CHIRPS, INSTANTS, 0.0), allowed }
    }

    fn reduce(self, asked: Detail, seed: u64, target: u32) -> ReducedPaths {
        let is_exact = self.paths.iter().all(|path| path.order == 0);
        let found = match asked {
            _ if is_exact => None,
            Detail::Paths => None,
            Detail::Auto => self.cheapest(),
            Detail::Merged => self.merged(&self.field()),
            Detail::Centres => self.centres(&self.field()),
            Detail::Statistical => self.statistical(&self.field(), seed, target),
        };
        let traced = self.paths.len();
        match found {
            Some(LevelWithError { level, paths, measured }) => {
                ReducedPaths { level, traced, paths, measured: Some(measured) }
            }
            None => ReducedPaths { level: Detail::Paths, traced, paths: self.paths, measured: None },
        }
    }

    /// Cheapest level found; levels that cost more to make than they are expected to save are not tried.
    /// Centres come first: they are fewer than merged paths.
    fn cheapest(&self) -> Option<LevelWithError> {
        let count = self.paths.len();
        let echo = |paths: usize| echo_s(self.radar, paths);
        let saved = |found: &LevelWithError| echo(found.paths.len()) < echo(count);
        let are_centres_worth_it = echo(count) - echo(FEW_CENTRES) > centres_s(self.radar, count);
        let is_merging_worth_it = echo(count) - echo(count / 2) > merging_s(count);
        if self.allowed <= 0.0 || !(are_centres_worth_it || is_merging_worth_it) {
            return None;
        }
        let field = self.field();
        let fitted = are_centres_worth_it.then(|| self.centres(&field)).flatten().filter(saved);
        fitted.or_else(|| is_merging_worth_it.then(|| self.merged(&field)).flatten().filter(saved))
    }

    /// Field of all paths at the sampled chirps.
    fn field(&self) -> Vec<Complex64> {
        self.chirps.field(&self.paths)
    }

    fn measure(&self, level: Detail, paths: Vec<Path>, field: &[Complex64]) -> LevelWithError {
        let missed = power(&difference(field, &self.chirps.field(&paths)));
        LevelWithError { level, paths, measured: MissedPower { missed, power: power(field) } }
    }

    /// First of several tables within the allowed error, each made with a finer setting than the last.
    fn first_within(
        &self,
        first: f64,
        attempts: usize,
        make: &dyn Fn(f64) -> Option<LevelWithError>,
    ) -> Option<LevelWithError> {
        let mut setting = first;
        for _ in 0..attempts {
            let found = make(setting)?;
            let error = found.measured.error();
            if error <= self.allowed {
                return Some(found);
            }
            setting *= (AIM * self.allowed / error).clamp(0.4, 0.8);
        }
        None
    }

    /// Merged paths; `None` if no merging to few enough paths is within the allowed error.
    fn merged(&self, field: &[Complex64]) -> Option<LevelWithError> {
        const ATTEMPTS: usize = 6;
        // Phases in a cell are uniformly distributed and cancel: their mean is off by less than a quarter of
        // the spread.
        self.first_within((4.0 * self.allowed).min(1.0), ATTEMPTS, &|spread_rad| {
            let paths = merged(self.radar, &self.paths, spread_rad);
            (paths.len() < self.paths.len()).then(|| self.measure(Detail::Merged, paths, field))
        })
    }

    /// Scattering centres; `None` if no small number of them is within the allowed error.
    fn centres(&self, field: &[Complex64]) -> Option<LevelWithError> {
        const ATTEMPTS: usize = 4;
        let finest_rad = CANDIDATES_RAD * (self.allowed / 0.1).powf(0.25).min(1.0);
        let first = AIM * self.allowed / MARGIN;
        self.first_within(first, ATTEMPTS, &|left| {
            let spread_rad = (left / first).sqrt() * finest_rad;
            let paths = centres(self.radar, &self.paths, spread_rad, left * left);
            (paths.len() < self.paths.len()).then(|| self.measure(Detail::Centres, paths, field))
        })
    }

    fn statistical(&self, field: &[Complex64], seed: u64, target: u32) -> Option<LevelWithError> {
        let points = PointModel::of(self.radar, &self.paths, &self.chirps)?.draw(
            self.radar,
            &self.chirps,
            seed,
            target,
        );
        Some(self.measure(Detail::Statistical, points, field))
    }
}

/// Number of centres of a car at −20 dB; merging keeps half of the paths where it succeeds
/// (docs/validation/levels-of-detail.md).
const FEW_CENTRES: usize = 15;

/// Phase spread of the paths merged into one candidate, at −20 dB: about two candidates per cell resolved by
/// samples. Values between candidates are interpolated from them, the better the denser they are.
const CANDIDATES_RAD: f64 = 0.6;

#[cfg(test)]
mod tests {
    use super::*;
    use artifact::radar::Pattern;
    use radar::aperture::Preset;
    use std::f64::consts::TAU;

    /// A radar of 3 × 4 elements, 128 chirps of 256 samples over 0.6 GHz.
    fn radar() -> Radar {
        let mut radar = radar::paper::radar(
            [0.0, 0.0, 6.0],
            radar::paper::waveform(256, 128),
            Preset::ThreeByFour.elements(),
        );
        radar.array.pattern = Pattern::Cosine { exponent: 2.0 };
        radar
    }

    /// Paths throughout a car 40 m ahead that approaches at 10 m/s, stronger at the nearer end; every third
    /// with two bounces.
    fn body(count: u32) -> Vec<Path> {
        let path = |i: u32| {
            let at = |step: f64| (f64::from(i) * step).fract();
            let (order, beside_m) = if i.is_multiple_of(3) { (2, 0.1) } else { (1, 0.0) };
            let place_m = [4.8 + 1.9 * at(0.618_034), 38.0 + 5.0 * at(0.414_214), 1.8 * at(0.732_051)];
            let value = Complex64::from_polar((-3.0 * at(0.414_214)).exp(), TAU * at(0.236_068));
            Path {
                order,
                apparent_tx_m: place_m,
                apparent_tx_mps: [0.0, -10.0, 0.0],
                apparent_rx_m: place_m.map(|x| x + beside_m),
                apparent_rx_mps: [0.0, -10.0, 0.0],
                amplitude_m: [[value; 2]; 2],
                slope_m_per_hz: [[value * 1e-10; 2]; 2],
                ..Path::default()
            }
        };
        (0..count).map(path).collect()
    }

    /// Relative error at chirps not used for making or measuring any level.
    fn error_elsewhere(radar: &Radar, paths: &[Path], all: &[Path]) -> f64 {
        let chirps = SampledChirps::new(radar, 40, 29, 0.271_828);
        let field = chirps.field(all);
        (power(&difference(&field, &chirps.field(paths))) / power(&field)).sqrt()
    }

    type MakeLevel = fn(&LevelChoice<'_>, &[Complex64]) -> Option<LevelWithError>;

    #[test]
    fn merged_paths_and_centres_err_by_no_more_than_is_told_and_allowed() {
        let (radar, all) = (radar(), body(2000));
        let levels: [(&str, MakeLevel); 2] =
            [("merged", |of, field| of.merged(field)), ("centres", |of, field| of.centres(field))];
        for (name, level) in levels {
            let mut last = 0;
            for allowed_db in [-10.0, -20.0, -30.0] {
                let choice =
                    LevelChoice::new(&radar, all.clone(), artifact::units::amplitude_from_db(allowed_db));
                let found = level(&choice, &choice.field()).unwrap();
                let (told, error) = (found.measured.error(), error_elsewhere(&radar, &found.paths, &all));
                let [told_db, error_db] = [told, error].map(artifact::units::db_from_amplitude);
                let count = found.paths.len();
                println!(
                    "{name}: asked {allowed_db} dB, told {told_db:.1}, got {error_db:.1}, {count} paths"
                );
                assert!(
                    told <= choice.allowed && error <= told,
                    "{name} at {allowed_db} dB: {told} told, {error}"
                );
                assert!(count >= last && count < all.len(), "{name}: looser must not take more");
                last = count;
            }
        }
    }

    #[test]
    fn centres_are_five_times_fewer_than_merged_paths() {
        let (radar, all) = (radar(), body(2000));
        let choice = LevelChoice::new(&radar, all, 0.1);
        let field = choice.field();
        let [merged, centres] =
            [choice.merged(&field), choice.centres(&field)].map(|found| found.unwrap().paths.len());
        assert!(5 * centres <= merged, "{centres} centres, {merged} merged paths");
    }

    #[test]
    fn merging_keeps_every_polarization_and_what_one_cell_holds() {
        let (radar, all) = (radar(), body(40));
        let near: Vec<Path> = all
            .iter()
            .filter(|path| path.order == 1)
            .map(|path| Path {
                apparent_tx_m: all[1].apparent_tx_m,
                apparent_rx_m: all[1].apparent_rx_m,
                ..*path
            })
            .collect();
        let one = merged(&radar, &near, 0.1);
        let sum: Complex64 = near.iter().map(|path| path.amplitude_m[1][0]).sum();
        assert_eq!(one.len(), 1);
        // The line over the band is fitted to three points: rounding of 27 amplitudes of about 1, and of
        // phases of 0.
        assert!(
            (one[0].amplitude_m[1][0] - sum).norm() < 1e-12
                && one[0].amplitude_m[0][0] == one[0].amplitude_m[1][1]
        );
    }

    #[test]
    fn points_have_the_body_s_mean_power_and_follow_the_seed() {
        let (radar, all) = (radar(), body(1000));
        let choice = LevelChoice::new(&radar, all.clone(), 1.0);
        let field = choice.field();
        let chirps = SampledChirps::new(&radar, 40, 29, 0.271_828);
        let exact = power(&chirps.field(&all));
        let draw = |seed: u64| choice.statistical(&field, seed, 0).unwrap().paths;
        assert_eq!(draw(1), draw(1));
        assert_ne!(draw(1), draw(2));
        // Over 100 draws; each field's power over the sampled chirps has at most its own mean as spread,
        // their mean a tenth of it: three times that.
        let mean = (0..100).map(|seed| power(&chirps.field(&draw(seed)))).sum::<f64>() / 100.0;
        assert!((mean / exact - 1.0).abs() < 0.3, "{}", mean / exact);
        let error =
            (0..100).map(|seed| error_elsewhere(&radar, &draw(seed), &all).powi(2)).sum::<f64>() / 100.0;
        // Two independent fields of equal power: 2, as above.
        assert!((error - 2.0).abs() < 0.6, "{error}");
    }

    #[test]
    fn nothing_is_reduced_that_few_paths_or_no_room_make_not_worth_it() {
        let radar = radar();
        assert!(LevelChoice::new(&radar, body(3), 0.1).cheapest().is_none());
        assert!(LevelChoice::new(&radar, body(4000), 0.0).cheapest().is_none());
        let found = LevelChoice::new(&radar, body(800), 0.1).cheapest().unwrap();
        assert!(echo_s(&radar, found.paths.len()) < echo_s(&radar, 800));
        // Fitting 20,000 paths takes longer than their echo on twelve channels.
        assert!(LevelChoice::new(&radar, body(20_000), 0.1).cheapest().is_none());
    }
}
