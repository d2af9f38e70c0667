//! What scatters, at many frequencies from few: a share of S turns with frequency as its length does, and what is left of the
//! turning is smooth.
//!
//! Shares are gathered by their length L₁ + L₂. Less its common phase e^{−jkL}, the sum of a group turns over the band by
//! θ = Δk·(how far the lengths spread) at most, Δk half the band, and few points of Chebyshev meet that
//! ([`crate::integral::chebyshev`]). 256 frequencies of a chirp so cost five for a small facet at −60 dB of the accuracy.

use crate::integral::chebyshev::{Chebyshev, middle_and_half, points};
use crate::joins::scatterer::{Way, sum};
use artifact::paths::Amplitude;
use num_complex::Complex64;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// Where S is asked for, and the few frequencies that it is taken at instead.
pub(crate) struct Band<'a> {
    wavenumbers_per_m: &'a [f64],
    classes: Vec<Class>,
    kind: Kind,
}

/// What a share of S is beside its turning.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// k times an entire function: integrals over facets.
    Facets,
    /// Analytic and bounded where Re k > 0, for its edge waves know √k: W(√(kc)) = e^{jkc}erfc(√(jkc)) is below 1 there, and so are
    /// the edge currents made of it, relative to the whole current of the edge (their integrands are Laplace transforms of one sign).
    Edges,
}

/// Sums by group, in the order of the groups.
pub(crate) type Groups = BTreeMap<Place, Vec<Amplitude>>;

/// Turns over the band that a group may take, rad. At finite range tiles are a few centimetres long and belong to the first;
/// a plane wave takes the side of a lorry as one. What turns farther is integrated at every frequency.
const TURNS_RAD: [f64; 4] = [0.25, 1.0, 4.0, 16.0];
/// Of a group's largest amplitude, as a part of the accuracy that its integrals are asked for.
pub(crate) const INTERPOLATION_ERROR: f64 = 0.01;

/// Groups that turn alike.
struct Class {
    /// Farthest that the length of a member or of a point on it may be from the group's, m.
    reach_m: f64,
    /// Over the band, its ends among them: shares are cut for the highest frequency.
    points: Chebyshev,
}

/// The group of a share.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Place {
    class: usize,
    /// Of its length, in units of the class's reach.
    bin: i64,
}

impl Place {
    fn length_m(&self, class: &Class) -> f64 {
        self.bin as f64 * class.reach_m
    }
}

impl<'a> Band<'a> {
    /// `None` where there are too few frequencies to save any; `error` is that of the interpolation, relative.
    pub(crate) fn new(wavenumbers_per_m: &'a [f64], error: f64, kind: Kind) -> Option<Self> {
        let classes = classes(wavenumbers_per_m, error.max(f64::EPSILON), kind);
        (!classes.is_empty()).then_some(Self { wavenumbers_per_m, classes, kind })
    }

    /// For shares to be cut for.
    pub(crate) fn highest_per_m(&self) -> f64 {
        self.wavenumbers_per_m.iter().copied().fold(0.0, f64::max)
    }

    /// The sums that a share belongs to and their wavenumbers; what belongs to no class is of the group behind all classes, at every
    /// frequency.
    pub(crate) fn group<'g>(&'g self, way: Way, groups: &'g mut Groups) -> (&'g mut [Amplitude], &'g [f64]) {
        // Half a reach for the way from the group's length to the share's, half for the share itself.
        let class = self.classes.iter().position(|class| way.extent_m <= 0.5 * class.reach_m);
        let bin = |class: &Class| (way.length_m / class.reach_m).round() as i64;
        let behind = Place { class: self.classes.len(), bin: 0 };
        let place = class.map_or(behind, |i| Place { class: i, bin: bin(&self.classes[i]) });
        let wavenumbers_per_m = class.map_or(self.wavenumbers_per_m, |i| &self.classes[i].points.nodes_per_m);
        let sums = groups.entry(place).or_insert_with(|| vec![Amplitude::default(); wavenumbers_per_m.len()]);
        (sums, wavenumbers_per_m)
    }

    /// S at every frequency; runs are added in their order.
    pub(crate) fn sum(&self, runs: Vec<Groups>) -> Vec<Amplitude> {
        let mut groups = Groups::new();
        for (place, share) in runs.into_iter().flatten() {
            match groups.entry(place) {
                Entry::Vacant(empty) => _ = empty.insert(share),
                Entry::Occupied(mut sum) => add(sum.get_mut(), &share),
            }
        }
        let groups: Vec<(Place, Vec<Amplitude>)> = groups.into_iter().collect();
        let interpolated = |(place, samples): &(Place, Vec<Amplitude>)| match self.classes.get(place.class) {
            Some(class) => self.interpolated(class, samples, place.length_m(class)),
            None => samples.clone(),
        };
        let parts: Vec<Vec<Amplitude>> = groups.par_iter().map(interpolated).collect();
        let mut sum = vec![Amplitude::default(); self.wavenumbers_per_m.len()];
        parts.iter().for_each(|part| add(&mut sum, part));
        sum
    }

    /// Samples at the points, of ways about `length_m`, at every wavenumber asked for.
    fn interpolated(&self, class: &Class, samples: &[Amplitude], length_m: f64) -> Vec<Amplitude> {
        let factor = |k: f64| if self.kind == Kind::Facets { k } else { 1.0 };
        let still = |(a, k): (&Amplitude, &f64)| turned(a, 1.0 / factor(*k), k * length_m);
        let still: Vec<Amplitude> = samples.iter().zip(&class.points.nodes_per_m).map(still).collect();
        let at = |k: &f64| turned(&class.at(*k, &still), factor(*k), -k * length_m);
        self.wavenumbers_per_m.iter().map(at).collect()
    }
}

/// Those with fewer points than there are frequencies, from the one with fewest points on.
fn classes(wavenumbers_per_m: &[f64], error: f64, kind: Kind) -> Vec<Class> {
    let Some((middle, half)) = middle_and_half(wavenumbers_per_m) else { return Vec::new() };
    let most = match kind {
        Kind::Facets => f64::INFINITY,
        // The ellipse that touches k = 0.
        Kind::Edges => middle / half + (middle * middle / (half * half) - 1.0).sqrt(),
    };
    let of = |turn_rad: &f64| {
        let count = points(*turn_rad, most, error);
        (count < wavenumbers_per_m.len())
            .then(|| Class { reach_m: turn_rad / half, points: Chebyshev::over(middle, half, count) })
    };
    TURNS_RAD.iter().filter_map(of).collect()
}

impl Class {
    /// The polynomial through the samples.
    fn at(&self, wavenumber_per_m: f64, samples: &[Amplitude]) -> Amplitude {
        let mut total = Amplitude::default();
        self.points.shares(wavenumber_per_m, |i, share| {
            total = sum(&total, &samples[i].map(|row| row.map(|a| share * a)));
        });
        total
    }
}

/// Less its factor, or with it again, and turned.
fn turned(a: &Amplitude, size: f64, phase_rad: f64) -> Amplitude {
    let factor = Complex64::from_polar(size, phase_rad);
    a.map(|row| row.map(|x| x * factor))
}

/// Shares at every frequency for themselves, without groups: what the interpolation is compared with. Runs of `run` shares are
/// added in their order: the same bits on any number of threads.
pub(crate) fn sum_at_each<T: Sync>(
    shares: &[T],
    run: usize,
    frequencies: usize,
    of: impl Fn(&T) -> Vec<Amplitude> + Sync,
) -> Vec<Amplitude> {
    let zero = || vec![Amplitude::default(); frequencies];
    let plus = |mut total: Vec<Amplitude>, share: &[Amplitude]| {
        add(&mut total, share);
        total
    };
    let of_run = |some: &[T]| some.iter().fold(zero(), |total, share| plus(total, &of(share)));
    let runs: Vec<Vec<Amplitude>> = shares.par_chunks(run).map(of_run).collect();
    runs.iter().fold(zero(), |total, run| plus(total, run))
}

/// Adds amplitude by amplitude.
pub(crate) fn add(total: &mut [Amplitude], share: &[Amplitude]) {
    for (sum, s) in total.iter_mut().flatten().flatten().zip(share.iter().flatten().flatten()) {
        *sum += s;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_frequencies_or_one_are_taken_one_by_one() {
        for kind in [Kind::Facets, Kind::Edges] {
            let classes = |wavenumbers_per_m: &[f64]| classes(wavenumbers_per_m, 1e-6, kind);
            assert!(classes(&[]).is_empty() && classes(&[1613.0]).is_empty() && classes(&[1613.0; 300]).is_empty());
            assert!(classes(&[1600.0, 1605.0, 1610.0]).is_empty());
            let many: Vec<f64> = (1..=256).map(|i| 1600.0 + f64::from(i)).collect();
            let counts: Vec<usize> = classes(&many).iter().map(|class| class.points.nodes_per_m.len()).collect();
            println!("{kind:?}: points for a turn of {TURNS_RAD:?} rad: {counts:?}");
            assert_eq!(counts.len(), TURNS_RAD.len());
        }
    }
}
