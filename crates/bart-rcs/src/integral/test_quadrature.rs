//! Gauss–Legendre rules, the brute-force reference for closed forms.

/// Nodes and weights on [−1, 1] by Newton's method on Legendre's polynomial.
pub(crate) fn gauss_legendre(n: usize) -> (Vec<f64>, Vec<f64>) {
    (1..=n).map(|i| node_and_weight(n, i)).unzip()
}

fn node_and_weight(n: usize, i: usize) -> (f64, f64) {
    let mut x = (std::f64::consts::PI * (i as f64 - 0.25) / (n as f64 + 0.5)).cos();
    for _ in 0..50 {
        let (value, slope) = legendre(n, x);
        x -= value / slope;
    }
    let slope = legendre(n, x).1;
    (x, 2.0 / ((1.0 - x * x) * slope * slope))
}

/// P_n(x) and its derivative.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    (value, n as f64 * (x * value - before) / (x * x - 1.0))
}
