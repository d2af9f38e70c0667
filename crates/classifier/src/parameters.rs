//! The network's parameters as plain numbers: drawn from a seed, read from and written to safetensors.

use crate::ClassifierError;
use crate::layout::{Layout, name};
use artifact::model::Weights;
use artifact::seed;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use safetensors::{Dtype, SafeTensors, tensor::TensorView};
use std::collections::BTreeMap;

/// One tensor, row-major.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Values {
    pub(crate) shape: Vec<usize>,
    pub(crate) values: Vec<f32>,
}

/// All tensors of a network by name; the names and shapes are those of [`Layout::tensors`].
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Parameters(BTreeMap<String, Values>);

impl Parameters {
    /// From tensors that a network gave.
    pub(crate) fn new(tensors: BTreeMap<String, Values>) -> Self {
        Self(tensors)
    }

    /// Where training begins.
    ///
    /// Drawn here and not by the learning library: its generator is one for the whole process, and two trainings at
    /// once would draw from each other's streams.
    pub(crate) fn initial(layout: &Layout, seed: u64) -> Self {
        let tensors = layout.tensors().into_iter().enumerate();
        Self(tensors.map(|(i, (name, shape))| (name.clone(), initial_values(&name, shape, seed, i as u64))).collect())
    }

    /// Reads weights, and refuses any tensor that is missing, left over, of another shape or type, or not possible.
    pub(crate) fn from_weights(layout: &Layout, weights: &Weights) -> Result<Self, ClassifierError> {
        let file = SafeTensors::deserialize(&weights.safetensors)?;
        let expected: BTreeMap<String, Vec<usize>> = layout.tensors().into_iter().collect();
        // Sorted, so that a file with several faults is refused with the same words each time.
        let mut names = file.names();
        names.sort_unstable();
        if let Some(unknown) = names.into_iter().find(|n| !expected.contains_key(*n)) {
            return Err(ClassifierError::TensorUnknown(unknown.to_owned()));
        }
        let read = |(name, shape): (String, Vec<usize>)| {
            let values = checked_values(&file, &name, shape)?;
            Ok((name, values))
        };
        Ok(Self(expected.into_iter().map(read).collect::<Result<_, ClassifierError>>()?))
    }

    /// A safetensors file without metadata: equal parameters are equal bytes.
    pub(crate) fn to_weights(&self) -> Result<Weights, ClassifierError> {
        let bytes: Vec<Vec<u8>> =
            self.0.values().map(|t| t.values.iter().flat_map(|v| v.to_le_bytes()).collect()).collect();
        let views = self
            .0
            .iter()
            .zip(&bytes)
            .map(|((name, tensor), bytes)| Ok((name, TensorView::new(Dtype::F32, tensor.shape.clone(), bytes)?)))
            .collect::<Result<Vec<_>, ClassifierError>>()?;
        Ok(Weights { safetensors: safetensors::serialize(views, None)? })
    }

    /// The tensor of that name.
    pub(crate) fn get(&self, name: &str) -> Result<&Values, ClassifierError> {
        self.0.get(name).ok_or_else(|| ClassifierError::TensorMissing(name.to_owned()))
    }

    /// How many numbers are fitted or kept.
    pub(crate) fn count(&self) -> u64 {
        self.0.values().map(|t| t.values.len() as u64).sum()
    }

    /// The parameters whose logits are those of `self` times `factor`: the last layer is linear.
    pub(crate) fn with_logits_scaled(mut self, factor: f64) -> Self {
        for name in [name::LINEAR_WEIGHT, name::LINEAR_BIAS] {
            if let Some(tensor) = self.0.get_mut(name) {
                tensor.values.iter_mut().for_each(|v| *v = (f64::from(*v) * factor) as f32);
            }
        }
        self
    }
}

/// He et al. 2015 (arXiv:1502.01852, eq. 10): uniform within ±√(6 / inputs) before a rectifier, so that the variance
/// neither grows nor dies. The last layer begins at zero: all classes equally likely, a loss of ln 4.
fn initial_values(name: &str, shape: Vec<usize>, seed: u64, index: u64) -> Values {
    let count = shape.iter().product();
    let constant = |value: f32| vec![value; count];
    let values = if shape.len() == 4 {
        let bound = (6.0 / shape[1..].iter().product::<usize>() as f32).sqrt();
        let mut generator = ChaCha8Rng::from_seed(seed::key(seed, "classifier/initial", &[index]));
        (0..count).map(|_| generator.random_range(-bound..bound)).collect()
    } else if name.ends_with("scale") || name.ends_with("variance") {
        constant(1.0)
    } else {
        constant(0.0)
    };
    Values { shape, values }
}

fn checked_values(file: &SafeTensors<'_>, name: &str, shape: Vec<usize>) -> Result<Values, ClassifierError> {
    let view = file.tensor(name).map_err(|_| ClassifierError::TensorMissing(name.to_owned()))?;
    if view.dtype() != Dtype::F32 {
        return Err(ClassifierError::TensorType { name: name.to_owned(), found: view.dtype() });
    }
    if view.shape() != shape {
        let found = view.shape().to_vec();
        return Err(ClassifierError::TensorShape { name: name.to_owned(), found, expected: shape });
    }
    let values: Vec<f32> = view.data().as_chunks().0.iter().map(|b| f32::from_le_bytes(*b)).collect();
    match values.iter().position(|v| !v.is_finite() || (name.ends_with("variance") && *v < 0.0)) {
        Some(index) => Err(ClassifierError::TensorValue { name: name.to_owned(), index, value: values[index] }),
        None => Ok(Values { shape, values }),
    }
}
