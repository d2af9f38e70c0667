//! Training of one network over range cells, by backpropagation.

use crate::crops::classify::softmax;
use crate::networks::batch::Batch;
use crate::networks::convolution::ConvolutionLayer;
use crate::networks::dense::DenseLayer;
use crate::networks::dropout::DropoutLayer;
use crate::networks::normalization::NormalizationLayer;
use crate::networks::optimizer::{Parameter, rate};
use crate::networks::pooling::PoolingLayer;
use crate::signatures::cells::{CELLS, OF_CELLS, OF_OBJECT};
use artifact::model::{Convolution, Dense, ProfileNetwork};
use artifact::seed;
use artifact::settings::Class;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

/// Settings for training a network.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct NetworkSettings {
    /// Outputs of the convolutions.
    pub channels: [usize; 3],
    /// Taps of the convolutions, odd numbers.
    pub taps: [usize; 3],
    /// Outputs of the first fully connected layer.
    pub hidden: usize,
    /// Share of the inputs of both fully connected layers that are dropped.
    pub dropped: f32,
    /// Number of passes over all examples.
    pub epochs: u32,
    /// Number of examples of a step.
    pub batch: usize,
    /// Least number of steps: few examples are passed more often.
    pub least_steps: u32,
    /// Largest learning rate.
    pub rate: f64,
    /// Decay of the weights.
    pub weight_decay: f64,
    /// Share of the target probability that is spread evenly over the classes (Szegedy and others,
    /// arXiv:1512.00567, section 7).
    pub smoothing: f64,
}

/// Inputs, classes and weights of the examples.
pub(crate) struct Examples<'a> {
    pub(crate) inputs: Vec<&'a [f32]>,
    pub(crate) classes: Vec<usize>,
    pub(crate) weights: Vec<f64>,
}

/// Trains a network; `heard` receives it after each pass over the examples.
///
/// The same examples, settings and seed give the same network on any number of threads.
pub(crate) fn trained_network(
    examples: &Examples<'_>,
    settings: &NetworkSettings,
    seed: u64,
    heard: &mut dyn FnMut(&ProfileNetwork),
) -> ProfileNetwork {
    let mut random = ChaCha8Rng::from_seed(seed::key(seed, "classifier/profile-network", &[]));
    let mut network = TrainingNetwork::random_init(settings, &mut random);
    let batch = settings.batch.min(examples.inputs.len()).max(1);
    let in_pass = (examples.inputs.len() / batch).max(1) as u32;
    // Few examples are passed several times in an epoch.
    let repeats = settings.least_steps.div_ceil(in_pass * settings.epochs).max(1);
    let steps = settings.epochs * repeats * in_pass;
    let mut order: Vec<usize> = (0..examples.inputs.len()).collect();
    let mut step = 0;
    for _ in 0..settings.epochs {
        for _ in 0..repeats {
            order.shuffle(&mut random);
            for taken in order.chunks_exact(batch) {
                network.compute_gradients(examples, taken, settings, &mut random);
                network.step(step, rate(step, steps, settings.rate), settings.weight_decay);
                step += 1;
            }
        }
        heard(&network.merged());
    }
    network.merged()
}

/// Convolution, batch normalization, rectifier and maximum.
struct Block {
    convolution: ConvolutionLayer,
    normalization: NormalizationLayer,
    pooling: PoolingLayer,
}

/// A network in training.
struct TrainingNetwork {
    blocks: Vec<Block>,
    before_hidden: DropoutLayer,
    hidden: DenseLayer,
    /// Whether each output of the hidden layer was above zero.
    passed: Vec<bool>,
    before_output: DropoutLayer,
    output: DenseLayer,
}

impl TrainingNetwork {
    fn random_init(settings: &NetworkSettings, random: &mut ChaCha8Rng) -> Self {
        let (mut inputs, mut cells, mut blocks) = (OF_CELLS.len(), CELLS, Vec::new());
        for (outputs, taps) in settings.channels.into_iter().zip(settings.taps) {
            blocks.push(Block {
                convolution: ConvolutionLayer::random_init(inputs, outputs, taps, random),
                normalization: NormalizationLayer::new(outputs),
                pooling: PoolingLayer::default(),
            });
            (inputs, cells) = (outputs, cells / 2);
        }
        Self {
            blocks,
            before_hidden: DropoutLayer::default(),
            hidden: DenseLayer::random_init(inputs * cells + OF_OBJECT.len(), settings.hidden, random),
            passed: vec![],
            before_output: DropoutLayer::default(),
            output: DenseLayer::random_init(settings.hidden, Class::ALL.len(), random),
        }
    }

    /// Logits of examples, `[sample, class]`.
    fn forward(&mut self, rows: &[&[f32]], dropped: f32, random: &mut ChaCha8Rng) -> Batch {
        let of_cells = OF_CELLS.len() * CELLS;
        let values = rows.iter().flat_map(|row| &row[..of_cells]).copied().collect();
        let mut batch = Batch { channels: OF_CELLS.len(), cells: CELLS, values };
        for Block { convolution, normalization, pooling } in &mut self.blocks {
            batch = pooling.forward(&normalization.forward(convolution.forward(batch)));
        }
        let joined = batch.rows().zip(rows).flat_map(|(maps, row)| maps.iter().chain(&row[of_cells..]));
        let values: Vec<f32> = joined.copied().collect();
        let flat = Batch { channels: batch.size() + OF_OBJECT.len(), cells: 1, values };
        let mut hidden = self.hidden.forward(self.before_hidden.forward(flat, dropped, random));
        self.passed = hidden.values.iter().map(|value| *value > 0.0).collect();
        hidden.values.iter_mut().for_each(|value| *value = value.max(0.0));
        self.output.forward(self.before_output.forward(hidden, dropped, random))
    }

    /// Gradients by all parameters, from those by the logits.
    fn backward(&mut self, logits: &Batch) {
        let mut hidden = self.before_output.backward(self.output.backward(logits));
        hidden.values.iter_mut().zip(&self.passed).for_each(|(gradient, passed)| {
            *gradient = if *passed { *gradient } else { 0.0 };
        });
        let flat = self.before_hidden.backward(self.hidden.backward(&hidden));
        let channels = self.blocks.last().map_or(0, |block| block.convolution.bias.values.len());
        let cells = CELLS >> self.blocks.len();
        let values = flat.rows().flat_map(|row| &row[..channels * cells]).copied().collect();
        let mut batch = Batch { channels, cells, values };
        for Block { convolution, normalization, pooling } in self.blocks.iter_mut().rev() {
            batch = convolution.backward(&normalization.backward(pooling.backward(&batch)));
        }
    }

    /// Gradients of the loss of some examples; returns the loss.
    fn compute_gradients(
        &mut self,
        examples: &Examples<'_>,
        taken: &[usize],
        settings: &NetworkSettings,
        random: &mut ChaCha8Rng,
    ) -> f64 {
        let rows: Vec<&[f32]> = taken.iter().map(|example| examples.inputs[*example]).collect();
        let mut logits = self.forward(&rows, settings.dropped, random);
        let mut loss = 0.0;
        for (row, example) in logits.values.chunks_exact_mut(Class::ALL.len()).zip(taken) {
            let weight = examples.weights[*example] / taken.len() as f64;
            let probabilities = softmax(std::array::from_fn(|class| row[class]));
            for (class, gradient) in row.iter_mut().enumerate() {
                let target = target(class, examples.classes[*example], settings.smoothing);
                loss -= weight * target * probabilities[class].max(f64::MIN_POSITIVE).ln();
                *gradient = (weight * (probabilities[class] - target)) as f32;
            }
        }
        self.backward(&logits);
        loss
    }

    fn parameters(&mut self) -> Vec<&mut Parameter> {
        let mut all = Vec::new();
        for Block { convolution, normalization, .. } in &mut self.blocks {
            all.extend([&mut convolution.weights, &mut convolution.bias]);
            all.extend([&mut normalization.scale, &mut normalization.offset]);
        }
        for layer in [&mut self.hidden, &mut self.output] {
            all.extend([&mut layer.weights, &mut layer.bias]);
        }
        all
    }

    fn step(&mut self, step: u32, rate: f64, weight_decay: f64) {
        self.parameters().into_iter().for_each(|parameter| parameter.step(step + 1, rate, weight_decay));
    }

    /// The network for inference, batch normalization merged into the convolutions.
    fn merged(&self) -> ProfileNetwork {
        let convolutions = self.blocks.iter().map(|Block { convolution, normalization, .. }| {
            let size = convolution.inputs * convolution.taps;
            let (mut weights, mut bias) =
                (convolution.weights.values.clone(), convolution.bias.values.clone());
            for (channel, (kernel, bias)) in weights.chunks_exact_mut(size).zip(&mut bias).enumerate() {
                let [factor, addend] = normalization.merged(channel);
                kernel.iter_mut().for_each(|weight| *weight *= factor);
                *bias = *bias * factor + addend;
            }
            Convolution { inputs: convolution.inputs as u32, taps: convolution.taps as u32, weights, bias }
        });
        let dense = |layer: &DenseLayer| Dense {
            weights: layer.weights.values.clone(),
            bias: layer.bias.values.clone(),
        };
        ProfileNetwork {
            convolutions: convolutions.collect(),
            hidden: dense(&self.hidden),
            output: dense(&self.output),
        }
    }
}

/// Target probability of a class.
fn target(class: usize, truth: usize, smoothing: f64) -> f64 {
    let is = f64::from(u8::from(class == truth));
    is * (1.0 - smoothing) + smoothing / Class::ALL.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::networks::profile_network::member_logits;
    use crate::signatures::cells::INPUTS;
    use rand::RngExt;

    const SETTINGS: NetworkSettings = NetworkSettings {
        channels: [4, 4, 6],
        taps: [5, 3, 3],
        hidden: 8,
        dropped: 0.0,
        epochs: 8,
        batch: 16,
        least_steps: 0,
        rate: 1e-2,
        weight_decay: 1e-2,
        smoothing: 0.05,
    };

    /// Noise with a bump whose place along range tells the class.
    fn drawn(count: usize, seed: u64) -> (Vec<Vec<f32>>, Vec<usize>) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let classes: Vec<usize> = (0..count).map(|i| i % 4).collect();
        let one = |class: &usize| {
            let mut inputs: Vec<f32> = (0..INPUTS).map(|_| random.random_range(-0.3..0.3)).collect();
            let at = 8 + 20 * class + random.random_range(0..6_usize);
            inputs[at..at + 4].iter_mut().for_each(|value| *value += 1.0);
            inputs
        };
        (classes.iter().map(one).collect(), classes)
    }

    fn examples<'a>(inputs: &'a [Vec<f32>], classes: &[usize]) -> Examples<'a> {
        let weights = (0..classes.len()).map(|i| 0.5 + (i % 3) as f64 / 2.0).collect();
        Examples { inputs: inputs.iter().map(Vec::as_slice).collect(), classes: classes.to_vec(), weights }
    }

    /// Loss of a batch; it also leaves its gradients in the parameters.
    fn loss(network: &mut TrainingNetwork, examples: &Examples<'_>) -> f64 {
        let all: Vec<usize> = (0..examples.inputs.len()).collect();
        network.compute_gradients(examples, &all, &SETTINGS, &mut ChaCha8Rng::seed_from_u64(1))
    }

    #[test]
    fn gradients_are_the_differences_of_the_loss() {
        let (inputs, classes) = drawn(12, 3);
        let examples = examples(&inputs, &classes);
        let mut network = TrainingNetwork::random_init(&SETTINGS, &mut ChaCha8Rng::seed_from_u64(2));
        loss(&mut network, &examples);
        let told: Vec<Vec<f32>> = network.parameters().iter().map(|p| p.gradient.clone()).collect();
        let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
        for (number, gradient) in told.iter().enumerate() {
            for at in [0, gradient.len() / 2, gradient.len() - 1] {
                let step = 3e-4_f32;
                let mut moved = |by: f32| {
                    network.parameters()[number].values[at] += by;
                    let loss = loss(&mut network, &examples);
                    network.parameters()[number].values[at] -= by;
                    loss
                };
                let slope = (moved(step) - moved(-step)) / (2.0 * f64::from(step));
                worst = worst.max((slope - f64::from(gradient[at])).abs());
                largest = largest.max(slope.abs());
            }
        }
        println!("largest slope {largest:.2e}, largest difference {worst:.2e}");
        // The rounding of single precision over the step is some 1e-4.
        assert!(largest > 1e-2 && worst < 3e-4, "{worst} of {largest}");
    }

    #[test]
    fn classes_that_a_place_along_range_tells_are_learned_and_told_of_unseen_examples() {
        let (inputs, classes) = drawn(200, 5);
        let mut passes = 0;
        let network = trained_network(&examples(&inputs, &classes), &SETTINGS, 1, &mut |_| passes += 1);
        assert_eq!(passes, SETTINGS.epochs);
        let (unseen, truths) = drawn(200, 6);
        let told = |inputs: &Vec<f32>| {
            let logits = member_logits(&network, inputs);
            (0..4).fold(0, |best, class| if logits[class] > logits[best] { class } else { best })
        };
        let right = unseen.iter().zip(&truths).filter(|(inputs, class)| told(inputs) == **class).count();
        assert!(right >= 190, "{right} of 200");
    }

    #[test]
    fn networks_are_the_same_on_any_number_of_threads_and_others_by_another_seed() {
        let (inputs, classes) = drawn(48, 7);
        let settings = NetworkSettings { epochs: 2, dropped: 0.4, ..SETTINGS };
        let on = |threads: usize, seed: u64| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| trained_network(&examples(&inputs, &classes), &settings, seed, &mut |_| ()))
        };
        assert!(on(1, 1) == on(3, 1) && on(1, 1) != on(1, 2));
    }

    #[test]
    fn few_examples_are_passed_until_the_least_number_of_steps() {
        let (inputs, classes) = drawn(8, 8);
        let of = |least_steps: u32| {
            let settings = NetworkSettings { least_steps, epochs: 2, ..SETTINGS };
            trained_network(&examples(&inputs, &classes), &settings, 1, &mut |_| ())
        };
        assert!(of(0) != of(40));
        let told = |network: &ProfileNetwork| {
            let wide = |i: &usize| member_logits(network, &inputs[*i]);
            (0..8).filter(|i| (0..4).all(|c| wide(i)[c] <= wide(i)[classes[*i]])).count()
        };
        assert!(told(&of(120)) >= 7, "{}", told(&of(120)));
    }
}
