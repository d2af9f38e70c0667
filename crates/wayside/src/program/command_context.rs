//! Context in which a command is carried out.

use pipeline::host::memory::Allowance;
use reporting::report::ReportOrigin;

/// Context in which a command is carried out.
pub struct CommandContext {
    /// Name of the command.
    pub command: String,
    /// Memory allowed for tracing.
    pub memory: Allowance,
    /// The command of this process, for reports.
    pub origin: ReportOrigin,
}
