//! Fully connected layer.

use crate::networks::batch::{Batch, add_scaled, dot};
use crate::networks::optimizer::Parameter;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// A fully connected layer in training.
#[derive(Debug, Clone)]
pub(crate) struct DenseLayer {
    /// Weights `[output, input]`.
    pub(crate) weights: Parameter,
    pub(crate) bias: Parameter,
    /// Input of the last forward pass.
    input: Option<Batch>,
}

impl DenseLayer {
    pub(crate) fn random_init(inputs: usize, outputs: usize, random: &mut ChaCha8Rng) -> Self {
        let weights = Parameter::random_init(outputs * inputs, inputs, random);
        Self { weights, bias: Parameter::random_init(outputs, inputs, random), input: None }
    }

    pub(crate) fn forward(&mut self, input: Batch) -> Batch {
        let (weights, bias) = (&self.weights.values, &self.bias.values);
        let rows = input.values.par_chunks_exact(input.size());
        let rows: Vec<Vec<f32>> = rows.map(|row| connected(row, weights, bias)).collect();
        let output = Batch { channels: bias.len(), cells: 1, values: rows.concat() };
        self.input = Some(input);
        output
    }

    /// Gradient by the input from that by the output; those by the parameters are kept in them.
    pub(crate) fn backward(&mut self, output: &Batch) -> Batch {
        let Some(input) = self.input.take() else { return output.zeros() };
        let size = input.size();
        let of_output = |(number, weights): (usize, &mut [f32])| {
            weights.fill(0.0);
            for (row, gradients) in input.rows().zip(output.rows()) {
                add_scaled(weights, gradients[number], row);
            }
        };
        self.weights.gradient.par_chunks_exact_mut(size).enumerate().for_each(of_output);
        for (number, bias) in self.bias.gradient.iter_mut().enumerate() {
            *bias = output.rows().map(|gradients| gradients[number]).sum();
        }
        let back = |gradients: &[f32]| {
            let mut row = vec![0.0; size];
            for (gradient, weights) in gradients.iter().zip(self.weights.values.chunks_exact(size)) {
                add_scaled(&mut row, *gradient, weights);
            }
            row
        };
        let rows: Vec<Vec<f32>> = output.values.par_chunks_exact(output.size()).map(back).collect();
        Batch { channels: input.channels, cells: input.cells, values: rows.concat() }
    }
}

/// Outputs of a fully connected layer for one sample.
pub(crate) fn connected(row: &[f32], weights: &[f32], bias: &[f32]) -> Vec<f32> {
    weights.chunks_exact(row.len()).zip(bias).map(|(weights, bias)| bias + dot(weights, row)).collect()
}
