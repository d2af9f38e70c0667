//! Divided differences of the exponential at points of the imaginary axis: integrals of a linear phase times
//! a polynomial over a triangle, in one symmetric code path.
//!
//! Hermite–Genocchi: with barycentric coordinates λ and corner phases φ, ∫ λ₁^a λ₂^b λ₃^c e^{jλ·φ} dA =
//! 2A·a!b!c!·exp[jφ₁ (a+1 times), jφ₂ (b+1 times), jφ₃ (c+1 times)].

use num_complex::Complex64;

/// Maximum multiplicity of one corner in [`DividedDifferences::of`]: second moments need a corner three
/// times.
pub(crate) const MULTIPLICITY_MAX: usize = 3;

/// Span of points below which they are expanded about their midpoint, and above which recursion is used.
///
/// The recursion divides by the span at every level, so with a span of 1 or more it does not amplify
/// rounding; the series uses powers of half the span, here 0.75, and reaches rounding after 18 terms.
const SERIES_SPAN: f64 = 1.5;
/// Number of terms of the series required by that span.
const SERIES_TERMS: usize = 19;

/// Divided differences of exp at j times three phases, each phase repeated up to [`MULTIPLICITY_MAX`] times.
///
/// Computed ones are cached: the six second moments of a triangle share most of their recursion.
pub(crate) struct DividedDifferences {
    /// Phases, ascending.
    phases: [f64; 3],
    /// Position of each corner in `phases`.
    place: [usize; 3],
    known: [Option<Complex64>; (MULTIPLICITY_MAX + 1).pow(3)],
}

impl DividedDifferences {
    /// Phases of the three corners, in any order.
    pub(crate) fn new(phases: [f64; 3]) -> Self {
        let mut corner_at = [0, 1, 2];
        corner_at.sort_by(|&a, &b| phases[a].total_cmp(&phases[b]));
        let mut place = [0; 3];
        for (at, &corner) in corner_at.iter().enumerate() {
            place[corner] = at;
        }
        Self { phases: corner_at.map(|corner| phases[corner]), place, known: [None; _] }
    }

    /// Divided difference exp[jφ₁ (m₁ times), jφ₂ (m₂ times), jφ₃ (m₃ times)]; at least one multiplicity is
    /// not zero.
    ///
    /// Error: a few ε of 1/n!, n one less than the number of points, for any phases (P8).
    pub(crate) fn of(&mut self, multiplicity: [usize; 3]) -> Complex64 {
        let mut sorted = [0; 3];
        for (corner, times) in multiplicity.into_iter().enumerate() {
            sorted[self.place[corner]] = times;
        }
        self.of_sorted(sorted)
    }

    fn of_sorted(&mut self, times: [usize; 3]) -> Complex64 {
        let side = MULTIPLICITY_MAX + 1;
        let slot = (times[0] * side + times[1]) * side + times[2];
        if let Some(known) = self.known[slot] {
            return known;
        }
        let low = usize::from(times[0] == 0) * (1 + usize::from(times[1] == 0));
        let high = 2 - usize::from(times[2] == 0) * (1 + usize::from(times[1] == 0));
        let span = self.phases[high] - self.phases[low];
        let value = if span < SERIES_SPAN {
            series(self.phases, times, low, high)
        } else {
            self.recursion(times, low, high)
        };
        self.known[slot] = Some(value);
        value
    }

    /// Recursion exp[z₀ … zₙ] = (exp[z₁ … zₙ] − exp[z₀ … zₙ₋₁])/(zₙ − z₀).
    fn recursion(&mut self, times: [usize; 3], low: usize, high: usize) -> Complex64 {
        let span = self.phases[high] - self.phases[low];
        let (mut without_low, mut without_high) = (times, times);
        without_low[low] -= 1;
        without_high[high] -= 1;
        let difference = self.of_sorted(without_low) - self.of_sorted(without_high);
        Complex64::new(difference.im, -difference.re) / span
    }
}

/// Series e^{jc} Σ_k j^k h_k(φ − c)/(n + k)!, h_k the complete homogeneous symmetric polynomials of all
/// points, c their midpoint.
fn series(phases: [f64; 3], times: [usize; 3], low: usize, high: usize) -> Complex64 {
    let middle = 0.5 * (phases[low] + phases[high]);
    let reach = 0.5 * (phases[high] - phases[low]);
    let terms = terms_to_rounding(reach).min(SERIES_TERMS);
    let mut homogeneous = [0.0; SERIES_TERMS];
    homogeneous[0] = 1.0;
    for corner in low..=high {
        for _ in 0..times[corner] {
            let offset = phases[corner] - middle;
            for k in 1..terms {
                homogeneous[k] += offset * homogeneous[k - 1];
            }
        }
    }
    let points: usize = times.iter().sum();
    Complex64::cis(middle) * weighted_by_factorials(&homogeneous[..terms], points - 1)
}

/// The k-th term of the series is below reach^k/k! of the first.
fn terms_to_rounding(reach: f64) -> usize {
    let (mut terms, mut size) = (1, 1.0);
    while size > 0.1 * f64::EPSILON {
        size *= reach / terms as f64;
        terms += 1;
    }
    terms
}

/// Sum Σ_k j^k h_k/(n + k)!.
fn weighted_by_factorials(homogeneous: &[f64], n: usize) -> Complex64 {
    let mut inverse_factorial = (1..=n).fold(1.0, |product, i| product / i as f64);
    let mut sum = [0.0; 4];
    for (k, h) in homogeneous.iter().enumerate() {
        sum[k % 4] += h * inverse_factorial;
        inverse_factorial /= (n + k + 1) as f64;
    }
    Complex64::new(sum[0] - sum[2], sum[1] - sum[3])
}

/// Six second moments of a triangle, exp[jφ₁, jφ₂, jφ₃] with two further phases: corner i twice more at i,
/// the other two corners once more at 3 + i; `turns` are e^{jφ}. All of [`DividedDifferences::of`] at once,
/// without its table: most of the time of a sweep is spent here.
pub(crate) fn second_moments(phases: [f64; 3], turns: [Complex64; 3]) -> [Complex64; 6] {
    let mut corner_at = [0, 1, 2];
    corner_at.sort_unstable_by(|&a, &b| phases[a].total_cmp(&phases[b]));
    let (sorted, turns) = (corner_at.map(|corner| phases[corner]), corner_at.map(|corner| turns[corner]));
    let found = if sorted[2] - sorted[0] < SERIES_SPAN { near(sorted) } else { far(sorted, turns) };
    let mut moments = [Complex64::ZERO; 6];
    for (place, corner) in corner_at.into_iter().enumerate() {
        moments[corner] = found[place];
        moments[3 + corner] = found[3 + place];
    }
    moments
}

/// Second moments by recursion from pairs of neighbours, for sorted phases.
fn far([a, b, c]: [f64; 3], [ea, eb, ec]: [Complex64; 3]) -> [Complex64; 6] {
    let [ab, bc] = [PhasePair::of((a, ea), (b, eb)), PhasePair::of((b, eb), (c, ec))];
    let per_span = 1.0 / (c - a);
    let step = |without_low: Complex64, without_high: Complex64| over_j(without_low - without_high, per_span);
    let d111 = step(bc.d11, ab.d11);
    let (d211, d112) = (step(d111, ab.d21), step(bc.d12, d111));
    let d121 = step(bc.d21, ab.d12);
    let squares = [step(d211, ab.d31), step(bc.d31, ab.d13), step(bc.d13, d112)];
    let products = [step(bc.d22, d121), step(d112, d211), step(d121, ab.d22)];
    [squares[0], squares[1], squares[2], products[0], products[1], products[2]]
}

/// Divided differences at two phases, named by the multiplicity of each.
struct PhasePair {
    d11: Complex64,
    d12: Complex64,
    d21: Complex64,
    d13: Complex64,
    d31: Complex64,
    d22: Complex64,
}

impl PhasePair {
    /// Pair of phases with their exponentials, ascending.
    fn of((low, at_low): (f64, Complex64), (high, at_high): (f64, Complex64)) -> Self {
        if high - low < SERIES_SPAN {
            return Self::near(low, high);
        }
        let per_span = 1.0 / (high - low);
        let step =
            |without_low: Complex64, without_high: Complex64| over_j(without_low - without_high, per_span);
        // exp taken m times at one point is its (m − 1)-th derivative over (m − 1)!.
        let d11 = step(at_high, at_low);
        let (d12, d21) = (step(at_high, d11), step(d11, at_low));
        let (d13, d31) = (step(0.5 * at_high, d12), step(d21, 0.5 * at_low));
        Self { d11, d12, d21, d13, d31, d22: step(d12, d21) }
    }

    fn near(low: f64, high: f64) -> Self {
        let series = Series::about(low, high);
        let (x, y) = (low - series.middle, high - series.middle);
        let h11 = series.with(&series.with(&Series::START, x), y);
        let (h12, h21) = (series.with(&h11, y), series.with(&h11, x));
        Self {
            d11: series.sum(&h11, 1),
            d12: series.sum(&h12, 2),
            d21: series.sum(&h21, 2),
            d13: series.sum(&series.with(&h12, y), 3),
            d31: series.sum(&series.with(&h21, x), 3),
            d22: series.sum(&series.with(&h12, x), 3),
        }
    }
}

/// Second moments by the series about the midpoint, for sorted phases.
fn near(phases: [f64; 3]) -> [Complex64; 6] {
    let series = Series::about(phases[0], phases[2]);
    let [x, y, z] = phases.map(|phase| phase - series.middle);
    let h111 = series.with(&series.with(&series.with(&Series::START, x), y), z);
    let [h211, h121, h112] = [x, y, z].map(|offset| series.with(&h111, offset));
    let five = |h: &Terms, offset: f64| series.sum(&series.with(h, offset), 4);
    [five(&h211, x), five(&h121, y), five(&h112, z), five(&h121, z), five(&h112, x), five(&h211, y)]
}

/// Complete homogeneous symmetric polynomials of several offsets, by degree.
type Terms = [f64; SERIES_TERMS];

/// Series of [`series`] for several divided differences about one midpoint.
struct Series {
    middle: f64,
    turn: Complex64,
    terms: usize,
}

impl Series {
    /// Terms of no offset.
    const START: Terms = {
        let mut terms = [0.0; SERIES_TERMS];
        terms[0] = 1.0;
        terms
    };

    fn about(low: f64, high: f64) -> Self {
        let middle = 0.5 * (low + high);
        let terms = terms_to_rounding(0.5 * (high - low)).min(SERIES_TERMS);
        Self { middle, turn: Complex64::cis(middle), terms }
    }

    /// Terms with one more offset.
    fn with(&self, terms: &Terms, offset: f64) -> Terms {
        let mut more = *terms;
        for k in 1..self.terms {
            more[k] += offset * more[k - 1];
        }
        more
    }

    /// Sum of the series of a divided difference with one more point than `n`.
    fn sum(&self, terms: &Terms, n: usize) -> Complex64 {
        let mut sum = [0.0; 4];
        for k in 0..self.terms {
            sum[k % 4] += terms[k] * INVERSE_FACTORIALS[n + k];
        }
        self.turn * Complex64::new(sum[0] - sum[2], sum[1] - sum[3])
    }
}

/// Reciprocals 1/n!.
const INVERSE_FACTORIALS: [f64; SERIES_TERMS + 4] = {
    let mut table = [1.0; SERIES_TERMS + 4];
    let mut n = 1;
    while n < table.len() {
        table[n] = table[n - 1] / n as f64;
        n += 1;
    }
    table
};

/// A difference over j times a span.
fn over_j(difference: Complex64, per_span: f64) -> Complex64 {
    Complex64::new(difference.im * per_span, -difference.re * per_span)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Entry (0, n) of the exponential of diag(jφ) + shift (Opitz 1964), by scaling and squaring.
    fn opitz(points: &[f64]) -> Complex64 {
        let n = points.len();
        let span = points.iter().fold(0.0_f64, |m, p| m.max(p.abs())) + 1.0;
        let halvings = span.log2().ceil() as i32 + 3;
        let scale = 0.5_f64.powi(halvings);
        let mut matrix = vec![vec![Complex64::ZERO; n]; n];
        for i in 0..n {
            matrix[i][i] = Complex64::new(0.0, points[i] * scale);
            if i + 1 < n {
                matrix[i][i + 1] = Complex64::from(scale);
            }
        }
        let mut result = identity(n);
        let mut power = identity(n);
        for k in 1..24 {
            power = product(&power, &matrix);
            for row in &mut power {
                for entry in row {
                    *entry /= f64::from(k);
                }
            }
            for (r, p) in result.iter_mut().flatten().zip(power.iter().flatten()) {
                *r += p;
            }
        }
        for _ in 0..halvings {
            result = product(&result, &result);
        }
        result[0][n - 1]
    }

    fn identity(n: usize) -> Vec<Vec<Complex64>> {
        (0..n).map(|i| (0..n).map(|j| Complex64::from(f64::from(u8::from(i == j)))).collect()).collect()
    }

    fn product(a: &[Vec<Complex64>], b: &[Vec<Complex64>]) -> Vec<Vec<Complex64>> {
        let n = a.len();
        (0..n).map(|i| (0..n).map(|j| (0..n).map(|k| a[i][k] * b[k][j]).sum()).collect()).collect()
    }

    /// Integral over the unit triangle (A = ½) of e^{jλ·φ} by Gauss–Legendre in collapsed coordinates.
    fn quadrature(phases: [f64; 3]) -> Complex64 {
        let (nodes, weights) = crate::integral::test_quadrature::gauss_legendre(40);
        let mut sum = Complex64::ZERO;
        for (u, wu) in nodes.iter().zip(&weights) {
            for (v, wv) in nodes.iter().zip(&weights) {
                let (s, t) = (0.5 * (u + 1.0), 0.5 * (v + 1.0));
                let phase = (1.0 - s) * phases[0] + s * (1.0 - t) * phases[1] + s * t * phases[2];
                sum += Complex64::cis(phase) * (0.25 * wu * wv * s);
            }
        }
        sum
    }

    /// Multiplicities of the corners in the order of [`second_moments`].
    const SECOND_MOMENTS: [[usize; 3]; 6] =
        [[3, 1, 1], [1, 3, 1], [1, 1, 3], [1, 2, 2], [2, 1, 2], [2, 2, 1]];

    /// Claim P8.
    #[test]
    fn the_integral_over_a_triangle_equals_quadrature() {
        let phases = [0.3, 2.1, -4.0];
        let error = (DividedDifferences::new(phases).of([1; 3]) - quadrature(phases)).norm();
        println!("P8: asked 1e-14, got {error:.1e}");
        assert!(error < 1e-14);
    }

    /// Claim P8.
    #[test]
    fn equal_phases_give_the_plain_area() {
        let mut at = DividedDifferences::new([1.7; 3]);
        assert!((at.of([1; 3]) - Complex64::cis(1.7) / 2.0).norm() < 1e-16);
        assert!((at.of([3, 1, 1]) - Complex64::cis(1.7) / 24.0).norm() < 1e-17);
    }

    /// Claim P8, against the matrix exponential, whose own squarings lose up to the span times ε.
    #[test]
    fn spans_from_1e_minus_12_to_1e3_keep_rounding_accuracy() {
        let mut worst = 0.0_f64;
        for exponent in -12..=3 {
            let span = 10_f64.powi(exponent);
            for shape in
                [[0.0, 1.0, 0.4], [0.0, 1.0, 1.0], [0.7, 0.0, 1.0], [0.0, 1.0, 1e-9], [-0.3, 0.2, 0.5]]
            {
                let phases = shape.map(|s| s * span);
                let mut at = DividedDifferences::new(phases);
                let mut check = |times: [usize; 3], factorial: f64| {
                    let points: Vec<f64> =
                        (0..3).flat_map(|i| std::iter::repeat_n(phases[i], times[i])).collect();
                    let error = (at.of(times) - opitz(&points)).norm() * factorial / (1.0 + span);
                    worst = worst.max(error);
                };
                check([1; 3], 2.0);
                SECOND_MOMENTS.iter().for_each(|&times| check(times, 24.0));
            }
        }
        println!("P8: asked 1e-14 of the value at equal phases, got {worst:.1e}");
        assert!(worst < 1e-14);
    }

    /// Claim P8.
    #[test]
    fn nothing_jumps_where_the_series_gives_way_to_the_recursion() {
        for times in SECOND_MOMENTS.into_iter().chain([[1; 3]]) {
            for middle in [0.0, 0.3, 1.0, 1.5 - 1e-13] {
                let just_below = DividedDifferences::new([0.0, middle, SERIES_SPAN - 1e-14]).of(times);
                let just_above = DividedDifferences::new([0.0, middle, SERIES_SPAN + 1e-14]).of(times);
                assert!((just_below - just_above).norm() < 1e-12 * just_below.norm(), "{times:?} {middle}");
            }
        }
    }

    #[test]
    fn the_order_of_the_corners_does_not_matter_to_the_bit() {
        let (a, b) = (
            DividedDifferences::new([0.3, 9.1, -4.0]).of([1, 3, 1]),
            DividedDifferences::new([-4.0, 0.3, 9.1]).of([1, 1, 3]),
        );
        assert_eq!(a, b);
    }

    /// The six second moments at once compared with one by one, for every combination of series and
    /// recursion.
    #[test]
    fn the_six_second_moments_at_once_are_those_one_by_one() {
        let mut worst = 0.0_f64;
        for low in [0.0, 1e-9, 0.3, 1.499, 1.5, 7.0, 300.0] {
            for high in [0.0, 1e-12, 0.7, 1.499, 1.5, 20.0, 1e3] {
                let ascending = [-2.0, -2.0 + low, -2.0 + low + high];
                for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
                    let phases = order.map(|place: usize| ascending[place]);
                    let at_once = second_moments(phases, phases.map(Complex64::cis));
                    let mut one_by_one = DividedDifferences::new(phases);
                    for (value, times) in at_once.iter().zip(SECOND_MOMENTS) {
                        worst = worst.max((value - one_by_one.of(times)).norm() * 24.0);
                    }
                }
            }
        }
        // As in P8: rounding of a few ε of the value at equal phases, 1/4!.
        println!("asked 1e-14 of the value at equal phases, got {worst:.1e}");
        assert!(worst < 1e-14);
    }
}
