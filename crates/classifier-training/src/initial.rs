//! Initial parameters of a training.
//!
//! Drawn here and not by the learning library: its generator is one for the whole process, and two trainings
//! at once would draw from each other's streams.

use artifact::seed;
use classifier::{Layout, Parameters, Values};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// The parameters of a network that has seen nothing.
pub(crate) fn initial(layout: &Layout, seed: u64) -> Parameters {
    let tensors = layout.tensors().into_iter().enumerate();
    let drawn =
        tensors.map(|(i, (name, shape))| (name.clone(), initial_values(&name, shape, seed, i as u64)));
    Parameters::new(drawn.collect())
}

/// Values of a tensor by He et al. 2015 (arXiv:1502.01852, eq. 10): uniform within ±√(6 / inputs)
/// before a rectifier, so that the variance neither grows nor dies. The last layer begins at zero: all
/// classes equally likely, a loss of ln 4.
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
