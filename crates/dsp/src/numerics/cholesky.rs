//! Normal equations, small symmetric systems, by Cholesky factorisation (Golub, Van Loan, Matrix Computations
//! (2013), §4.2), scaled to a unit diagonal, since parameters have different units such as metres and
//! cosines.

/// Solves M·x = b for x; undetermined parameters (a zero on the diagonal of M) stay 0. `None` if two are
/// indistinguishable.
pub(crate) fn solve<const N: usize>(matrix: [[f64; N]; N], right: [f64; N]) -> Option<[f64; N]> {
    let largest = (0..N).map(|i| matrix[i][i]).fold(0.0, f64::max);
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let scale: [f64; N] =
        std::array::from_fn(|i| if matrix[i][i] > 0.0 { matrix[i][i].sqrt().recip() } else { 0.0 });
    let lower = factor::<N>(std::array::from_fn(|i| {
        std::array::from_fn(|j| if i == j { 1.0 } else { matrix[i][j] * scale[i] * scale[j] })
    }))?;
    let mut x: [f64; N] = std::array::from_fn(|i| right[i] * scale[i]);
    for i in 0..N {
        x[i] = (x[i] - (0..i).map(|k| lower[i][k] * x[k]).sum::<f64>()) / lower[i][i];
    }
    for i in (0..N).rev() {
        x[i] = (x[i] - (i + 1..N).map(|k| lower[k][i] * x[k]).sum::<f64>()) / lower[i][i];
    }
    Some(std::array::from_fn(|i| x[i] * scale[i]))
}

/// Distance from 1 within which correlation coefficients count as 1 up to rounding.
const DEPENDENT: f64 = 1e-12;

fn factor<const N: usize>(matrix: [[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let mut lower = [[0.0; N]; N];
    for i in 0..N {
        for j in 0..=i {
            let left = matrix[i][j] - (0..j).map(|k| lower[i][k] * lower[j][k]).sum::<f64>();
            lower[i][j] = match i == j {
                true if left > DEPENDENT => left.sqrt(),
                true => return None,
                false => left / lower[j][j],
            };
        }
    }
    Some(lower)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_with_units_decades_apart_is_solved_to_rounding() {
        // M = D·C·D with known x: the condition number of C is 5.
        let (d, c) = ([1e-6, 1.0, 1e7], [[1.0, 0.5, 0.2], [0.5, 1.0, -0.3], [0.2, -0.3, 1.0]]);
        let x = [3e5, -2.0, 4e-8];
        let m: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| d[i] * c[i][j] * d[j]));
        let b: [f64; 3] = std::array::from_fn(|i| (0..3).map(|j| m[i][j] * x[j]).sum());
        let got = solve(m, b).unwrap();
        for i in 0..3 {
            assert!((got[i] / x[i] - 1.0).abs() < 1e-14, "asked {}, got {}", x[i], got[i]);
        }
    }

    #[test]
    fn unknown_parameters_stay_and_dependent_ones_are_refused() {
        assert_eq!(solve([[4.0, 0.0], [0.0, 0.0]], [2.0, 0.0]), Some([0.5, 0.0]));
        assert_eq!(solve([[1.0, 1.0], [1.0, 1.0]], [1.0, 1.0]), None);
        assert_eq!(solve([[0.0]], [0.0]), None);
        assert_eq!(solve([[f64::NAN]], [0.0]), None);
    }
}
