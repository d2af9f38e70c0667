//! Gauss quadrature over a set of points: Lanczos's recursion yields the Jacobi matrix, whose eigenvalues and
//! first eigenvector components are the rule (Golub, Welsch, Math. Comp. 23 (1969) 221).

use crate::numerics::symmetric_qr::eigenvalues_of_tridiagonal;

/// Nodes and weights of Gauss's rule over equally weighted points.
pub(crate) fn gauss_nodes(points: &[f64], nodes: usize) -> Vec<(f64, f64)> {
    let mut before = vec![0.0; points.len()];
    let mut vector = vec![(points.len() as f64).sqrt().recip(); points.len()];
    let (mut diagonal, mut beside, mut link) = (vec![], vec![], 0.0_f64);
    for _ in 0..nodes.min(points.len()) {
        let mean: f64 = vector.iter().zip(points).map(|(v, p)| v * v * p).sum();
        diagonal.push(mean);
        let next = |i: usize| (points[i] - mean) * vector[i] - link * before[i];
        let next: Vec<f64> = (0..points.len()).map(next).collect();
        link = next.iter().map(|x| x * x).sum::<f64>().sqrt();
        // All moments are exhausted: there are no more distinct points.
        if link < 1e-7 {
            break;
        }
        beside.push(link);
        before = std::mem::replace(&mut vector, next.iter().map(|x| x / link).collect());
    }
    let (values, first) = eigenvalues_of_tridiagonal(diagonal, beside);
    values.into_iter().zip(first.into_iter().map(|f| f * f)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fewer_different_points_than_nodes_are_returned_themselves() {
        let nodes = gauss_nodes(&[1.0; 13], 8);
        assert_eq!(nodes.len(), 1);
        assert!((nodes[0].0 - 1.0).abs() < 1e-14 && (nodes[0].1 - 1.0).abs() < 1e-14);
    }

    #[test]
    fn gauss_nodes_keep_the_powers_of_their_points() {
        let points: Vec<f64> = (0..40).map(|i| 0.05 + f64::from(i * i) / 400.0).collect();
        let nodes = gauss_nodes(&points, 8);
        for power in 0..16 {
            let asked = points.iter().map(|x| x.powi(power)).sum::<f64>() / 40.0;
            let got: f64 = nodes.iter().map(|(x, w)| w * x.powi(power)).sum();
            assert!((got / asked - 1.0).abs() < 1e-9, "power {power}: {got} against {asked}");
        }
    }
}
