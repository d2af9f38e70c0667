//! The network's parameters as plain numbers: read from and written to safetensors.

use crate::crops::layout::Layout;
use crate::error::ClassifierError;
use artifact::model::Weights;
use safetensors::{Dtype, SafeTensors, tensor::TensorView};
use std::collections::BTreeMap;

/// One tensor, row-major.
#[derive(Debug, Clone, PartialEq)]
pub struct Values {
    /// Sides, the slowest first.
    pub shape: Vec<usize>,
    /// Numbers of the tensor, as many as the product of the sides.
    pub values: Vec<f32>,
}

/// All tensors of a network by name; the names and shapes are those of [`Layout::tensors`].
#[derive(Debug, Clone, PartialEq)]
pub struct Parameters(BTreeMap<String, Values>);

impl Parameters {
    /// Parameters from tensors of the names and shapes of [`Layout::tensors`].
    pub fn new(tensors: BTreeMap<String, Values>) -> Self {
        Self(tensors)
    }

    /// Reads weights, and refuses any tensor that is missing, superfluous, of another shape or type, or
    /// invalid.
    pub fn from_weights(layout: &Layout, weights: &Weights) -> Result<Self, ClassifierError> {
        let Weights::Network { safetensors } = weights else { return Err(ClassifierError::OtherWeights) };
        let file = SafeTensors::deserialize(safetensors)?;
        let expected: BTreeMap<String, Vec<usize>> = layout.tensors().into_iter().collect();
        // Sorted, so that a file with several faults always gives the same error.
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

    /// Writes a safetensors file without metadata: equal parameters give equal bytes.
    pub fn to_weights(&self) -> Result<Weights, ClassifierError> {
        let bytes: Vec<Vec<u8>> =
            self.0.values().map(|t| t.values.iter().flat_map(|v| v.to_le_bytes()).collect()).collect();
        let views = self
            .0
            .iter()
            .zip(&bytes)
            .map(|((name, tensor), bytes)| {
                Ok((name, TensorView::new(Dtype::F32, tensor.shape.clone(), bytes)?))
            })
            .collect::<Result<Vec<_>, ClassifierError>>()?;
        Ok(Weights::Network { safetensors: safetensors::serialize(views, None)? })
    }

    /// The tensor with this name.
    pub fn get(&self, name: &str) -> Result<&Values, ClassifierError> {
        self.0.get(name).ok_or_else(|| ClassifierError::TensorMissing(name.to_owned()))
    }

    /// The parameters with every number of some tensors changed.
    pub fn changed(mut self, names: &[&str], change: impl Fn(f32) -> f32) -> Self {
        for (_, tensor) in self.0.iter_mut().filter(|(name, _)| names.contains(&name.as_str())) {
            tensor.values.iter_mut().for_each(|value| *value = change(*value));
        }
        self
    }

    /// Number of trained and of running values.
    pub fn count(&self) -> u64 {
        self.0.values().map(|t| t.values.len() as u64).sum()
    }
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
        Some(index) => {
            Err(ClassifierError::TensorValue { name: name.to_owned(), index, value: values[index] })
        }
        None => Ok(Values { shape, values }),
    }
}
