//! Values of several paths side by side: f64 lanes of the machine's widest instruction set, detected at run
//! time.
//!
//! Products and sums are fused if the instruction set can; results are bit-identical for one instruction set,
//! and differ in the last bits between two. Everything is `inline(always)` and free of closures: only inlined
//! code is compiled for the instruction set that `pulp` has chosen, and a closure passed to `map` is not
//! inlined (a factor of 3).

use glam::DVec3;
use pulp::Simd;
use std::ops::{Add, Mul, Sub};

/// One real number per lane.
#[derive(Clone, Copy)]
pub(crate) struct Real<S: Simd> {
    simd: S,
    pub(crate) value: S::f64s,
}

impl<S: Simd> Real<S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, value: S::f64s) -> Self {
        Self { simd, value }
    }

    #[inline(always)]
    pub(crate) fn splat(simd: S, value: f64) -> Self {
        Self { simd, value: simd.splat_f64s(value) }
    }

    /// Fused multiply–add `self·factor + term`.
    #[inline(always)]
    pub(crate) fn mul_add(self, factor: Self, term: Self) -> Self {
        Self { value: self.simd.mul_add_e_f64s(self.value, factor.value, term.value), ..self }
    }

    /// Fused negated multiply–add `term − self·factor`.
    #[inline(always)]
    pub(crate) fn negate_mul_add(self, factor: Self, term: Self) -> Self {
        Self { value: self.simd.negate_mul_add_e_f64s(self.value, factor.value, term.value), ..self }
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        Self { value: self.simd.sqrt_f64s(self.value), ..self }
    }

    #[inline(always)]
    pub(crate) fn recip(self) -> Self {
        Self { value: self.simd.div_f64s(self.simd.splat_f64s(1.0), self.value), ..self }
    }

    #[inline(always)]
    pub(crate) fn scale(self, factor: f64) -> Self {
        Self { value: self.simd.mul_f64s(self.value, self.simd.splat_f64s(factor)), ..self }
    }

    /// Distance to the nearest integer, in −½ … ½, for |x| < 2⁵¹: adding 1.5·2⁵² removes the fraction.
    #[inline(always)]
    pub(crate) fn fraction(self) -> Self {
        let integer_only = Self::splat(self.simd, 6_755_399_441_055_744.0);
        self - ((self + integer_only) - integer_only)
    }

    /// Applies `f` lane by lane, for the rare function without a vector form.
    #[inline(always)]
    pub(crate) fn map3(of: [Self; 3], f: impl Fn([f64; 3]) -> f64) -> Self {
        let simd = of[0].simd;
        let mut lanes = [[0.0; MAX_LANES]; 3];
        for (lanes, part) in lanes.iter_mut().zip(&of) {
            simd.partial_store_f64s(&mut lanes[..S::F64_LANES], part.value);
        }
        let mut results = [0.0; MAX_LANES];
        for (i, result) in results.iter_mut().enumerate().take(S::F64_LANES) {
            *result = f([lanes[0][i], lanes[1][i], lanes[2][i]]);
        }
        Self { value: simd.partial_load_f64s(&results[..S::F64_LANES]), ..of[0] }
    }
}

/// Maximum number of lanes: the widest instruction set has 8 lanes of f64.
pub(crate) const MAX_LANES: usize = 8;

impl<S: Simd> Add for Real<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { value: self.simd.add_f64s(self.value, other.value), ..self }
    }
}

impl<S: Simd> Sub for Real<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { value: self.simd.sub_f64s(self.value, other.value), ..self }
    }
}

impl<S: Simd> Mul for Real<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { value: self.simd.mul_f64s(self.value, other.value), ..self }
    }
}

/// One complex number per lane.
#[derive(Clone, Copy)]
pub(crate) struct Complex<S: Simd> {
    pub(crate) re: Real<S>,
    pub(crate) im: Real<S>,
}

impl<S: Simd> Complex<S> {
    #[inline(always)]
    pub(crate) fn scale(self, factor: f64) -> Self {
        Self { re: self.re.scale(factor), im: self.im.scale(factor) }
    }

    /// Phasors e^{j2πx}, x in cycles.
    ///
    /// x is reduced to a quarter of its fraction (|angle| ≤ π/4), evaluated by the Taylor series to θ¹⁵ and
    /// θ¹⁶ (remainders 5e-17 and 2e-18 there) and squared twice, which makes the error four times as large:
    /// below 2e-15.
    #[inline(always)]
    pub(crate) fn from_cycles(cycles: Real<S>) -> Self {
        let angle = cycles.fraction().scale(std::f64::consts::FRAC_PI_2);
        let square = angle * angle;
        let quarter = Self { re: series(square, &COSINE), im: angle * series(square, &SINE) };
        quarter.squared().squared()
    }

    #[inline(always)]
    fn squared(self) -> Self {
        self * self
    }
}

/// One vector in space per lane.
#[derive(Clone, Copy)]
pub(crate) struct Vector<S: Simd> {
    pub(crate) x: Real<S>,
    pub(crate) y: Real<S>,
    pub(crate) z: Real<S>,
}

impl<S: Simd> Vector<S> {
    #[inline(always)]
    pub(crate) fn splat(simd: S, value: DVec3) -> Self {
        Self { x: Real::splat(simd, value.x), y: Real::splat(simd, value.y), z: Real::splat(simd, value.z) }
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> Real<S> {
        self.z.mul_add(other.z, self.y.mul_add(other.y, self.x * other.x))
    }

    /// Fused multiply–add `self·factor + term`.
    #[inline(always)]
    pub(crate) fn mul_add(self, factor: Real<S>, term: Self) -> Self {
        Self {
            x: self.x.mul_add(factor, term.x),
            y: self.y.mul_add(factor, term.y),
            z: self.z.mul_add(factor, term.z),
        }
    }

    /// Fused negated multiply–add `term − self·factor`.
    #[inline(always)]
    pub(crate) fn negate_mul_add(self, factor: Real<S>, term: Self) -> Self {
        Self {
            x: self.x.negate_mul_add(factor, term.x),
            y: self.y.negate_mul_add(factor, term.y),
            z: self.z.negate_mul_add(factor, term.z),
        }
    }
}

impl<S: Simd> Sub for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<S: Simd> Add for Complex<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<S: Simd> Sub for Complex<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl<S: Simd> Mul for Complex<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            re: self.im.negate_mul_add(other.im, self.re * other.re),
            im: self.re.mul_add(other.im, self.im * other.re),
        }
    }
}

/// Polynomial Σ c_k·x^k by Horner's rule.
#[inline(always)]
fn series<S: Simd, const N: usize>(x: Real<S>, coefficients: &[f64; N]) -> Real<S> {
    let mut sum = Real::splat(x.simd, coefficients[N - 1]);
    let mut k = N - 1;
    while k > 0 {
        k -= 1;
        sum = sum.mul_add(x, Real::splat(x.simd, coefficients[k]));
    }
    sum
}

/// Coefficients (−1)^k/(2k+1)! of the sine.
const SINE: [f64; 8] = [
    1.0,
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5_040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 1_307_674_368_000.0,
];

/// Coefficients (−1)^k/(2k)! of the cosine.
const COSINE: [f64; 9] = [
    1.0,
    -1.0 / 2.0,
    1.0 / 24.0,
    -1.0 / 720.0,
    1.0 / 40_320.0,
    -1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 20_922_789_888_000.0,
];

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex64;
    use pulp::{Arch, WithSimd};
    use std::f64::consts::TAU;

    struct FirstLane(f64);

    impl WithSimd for FirstLane {
        type Output = Complex64;
        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Complex64 {
            let phasor = Complex::from_cycles(Real::splat(simd, self.0));
            let first = |x: Real<S>| simd.reduce_sum_f64s(x.value) / S::F64_LANES as f64;
            Complex64::new(first(phasor.re), first(phasor.im))
        }
    }

    #[test]
    fn a_phasor_from_cycles_is_exact_to_2e_15_at_any_angle_and_after_many_turns() {
        for step in -2000..2000 {
            let fraction = f64::from(step) / 1990.0;
            for turns in [0.0, 1.0, -20_517.0, 1_048_576.0] {
                // The sum turns + fraction is rounded: compare with the actual argument.
                let asked = turns + fraction;
                let exact = Complex64::cis(TAU * (asked - asked.round()));
                let got = Arch::new().dispatch(FirstLane(asked));
                assert!((got - exact).norm() < 2e-15, "{asked}: {got} against {exact}");
            }
        }
    }

    #[test]
    fn lanes_map_one_by_one() {
        struct Map;
        impl WithSimd for Map {
            type Output = f64;
            fn with_simd<S: Simd>(self, simd: S) -> f64 {
                let three = [1.0, 2.0, 3.0].map(|x| Real::splat(simd, x));
                simd.reduce_sum_f64s(Real::map3(three, |[x, y, z]| x + y * z).value) / S::F64_LANES as f64
            }
        }
        assert_eq!(Arch::new().dispatch(Map), 7.0);
    }
}
