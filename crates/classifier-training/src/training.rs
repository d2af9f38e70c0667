//! Fitting the network to a dataset: Adam, the best epoch by validation, calibrated, then tested once.

use crate::augmentation::{Augmentation, VariationKey, augmented};
use crate::batch_sampler::BatchSampler;
use crate::error::TrainingError;
use crate::initial::initial;
use crate::metrics::Metrics;
use crate::network::{self, Network};
use crate::split_protocol::{ImageAugmenter, SplitProtocol, split_examples};
use artifact::ArtifactError;
use artifact::dataset::{CropFormat, Sample, Split};
use artifact::model::{Learner, ModelHeader, NetworkShape, Weights};
use artifact::settings::Class;
use burn::optim::{AdamWConfig, GradientsParams, ModuleOptimizer};
use burn::tensor::{Device, Tensor, TensorData, activation};
use classifier::{
    ARCHITECTURE, CHANNELS, Classifier, ClassifierError, Example, Examples, Layout, Logits, Parameters,
    accuracy, evaluations, fitted_temperature, log_loss, tensor_name,
};
use serde::Serialize;

/// Settings of a training.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TrainSettings {
    /// Side that crops are pooled to before the first convolution, pixels, 8 to 1024.
    pub input_side: u32,
    /// Channels of the three convolutions.
    pub channels: [u32; 3],
    /// Crops in an iteration, at least 2 (batch normalization needs a spread).
    pub batch: u32,
    /// Steps of the optimizer.
    pub iterations: u32,
    /// Adam's step size where the schedule is 1.
    pub learning_rate: f64,
    /// Schedule of the step size.
    pub schedule: Schedule,
    /// Part of the step size by which every weight shrinks each step (decoupled: Loshchilov & Hutter,
    /// arXiv:1711.05101); 0 is plain Adam.
    pub weight_decay: f64,
    /// Variation of training crops; other splits are never varied.
    pub augmentation: Augmentation,
}

impl TrainSettings {
    /// The paper's: 451 x 451 input, rate 0.005, 1440 iterations. It does not tell channels and batch: here
    /// 8-16-32 and
    /// 20. On two cores an iteration takes about 4 s and 1.2 GB.
    pub const PAPER: Self = Self {
        input_side: 451,
        channels: CHANNELS,
        batch: 20,
        iterations: 1440,
        learning_rate: 0.005,
        schedule: Schedule::Constant,
        weight_decay: 0.0,
        augmentation: Augmentation::NONE,
    };

    /// The paper's network on crops pooled to 113 × 113, four pixels in one: 7 cm × 0.07 m/s, finer than any
    /// cell.
    pub fn of_maps(iterations: u32) -> Self {
        Self {
            input_side: 113,
            iterations,
            schedule: Schedule::Cosine { warm_up: 20.min(iterations) },
            augmentation: Augmentation {
                range_shift_m: 0.75,
                velocity_shift_mps: 0.2,
                gain_db: 3.0,
                noise_db: 1.0,
            },
            ..Self::PAPER
        }
    }

    /// Settings of [`Self::of_maps`] with the paper's rate throughout.
    pub fn of_protocol(iterations: u32) -> Self {
        Self { schedule: Schedule::Constant, ..Self::of_maps(iterations) }
    }

    fn rate(&self, iteration: u32) -> f64 {
        self.learning_rate * self.schedule.factor(iteration, self.iterations)
    }

    fn check(&self) -> Result<(), ClassifierError> {
        let rules = [
            ("batch", "from 2 to 4096", f64::from(self.batch), (2..=4096).contains(&self.batch)),
            ("iterations", "at least 1", f64::from(self.iterations), self.iterations >= 1),
            (
                "learning_rate",
                "above 0, at most 1",
                self.learning_rate,
                (1e-12..=1.0).contains(&self.learning_rate),
            ),
            ("weight_decay", "from 0 to 1", self.weight_decay, (0.0..=1.0).contains(&self.weight_decay)),
        ];
        match rules.into_iter().find(|(_, _, _, kept)| !kept) {
            Some((setting, rule, found, _)) => Err(ClassifierError::Setting { setting, rule, found }),
            None => self.augmentation.check(),
        }
    }
}

/// Schedule of the step size over the iterations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Schedule {
    /// The step size stays.
    Constant,
    /// The step size rises evenly over the first `warm_up` iterations (Adam's first steps move every input
    /// of a wide layer by a full rate in the same direction), then falls to zero along half a cosine.
    Cosine {
        /// Iterations of the rise.
        warm_up: u32,
    },
}

impl Schedule {
    /// Share of the step size at `iteration`, which counts from 1.
    fn factor(self, iteration: u32, iterations: u32) -> f64 {
        match self {
            Self::Constant => 1.0,
            Self::Cosine { warm_up } if iteration <= warm_up => f64::from(iteration) / f64::from(warm_up),
            Self::Cosine { warm_up } => {
                let part = f64::from(iteration - warm_up) / f64::from((iterations - warm_up + 1).max(1));
                0.5 * (1.0 + (std::f64::consts::PI * part).cos())
            }
        }
    }
}

/// Progress that is told after each iteration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Number of the iteration, from 1.
    pub iteration: u32,
    /// Number of the last iteration.
    pub iterations: u32,
    /// Log loss of the iteration's batch.
    pub log_loss: f64,
    /// Point of the curves, where an epoch ended with this iteration.
    pub epoch: Option<CurvePoint>,
}

/// A point of the training curves: the end of an epoch.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CurvePoint {
    /// Number of the iteration, from 1.
    pub iteration: u32,
    /// Step size of this iteration.
    pub learning_rate: f64,
    /// Mean log loss over the epoch's batches, varied crops, weights as they were at each.
    pub train_log_loss: f64,
    /// Mean accuracy over the epoch's batches, varied crops, weights as they were at each.
    pub train_accuracy: f64,
    /// Log loss on the whole validation split, before calibration.
    pub validation_log_loss: f64,
    /// Accuracy on the whole validation split, before calibration.
    pub validation_accuracy: f64,
}

/// A trained model and how it came about.
#[derive(Debug, Clone, PartialEq)]
pub struct Trained {
    /// Header of the model: what the network expects and answers.
    pub header: ModelHeader,
    /// Weights of the best epoch, calibrated.
    pub weights: Weights,
    /// One point an epoch.
    pub curves: Vec<CurvePoint>,
    /// Measures of how good it is, by split.
    pub metrics: Metrics,
}

/// Trains on the training split, keeps the weights of the epoch with the lowest log loss on the validation
/// split, fits a temperature there, and evaluates every split.
///
/// The samples are read once and held at the network's resolution. Those without a class are left out. The
/// same samples, settings and seed give the same bytes on any number of threads.
pub fn train(
    samples: impl Iterator<Item = Result<Sample, ArtifactError>>,
    format: &CropFormat,
    settings: &TrainSettings,
    seed: u64,
    progress: &mut dyn FnMut(Progress),
) -> Result<Trained, TrainingError> {
    settings.check()?;
    let header = header(format, settings);
    let layout = Layout::of(&header)?;
    fitted(&Examples::read(samples, &layout)?, header, format, settings, seed, progress)
}

/// Trains as [`train`] does, with the samples' augmented copies parted as `deal` says and not as the
/// dataset has them: training crops are not varied any further.
pub fn train_with_protocol(
    samples: impl Iterator<Item = Result<Sample, ArtifactError>>,
    format: &CropFormat,
    (settings, deal): (&TrainSettings, SplitProtocol),
    seed: u64,
    progress: &mut dyn FnMut(Progress),
) -> Result<Trained, TrainingError> {
    settings.check()?;
    let header = header(format, settings);
    let examples = Examples::read(samples, &Layout::of(&header)?)?;
    let augmenter = ImageAugmenter { format, augmentation: &settings.augmentation, seed };
    let examples = split_examples(&examples, &augmenter, deal)?;
    let as_dealt = TrainSettings { augmentation: Augmentation::NONE, ..*settings };
    fitted(&examples, header, format, &as_dealt, seed, progress)
}

fn fitted(
    examples: &Examples,
    header: ModelHeader,
    format: &CropFormat,
    settings: &TrainSettings,
    seed: u64,
    progress: &mut dyn FnMut(Progress),
) -> Result<Trained, TrainingError> {
    let layout = Layout::of(&header)?;
    check_classes(required_split(examples, Split::Train)?)?;
    let validation = required_split(examples, Split::Validation)?;
    let fitted = Training::new(examples, &layout, format, settings, seed)?.run(validation, progress)?;
    let (parameters, temperature) = calibrated(fitted.best.parameters, layout, validation)?;
    let classifier = Classifier::from_parameters(layout, &parameters)?;
    let metrics = Metrics {
        classes: Class::ALL,
        seed,
        parameters: parameters.count(),
        best_iteration: fitted.best.iteration,
        temperature,
        unlabelled: examples.unlabelled,
        splits: evaluations(&classifier, examples),
    };
    Ok(Trained { header, weights: parameters.to_weights()?, curves: fitted.curves, metrics })
}

fn header(format: &CropFormat, settings: &TrainSettings) -> ModelHeader {
    let shape = NetworkShape {
        format: *format,
        architecture: ARCHITECTURE.into(),
        channels: settings.channels.to_vec(),
        input_side: settings.input_side,
    };
    ModelHeader {
        classes: Class::ALL.to_vec(),
        learner: Learner::CropNetwork(shape),
        least_probability: 0.0,
        frame_correlation: 1.0,
        attributions: vec![],
    }
}

fn check_classes(train: &[Example]) -> Result<(), TrainingError> {
    let seen = |class: usize| train.iter().any(|e| e.class == class);
    match (0..Class::ALL.len()).find(|class| !seen(*class)) {
        Some(missing) => Err(TrainingError::MissingClass(Class::ALL[missing])),
        None => Ok(()),
    }
}

/// The parameters with the temperature of the validation split inside, and that temperature.
fn calibrated(
    parameters: Parameters,
    layout: Layout,
    validation: &[Example],
) -> Result<(Parameters, f64), TrainingError> {
    let logits = Classifier::from_parameters(layout, &parameters)?.logits(validation);
    let answers: Vec<_> = validation.iter().zip(&logits).map(|(e, l)| (e.class, *l, 1.0)).collect();
    let temperature = fitted_temperature(&answers);
    Ok((temperature_scaled(parameters, temperature), temperature))
}

/// The parameters whose logits are those of `parameters` divided by `temperature`: the last layer is linear.
fn temperature_scaled(parameters: Parameters, temperature: f64) -> Parameters {
    let last = [tensor_name::LINEAR_WEIGHT, tensor_name::LINEAR_BIAS];
    parameters.changed(&last, |value| (f64::from(value) / temperature) as f32)
}

/// The examples of a split that must not be empty.
fn required_split(examples: &Examples, split: Split) -> Result<&[Example], TrainingError> {
    match examples.of(split) {
        [] => Err(TrainingError::EmptySplit(split)),
        examples => Ok(examples),
    }
}

/// A network while it learns.
struct Training<'a> {
    examples: &'a [Example],
    layout: &'a Layout,
    format: &'a CropFormat,
    settings: &'a TrainSettings,
    seed: u64,
    sampler: BatchSampler,
    device: Device,
    network: Network,
    optimizer: ModuleOptimizer,
}

/// Result of a training.
struct FitResult {
    best: BestEpoch,
    curves: Vec<CurvePoint>,
}

/// The weights of the epoch that validated best.
struct BestEpoch {
    iteration: u32,
    validation_log_loss: f64,
    parameters: Parameters,
}

impl<'a> Training<'a> {
    fn new(
        examples: &'a Examples,
        layout: &'a Layout,
        format: &'a CropFormat,
        settings: &'a TrainSettings,
        seed: u64,
    ) -> Result<Self, TrainingError> {
        let device = Device::flex().autodiff();
        let network = Network::new(layout, &initial(layout, seed), &device)?;
        let optimizer = AdamWConfig::new().with_weight_decay(settings.weight_decay as f32).init();
        let examples = examples.of(Split::Train);
        let sampler = BatchSampler::new(examples.len(), seed);
        Ok(Self { examples, layout, format, settings, seed, sampler, device, network, optimizer })
    }

    fn run(
        mut self,
        validation: &[Example],
        progress: &mut dyn FnMut(Progress),
    ) -> Result<FitResult, TrainingError> {
        let iterations = self.settings.iterations;
        let (mut best, mut curves, mut epoch) = (None, Vec::new(), Vec::new());
        for iteration in 1..=iterations {
            let answers = self.step(iteration)?;
            let log_loss = log_loss(answers.iter().copied());
            epoch.extend(answers);
            let ended = epoch.len() >= self.examples.len() || iteration == iterations;
            let point =
                if ended { Some(self.validate(iteration, &epoch, validation, &mut best)?) } else { None };
            if ended {
                epoch.clear();
            }
            curves.extend(point);
            progress(Progress { iteration, iterations, log_loss, epoch: point });
        }
        let best = best.ok_or(TrainingError::Diverged { iteration: iterations })?;
        Ok(FitResult { best, curves })
    }

    /// One batch forward, backward and a step; returns true classes and logits.
    fn step(&mut self, iteration: u32) -> Result<Vec<(usize, Logits)>, TrainingError> {
        let taken = self.sampler.next_batch(self.settings.batch as usize);
        let crops: Vec<Vec<u8>> =
            taken.iter().map(|(example, index)| self.augmented(*example, *index)).collect();
        let classes: Vec<usize> = taken.iter().map(|(_, index)| self.examples[*index].class).collect();
        let logits = self.network.forward(network::input(&crops, self.layout.input_side, &self.device));
        let answers = network::logits(logits.clone().inner())?;
        if answers.iter().flatten().any(|l| !l.is_finite()) {
            return Err(TrainingError::Diverged { iteration });
        }
        let gradients =
            GradientsParams::from_grads(cross_entropy(logits, &classes).backward(), &self.network);
        self.network = self.optimizer.step(self.settings.rate(iteration), self.network.clone(), gradients);
        Ok(classes.into_iter().zip(answers).collect())
    }

    fn augmented(&self, example: u64, index: usize) -> Vec<u8> {
        let key = VariationKey { seed: self.seed, example };
        augmented(&self.examples[index].pooled, self.format, &self.settings.augmentation, key)
    }

    fn validate(
        &self,
        iteration: u32,
        epoch: &[(usize, Logits)],
        validation: &[Example],
        best: &mut Option<BestEpoch>,
    ) -> Result<CurvePoint, TrainingError> {
        let parameters = self.network.parameters()?;
        let logits = Classifier::from_parameters(*self.layout, &parameters)?.logits(validation);
        let answers = || validation.iter().map(|e| e.class).zip(logits.iter().copied());
        let point = CurvePoint {
            iteration,
            learning_rate: self.settings.rate(iteration),
            train_log_loss: log_loss(epoch.iter().copied()),
            train_accuracy: accuracy(epoch.iter().copied()),
            validation_log_loss: log_loss(answers()),
            validation_accuracy: accuracy(answers()),
        };
        // Not a number is never lower.
        if point.validation_log_loss < best.as_ref().map_or(f64::INFINITY, |b| b.validation_log_loss) {
            *best = Some(BestEpoch { iteration, validation_log_loss: point.validation_log_loss, parameters });
        }
        Ok(point)
    }
}

/// Mean of −ln p of the true class, over the batch.
fn cross_entropy(logits: Tensor<2>, classes: &[usize]) -> Tensor<1> {
    let truth =
        classes.iter().flat_map(|class| (0..4).map(|c| if c == *class { 1.0_f32 } else { 0.0 })).collect();
    let truth =
        Tensor::<2>::from_data(TensorData::new::<f32, _>(truth, [classes.len(), 4]), &logits.device());
    (activation::log_softmax(logits, 1) * truth).sum() * (-1.0 / classes.len() as f64)
}
