//! Means with which a command is carried out.

use pipeline::host::memory::Allowance;
use reporting::report::Making;

/// Means with which a command is carried out.
pub struct Means {
    /// Word of the command.
    pub command: String,
    /// Memory that tracing may take.
    pub memory: Allowance,
    /// The command of this process, for reports.
    pub making: Making,
}
