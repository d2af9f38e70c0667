//! Ending long work from outside, between two of its parts.

use crate::oversight::error::BartError;

/// A question that work asks before each of its parts: whether it was called off.
#[derive(Clone, Copy)]
pub struct CalledOff<'a>(&'a (dyn Fn() -> bool + Sync));

impl CalledOff<'static> {
    /// Nobody ends the work before it is done.
    pub const NEVER: Self = Self(&|| false);
}

impl<'a> CalledOff<'a> {
    /// Work ends once this answers yes, from any thread.
    pub fn by(is_called_off: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self(is_called_off)
    }

    /// Refuses to begin a part of work that was called off.
    pub(crate) fn check(self) -> Result<(), BartError> {
        if (self.0)() { Err(BartError::CalledOff) } else { Ok(()) }
    }
}
