//! A body as random points with its own statistics: their number, level distribution and positions come from
//! its paths, the rest from the seed.
//!
//! The mean level and the body's extent in range, angle and velocity are preserved; the field is another
//! realisation, so that its complex error is that of two independent fields of equal power, +3 dB.

use crate::detail::merged_paths::merged;
use crate::detail::sampled_chirps::{SampledChirps, power};
use artifact::Radar;
use artifact::paths::{Amplitude, Path};
use artifact::seed;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Phase difference within which paths stay in one cell of range, Doppler and angle, and count as one centre
/// with one level.
const CENTRE_RAD: f64 = 0.5 * PI;
/// Share of the power carried by the centres that determine number and levels.
const TOLD: f64 = 0.99;

/// Statistics of a body, from its centres that carry 99 % of the power.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PointModel {
    pub(crate) points: usize,
    /// Mean and standard deviation of ln σ: levels of a vehicle's centres spread over tens of decibels,
    /// log-normally.
    pub(crate) log_level: [f64; 2],
    /// Possible positions of points, with their probabilities.
    places: Vec<Path>,
    /// Mean power of the whole body at the sampled chirps.
    power: f64,
}

impl PointModel {
    /// Model of the paths of one target; `None` if they scatter nothing.
    pub(crate) fn of(radar: &Radar, paths: &[Path], chirps: &SampledChirps<'_>) -> Option<Self> {
        let mut places = merged(radar, paths, CENTRE_RAD);
        places.sort_by(|a, b| level(radar, b).total_cmp(&level(radar, a)));
        let total: f64 = places.iter().map(|path| level(radar, path)).sum();
        let mut sum = 0.0;
        let points = places.iter().take_while(|path| {
            let is_told = sum < TOLD * total;
            sum += level(radar, path);
            is_told
        });
        let points = points.count();
        places.truncate(points);
        let logarithms: Vec<f64> = places.iter().map(|path| level(radar, path).ln()).collect();
        let mean = logarithms.iter().sum::<f64>() / points.max(1) as f64;
        let variance = logarithms.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / points.max(1) as f64;
        let power = power(&chirps.field(paths));
        (points > 0 && power > 0.0).then(|| Self {
            points,
            log_level: [mean, variance.sqrt()],
            places,
            power,
        })
    }

    /// Draws points from `seed` and `target`, each with the bounce order of its position; their mean power is
    /// the body's.
    ///
    /// Levels are log-normal, phases uniform, positions drawn uniformly from the body's own.
    pub(crate) fn draw(
        &self,
        radar: &Radar,
        chirps: &SampledChirps<'_>,
        seed: u64,
        target: u32,
    ) -> Vec<Path> {
        let mut points: Vec<Path> =
            (0..self.points as u64).map(|i| self.point(radar, seed, target, i)).collect();
        // Powers of independent phases add up: the deviation of the drawn levels is corrected for all alike.
        let drawn: f64 = points.iter().map(|point| power(&chirps.field(std::slice::from_ref(point)))).sum();
        let factor = if drawn > 0.0 { (self.power / drawn).sqrt() } else { 0.0 };
        points.iter_mut().flat_map(|point| point.amplitude_m.as_flattened_mut()).for_each(|a| *a *= factor);
        points
    }

    fn point(&self, radar: &Radar, seed: u64, target: u32, index: u64) -> Path {
        let [place, phase, radius, angle] =
            seed::shares(seed, "bart-rcs/statistical points", &[target.into(), index]);
        // Box–Muller (1958); 1 − radius is never 0.
        let normal = (-2.0 * (1.0 - radius).ln()).sqrt() * (TAU * angle).cos();
        let [mean, deviation] = self.log_level;
        let root = (0.5 * (mean + deviation * normal)).exp();
        let place = &self.places[((place * self.places.len() as f64) as usize).min(self.places.len() - 1)];
        let (p, q) = radar.array.polarization.indices();
        let mut amplitude_m = Amplitude::default();
        amplitude_m[p][q] = Complex64::from_polar(root, TAU * phase);
        Path { amplitude_m, slope_m_per_hz: Amplitude::default(), ..*place }
    }
}

/// Cross section σ of a path in the radar's polarization.
fn level(radar: &Radar, path: &Path) -> f64 {
    let (p, q) = radar.array.polarization.indices();
    path.amplitude_m[p][q].norm_sqr()
}
