//! Kalman filter with a nearly-constant-velocity model: state (x, y, v_x, v_y).
//!
//! The acceleration is white noise of spectral density q: over T seconds the velocity gains a variance of qT,
//! the position of qT³/3 (Bar-Shalom, Li, Kirubarajan, *Estimation with Applications to Tracking and
//! Navigation*, 2001, §6.2.2), however many frames that takes. Measurements are scalar, which is equivalent
//! to a joint update as long as their errors are independent, and requires no matrix inversion.

use glam::{DMat4, DVec4};

/// State estimate with its covariance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Mean (x, y, v_x, v_y).
    pub mean: DVec4,
    /// Covariance of the error of the mean.
    pub covariance: DMat4,
}

/// Difference between a measurement and its prediction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Innovation {
    /// Measured minus predicted value.
    pub residual: f64,
    /// Predicted variance of the residual.
    pub variance: f64,
}

impl Innovation {
    /// Squared Mahalanobis distance.
    pub fn distance2(self) -> f64 {
        self.residual * self.residual / self.variance
    }

    /// −2 ln of the measurement's density.
    pub fn neg2_log_likelihood(self) -> f64 {
        self.distance2() + (std::f64::consts::TAU * self.variance).ln()
    }
}

impl Estimate {
    /// Prediction over `interval_s`; `acceleration_density` is q in m²/s³ along each axis.
    pub fn predicted(&self, interval_s: f64, acceleration_density: f64) -> Self {
        let t = interval_s;
        let step =
            DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(t, 0.0, 1.0, 0.0), DVec4::new(0.0, t, 0.0, 1.0));
        let (place, mixed, velocity) = (t * t * t / 3.0, 0.5 * t * t, t);
        let noise = DMat4::from_cols(
            DVec4::new(place, 0.0, mixed, 0.0),
            DVec4::new(0.0, place, 0.0, mixed),
            DVec4::new(mixed, 0.0, velocity, 0.0),
            DVec4::new(0.0, mixed, 0.0, velocity),
        );
        let covariance = step * self.covariance * step.transpose() + noise * acceleration_density;
        Self { mean: step * self.mean, covariance }
    }

    /// Innovation of a scalar measurement with gradient `row` in the state and this variance.
    pub fn innovation(&self, row: DVec4, residual: f64, variance: f64) -> Innovation {
        Innovation { residual, variance: row.dot(self.covariance * row) + variance }
    }

    /// Estimate updated by a scalar measurement. The covariance uses Joseph's form, which stays symmetric and
    /// positive.
    pub fn updated(&self, row: DVec4, residual: f64, variance: f64) -> Self {
        let gain = self.covariance * row / self.innovation(row, residual, variance).variance;
        let left = DMat4::IDENTITY - outer(gain, row);
        let covariance = left * self.covariance * left.transpose() + outer(gain, gain) * variance;
        let covariance = (covariance + covariance.transpose()) * 0.5;
        Self { mean: self.mean + gain * residual, covariance }
    }
}

/// Outer product a·bᵀ.
pub(crate) fn outer(a: DVec4, b: DVec4) -> DMat4 {
    DMat4::from_cols(a * b.x, a * b.y, a * b.z, a * b.w)
}

#[cfg(test)]
mod tests {
    use super::*;

    const INTERVAL_S: f64 = 0.1;
    const DENSITY: f64 = 2.0;
    const VARIANCE: f64 = 0.09;

    /// Predicted steady state just before a measurement of x.
    fn settled() -> Estimate {
        let start = Estimate { mean: DVec4::ZERO, covariance: DMat4::IDENTITY * 100.0 };
        (0..2000)
            .fold(start, |state, _| state.updated(DVec4::X, 0.0, VARIANCE).predicted(INTERVAL_S, DENSITY))
    }

    /// The steady-state gains α and β/T satisfy, with λ² = qT³/r, λ² = β²/(1 − α) and β = 3(2 − α) − √(3(α² −
    /// 12α + 12)) (Bar-Shalom §6.5.3).
    #[test]
    fn the_settled_gain_is_that_of_the_closed_form() {
        let state = settled();
        let gain = state.covariance * DVec4::X / state.innovation(DVec4::X, 0.0, VARIANCE).variance;
        let (alpha, beta) = (gain.x, gain.z * INTERVAL_S);
        let index2 = DENSITY * INTERVAL_S.powi(3) / VARIANCE;
        println!("alpha {alpha}, beta {beta}, index² {index2} against {}", beta * beta / (1.0 - alpha));
        // Thousands of contracting steps: rounding remains, some hundred ε.
        assert!((beta * beta / (1.0 - alpha) - index2).abs() < 1e-12);
        let asked = 3.0 * (2.0 - alpha) - (3.0 * (alpha * alpha - 12.0 * alpha + 12.0)).sqrt();
        assert!((beta - asked).abs() < 1e-12, "{beta} {asked}");
    }

    #[test]
    fn the_settled_covariance_solves_the_algebraic_riccati_equation() {
        let state = settled();
        let (p, h) = (state.covariance, DVec4::X);
        let left = p - outer(p * h, p * h) * (1.0 / (h.dot(p * h) + VARIANCE));
        // F·left·Fᵀ + Q by the prediction, which is tested by the closed form above; unmeasured y grows and
        // is left out.
        let right =
            Estimate { mean: DVec4::ZERO, covariance: left }.predicted(INTERVAL_S, DENSITY).covariance;
        for (i, j) in [(0, 0), (0, 2), (2, 0), (2, 2)] {
            assert!((p.col(j)[i] - right.col(j)[i]).abs() < 1e-12, "{i}, {j}");
        }
    }

    #[test]
    fn two_half_steps_are_a_whole_one() {
        let state = Estimate { mean: DVec4::new(1.0, 2.0, 3.0, -4.0), covariance: settled().covariance };
        let whole = state.predicted(0.2, DENSITY);
        let halves = state.predicted(0.1, DENSITY).predicted(0.1, DENSITY);
        assert!((whole.mean - halves.mean).length() < 1e-14);
        // y is unmeasured: its variance is thousands, of which ε is 1e-12 per step.
        let (a, b) = (whole.covariance.to_cols_array(), halves.covariance.to_cols_array());
        a.iter().zip(b).for_each(|(a, b)| assert!((a - b).abs() <= 1e-12 * a.abs().max(1.0), "{a} {b}"));
    }
}
