//! Calling long work off from outside: it ends between two frames, and what is whole is kept.

use crate::host::failure::Failure;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A switch that whoever runs a scene keeps a copy of; switched once, the work ends with
/// [`Failure::CalledOff`].
#[derive(Debug, Clone, Default)]
pub struct CallOff(Arc<AtomicBool>);

impl CallOff {
    /// Asks the work to end; callable from any thread.
    pub fn call_off(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// A failure once the work was called off.
    pub fn check(&self) -> Result<(), Failure> {
        if self.0.load(Ordering::Relaxed) { Err(Failure::CalledOff) } else { Ok(()) }
    }
}
