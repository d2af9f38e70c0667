//! Monotone cubic curves through the control points of a drawing.

/// A once-differentiable curve y(x) through control points that never overshoots them (Fritsch and Carlson
/// 1980), so that a roof line drawn from five points has no unintended dents.
#[derive(Debug, Clone)]
pub(crate) struct Curve {
    points: Vec<(f64, f64)>,
    slopes: Vec<f64>,
}

impl Curve {
    /// Curve through `points`, sorted here by x; constant beyond the ends.
    pub(crate) fn through(points: &[(f64, f64)]) -> Self {
        let mut points = points.to_vec();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let slopes = (0..points.len()).map(|i| slope_at(&points, i)).collect();
        Self { points, slopes }
    }

    /// Curve of the same value everywhere.
    pub(crate) fn flat(value: f64) -> Self {
        Self::through(&[(0.0, value)])
    }

    /// Value at `x`.
    pub(crate) fn at(&self, x: f64) -> f64 {
        let last = self.points.len() - 1;
        if x <= self.points[0].0 {
            return self.points[0].1;
        }
        if x >= self.points[last].0 {
            return self.points[last].1;
        }
        let i = self.points.partition_point(|p| p.0 <= x) - 1;
        let ((x0, y0), (x1, y1)) = (self.points[i], self.points[i + 1]);
        let width = x1 - x0;
        let t = (x - x0) / width;
        let (rest, square) = (1.0 - t, t * t);
        y0 * (1.0 + 2.0 * t) * rest * rest
            + self.slopes[i] * width * t * rest * rest
            + y1 * square * (3.0 - 2.0 * t)
            - self.slopes[i + 1] * width * square * rest
    }

    /// Derivative at `x`, by a central difference over 2 mm, the accuracy of drawings.
    pub(crate) fn slope(&self, x: f64) -> f64 {
        (self.at(x + 1e-3) - self.at(x - 1e-3)) / 2e-3
    }
}

/// Harmonic mean of the neighbouring chords' slopes, zero at an extremum and at the ends' outer sides.
fn slope_at(points: &[(f64, f64)], i: usize) -> f64 {
    let chord = |k: usize| (points[k + 1].1 - points[k].1) / (points[k + 1].0 - points[k].0);
    match (i.checked_sub(1), i + 1 < points.len()) {
        (None, false) => 0.0,
        (None, true) => chord(i),
        (Some(before), false) => chord(before),
        (Some(before), true) if chord(before) * chord(i) <= 0.0 => 0.0,
        (Some(before), true) => 2.0 / (1.0 / chord(before) + 1.0 / chord(i)),
    }
}

/// Step from 0 at `from` to 1 at `to` (in either order), with continuous slope.
pub(crate) fn smooth_step(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
