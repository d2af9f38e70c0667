//! A figure beside its gate.

use std::ops::RangeInclusive;

/// One line of the page.
pub(crate) struct Row {
    pub(crate) check: String,
    pub(crate) figure: f64,
    pub(crate) gate: RangeInclusive<f64>,
    pub(crate) unit: &'static str,
}

impl Row {
    /// A figure that must not exceed a limit.
    pub(crate) fn at_most(check: impl Into<String>, figure: f64, limit: f64, unit: &'static str) -> Self {
        Self { check: check.into(), figure, gate: f64::NEG_INFINITY..=limit, unit }
    }

    /// A figure that must land on a known one.
    pub(crate) fn near(
        check: impl Into<String>,
        figure: f64,
        known: f64,
        tolerance: f64,
        unit: &'static str,
    ) -> Self {
        Self { check: check.into(), figure, gate: known - tolerance..=known + tolerance, unit }
    }

    /// A figure without a gate.
    pub(crate) fn shown(check: impl Into<String>, figure: f64, unit: &'static str) -> Self {
        Self { check: check.into(), figure, gate: f64::NEG_INFINITY..=f64::INFINITY, unit }
    }

    /// Whether the figure is inside; NaN never is.
    pub(crate) fn holds(&self) -> bool {
        self.gate.contains(&self.figure)
    }

    /// Line of a Markdown table with this row.
    pub(crate) fn line(&self) -> String {
        let number = |x: f64| if x != 0.0 && x.abs() < 1e-2 { format!("{x:.2e}") } else { format!("{x:.3}") };
        let (low, high) = (*self.gate.start(), *self.gate.end());
        let gate = if high.is_infinite() {
            "–".to_owned()
        } else if low.is_infinite() {
            format!("≤ {}", number(high))
        } else {
            format!("{} ± {}", number(0.5 * (low + high)), number(0.5 * (high - low)))
        };
        let verdict = match (high.is_infinite(), self.holds()) {
            (true, _) => "for comparison",
            (false, true) => "held",
            (false, false) => "**missed**",
        };
        format!("| {} | {} {} | {gate} | {verdict} |", self.check, number(self.figure), self.unit)
    }
}
