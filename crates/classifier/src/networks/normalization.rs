//! Batch normalization (Ioffe & Szegedy, arXiv:1502.03167): every channel has mean zero and variance one over
//! the batch, then a learned scale and offset.

use crate::crops::network::VARIANCE_FLOOR;
use crate::networks::batch::Batch;
use crate::networks::optimizer::Parameter;

/// Share of a new batch in the running mean and variance.
const NEW_SHARE: f64 = 0.1;

/// Batch normalization in training.
#[derive(Debug, Clone)]
pub(crate) struct NormalizationLayer {
    pub(crate) scale: Parameter,
    pub(crate) offset: Parameter,
    /// Running mean and variance of each channel.
    mean: Vec<f64>,
    variance: Vec<f64>,
    /// Normalized values, and the reciprocal root of each channel's variance, of the last forward pass.
    normal: Option<(Batch, Vec<f32>)>,
}

impl NormalizationLayer {
    pub(crate) fn new(channels: usize) -> Self {
        Self {
            scale: Parameter::of(vec![1.0; channels]),
            offset: Parameter::of(vec![0.0; channels]),
            mean: vec![0.0; channels],
            variance: vec![1.0; channels],
            normal: None,
        }
    }

    pub(crate) fn forward(&mut self, mut batch: Batch) -> Batch {
        let (cells, channels) = (batch.cells, batch.channels);
        let count = (batch.samples() * cells) as f64;
        let mut roots = Vec::with_capacity(channels);
        for channel in 0..channels {
            let sum = |power: i32, centre: f64| {
                each(&batch, channel).map(|v| (f64::from(*v) - centre).powi(power)).sum::<f64>() / count
            };
            let mean = sum(1, 0.0);
            let variance = sum(2, mean);
            let unbiased = variance * count / (count - 1.0).max(1.0);
            self.mean[channel] += NEW_SHARE * (mean - self.mean[channel]);
            self.variance[channel] += NEW_SHARE * (unbiased - self.variance[channel]);
            let root = (1.0 / (variance + f64::from(VARIANCE_FLOOR)).sqrt()) as f32;
            each_mut(&mut batch, channel).for_each(|value| *value = (*value - mean as f32) * root);
            roots.push(root);
        }
        let normal = batch.clone();
        for channel in 0..channels {
            let (scale, offset) = (self.scale.values[channel], self.offset.values[channel]);
            each_mut(&mut batch, channel).for_each(|value| *value = scale * *value + offset);
        }
        self.normal = Some((normal, roots));
        batch
    }

    /// Gradient by the input from that by the output: γ/σ (g − mean of g − x̂ · mean of g x̂).
    pub(crate) fn backward(&mut self, mut gradients: Batch) -> Batch {
        let Some((normal, roots)) = self.normal.take() else { return gradients };
        let count = (gradients.samples() * gradients.cells) as f64;
        for (channel, root) in roots.iter().enumerate() {
            let of_offset: f64 = each(&gradients, channel).map(|g| f64::from(*g)).sum();
            let pairs = each(&gradients, channel).zip(each(&normal, channel));
            let of_scale: f64 = pairs.map(|(g, x)| f64::from(*g) * f64::from(*x)).sum();
            (self.offset.gradient[channel], self.scale.gradient[channel]) =
                (of_offset as f32, of_scale as f32);
            let factor = self.scale.values[channel] * root;
            let [mean, along] = [of_offset, of_scale].map(|sum| (sum / count) as f32);
            for (gradient, x) in each_mut(&mut gradients, channel).zip(each(&normal, channel)) {
                *gradient = factor * (*gradient - mean - x * along);
            }
        }
        gradients
    }

    /// Factor and addend that the layer is for a channel after training, by the running mean and variance.
    pub(crate) fn merged(&self, channel: usize) -> [f32; 2] {
        let root = (self.variance[channel] + f64::from(VARIANCE_FLOOR)).sqrt();
        let factor = f64::from(self.scale.values[channel]) / root;
        let addend = f64::from(self.offset.values[channel]) - self.mean[channel] * factor;
        [factor as f32, addend as f32]
    }
}

fn each(batch: &Batch, channel: usize) -> impl Iterator<Item = &f32> {
    let cells = batch.cells;
    batch.rows().flat_map(move |row| &row[channel * cells..][..cells])
}

fn each_mut(batch: &mut Batch, channel: usize) -> impl Iterator<Item = &mut f32> {
    let (cells, size) = (batch.cells, batch.size());
    batch.values.chunks_exact_mut(size).flat_map(move |row| &mut row[channel * cells..][..cells])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_channel_has_mean_zero_and_variance_one_before_scale_and_offset() {
        let mut layer = NormalizationLayer::new(2);
        layer.scale.values[1] = 3.0;
        layer.offset.values[1] = -1.0;
        let values = vec![1.0, 3.0, 10.0, 10.5, 5.0, 7.0, 11.0, 11.5];
        let out = layer.forward(Batch { channels: 2, cells: 2, values });
        let of = |channel: usize| each(&out, channel).map(|v| f64::from(*v)).collect::<Vec<f64>>();
        for (channel, [mean, deviation]) in [(0, [0.0, 1.0]), (1, [-1.0, 3.0])] {
            let values = of(channel);
            let got = values.iter().sum::<f64>() / 4.0;
            let spread = (values.iter().map(|v| (v - got).powi(2)).sum::<f64>() / 4.0).sqrt();
            assert!((got - mean).abs() < 1e-5 && (spread - deviation).abs() < 1e-3, "{values:?}");
        }
    }

    #[test]
    fn merged_it_is_what_it_does_to_batches_like_those_it_has_seen() {
        let mut layer = NormalizationLayer::new(1);
        layer.scale.values[0] = 2.0;
        let batch = Batch { channels: 1, cells: 4, values: vec![3.0, 5.0, 7.0, 9.0] };
        for _ in 0..300 {
            layer.forward(batch.clone());
        }
        let [factor, addend] = layer.merged(0);
        let out = layer.forward(batch.clone());
        for (input, output) in batch.values.iter().zip(&out.values) {
            // The running variance is the unbiased one: 4/3 of that of the batch.
            let expected = output * 0.75_f32.sqrt();
            assert!((factor * input + addend - expected).abs() < 1e-3, "{input}: {expected}");
        }
    }
}
