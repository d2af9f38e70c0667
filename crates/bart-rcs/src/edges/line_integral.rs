//! Integrals of a slowly varying weight with a fast phase along a straight line (Filon 1928), divided where
//! the weight or the phase's curvature requires it.

use crate::edges::wave_exit::WaveExit;
use num_complex::Complex64;

/// Weight and length along a line.
pub(crate) trait Integrand {
    /// Values at a point that are computed once for all wavenumbers.
    type Sample: Clone;
    /// Sample at a coordinate along the line, m.
    fn sample(&self, at_m: f64) -> Self::Sample;
    /// Length L of the phase −kL, m.
    fn length_m(sample: &Self::Sample) -> f64;
    /// Weights [vv, vh, hv, hh] without that phase.
    fn weights(&self, sample: &Self::Sample, wavenumber_per_m: f64) -> [Complex64; 4];
    /// Length by which the weights turn with the wavenumber, m.
    fn turning_m(&self) -> f64 {
        0.0
    }
    /// Point at which the wave of a sample leaves; `None` if it leaves from the line.
    fn exit(&self, _sample: &Self::Sample) -> Option<WaveExit> {
        None
    }
}

/// Maximum number of halvings: at 2⁻²⁴ of a line, where a weight jumps, the remainder is below any requested
/// accuracy.
const HALVINGS_MAX: u32 = 24;

/// Minimum share of the error allotted to a piece, however small: a root at an end would otherwise be halved
/// without end.
const SMALLEST_SHARE: f64 = 1.0 / 64.0;

/// Adds ∫ weight·e^{−jkL} over `span_m` for every wavenumber to `sums`; returns an error bound for every
/// element, m.
#[cfg(test)]
pub(crate) fn add_line_integral<I: Integrand>(
    integrand: &I,
    span_m: [f64; 2],
    wavenumbers_per_m: &[f64],
    accuracy: f64,
    sums: &mut [[Complex64; 4]],
) -> f64 {
    let highest = wavenumbers_per_m.iter().copied().fold(0.0, f64::max);
    let mut error_m = 0.0;
    for_each_piece(integrand, span_m, highest, accuracy, &mut |piece, error| {
        error_m += error;
        piece.add_to(wavenumbers_per_m, sums);
    });
    error_m
}

/// Divides a line into pieces suitable for wavenumbers up to `highest_per_m`; `give` receives each with its
/// error bound, m.
///
/// A piece approximates the weight times the residual phase by the quadratic through its ends and centre,
/// integrated exactly with the linear phase; it is halved until the values at its quarters, at the highest
/// wavenumber, are matched to `accuracy`. A cubic error has 97 % of its maximum there: h³/16 of h³/9√3 times
/// a sixth of its third derivative.
pub(crate) fn for_each_piece<I: Integrand>(
    integrand: &I,
    span_m: [f64; 2],
    highest_per_m: f64,
    accuracy: f64,
    give: &mut dyn FnMut(&LinePiece<'_, I>, f64),
) {
    let [from, to] = span_m;
    let ends = [from, 0.5 * (from + to), to].map(|at| integrand.sample(at));
    let mut left = vec![(span_m, ends, 0)];
    while let Some(([from, to], samples, halvings)) = left.pop() {
        // A weight that jumps at an end leaves a piece between adjacent numbers.
        if to - from <= 1e-12 * (span_m[1] - span_m[0]).max(to.abs()) {
            continue;
        }
        let half_m = 0.5 * (to - from);
        let centre = from + half_m;
        let quarters = [from + 0.5 * half_m, centre + 0.5 * half_m].map(|at| integrand.sample(at));
        let piece = LinePiece::new(integrand, &samples, half_m);
        let missed = piece.missed_by(&quarters, highest_per_m);
        let share = (2.0 * half_m / (span_m[1] - span_m[0])).max(SMALLEST_SHARE);
        if missed * 2.0 * half_m <= accuracy * share * (span_m[1] - span_m[0]) || halvings == HALVINGS_MAX {
            give(&piece, missed * 2.0 * half_m);
        } else {
            let ([start, middle, end], [first, second]) = (samples, quarters);
            left.push(([centre, to], [middle.clone(), second, end], halvings + 1));
            left.push(([from, centre], [start, first, middle], halvings + 1));
        }
    }
}

/// A part of a line given by its start, middle and end, with the linear phase between the ends removed.
pub(crate) struct LinePiece<'a, I: Integrand> {
    integrand: &'a I,
    samples: &'a [I::Sample; 3],
    half_m: f64,
    middle_length_m: f64,
    /// Slope dL/ds of the straight line between the ends.
    slope: f64,
    /// Excess of L at both ends over the line of this slope through the middle.
    bend_m: f64,
}

/// Weights of the quadratic through three values, evaluated at the quarters.
const AT_QUARTERS: [[f64; 3]; 2] = [[0.375, 0.75, -0.125], [-0.125, 0.75, 0.375]];

impl<'a, I: Integrand> LinePiece<'a, I> {
    fn new(integrand: &'a I, samples: &'a [I::Sample; 3], half_m: f64) -> Self {
        let [start_m, middle_length_m, end_m] = [0, 1, 2].map(|i| I::length_m(&samples[i]));
        let slope = (end_m - start_m) / (2.0 * half_m);
        let bend_m = 0.5 * (start_m + end_m) - middle_length_m;
        Self { integrand, samples, half_m, middle_length_m, slope, bend_m }
    }

    /// Length L at the middle.
    pub(crate) fn length_m(&self) -> f64 {
        self.middle_length_m
    }

    /// Samples at its start, middle and end.
    pub(crate) fn samples(&self) -> &'a [I::Sample; 3] {
        self.samples
    }

    /// Maximum difference of L on the piece from that at the middle.
    pub(crate) fn extent_m(&self) -> f64 {
        self.slope.abs() * self.half_m + self.bend_m.abs()
    }

    /// Length by which its weights turn with the wavenumber, m.
    pub(crate) fn turning_m(&self) -> f64 {
        self.integrand.turning_m()
    }

    /// Point at which the wave of its middle leaves; `None` if it leaves from the line.
    pub(crate) fn exit(&self) -> Option<WaveExit> {
        self.integrand.exit(&self.samples[1])
    }

    /// Values weight·e^{−jk(L − linear part)} at the ends and at the middle.
    fn values(&self, wavenumber_per_m: f64) -> [[Complex64; 4]; 3] {
        let turned = Complex64::cis(-wavenumber_per_m * self.bend_m);
        let at = |i: usize| self.integrand.weights(&self.samples[i], wavenumber_per_m);
        [at(0).map(|weight| weight * turned), at(1), at(2).map(|weight| weight * turned)]
    }

    /// Maximum difference between a quarter's value and the quadratic.
    fn missed_by(&self, quarters: &[I::Sample; 2], wavenumber_per_m: f64) -> f64 {
        let values = self.values(wavenumber_per_m);
        let missed = |(i, quarter): (usize, &I::Sample)| {
            let linear_m = self.middle_length_m + self.slope * (i as f64 - 0.5) * self.half_m;
            let turned = Complex64::cis(-wavenumber_per_m * (I::length_m(quarter) - linear_m));
            let value = self.integrand.weights(quarter, wavenumber_per_m).map(|weight| weight * turned);
            let quadratic = |e: usize| (0..3).map(|n| AT_QUARTERS[i][n] * values[n][e]).sum::<Complex64>();
            (0..4).map(|e| (quadratic(e) - value[e]).norm()).fold(0.0, f64::max)
        };
        quarters.iter().enumerate().map(missed).fold(0.0, f64::max)
    }

    /// Adds ∫ quadratic·e^{−jkL} for every wavenumber, including the phase at the middle.
    pub(crate) fn add_to(&self, wavenumbers_per_m: &[f64], sums: &mut [[Complex64; 4]]) {
        for (k, sum) in wavenumbers_per_m.iter().zip(sums) {
            let [m0, m1, m2] = moments(k * self.slope * self.half_m);
            let odd = Complex64::new(0.0, -m1);
            let nodes = [0.5 * (m2 - odd), Complex64::from(m0 - m2), 0.5 * (m2 + odd)];
            let scale = Complex64::from_polar(self.half_m, -k * self.middle_length_m);
            let values = self.values(*k);
            for (e, total) in sum.iter_mut().enumerate() {
                *total += scale * (0..3).map(|i| nodes[i] * values[i][e]).sum::<Complex64>();
            }
        }
    }
}

/// Moments ∫cos θu, ∫u sin θu, ∫u² cos θu over −1 < u < 1.
fn moments(theta: f64) -> [f64; 3] {
    // Below this, the closed forms lose ε/θ³; the series' next terms are θ⁸/181440 and below: 4e-10·ε... at
    // 0.1.
    if theta.abs() < 0.1 {
        let t2 = theta * theta;
        return [
            2.0 * (1.0 - t2 / 6.0 * (1.0 - t2 / 20.0 * (1.0 - t2 / 42.0))),
            2.0 * theta * (1.0 / 3.0 - t2 * (1.0 / 30.0 - t2 * (1.0 / 840.0 - t2 / 45360.0))),
            2.0 * (1.0 / 3.0 - t2 * (1.0 / 10.0 - t2 * (1.0 / 168.0 - t2 / 6480.0))),
        ];
    }
    let (sin, cos) = theta.sin_cos();
    let (s, c) = (sin / theta, cos / theta);
    [2.0 * s, 2.0 * (s - cos) / theta, 2.0 * (s + 2.0 * (c - s / theta) / theta)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::test_quadrature::gauss_legendre;

    /// Phase of a spherical wave from `distance_m` beside the line, with a curved weight.
    struct SphericalWave {
        distance_m: f64,
        foot_m: f64,
    }

    impl Integrand for SphericalWave {
        type Sample = [f64; 2];
        fn sample(&self, at_m: f64) -> [f64; 2] {
            let length_m = self.distance_m.hypot(at_m - self.foot_m);
            [length_m, (at_m - self.foot_m) / length_m]
        }
        fn length_m(sample: &[f64; 2]) -> f64 {
            2.0 * sample[0]
        }
        fn weights(&self, sample: &[f64; 2], _: f64) -> [Complex64; 4] {
            [1.0, sample[1], sample[1] * sample[1], 1.0 / (1.5 + sample[1])].map(Complex64::from)
        }
    }

    const SPAN_M: [f64; 2] = [-0.2, 0.3];

    fn exact(wave: &SphericalWave, k: f64) -> [Complex64; 4] {
        let (nodes, weights) = gauss_legendre(600);
        let mut sum = [Complex64::ZERO; 4];
        for (node, w) in nodes.iter().zip(weights) {
            let at = wave.sample(0.5 * (SPAN_M[0] + SPAN_M[1]) + 0.25 * node);
            let phase = Complex64::cis(-k * SphericalWave::length_m(&at)) * 0.25 * w;
            let weight = wave.weights(&at, k);
            sum.iter_mut().zip(weight).for_each(|(sum, weight)| *sum += weight * phase);
        }
        sum
    }

    #[test]
    fn the_error_stays_below_the_accuracy_asked_and_the_bound_printed_over_ten_decades() {
        let wavenumbers = [1.0, 400.0, 1613.8];
        for (distance_m, foot_m) in [(0.7, 0.0), (3.0, 10.0), (30.0, 0.1), (200.0, 200.0)] {
            let wave = SphericalWave { distance_m, foot_m };
            let known = wavenumbers.map(|k| exact(&wave, k));
            for decade in 1..=10 {
                let asked = 10_f64.powi(-decade);
                let mut got = [[Complex64::ZERO; 4]; 3];
                let printed = add_line_integral(&wave, SPAN_M, &wavenumbers, asked, &mut got);
                let errors = got.iter().flatten().zip(known.iter().flatten()).map(|(g, e)| (g - e).norm());
                let error = errors.fold(0.0, f64::max) / 0.5;
                println!("{distance_m} m: asked {asked:.0e}, got {error:.1e}, printed {:.1e}", printed / 0.5);
                // 600 Gauss points leave 1e-13.
                assert!(
                    error <= asked && error <= 1.1 * printed / 0.5 + 1e-13,
                    "{distance_m}: {asked:e} {error:e}"
                );
            }
        }
    }

    #[test]
    fn the_moments_meet_at_the_switch_of_their_forms() {
        let theta = 0.1_f64;
        for (below, above) in moments(theta.next_down()).into_iter().zip(moments(theta)) {
            assert!((below - above).abs() < 2e-13, "{below} {above}");
        }
    }
}
