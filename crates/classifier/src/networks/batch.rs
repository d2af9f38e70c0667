//! Values of a batch of samples, and the sums that all layers take over them.

/// Values `[sample, channel, cell]`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Batch {
    pub(crate) channels: usize,
    pub(crate) cells: usize,
    pub(crate) values: Vec<f32>,
}

impl Batch {
    /// Number of values of one sample.
    pub(crate) fn size(&self) -> usize {
        self.channels * self.cells
    }

    /// Number of samples.
    pub(crate) fn samples(&self) -> usize {
        self.values.len() / self.size().max(1)
    }

    /// Values of each sample.
    pub(crate) fn rows(&self) -> std::slice::ChunksExact<'_, f32> {
        self.values.chunks_exact(self.size())
    }

    /// A batch of zeros of the same shape.
    pub(crate) fn zeros(&self) -> Self {
        Self { values: vec![0.0; self.values.len()], ..*self }
    }
}

/// Number of partial sums of a scalar product: one vector register of eight.
const LANES: usize = 8;

/// Scalar product, summed in eight parts in a fixed order.
pub(crate) fn dot(a: &[f32], b: &[f32]) -> f32 {
    let mut sums = [0.0_f32; LANES];
    let (wide_a, wide_b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f32 = wide_a.remainder().iter().zip(wide_b.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in wide_a.zip(wide_b) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    sums.iter().sum::<f32>() + rest
}

/// Adds `factor` times the other values.
pub(crate) fn add_scaled(sums: &mut [f32], factor: f32, values: &[f32]) {
    sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += factor * value);
}

/// The overlapping parts of two rows when the second is read `shift` cells further on.
pub(crate) fn overlap(cells: usize, shift: isize) -> [std::ops::Range<usize>; 2] {
    let by = shift.unsigned_abs().min(cells);
    if shift >= 0 { [0..cells - by, by..cells] } else { [by..cells, 0..cells - by] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scalar_product_takes_every_value_once() {
        let a: Vec<f32> = (0..21).map(|i| i as f32).collect();
        assert_eq!(dot(&a, &a), (0..21).map(|i| (i * i) as f32).sum::<f32>());
        assert_eq!(dot(&a[..3], &a[1..4]), 0.0 + 2.0 + 6.0);
    }

    #[test]
    fn rows_overlap_by_their_length_less_the_shift() {
        assert_eq!(overlap(5, 2), [0..3, 2..5]);
        assert_eq!(overlap(5, -2), [2..5, 0..3]);
        assert_eq!(overlap(2, 3), [0..0, 2..2]);
    }
}
