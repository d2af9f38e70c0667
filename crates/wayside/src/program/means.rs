//! Means for carrying out a command.

use pipeline::host::memory::Allowance;
use reporting::report::Making;

/// Means for carrying out a command.
pub struct Means {
    /// Name of the command.
    pub command: String,
    /// Memory allowed for tracing.
    pub memory: Allowance,
    /// The command of this process, for reports.
    pub making: Making,
}
