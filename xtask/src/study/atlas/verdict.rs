//! A row of the atlas, and the rule for its verdict.

use crate::project::project_root;
use crate::study::extent::Extent;
use artifact::ErrorBudget;
use artifact::units::db_from_amplitude;
use bart_rcs::RcsResult;
use std::fmt::Display;
use wayside::host::failure::Failure;

/// A function of the atlas that tries some cases.
pub(super) struct AtlasCase {
    /// Name of the function, with its file.
    pub(super) name: &'static str,
    pub(super) rows: fn(Extent) -> Result<Vec<CaseRow>, Failure>,
}

/// Makes a list of functions that try cases, with their names.
macro_rules! atlas_cases {
    ($($case:path),* $(,)?) => {
        &[$(crate::study::atlas::verdict::AtlasCase { name: stringify!($case), rows: $case }),*]
    };
}

pub(super) use atlas_cases;

/// Statement of the program about its own error, as relative amplitudes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::study) enum ErrorStatement {
    /// No statement.
    Missing,
    /// An upper bound of the error.
    UpperBound(f64),
    /// An estimate of a model's error: the spread of node rules, the next order, the far field.
    Estimate(f64),
    /// A flag, a null or a remark in the result, or a limit in the method's documentation.
    Remark(&'static str),
    /// A limit in these words of this page; made only by [`documented`], which checks the page.
    Documented(&'static str, &'static str),
}

/// A limit stated by a page of the project, if the page contains these words.
pub(super) fn documented(page: &'static str, words: &'static str) -> Result<ErrorStatement, Failure> {
    let file = project_root().join(page);
    let text = std::fs::read_to_string(&file).map_err(|e| Failure::system(&file, "read", e))?;
    let plain = text.split_whitespace().collect::<Vec<_>>().join(" ");
    Ok(if plain.contains(words) { ErrorStatement::Documented(page, words) } else { ErrorStatement::Missing })
}

/// Bound of a result for its own error.
pub(super) fn printed(error: &ErrorBudget) -> ErrorStatement {
    error.total().map_or(ErrorStatement::Missing, ErrorStatement::UpperBound)
}

/// Estimate of a result's missing diffraction, or the remark that there is none.
pub(super) fn without_edges(result: &RcsResult) -> ErrorStatement {
    match result.model_error.edges {
        Some(edges) => ErrorStatement::Estimate(edges),
        None => ErrorStatement::Remark("model_error_db.edges is null: diffraction is left out"),
    }
}

/// Outcome of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::study) enum Verdict {
    Good,
    Degraded,
    Refused,
    Wrong,
}

impl Verdict {
    pub(in crate::study) const ALL: [Self; 4] = [Self::Good, Self::Degraded, Self::Refused, Self::Wrong];

    pub(in crate::study) fn name(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Degraded => "degraded",
            Self::Refused => "refused",
            Self::Wrong => "wrong",
        }
    }
}

/// −20 dB, the default accuracy of a scene: errors below it are good.
const GOOD: f64 = 0.1;
/// Factor by which an error may exceed an estimate of a model's error, 10 dB: the spread of node rules is on
/// average 5 to 8 dB below the error of its model over full-wave scenes (docs/physics.md §2).
const ABOVE_ESTIMATE: f64 = 3.1623;

/// Verdict: good within −20 dB; beyond it degraded if the program's own statement covers the error, wrong if
/// it does not.
fn verdict(error: f64, statement: ErrorStatement) -> Verdict {
    let covered = match statement {
        ErrorStatement::Missing => false,
        ErrorStatement::UpperBound(bound) => error <= bound,
        ErrorStatement::Estimate(estimate) => error <= ABOVE_ESTIMATE * estimate,
        ErrorStatement::Remark(_) | ErrorStatement::Documented(..) => !error.is_nan(),
    };
    match (error <= GOOD, covered) {
        (true, _) => Verdict::Good,
        (false, true) => Verdict::Degraded,
        (false, false) => Verdict::Wrong, // NaN ends here too
    }
}

/// One case with one value of its parameter.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::study) struct CaseRow {
    pub(in crate::study) stage: &'static str,
    pub(in crate::study) method: &'static str,
    pub(in crate::study) case: &'static str,
    pub(in crate::study) parameter: &'static str,
    pub(in crate::study) value: String,
    /// Relative amplitude error; `None` for a refused case.
    pub(in crate::study) error: Option<f64>,
    pub(in crate::study) verdict: Verdict,
    /// Statement of the program: a figure, a flag, or the refusal.
    pub(in crate::study) statement: String,
    /// Factor by which the error exceeds its bound; `None` if it does not.
    pub(in crate::study) excess: Option<f64>,
}

/// A case before its outcome is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Trial {
    pub(super) stage: &'static str,
    pub(super) method: &'static str,
    pub(super) case: &'static str,
    pub(super) parameter: &'static str,
}

impl Trial {
    /// An answer whose error is known.
    pub(super) fn answered(self, value: impl Display, error: f64, statement: ErrorStatement) -> CaseRow {
        let excess = excess(error, statement);
        CaseRow {
            excess,
            ..self.row(value, Some(error), verdict(error, statement), words(statement, excess))
        }
    }

    /// An input that must be refused.
    pub(super) fn must_refuse<T, E: Display>(self, value: impl Display, answer: Result<T, E>) -> CaseRow {
        match answer {
            Ok(_) => self.row(value, None, Verdict::Wrong, "was taken".into()),
            Err(refusal) => self.row(value, None, Verdict::Refused, refusal.to_string()),
        }
    }

    fn row(self, value: impl Display, error: Option<f64>, verdict: Verdict, statement: String) -> CaseRow {
        let Self { stage, method, case, parameter } = self;
        let value = value.to_string();
        CaseRow { stage, method, case, parameter, value, error, verdict, statement, excess: None }
    }
}

/// Factor by which an error exceeds its bound.
fn excess(error: f64, statement: ErrorStatement) -> Option<f64> {
    match statement {
        ErrorStatement::UpperBound(bound) if error > bound => Some(error / bound),
        _ => None,
    }
}

fn words(statement: ErrorStatement, excess: Option<f64>) -> String {
    let exceeded = |factor: f64| format!(", exceeded by {:.1} dB", db_from_amplitude(factor));
    match statement {
        ErrorStatement::Missing => String::new(),
        ErrorStatement::UpperBound(bound) => {
            let exceeded = excess.map(exceeded).unwrap_or_default();
            format!("at most {:.1} dB{exceeded}", db_from_amplitude(bound))
        }
        ErrorStatement::Estimate(estimate) => format!("about {:.1} dB", db_from_amplitude(estimate)),
        ErrorStatement::Remark(words) => words.into(),
        ErrorStatement::Documented(page, words) => format!("{page}: {words}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_above_minus_twenty_db_needs_a_figure_that_covers_it() {
        assert_eq!(verdict(0.09, ErrorStatement::Missing), Verdict::Good);
        assert_eq!(verdict(0.2, ErrorStatement::Missing), Verdict::Wrong);
        assert_eq!(verdict(0.2, ErrorStatement::UpperBound(0.25)), Verdict::Degraded);
        assert_eq!(verdict(0.2, ErrorStatement::UpperBound(0.15)), Verdict::Wrong);
        assert_eq!(verdict(0.2, ErrorStatement::Estimate(0.07)), Verdict::Degraded);
        assert_eq!(verdict(f64::NAN, ErrorStatement::UpperBound(1.0)), Verdict::Wrong);
        assert_eq!(verdict(f64::NAN, ErrorStatement::Remark("null")), Verdict::Wrong);
    }

    #[test]
    fn an_error_beyond_what_was_told_is_marked_also_where_it_is_good() {
        let trial = Trial { stage: "dsp", method: "map", case: "test", parameter: "none" };
        let row = trial.answered(1, 0.02, ErrorStatement::UpperBound(0.01));
        assert_eq!((row.verdict, row.excess), (Verdict::Good, Some(2.0)));
        assert_eq!(row.statement, "at most -40.0 dB, exceeded by 6.0 dB");
        assert_eq!(trial.answered(1, 0.02, ErrorStatement::UpperBound(0.03)).excess, None);
    }

    #[test]
    fn what_should_be_refused_and_is_taken_is_wrong() {
        let trial = Trial { stage: "scene", method: "read", case: "test", parameter: "none" };
        assert_eq!(trial.must_refuse("", Ok::<(), &str>(())).verdict, Verdict::Wrong);
        assert_eq!(trial.must_refuse("", Err::<(), &str>("no")).verdict, Verdict::Refused);
    }
}
