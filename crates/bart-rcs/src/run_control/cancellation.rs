//! Cancellation of long work from outside, between two of its parts.

use crate::run_control::error::BartError;

/// Cancellation of work by its caller, checked before each of its parts.
#[derive(Clone, Copy)]
pub struct CancellationCheck<'a>(&'a (dyn Fn() -> bool + Sync));

impl CancellationCheck<'static> {
    /// Nobody ends the work before it is done.
    pub const NEVER: Self = Self(&|| false);
}

impl<'a> CancellationCheck<'a> {
    /// Work ends once `is_cancelled` answers yes, from any thread.
    pub fn by(is_cancelled: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self(is_cancelled)
    }

    /// Refuses to begin a part of cancelled work.
    pub(crate) fn check(self) -> Result<(), BartError> {
        if (self.0)() { Err(BartError::Cancelled) } else { Ok(()) }
    }
}
