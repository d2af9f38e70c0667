//! Sums over orders, and means over frequency, of S by order.

use num_complex::Complex64;

/// Mean over frequency of the power of a sum over orders.
pub(crate) fn power_of(orders: &[Vec<Complex64>]) -> f64 {
    mean_over_frequencies(orders.first().map_or(0, Vec::len), |f| total(orders, f))
}

/// Sum over orders at one frequency.
pub(crate) fn total(orders: &[Vec<Complex64>], frequency: usize) -> Complex64 {
    orders.iter().map(|order| order[frequency]).sum()
}

/// Values shifted by the difference of `to` from `from`, order by order.
pub(crate) fn moved(
    mut of: Vec<Vec<Complex64>>,
    from: &[Vec<Complex64>],
    to: &[Vec<Complex64>],
) -> Vec<Vec<Complex64>> {
    let all = of.iter_mut().flatten().zip(from.iter().flatten().zip(to.iter().flatten()));
    all.for_each(|(value, (from, to))| *value += to - from);
    of
}

/// Mean over frequency of the power of a difference of sums over orders.
pub(crate) fn power_between(a: &[Vec<Complex64>], b: &[Vec<Complex64>]) -> f64 {
    mean_over_frequencies(a.first().map_or(0, Vec::len), |f| total(a, f) - total(b, f))
}

pub(crate) fn mean_over_frequencies(count: usize, of: impl Fn(usize) -> Complex64) -> f64 {
    (0..count).map(|f| of(f).norm_sqr()).sum::<f64>() / count.max(1) as f64
}

/// S by order over all frequencies, from that of bands, each with the indices of its frequencies.
pub(crate) fn of_bands<'a>(
    bands: impl Iterator<Item = (&'a Vec<usize>, &'a Vec<Vec<Complex64>>)>,
) -> Vec<Vec<Complex64>> {
    let mut all: Vec<Vec<Complex64>> = Vec::new();
    for (indices, orders) in bands {
        all.resize(all.len().max(orders.len()), Vec::new());
        for (whole, of_band) in all.iter_mut().zip(orders) {
            for (&index, s) in indices.iter().zip(of_band) {
                whole.resize(whole.len().max(index + 1), Complex64::ZERO);
                whole[index] = *s;
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_fill_the_places_of_their_frequencies() {
        let order = |values: &[f64]| values.iter().map(|re| Complex64::from(*re)).collect::<Vec<_>>();
        let bands = [
            (vec![1, 3], vec![order(&[1.0, 3.0]), order(&[-1.0, -3.0])]),
            (vec![0, 2], vec![order(&[0.0, 2.0]), order(&[0.0, -2.0])]),
        ];
        let all = of_bands(bands.iter().map(|(indices, orders)| (indices, orders)));
        assert_eq!(all, [order(&[0.0, 1.0, 2.0, 3.0]), order(&[0.0, -1.0, -2.0, -3.0])]);
        assert_eq!([power_of(&all), total(&all, 2).re], [0.0; 2]);
    }
}
