//! Dropout (Srivastava and others, J. Mach. Learn. Res. 15 (2014) 1929): in training, values are zero by
//! chance, and the others larger, so that their mean stays.

use crate::networks::batch::Batch;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Factors of the last forward pass.
#[derive(Debug, Clone, Default)]
pub(crate) struct DropoutLayer {
    factors: Vec<f32>,
}

impl DropoutLayer {
    pub(crate) fn forward(&mut self, mut batch: Batch, dropped: f32, random: &mut ChaCha8Rng) -> Batch {
        let kept = 1.0 / (1.0 - dropped);
        let factor = |_: &f32| if random.random::<f32>() < dropped { 0.0 } else { kept };
        self.factors = batch.values.iter().map(factor).collect();
        batch.values.iter_mut().zip(&self.factors).for_each(|(value, factor)| *value *= factor);
        batch
    }

    pub(crate) fn backward(&self, mut gradients: Batch) -> Batch {
        gradients.values.iter_mut().zip(&self.factors).for_each(|(gradient, factor)| *gradient *= factor);
        gradients
    }
}
