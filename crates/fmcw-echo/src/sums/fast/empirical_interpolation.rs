//! Empirical interpolation of functions over a frame from a few instants, chosen from the functions
//! themselves.
//!
//! Functions of a family, known at the points of a grid, are approximated from their values at a few of these
//! points. A point is added where the residual is largest (Barrault, Maday, Nguyen, Patera, C. R. Acad. Sci.
//! Paris 339 (2004) 667), then each point may move to where it leaves the smallest residual, and the weights
//! of the points are those of least mean square over the known functions.

use num_complex::Complex64;

/// Interpolation points and weights.
#[derive(Debug, Clone, Default)]
pub(crate) struct EmpiricalInterpolation {
    /// Indices of the points in the grid.
    pub(crate) points: Vec<usize>,
    /// Weight of each point for the value at every point of the grid.
    pub(crate) shares: Vec<Vec<Complex64>>,
    /// Root mean square residual over functions and points.
    pub(crate) residual_rms: f64,
}

impl EmpiricalInterpolation {
    /// Interpolation of sample functions of the family, none larger than about 1, until the root mean square
    /// residual is `error`, or up to `most` points.
    pub(crate) fn of(functions: &[Vec<Complex64>], error: f64, most: usize) -> Self {
        let mut found = Self { residual_rms: root_mean_square(functions), ..Self::default() };
        let products = Products::of(functions);
        let mut residuals = functions.to_vec();
        while found.residual_rms > error && found.points.len() < most {
            let mut points = found.points.clone();
            points.push(largest_residual_point(&residuals));
            let mut moved = points.clone();
            products.improve(&mut moved);
            // A point that the others already determine would have huge weights of either sign. Where the
            // residual is largest, none determines it.
            let of_points = |points: Vec<usize>| (shares(functions, &points), points);
            let steady = [moved, points]
                .into_iter()
                .map(of_points)
                .find(|(shares, _)| amplification(shares) <= AMPLIFICATION_MAX);
            let Some((shares, points)) = steady else { return found };
            residuals = functions.iter().map(|function| residual(function, &points, &shares)).collect();
            let residual_rms = root_mean_square(&residuals);
            if residual_rms >= found.residual_rms {
                return found;
            }
            found = Self { points, shares, residual_rms };
        }
        found
    }

    /// Residual of a function after interpolation from its values at the points, at every point of the grid.
    pub(crate) fn residual(&self, function: &[Complex64]) -> Vec<Complex64> {
        residual(function, &self.points, &self.shares)
    }
}

/// Maximum amplification of rounding by weights: 6e-8 in single precision, used for sums down to 1e-5; 30
/// times that is a fifth of it.
const AMPLIFICATION_MAX: f64 = 30.0;

/// Maximum sum of the weights' magnitudes for a value.
fn amplification(shares: &[Vec<Complex64>]) -> f64 {
    let grid = shares.first().map_or(0, Vec::len);
    (0..grid).map(|at| shares.iter().map(|share| share[at].norm()).sum()).fold(0.0, f64::max)
}

fn residual(function: &[Complex64], points: &[usize], shares: &[Vec<Complex64>]) -> Vec<Complex64> {
    let mut left = function.to_vec();
    for (&point, shares) in points.iter().zip(shares) {
        left.iter_mut().zip(shares).for_each(|(left, share)| *left -= share * function[point]);
    }
    left
}

/// Root mean square over all values of several functions.
pub(crate) fn root_mean_square(functions: &[Vec<Complex64>]) -> f64 {
    let count: usize = functions.iter().map(Vec::len).sum();
    (functions.iter().flatten().map(|value| value.norm_sqr()).sum::<f64>() / count.max(1) as f64).sqrt()
}

/// Point with the largest sum of squares.
fn largest_residual_point(functions: &[Vec<Complex64>]) -> usize {
    let power = |point: usize| functions.iter().map(|function| function[point].norm_sqr()).sum::<f64>();
    let powers: Vec<f64> = (0..functions.first().map_or(0, Vec::len)).map(power).collect();
    (0..powers.len()).fold(0, |most, point| if powers[point] > powers[most] { point } else { most })
}

/// Weights X of points that minimise Σ|M − A·X|² over functions, A their values at the points: A = QR by
/// modified Gram–Schmidt, RX = QᴴM.
fn shares(functions: &[Vec<Complex64>], points: &[usize]) -> Vec<Vec<Complex64>> {
    let count = points.len();
    let mut columns: Vec<Vec<Complex64>> =
        points.iter().map(|&point| functions.iter().map(|function| function[point]).collect()).collect();
    let mut upper = vec![vec![Complex64::ZERO; count]; count];
    for i in 0..count {
        let size = columns[i].iter().map(|v| v.norm_sqr()).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
        upper[i][i] = Complex64::from(size);
        columns[i].iter_mut().for_each(|v| *v /= size);
        let (done, rest) = columns.split_at_mut(i + 1);
        for (later, column) in rest.iter_mut().enumerate() {
            let along = inner(&done[i], column);
            upper[i][i + 1 + later] = along;
            column.iter_mut().zip(&done[i]).for_each(|(v, q)| *v -= along * q);
        }
    }
    let grid = functions.first().map_or(0, Vec::len);
    let mut shares = vec![vec![Complex64::ZERO; grid]; count];
    for point in 0..grid {
        let values: Vec<Complex64> = functions.iter().map(|function| function[point]).collect();
        for i in (0..count).rev() {
            let known: Complex64 = (i + 1..count).map(|j| upper[i][j] * shares[j][point]).sum();
            shares[i][point] = (inner(&columns[i], &values) - known) / upper[i][i];
        }
    }
    shares
}

/// Inner product Σ conj(a)·b.
fn inner(a: &[Complex64], b: &[Complex64]) -> Complex64 {
    a.iter().zip(b).map(|(a, b)| a.conj() * b).sum()
}

/// Products of the functions' values at every two points, used to rate sets of points.
struct Products {
    of: Vec<Vec<Complex64>>,
}

impl Products {
    fn of(functions: &[Vec<Complex64>]) -> Self {
        let at: Vec<Vec<Complex64>> = (0..functions.first().map_or(0, Vec::len))
            .map(|point| functions.iter().map(|function| function[point]).collect())
            .collect();
        Self { of: at.iter().map(|a| at.iter().map(|b| inner(a, b)).collect()).collect() }
    }

    /// Moves each of the points, once, to where it explains most.
    fn improve(&self, points: &mut [usize]) {
        for i in 0..points.len() {
            let (mut best, mut told) = (points[i], self.explained_power(points));
            for candidate in 0..self.of.len() {
                points[i] = candidate;
                let also = self.explained_power(points);
                if also > told {
                    (best, told) = (candidate, also);
                }
            }
            points[i] = best;
        }
    }

    /// Power Σ|M|² explained by the best weights of a set of points: their columns are orthogonalised one
    /// after the other.
    fn explained_power(&self, points: &[usize]) -> f64 {
        let mut rows: Vec<Vec<Complex64>> = Vec::with_capacity(points.len());
        let mut told = 0.0;
        for &point in points {
            let mut row = self.of[point].clone();
            for (before, &earlier) in rows.iter().zip(points) {
                let along = row[earlier] / before[earlier];
                row.iter_mut().zip(before).for_each(|(value, before)| *value -= along * before);
            }
            let own = row[point].re;
            // Rounding residual of a point already determined by those before it.
            if own > 1e-13 * self.of[point][point].re {
                told += row.iter().map(|value| value.norm_sqr()).sum::<f64>() / own;
            } else {
                return told;
            }
            rows.push(row);
        }
        told
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_of_three_shapes_are_told_by_three_points() {
        let at = |i: usize| i as f64 / 20.0 - 0.5;
        let function = |k: usize| {
            let of =
                |i: usize| Complex64::new(1.0 + 0.1 * k as f64 * at(i), (k as f64).sin() * at(i).powi(2));
            (0..21).map(of).collect::<Vec<_>>()
        };
        let known: Vec<Vec<Complex64>> = (0..9).map(function).collect();
        let interpolation = EmpiricalInterpolation::of(&known, 1e-12, 9);
        let unseen = root_mean_square(&[interpolation.residual(&function(23))]);
        println!(
            "{} points leave {:.1e}, {unseen:.1e} of another",
            interpolation.points.len(),
            interpolation.residual_rms
        );
        assert!(interpolation.points.len() == 3 && unseen < 1e-10);
    }
}
