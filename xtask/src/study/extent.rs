//! How much a study tries.

/// With `--quick`, or all that its page holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Extent {
    /// Fewer and smaller cases.
    Quick,
    /// Every case of the page.
    Full,
}
