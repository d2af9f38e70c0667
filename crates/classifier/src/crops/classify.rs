//! Class probabilities of crops.

use crate::crops::layout::Layout;
use crate::crops::network::{Logits, Network};
use crate::crops::parameters::Parameters;
use crate::crops::pooling::pool;
use crate::error::ClassifierError;
use artifact::dataset::Crop;
use artifact::model::{ModelHeader, Weights};
use rayon::prelude::*;

/// A trained network, ready to classify.
#[derive(Debug)]
pub struct Classifier {
    layout: Layout,
    network: Network,
}

impl Classifier {
    /// Makes the network of a model; refused if header and weights do not fit this program or each other.
    pub fn from_model(header: &ModelHeader, weights: &Weights) -> Result<Self, ClassifierError> {
        let layout = Layout::of(header)?;
        Self::from_parameters(layout, &Parameters::from_weights(&layout, weights)?)
    }

    /// The probability of each class of [`artifact::settings::Class::ALL`] for each crop; each row sums to 1.
    ///
    /// The crops must have the model's [`artifact::dataset::CropFormat`].
    pub fn probabilities(&self, crops: &[Crop]) -> Result<Vec<[f32; 4]>, ClassifierError> {
        // All crops are checked before any is classified, so that the first invalid one is reported with any
        // number of threads.
        crops.iter().enumerate().try_for_each(|(index, crop)| check_pixels(crop, &self.layout, index))?;
        let answer = |crop: &Crop| {
            let pooled = pool(&crop.pixels, self.layout.crop_side, self.layout.input_side);
            softmax(self.network.logits(&pooled)).map(|p| p as f32)
        };
        Ok(crops.par_iter().map(answer).collect())
    }

    /// Makes the network with these parameters; refused if a tensor is missing.
    pub fn from_parameters(layout: Layout, parameters: &Parameters) -> Result<Self, ClassifierError> {
        Ok(Self { layout, network: Network::new(&layout, parameters)? })
    }

    /// Layout that the network expects.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Logits of crops already pooled to the network's input.
    ///
    /// Each must hold `input_side`² grey levels.
    pub fn logits(&self, pooled: &[impl AsRef<[u8]> + Sync]) -> Vec<Logits> {
        pooled.par_iter().map(|levels| self.network.logits(levels.as_ref())).collect()
    }
}

/// Pools a crop to the network's resolution; `index` names it in errors.
pub(crate) fn pooled_crop(crop: &Crop, layout: &Layout, index: usize) -> Result<Vec<u8>, ClassifierError> {
    check_pixels(crop, layout, index)?;
    Ok(pool(&crop.pixels, layout.crop_side, layout.input_side))
}

fn check_pixels(crop: &Crop, layout: &Layout, index: usize) -> Result<(), ClassifierError> {
    let (found, side) = (crop.pixels.len(), layout.crop_side);
    if found == side * side {
        Ok(())
    } else {
        Err(ClassifierError::CropPixels { index, found, side: side as u32 })
    }
}

/// Softmax e^l / Σ e^l in double precision, with the largest logit subtracted first to avoid overflow.
pub(crate) fn softmax(logits: Logits) -> [f64; 4] {
    let largest = logits.into_iter().fold(f32::NEG_INFINITY, f32::max);
    let powers = logits.map(|l| (f64::from(l) - f64::from(largest)).exp());
    let sum: f64 = powers.iter().sum();
    powers.map(|p| p / sum)
}
