//! Search for the first non-finite value at memory speed.

use num_complex::Complex32;
use rayon::prelude::*;

/// Number of values tested together.
const VALUES_PER_RUN: usize = 4096;

/// Index of the first value that is infinite or NaN.
pub(crate) fn first_not_finite(values: &[Complex32]) -> Option<usize> {
    let run = values.par_chunks(VALUES_PER_RUN).position_first(|run| !all_finite(run))?;
    let start = run * VALUES_PER_RUN;
    values[start..].iter().position(|v| !v.is_finite()).map(|at| start + at)
}

/// Whether all values are finite, without a branch per value: SIMD instructions compare exponents.
fn all_finite(values: &[Complex32]) -> bool {
    let beyond = |x: f32| u32::from(x.to_bits() & EXPONENT == EXPONENT);
    values.iter().fold(0, |any, v| any | beyond(v.re) | beyond(v.im)) == 0
}

/// Exponent bits, all ones in infinities and NaN (IEEE 754).
const EXPONENT: u32 = 0x7f80_0000;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_several_is_found_wherever_it_is() {
        let mut values = vec![Complex32::ONE; 3 * VALUES_PER_RUN + 7];
        assert_eq!(first_not_finite(&values), None);
        for at in [3 * VALUES_PER_RUN + 6, 2 * VALUES_PER_RUN, VALUES_PER_RUN - 1, 0] {
            values[at].im = if at % 2 == 0 { f32::NAN } else { f32::NEG_INFINITY };
            assert_eq!(first_not_finite(&values), Some(at));
        }
        assert_eq!(first_not_finite(&[]), None);
    }
}
