//! Convolution along range that keeps the number of cells; beyond the ends there are zeros.

use crate::networks::batch::{Batch, add_scaled, dot, overlap};
use crate::networks::optimizer::Parameter;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// A convolution in training.
#[derive(Debug, Clone)]
pub(crate) struct ConvolutionLayer {
    pub(crate) inputs: usize,
    pub(crate) taps: usize,
    /// Weights `[output, input, tap]`.
    pub(crate) weights: Parameter,
    pub(crate) bias: Parameter,
    /// Input of the last forward pass.
    input: Option<Batch>,
}

impl ConvolutionLayer {
    pub(crate) fn random_init(inputs: usize, outputs: usize, taps: usize, random: &mut ChaCha8Rng) -> Self {
        Self {
            inputs,
            taps,
            weights: Parameter::random_init(outputs * inputs * taps, inputs * taps, random),
            bias: Parameter::random_init(outputs, inputs * taps, random),
            input: None,
        }
    }

    pub(crate) fn forward(&mut self, input: Batch) -> Batch {
        let (weights, bias) = (&self.weights.values, &self.bias.values);
        let rows: Vec<Vec<f32>> = input
            .values
            .par_chunks_exact(input.size())
            .map(|sample| convolved(sample, input.cells, weights, bias))
            .collect();
        let output = Batch { channels: bias.len(), cells: input.cells, values: rows.concat() };
        self.input = Some(input);
        output
    }

    /// Gradient by the input from that by the output; those by the parameters are kept in them.
    pub(crate) fn backward(&mut self, output: &Batch) -> Batch {
        let Some(input) = self.input.take() else { return output.zeros() };
        let (inputs, taps, cells) = (self.inputs, self.taps, input.cells);
        let size = inputs * taps;
        let of_output = |(number, kernel): (usize, &mut [f32])| {
            kernel.fill(0.0);
            for (sample, gradients) in input.rows().zip(output.rows()) {
                let gradients = &gradients[number * cells..][..cells];
                for (at, weight) in kernel.iter_mut().enumerate() {
                    let [of_gradients, of_row] = overlap(cells, shift(at % taps, taps));
                    let row = &sample[at / taps * cells..][..cells];
                    *weight += dot(&gradients[of_gradients], &row[of_row]);
                }
            }
        };
        self.weights.gradient.par_chunks_exact_mut(size).enumerate().for_each(of_output);
        for (number, bias) in self.bias.gradient.iter_mut().enumerate() {
            *bias = output.rows().map(|row| row[number * cells..][..cells].iter().sum::<f32>()).sum();
        }
        let weights = &self.weights.values;
        let rows: Vec<Vec<f32>> = output
            .values
            .par_chunks_exact(output.size())
            .map(|gradients| input_gradients(gradients, cells, weights, [inputs, taps]))
            .collect();
        Batch { channels: inputs, cells, values: rows.concat() }
    }
}

/// Cells by which a tap looks further on.
fn shift(tap: usize, taps: usize) -> isize {
    tap as isize - (taps / 2) as isize
}

/// One sample `[input, cell]` convolved with the weights `[output, input, tap]`: `[output, cell]`.
pub(crate) fn convolved(sample: &[f32], cells: usize, weights: &[f32], bias: &[f32]) -> Vec<f32> {
    let inputs = sample.len() / cells;
    let taps = weights.len() / (inputs * bias.len()).max(1);
    let mut all = Vec::with_capacity(bias.len() * cells);
    for (kernels, bias) in weights.chunks_exact(inputs * taps).zip(bias) {
        let mut output = vec![*bias; cells];
        for (row, kernel) in sample.chunks_exact(cells).zip(kernels.chunks_exact(taps)) {
            for (tap, weight) in kernel.iter().enumerate() {
                let [of_output, of_row] = overlap(cells, shift(tap, taps));
                add_scaled(&mut output[of_output], *weight, &row[of_row]);
            }
        }
        all.extend(output);
    }
    all
}

/// Gradient by one sample's input, `[input, cell]`.
fn input_gradients(gradients: &[f32], cells: usize, weights: &[f32], [inputs, taps]: [usize; 2]) -> Vec<f32> {
    let mut all = vec![0.0; inputs * cells];
    for (gradients, kernels) in gradients.chunks_exact(cells).zip(weights.chunks_exact(inputs * taps)) {
        for (row, kernel) in all.chunks_exact_mut(cells).zip(kernels.chunks_exact(taps)) {
            for (tap, weight) in kernel.iter().enumerate() {
                let [of_gradients, of_row] = overlap(cells, shift(tap, taps));
                add_scaled(&mut row[of_row], *weight, &gradients[of_gradients]);
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tap_before_the_middle_looks_at_the_cell_before() {
        let row = [1.0, 2.0, 3.0, 4.0];
        assert_eq!(convolved(&row, 4, &[1.0, 0.0, 0.0], &[0.5]), [0.5, 1.5, 2.5, 3.5]);
        assert_eq!(convolved(&row, 4, &[0.0, 0.0, 1.0], &[0.0]), [2.0, 3.0, 4.0, 0.0]);
        assert_eq!(
            convolved(&[1.0, 2.0, 10.0, 20.0], 2, &[0.0, 1.0, 0.0, 0.0, 2.0, 0.0], &[0.0]),
            [21.0, 42.0]
        );
    }
}
