//! Eigenvalues of symmetric matrices by the symmetric QR algorithm: Householder tridiagonalisation, then
//! implicit QR steps with Wilkinson's shift (Golub, Van Loan, Matrix Computations (2013), §8.3).

/// Eigenvalues, unordered, of a symmetric matrix given by rows.
pub(crate) fn eigenvalues(matrix: Vec<Vec<f64>>) -> Vec<f64> {
    let (diagonal, beside) = householder_tridiagonal(matrix);
    eigenvalues_of_tridiagonal(diagonal, beside).0
}

/// Diagonal and off-diagonal of a tridiagonal matrix with the same eigenvalues.
fn householder_tridiagonal(mut a: Vec<Vec<f64>>) -> (Vec<f64>, Vec<f64>) {
    let size = a.len();
    let mut beside = vec![];
    for k in 0..size.saturating_sub(1) {
        let mut mirror: Vec<f64> = a[k + 1..].iter().map(|row| row[k]).collect();
        let length = norm(&mirror);
        let left = if mirror[0] > 0.0 { -length } else { length };
        beside.push(left);
        mirror[0] -= left;
        let scale = norm(&mirror);
        if scale == 0.0 {
            continue;
        }
        mirror.iter_mut().for_each(|v| *v /= scale);
        // A − 2vwᵀ − 2wvᵀ with w = Av − (vᵀAv)v is A reflected from both sides.
        let mut w: Vec<f64> = a[k + 1..].iter().map(|row| dot(&row[k + 1..], &mirror)).collect();
        let along = dot(&w, &mirror);
        w.iter_mut().zip(&mirror).for_each(|(w, v)| *w -= along * v);
        for (i, row) in a[k + 1..].iter_mut().enumerate() {
            let (own_v, own_w) = (2.0 * mirror[i], 2.0 * w[i]);
            row[k + 1..]
                .iter_mut()
                .zip(w.iter().zip(&mirror))
                .for_each(|(x, (w, v))| *x -= own_v * w + own_w * v);
        }
    }
    ((0..size).map(|i| a[i][i]).collect(), beside)
}

/// Eigenvalues of a symmetric tridiagonal matrix, and the first components of their eigenvectors.
///
/// The off-diagonal `beside` may be longer than needed.
pub(crate) fn eigenvalues_of_tridiagonal(
    mut diagonal: Vec<f64>,
    mut beside: Vec<f64>,
) -> (Vec<f64>, Vec<f64>) {
    let size = diagonal.len();
    beside.resize(size, 0.0);
    let mut first: Vec<f64> = (0..size).map(|i| if i == 0 { 1.0 } else { 0.0 }).collect();
    let mut end = size.saturating_sub(1);
    // Each eigenvalue takes two or three steps; failure to settle after 60 is rounding.
    for _ in 0..60 * size {
        while end > 0 && is_small(&diagonal, &beside, end - 1) {
            end -= 1;
        }
        if end == 0 {
            break;
        }
        let start = (0..end).rev().find(|i| is_small(&diagonal, &beside, *i)).map_or(0, |i| i + 1);
        implicit_step(&mut diagonal, &mut beside, &mut first, [start, end]);
    }
    (diagonal, first)
}

fn is_small(diagonal: &[f64], beside: &[f64], at: usize) -> bool {
    beside[at].abs() <= f64::EPSILON * (diagonal[at].abs() + diagonal[at + 1].abs())
        || beside[at].abs() < 1e-300
}

/// One QR step with an implicit shift on rows `start..=end`: a bulge beside the diagonals is chased out at
/// the end.
fn implicit_step(diagonal: &mut [f64], beside: &mut [f64], first: &mut [f64], [start, end]: [usize; 2]) {
    let half = 0.5 * (diagonal[end - 1] - diagonal[end]);
    let square = beside[end - 1] * beside[end - 1];
    let root = half.hypot(beside[end - 1]).copysign(half);
    let mut x = diagonal[start] - (diagonal[end] - square / (half + root));
    let mut bulge = beside[start];
    for k in start..end {
        let length = x.hypot(bulge);
        let (cos, sin) = if length > 0.0 { (x / length, bulge / length) } else { (1.0, 0.0) };
        if k > start {
            beside[k - 1] = length;
        }
        let (p, q, r) = (diagonal[k], beside[k], diagonal[k + 1]);
        diagonal[k] = cos * cos * p + 2.0 * cos * sin * q + sin * sin * r;
        diagonal[k + 1] = sin * sin * p - 2.0 * cos * sin * q + cos * cos * r;
        beside[k] = cos * sin * (r - p) + (cos * cos - sin * sin) * q;
        (first[k], first[k + 1]) = (cos * first[k] + sin * first[k + 1], cos * first[k + 1] - sin * first[k]);
        if k + 1 < end {
            x = beside[k];
            bulge = sin * beside[k + 1];
            beside[k + 1] *= cos;
        }
    }
}

fn norm(v: &[f64]) -> f64 {
    dot(v, v).sqrt()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn eigenvalues_have_their_closed_form_and_first_components_their_unit_length() {
        for size in [1_usize, 2, 3, 20, 104] {
            // 2 on the diagonal, −1 beside it: 2 − 2cos(πk/(n + 1)) with first components √(2/(n +
            // 1))·sin(πk/(n + 1)).
            let n = size as f64 + 1.0;
            let (mut values, first) = eigenvalues_of_tridiagonal(vec![2.0; size], vec![-1.0; size]);
            assert!((norm(&first) - 1.0).abs() < 1e-12);
            for (value, first) in values.iter().zip(&first) {
                let angle = (1.0 - 0.5 * value).clamp(-1.0, 1.0).acos();
                assert!(
                    (first.abs() - (2.0 / n).sqrt() * angle.sin()).abs() < 1e-9,
                    "{size}: {value}, {first}"
                );
            }
            values.sort_by(f64::total_cmp);
            for (k, value) in values.iter().enumerate() {
                assert!(
                    (value - 2.0 + 2.0 * (PI * (k as f64 + 1.0) / n).cos()).abs() < 1e-12,
                    "{size}: {value}"
                );
            }
        }
    }

    #[test]
    fn a_full_matrix_keeps_the_sums_of_all_powers_of_its_eigenvalues() {
        // min(i, j) has the eigenvalues 1/(4·sin²(π(2k − 1)/(4n + 2))).
        let size = 60;
        let entry = |i: usize, j: usize| (i.min(j) + 1) as f64;
        let mut got = eigenvalues((0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect());
        got.sort_by(|a, b| b.total_cmp(a));
        for (k, got) in got.into_iter().enumerate() {
            let asked = 0.25 / (PI * (2.0 * k as f64 + 1.0) / (4.0 * size as f64 + 2.0)).sin().powi(2);
            // Largest eigenvalue 1,484: ε of it, times the size.
            assert!((got - asked).abs() < 2e-11, "{k}: {got} against {asked}");
        }
    }
}
