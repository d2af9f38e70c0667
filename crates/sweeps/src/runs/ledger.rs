//! Metrics of all runs of a study so far: by design and situation.

use crate::runs::run_accuracy::RunAccuracy;

/// A run: its metrics, and its accuracy.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Run {
    /// Values in the order of the study's metrics.
    pub(crate) values: Vec<Option<f64>>,
    pub(crate) accuracy: RunAccuracy,
}

/// Runs by design; each design has seen a number of the first situations.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ledger {
    runs: Vec<Vec<Run>>,
    /// Designs that are still repeated.
    pub(crate) open: Vec<usize>,
}

impl Ledger {
    /// Makes an empty ledger of the given number of designs.
    pub(crate) fn of(designs: usize) -> Self {
        Self { runs: vec![vec![]; designs], open: (0..designs).collect() }
    }

    /// Enters a design's run in its next situation.
    pub(crate) fn enter(&mut self, design: usize, run: Run) {
        self.runs[design].push(run);
    }

    /// Number of designs.
    pub(crate) fn designs(&self) -> usize {
        self.runs.len()
    }

    /// Runs of a design, situation by situation.
    pub(crate) fn runs(&self, design: usize) -> &[Run] {
        &self.runs[design]
    }

    /// One metric of a design, situation by situation.
    pub(crate) fn metric(&self, design: usize, metric: usize) -> Vec<Option<f64>> {
        self.runs[design].iter().map(|run| run.values[metric]).collect()
    }

    /// Whether a design has seen fewer situations than another.
    pub(crate) fn has_seen_less(&self, design: usize, other: usize) -> bool {
        self.runs[design].len() < self.runs[other].len()
    }

    /// Number of situations that every design has seen.
    pub(crate) fn common(&self) -> usize {
        self.runs.iter().map(Vec::len).min().unwrap_or(0)
    }
}
