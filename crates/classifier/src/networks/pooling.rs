//! The largest of each two cells and zero: rectifier and maximum in one.

use crate::networks::batch::Batch;

/// Rectifier and maximum in training.
#[derive(Debug, Clone, Default)]
pub(crate) struct PoolingLayer {
    /// Cells of the last input, and which of each two was taken: 0 neither, 1 the first, 2 the second.
    taken: Option<(usize, Vec<u8>)>,
}

impl PoolingLayer {
    pub(crate) fn forward(&mut self, batch: &Batch) -> Batch {
        let cells = batch.cells;
        let halves = || batch.values.chunks_exact(cells).flat_map(|row| row.chunks_exact(2));
        let which = |pair: &[f32]| match (pair[0] >= pair[1], pair[0].max(pair[1]) > 0.0) {
            (_, false) => 0,
            (true, true) => 1,
            (false, true) => 2,
        };
        self.taken = Some((cells, halves().map(which).collect()));
        let values = batch.values.chunks_exact(cells).flat_map(relu_max_pool);
        Batch { channels: batch.channels, cells: cells / 2, values: values.collect() }
    }

    pub(crate) fn backward(&mut self, gradients: &Batch) -> Batch {
        let Some((cells, taken)) = self.taken.take() else { return gradients.clone() };
        let half = gradients.cells;
        let mut values = vec![0.0; gradients.values.len() / half * cells];
        for (at, (gradient, which)) in gradients.values.iter().zip(taken).enumerate() {
            if which > 0 {
                values[at / half * cells + 2 * (at % half) + usize::from(which) - 1] = *gradient;
            }
        }
        Batch { channels: gradients.channels, cells, values }
    }
}

/// The largest of each two cells and zero; an odd last cell is ignored.
pub(crate) fn relu_max_pool(row: &[f32]) -> impl Iterator<Item = f32> {
    row.chunks_exact(2).map(|pair| pair[0].max(pair[1]).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gradient_goes_to_the_cell_that_was_taken() {
        let mut layer = PoolingLayer::default();
        let batch = Batch { channels: 2, cells: 5, values: vec![1., 2., -1., -2., 9., 4., 3., 0.5, 0., 9.] };
        let out = layer.forward(&batch);
        assert_eq!((out.cells, &out.values[..]), (2, &[2.0, 0.0, 4.0, 0.5][..]));
        let back = layer.backward(&Batch { channels: 2, cells: 2, values: vec![10., 20., 30., 40.] });
        assert_eq!(back.values, [0., 10., 0., 0., 0., 30., 0., 40., 0., 0.]);
    }
}
