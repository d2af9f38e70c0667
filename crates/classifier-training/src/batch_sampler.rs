//! The order in which training takes its examples: one shuffled pass after another, cut into batches without
//! regard to where a pass ends, so that every batch is whole.

use artifact::seed;
use rand::{SeedableRng, seq::SliceRandom};
use rand_chacha::ChaCha8Rng;

/// An endless sequence of indices; each pass holds every index once.
#[derive(Debug)]
pub(crate) struct BatchSampler {
    seed: u64,
    taken: u64,
    pass: Vec<usize>,
}

impl BatchSampler {
    /// Sampler of `count` examples, at least one.
    pub(crate) fn new(count: usize, seed: u64) -> Self {
        Self { seed, taken: 0, pass: (0..count).collect() }
    }

    /// The next `count` indices, each with its number in the sequence.
    pub(crate) fn next_batch(&mut self, count: usize) -> Vec<(u64, usize)> {
        (0..count).map(|_| self.next()).collect()
    }

    fn next(&mut self) -> (u64, usize) {
        let length = self.pass.len() as u64;
        let (pass, place) = (self.taken / length, self.taken % length);
        if place == 0 {
            let key = seed::key(self.seed, "classifier/order", &[pass]);
            self.pass.shuffle(&mut ChaCha8Rng::from_seed(key));
        }
        self.taken += 1;
        (self.taken - 1, self.pass[place as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pass_holds_every_example_once_in_another_order() {
        let mut sampler = BatchSampler::new(50, 4);
        let batches: Vec<(u64, usize)> = (0..10).flat_map(|_| sampler.next_batch(20)).collect();
        let passes: Vec<Vec<usize>> =
            batches.chunks(50).map(|c| c.iter().map(|(_, i)| *i).collect()).collect();
        for pass in &passes {
            let mut sorted = pass.clone();
            sorted.sort_unstable();
            assert!(sorted.into_iter().eq(0..50));
        }
        assert!(passes[0] != passes[1]);
        assert!(batches.iter().map(|(n, _)| *n).eq(0..200));
    }
}
