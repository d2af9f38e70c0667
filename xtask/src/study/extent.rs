//! Extent of a study: the number of its cases.

/// Extent of a study: that of `--quick`, or the whole page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Extent {
    /// Fewer and smaller cases.
    Quick,
    /// Every case of the page.
    Full,
}

impl Extent {
    /// Number of cases to try among `cases`: for a quick study a fiftieth, and at least two.
    pub(super) fn case_count(self, cases: u64) -> u64 {
        match self {
            Self::Quick => (cases / 50).max(2),
            Self::Full => cases,
        }
    }
}
