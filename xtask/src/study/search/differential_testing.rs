//! Two methods for one quantity on random cases.

use artifact::seed;
use artifact::units::db_from_amplitude;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use wayside::host::failure::Failure;

/// Source of a case's numbers.
pub(super) type Random = ChaCha8Rng;

/// Outcome of a case.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Outcome {
    /// Both methods agree within their reported errors.
    Agreed,
    /// The case is uninformative: nothing is lit, nothing scatters.
    Uninformative,
    /// Both methods differ, as described.
    Discrepancy(String),
}

/// A function that draws cases and evaluates them by two methods.
pub(in crate::study) struct DifferentialTest {
    pub(super) name: &'static str,
    pub(super) trial: fn(&mut Random) -> Result<Outcome, Failure>,
}

impl DifferentialTest {
    /// Case `number` of a search.
    pub(super) fn case(&self, seed: u64, number: u64) -> Result<Outcome, Failure> {
        (self.trial)(&mut Random::from_seed(seed::key(seed, self.name, &[number])))
    }
}

/// Number of cases of a differential test, and its finds.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::study) struct Tally {
    pub(in crate::study) name: &'static str,
    pub(in crate::study) cases: u64,
    /// Processor seconds.
    pub(in crate::study) seconds: f64,
    pub(in crate::study) finds: Vec<String>,
}

impl Tally {
    pub(super) fn of(test: &DifferentialTest) -> Self {
        Self { name: test.name, cases: 0, seconds: 0.0, finds: vec![] }
    }
}

/// Outcome of an error: agreed if it is within the allowed one.
pub(super) fn outcome_of(error: f64, allowed: f64, case: impl Fn() -> String) -> Outcome {
    if error <= allowed {
        Outcome::Agreed
    } else {
        let [error_db, allowed_db] = [error, allowed].map(db_from_amplitude);
        Outcome::Discrepancy(format!("{error_db:.1} dB, allowed {allowed_db:.1} dB: {}", case()))
    }
}
