//! The reference data's CSV files, and the figures of merit over their cuts.

use num_complex::Complex64;
use std::path::Path;

/// Columns by name.
pub(crate) struct Table {
    names: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    pub(crate) fn read(file: &Path) -> Self {
        let text = std::fs::read_to_string(file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        let mut lines = text.lines().map(|l| l.split(',').map(str::to_owned).collect::<Vec<_>>());
        let names = lines.next().unwrap();
        Self { names, rows: lines.collect() }
    }

    fn column(&self, name: &str) -> usize {
        self.names.iter().position(|n| n == name).unwrap_or_else(|| panic!("no column {name}"))
    }

    /// The rows that have all these texts or numbers.
    pub(crate) fn only(&self, conditions: &[(&str, &str)]) -> Self {
        let keep =
            |row: &&Vec<String>| conditions.iter().all(|(name, value)| same(&row[self.column(name)], value));
        Self { names: self.names.clone(), rows: self.rows.iter().filter(keep).cloned().collect() }
    }

    /// The rows where a number lies between limits.
    pub(crate) fn between(&self, name: &str, low: f64, high: f64) -> Self {
        let column = self.column(name);
        let keep = |row: &&Vec<String>| (low..=high).contains(&row[column].parse().unwrap());
        Self { names: self.names.clone(), rows: self.rows.iter().filter(keep).cloned().collect() }
    }

    /// Every `step`th row.
    pub(crate) fn every(&self, step: usize) -> Self {
        Self { names: self.names.clone(), rows: self.rows.iter().step_by(step).cloned().collect() }
    }

    pub(crate) fn numbers(&self, name: &str) -> Vec<f64> {
        let column = self.column(name);
        self.rows.iter().map(|row| row[column].parse().unwrap()).collect()
    }

    pub(crate) fn complex(&self, re: &str, im: &str) -> Vec<Complex64> {
        self.numbers(re).into_iter().zip(self.numbers(im)).map(|(re, im)| Complex64::new(re, im)).collect()
    }
}

fn same(cell: &str, value: &str) -> bool {
    cell == value
        || matches!((cell.parse::<f64>(), value.parse::<f64>()), (Ok(a), Ok(b)) if (a - b).abs() < 1e-9)
}

/// RCS σ = |S|² in dBsm.
pub(crate) fn dbsm(s: Complex64) -> f64 {
    10.0 * s.norm_sqr().max(1e-40).log10()
}

/// Largest |S − S_ref| of a cut over its largest |S_ref|.
pub(crate) fn worst_of_peak(got: &[Complex64], reference: &[Complex64]) -> f64 {
    let peak = reference.iter().map(|s| s.norm()).fold(0.0, f64::max);
    got.iter().zip(reference).map(|(g, r)| (g - r).norm()).fold(0.0, f64::max) / peak
}

/// ‖S − S_ref‖/‖S_ref‖ over a cut.
pub(crate) fn complex_error(got: &[Complex64], reference: &[Complex64]) -> f64 {
    let difference: f64 = got.iter().zip(reference).map(|(g, r)| (g - r).norm_sqr()).sum();
    (difference / reference.iter().map(|r| r.norm_sqr()).sum::<f64>()).sqrt()
}

/// Mean of |dB| over all aspects, and over those within 30 dB of the highest.
pub(crate) fn mean_db(got_dbsm: &[f64], reference_dbsm: &[f64]) -> [f64; 2] {
    let peak = reference_dbsm.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [f64::INFINITY, 30.0].map(|span| {
        let errors: Vec<f64> = got_dbsm
            .iter()
            .zip(reference_dbsm)
            .filter(|(_, r)| **r > -100.0 && **r >= peak - span)
            .map(|(g, r)| (g - r).abs())
            .collect();
        errors.iter().sum::<f64>() / errors.len() as f64
    })
}

/// 10·log₁₀ of the mean of linear σ.
pub(crate) fn power_mean_dbsm(levels_dbsm: &[f64]) -> f64 {
    let linear: f64 = levels_dbsm.iter().map(|l| 10.0_f64.powf(l / 10.0)).sum();
    10.0 * (linear / levels_dbsm.len() as f64).log10()
}
