//! Scattering at many frequencies from few: a contribution to S rotates in phase with frequency as its length
//! does, and without this rotation it is smooth.
//!
//! Contributions are grouped by their length L₁ + L₂. Without its common phase e^{−jkL}, the sum of a group
//! rotates over the band by at most θ = Δk·(spread of the lengths), Δk half the band, and few Chebyshev
//! points match that ([`crate::integral::chebyshev`]). Groups form classes, each as wide as its number of
//! points can match: a contribution takes the class with fewest points, and groups are merged into those of a
//! wider class until few are left.

use crate::integral::chebyshev::{Chebyshev, middle_and_half, turn_in_ellipse_rad, turn_of_exponentials_rad};
use crate::joins::group::Group;
use crate::joins::scatterer::{PathLengthRange, sum};
use artifact::paths::Amplitude;
use num_complex::Complex64;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// Frequencies at which S is requested, and the few at which it is evaluated instead.
pub(crate) struct Band<'a> {
    wavenumbers_per_m: &'a [f64],
    classes: Vec<InterpolationClass>,
}

/// Kind of a contribution to S, by its behaviour without the phase rotation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ContributionKind {
    /// Integrals over facets: k times a sum of exponentials whose magnitudes add up to the maximum
    /// contribution.
    Facets,
    /// Integrals along edges, analytic and bounded where Re k > 0, since their edge waves depend on √k:
    /// W(√(kc)) = e^{jkc}erfc(√(jkc)) is below 1 there, and so are the edge currents made of it, relative to
    /// the whole current of the edge (their integrands are Laplace transforms of one sign).
    Edges,
}

/// Sums by group, in the order of the groups.
pub(crate) type Groups = BTreeMap<GroupKey, Vec<Amplitude>>;

/// Numbers of points of the classes. At finite range tiles are a few centimetres long and need less than ten;
/// for a plane wave the side of a lorry is one tile. Contributions beyond the last class are integrated at
/// every frequency.
const POINTS: [usize; 15] = [2, 3, 4, 5, 6, 7, 8, 10, 12, 16, 20, 24, 32, 48, 64];
/// Interpolation error relative to a group's largest amplitude, as a share of the accuracy requested of its
/// integrals; the same again each time it is merged into a wider one, five times at most.
pub(crate) const INTERPOLATION_ERROR: f64 = 0.003;

/// Groups with the same limit on phase rotation.
struct InterpolationClass {
    /// Maximum difference between the length of a member, or of a point on it, and the group's, m.
    reach_m: f64,
    /// Wavenumbers of the nodes over the band.
    nodes_per_m: Vec<f64>,
    /// Class into which its groups are merged, wide enough for a whole group.
    wider: Option<usize>,
    /// Weights of the nodes (inner) for the values at the nodes of the wider class, or at every requested
    /// wavenumber.
    shares: Vec<Vec<f64>>,
}

/// Group of a contribution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct GroupKey {
    class: usize,
    /// Bin of its length, in units of the class's reach.
    bin: i64,
}

impl<'a> Band<'a> {
    /// Band of these wavenumbers; `None` if there are too few frequencies to save any; `error` is the
    /// relative interpolation error.
    pub(crate) fn new(wavenumbers_per_m: &'a [f64], error: f64, kind: ContributionKind) -> Option<Self> {
        let classes = classes(wavenumbers_per_m, error.max(f64::EPSILON), kind);
        (!classes.is_empty()).then_some(Self { wavenumbers_per_m, classes })
    }

    /// Highest wavenumber, for which contributions are to be subdivided.
    pub(crate) fn highest_per_m(&self) -> f64 {
        self.wavenumbers_per_m.iter().copied().fold(0.0, f64::max)
    }

    /// Group to which a contribution belongs; one that fits no class goes to the group after all classes, at
    /// every frequency.
    pub(crate) fn group<'g>(&'g self, way: PathLengthRange, groups: &'g mut Groups) -> Group<'g> {
        // Half a reach for the distance from the group's length to that of the contribution, half for its own
        // extent.
        let class = self.classes.iter().position(|class| way.extent_m <= 0.5 * class.reach_m);
        let place = class.map_or(self.behind(), |class| self.place(class, way.length_m));
        let wavenumbers_per_m = class.map_or(self.wavenumbers_per_m, |i| &self.classes[i].nodes_per_m);
        let length_m = self.length_m(place);
        let sums = groups.entry(place).or_insert_with(|| vec![Amplitude::default(); wavenumbers_per_m.len()]);
        Group { sums, wavenumbers_per_m, length_m }
    }

    /// S at every frequency; runs are summed in order.
    pub(crate) fn sum(&self, runs: Vec<Groups>) -> Vec<Amplitude> {
        let mut groups = Groups::new();
        runs.into_iter().flatten().for_each(|(place, share)| add_to_group(&mut groups, place, share));
        let mut total = vec![Amplitude::default(); self.wavenumbers_per_m.len()];
        // Wider classes come later.
        while let Some((place, samples)) = groups.pop_first() {
            match self.classes.get(place.class) {
                None => add(&mut total, &samples),
                Some(class) => match class.wider {
                    None => add(&mut total, &self.at_all(class, place, &samples)),
                    Some(wider) => self.gather(class, place, wider, &samples, &mut groups),
                },
            }
        }
        total
    }

    /// Merges a group into one of a wider class.
    fn gather(
        &self,
        class: &InterpolationClass,
        place: GroupKey,
        wider: usize,
        samples: &[Amplitude],
        groups: &mut Groups,
    ) {
        let length_m = self.length_m(place);
        let into = self.place(wider, length_m);
        let turned_m = length_m - self.length_m(into);
        let at = class.shares.iter().zip(&self.classes[wider].nodes_per_m);
        let share = at.map(|(shares, k)| turned(&interpolated(shares, samples), -k * turned_m)).collect();
        add_to_group(groups, into, share);
    }

    fn at_all(&self, class: &InterpolationClass, place: GroupKey, samples: &[Amplitude]) -> Vec<Amplitude> {
        let length_m = self.length_m(place);
        let at = class.shares.iter().zip(self.wavenumbers_per_m);
        at.map(|(shares, k)| turned(&interpolated(shares, samples), -k * length_m)).collect()
    }

    fn place(&self, class: usize, length_m: f64) -> GroupKey {
        GroupKey { class, bin: (length_m / self.classes[class].reach_m).round() as i64 }
    }

    fn behind(&self) -> GroupKey {
        GroupKey { class: self.classes.len(), bin: 0 }
    }

    fn length_m(&self, place: GroupKey) -> f64 {
        self.classes.get(place.class).map_or(0.0, |class| place.bin as f64 * class.reach_m)
    }
}

/// Classes with at most half as many points as there are frequencies, the one with fewest points first.
fn classes(wavenumbers_per_m: &[f64], error: f64, kind: ContributionKind) -> Vec<InterpolationClass> {
    let Some((middle, half)) = middle_and_half(wavenumbers_per_m) else { return Vec::new() };
    let counts = POINTS.into_iter().filter(|count| 2 * *count <= wavenumbers_per_m.len());
    let all: Vec<(f64, Chebyshev)> = counts
        .map(|count| match kind {
            ContributionKind::Facets => {
                (turn_of_exponentials_rad(count, error) / half, Chebyshev::of_first_kind(middle, half, count))
            }
            ContributionKind::Edges => {
                // Ellipse that touches k = 0.
                let most = middle / half + (middle * middle / (half * half) - 1.0).sqrt();
                (turn_in_ellipse_rad(count, most, error) / half, Chebyshev::over(middle, half, count))
            }
        })
        .filter(|(reach_m, _)| *reach_m > 0.0)
        .collect();
    let class = |(i, (reach_m, points)): (usize, &(f64, Chebyshev))| {
        // Room for a group's members and half of the wider one's reach.
        let wider = (i + 1..all.len()).find(|&j| all[j].0 >= 2.0 * reach_m);
        let at = wider.map_or(wavenumbers_per_m, |j| &all[j].1.nodes_per_m);
        let shares = at.iter().map(|k| shares(points, *k, kind)).collect();
        InterpolationClass { reach_m: *reach_m, nodes_per_m: points.nodes_per_m.clone(), wider, shares }
    };
    all.iter().enumerate().map(class).collect()
}

/// Weight of every node for the value at a wavenumber; for facets, k times the polynomial through their
/// values over k.
fn shares(points: &Chebyshev, wavenumber_per_m: f64, kind: ContributionKind) -> Vec<f64> {
    let mut shares = vec![0.0; points.nodes_per_m.len()];
    points.shares(wavenumber_per_m, |i, share| {
        shares[i] = if kind == ContributionKind::Facets {
            share * wavenumber_per_m / points.nodes_per_m[i]
        } else {
            share
        };
    });
    shares
}

fn interpolated(shares: &[f64], samples: &[Amplitude]) -> Amplitude {
    let share = |(share, sample): (&f64, &Amplitude)| sample.map(|row| row.map(|a| share * a));
    shares.iter().zip(samples).map(share).fold(Amplitude::default(), |total, a| sum(&total, &a))
}

fn turned(a: &Amplitude, phase_rad: f64) -> Amplitude {
    let factor = Complex64::cis(phase_rad);
    a.map(|row| row.map(|x| x * factor))
}

fn add_to_group(groups: &mut Groups, place: GroupKey, share: Vec<Amplitude>) {
    match groups.entry(place) {
        Entry::Vacant(empty) => _ = empty.insert(share),
        Entry::Occupied(mut sum) => add(sum.get_mut(), &share),
    }
}

/// Contributions at every frequency separately, without groups: the reference of the interpolation. Runs of
/// `run` contributions are summed in order, so the result is bit-identical for any number of threads.
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

/// Adds two lists amplitude by amplitude.
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
        for kind in [ContributionKind::Facets, ContributionKind::Edges] {
            let classes = |wavenumbers_per_m: &[f64]| classes(wavenumbers_per_m, 1e-6, kind);
            assert!(
                classes(&[]).is_empty()
                    && classes(&[1613.0]).is_empty()
                    && classes(&[1613.0; 300]).is_empty()
            );
            assert!(classes(&[1600.0, 1605.0, 1610.0]).is_empty());
            let many: Vec<f64> = (1..=256).map(|i| 1600.0 + f64::from(i)).collect();
            let reaches_m: Vec<f64> = classes(&many).iter().map(|class| class.reach_m).collect();
            println!("{kind:?}: reaches of {POINTS:?} points: {reaches_m:?}");
            assert!(reaches_m.is_sorted() && reaches_m.len() > 10);
        }
    }
}
