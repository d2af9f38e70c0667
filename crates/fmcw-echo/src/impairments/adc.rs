//! Analogue-to-digital converter: each part of a complex sample becomes one of 2^bits codes.

use artifact::radar::Adc;
use num_complex::Complex32;
use rayon::prelude::*;

/// Rounds and clips samples like a converter with codes −2^(b−1) … 2^(b−1) − 1, one code being full
/// scale/2^(b−1).
///
/// Below clipping, the error of a part is uniformly distributed over a code q: variance q²/12 (Bennett, Bell
/// Syst. Tech. J. 27 (1948) 446).
pub fn convert(adc: &Adc, samples: &mut [Complex32]) {
    let codes = 2.0_f64.powi(i32::from(adc.bits) - 1);
    let code = adc.full_scale / codes;
    let part = |value: f32| ((f64::from(value) / code).round().clamp(-codes, codes - 1.0) * code) as f32;
    samples.par_iter_mut().for_each(|sample| *sample = Complex32::new(part(sample.re), part(sample.im)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_the_clips_the_error_has_a_twelfth_of_a_code_squared() {
        let (count, turn) = (100_000, 0.618_033_988_749_895_f64);
        for bits in [4, 8, 12] {
            let adc = Adc { bits, full_scale: 2.0 };
            let exact = |i: usize| ((i as f64 * turn).fract() - 0.5) as f32 * 3.0;
            let mut samples: Vec<Complex32> =
                (0..count).map(|i| Complex32::new(exact(i), -exact(i))).collect();
            convert(&adc, &mut samples);
            let power: f64 =
                samples.iter().enumerate().map(|(i, x)| f64::from(x.re - exact(i)).powi(2)).sum();
            let code = 4.0 / 2.0_f64.powi(i32::from(bits));
            let got = power / count as f64 / (code * code / 12.0);
            println!("{bits} bits: error {got:.4} of q²/12");
            // Golden-ratio points are uniform to 1/count; the range of 3 covers some codes in part, at least
            // one of 12.
            assert!((got - 1.0).abs() < 0.02, "{bits} bits: {got}");
        }
    }

    #[test]
    fn beyond_full_scale_samples_stay_at_the_outermost_codes() {
        let mut samples = [Complex32::new(9.0, -9.0)];
        convert(&Adc { bits: 8, full_scale: 1.0 }, &mut samples);
        assert_eq!(samples[0], Complex32::new(127.0 / 128.0, -1.0));
    }
}
