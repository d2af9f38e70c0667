//! Rates that best predict some runs: fitted to logarithms, so that a factor of two counts equally for a
//! tenth of a second and a minute; with Charbonnier's loss, quadratic for small errors and linear for large
//! ones, so that no single run dominates; and held to the existing rates, which remain for work that few
//! scenes have.

/// Counts of a run by kind with the resulting cost: processor seconds on the reference machine, or MiB.
#[derive(Debug, Clone)]
pub(super) struct CountedRun<const N: usize> {
    pub(super) counts: [f64; N],
    pub(super) taken: f64,
}

impl<const N: usize> CountedRun<N> {
    /// Whether all its numbers are finite.
    pub(super) fn is_finite(&self) -> bool {
        self.counts.iter().chain([&self.taken]).all(|number| number.is_finite())
    }
}

/// Weight of the existing rates: a rate that differs from its old value by e counts like this many runs with
/// an error of e.
const HELD: f64 = 0.02;
/// Error of a logarithm above which the loss is linear: a factor of one and a half.
const LARGE: f64 = 0.4;
/// Number of rounds through all rates; the step of a logarithm is halved when a round gains nothing.
const ROUNDS: usize = 400;

/// Fits the rates to the runs, starting from the rates `before`, to which they are held.
pub(super) fn rates<const N: usize>(runs: &[CountedRun<N>], before: [f64; N]) -> [f64; N] {
    let (mut rates, mut step) = (before, 1.0);
    let mut best = misfit(runs, &before, &rates);
    for _ in 0..ROUNDS {
        let begun = best;
        for item in 0..N {
            for factor in [f64::exp(step), f64::exp(-step)] {
                let mut tried = rates;
                tried[item] *= factor;
                let found = misfit(runs, &before, &tried);
                if found < best {
                    (rates, best) = (tried, found);
                }
            }
        }
        if best == begun {
            step *= 0.5;
        }
    }
    rates
}

fn misfit<const N: usize>(runs: &[CountedRun<N>], before: &[f64; N], rates: &[f64; N]) -> f64 {
    let missed = |run: &CountedRun<N>| {
        let told: f64 = rates.iter().zip(&run.counts).map(|(rate, count)| rate * count).sum();
        let error = (told / run.taken).ln() / LARGE;
        2.0 * LARGE * LARGE * ((1.0 + error * error).sqrt() - 1.0)
    };
    let moved = rates.iter().zip(before).map(|(rate, before)| HELD * (rate / before).ln().powi(2));
    runs.iter().map(missed).sum::<f64>() + moved.sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_that_made_the_seconds_are_found_again() {
        const ITEMS: usize = 31;
        let truth: [f64; ITEMS] = std::array::from_fn(|item| 1e-6 * (1.0 + item as f64));
        let runs: Vec<CountedRun<ITEMS>> = (0..200_usize)
            .map(|run| {
                let count = |item: usize| (((run + 1) * (item + 3) * 7919) % 1000) as f64;
                let counts: [f64; ITEMS] = std::array::from_fn(count);
                let taken = truth.iter().zip(&counts).map(|(rate, count)| rate * count).sum();
                CountedRun { counts, taken }
            })
            .collect();
        let found = rates(&runs, truth.map(|rate| 3.0 * rate));
        for run in &runs {
            let told: f64 = found.iter().zip(&run.counts).map(|(rate, count)| rate * count).sum();
            assert!((told / run.taken).ln().abs() < 0.2, "{told} of {}", run.taken);
        }
    }
}
