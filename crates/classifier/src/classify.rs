//! Class probabilities of crops.

use crate::ClassifierError;
use crate::layout::Layout;
use crate::network::{self, Logits, Network};
use crate::parameters::Parameters;
use crate::pooling::pool;
use artifact::dataset::Crop;
use artifact::model::{ModelHeader, Weights};
use burn::module::Module;
use burn::tensor::Device;

/// Crops in one pass through the network: more than this no longer saves time, and costs 100 MB at side 128 and more.
const BATCH: usize = 20;

/// A trained network, ready to classify.
#[derive(Debug)]
pub struct Classifier {
    layout: Layout,
    network: Network,
    device: Device,
}

impl Classifier {
    /// The network of a model; refused where header and weights do not fit this program or each other.
    pub fn from_model(header: &ModelHeader, weights: &Weights) -> Result<Self, ClassifierError> {
        let layout = Layout::of(header)?;
        Self::from_parameters(layout, &Parameters::from_weights(&layout, weights)?)
    }

    /// The probability of each class of [`artifact::settings::Class::ALL`] for each crop; a row sums to 1.
    ///
    /// The crops must be of the model's [`artifact::dataset::CropFormat`].
    pub fn probabilities(&self, crops: &[Crop]) -> Result<Vec<[f32; 4]>, ClassifierError> {
        let mut rows = Vec::with_capacity(crops.len());
        for (batch, crops) in crops.chunks(BATCH).enumerate() {
            let pooled = crops
                .iter()
                .enumerate()
                .map(|(i, crop)| pooled_crop(crop, &self.layout, batch * BATCH + i))
                .collect::<Result<Vec<_>, _>>()?;
            rows.extend(self.logits(&pooled)?.into_iter().map(|l| softmax(l).map(|p| p as f32)));
        }
        Ok(rows)
    }

    pub(crate) fn from_parameters(layout: Layout, parameters: &Parameters) -> Result<Self, ClassifierError> {
        let device = Device::flex();
        let network = Network::new(&layout, parameters, &device)?.valid();
        Ok(Self { layout, network, device })
    }

    pub(crate) fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Logits of crops already pooled to the network's input.
    pub(crate) fn logits(&self, pooled: &[impl AsRef<[u8]>]) -> Result<Vec<Logits>, ClassifierError> {
        let mut rows = Vec::with_capacity(pooled.len());
        for batch in pooled.chunks(BATCH) {
            let input = network::input(batch, self.layout.input_side, &self.device);
            rows.extend(network::logits(self.network.forward(input))?);
        }
        Ok(rows)
    }
}

/// A crop at the network's resolution; `index` names it where it is refused.
pub(crate) fn pooled_crop(crop: &Crop, layout: &Layout, index: usize) -> Result<Vec<u8>, ClassifierError> {
    let side = layout.crop_side;
    if crop.pixels.len() != side * side {
        return Err(ClassifierError::CropPixels { index, found: crop.pixels.len(), side: side as u32 });
    }
    Ok(pool(&crop.pixels, side, layout.input_side))
}

/// e^l / Σ e^l in double precision, the largest logit taken off first so that nothing overflows.
pub(crate) fn softmax(logits: Logits) -> [f64; 4] {
    let largest = logits.into_iter().fold(f32::NEG_INFINITY, f32::max);
    let powers = logits.map(|l| (f64::from(l) - f64::from(largest)).exp());
    let sum: f64 = powers.iter().sum();
    powers.map(|p| p / sum)
}
