//! Programs as separate processes, so that their processor time and peak size are their own.

use std::fmt::Display;
use std::process::{Child, Command, Stdio};
use std::time::Duration;
use wayside::host::failure::Failure;
use wayside::host::{memory, processor_time};

/// Costs of a process.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProcessCosts {
    pub(crate) processor_s: f64,
    pub(crate) peak_mib: f64,
}

/// Runs a program to its end, without its lines of results; `None` if the system does not report the costs
/// of a process. `about` names the work where it fails.
pub(crate) fn costs_of(command: &mut Command, about: impl Display) -> Result<Option<ProcessCosts>, Failure> {
    let before = processor_time::of_ended_children();
    let system = |e: std::io::Error| Failure::System(format!("{about}: cannot be run: {e}"));
    let mut child = command.stdout(Stdio::null()).spawn().map_err(system)?;
    let peak_mib = watch(&mut child).map_err(system)?;
    let status = child.wait().map_err(system)?;
    if !status.success() {
        return Err(Failure::refused(format!("{about}: {status}")));
    }
    let processor_s = processor_time::of_ended_children().zip(before).map(|(after, before)| after - before);
    Ok(processor_s.zip(peak_mib).map(|(processor_s, peak_mib)| ProcessCosts { processor_s, peak_mib }))
}

/// Peak size seen until the process ends: the system keeps the maximum, so only growth in the last hundredth
/// of a second may be missed.
fn watch(child: &mut Child) -> std::io::Result<Option<f64>> {
    let mut peak_mib = None;
    while child.try_wait()?.is_none() {
        peak_mib = memory::peak_mib_of(&child.id().to_string()).or(peak_mib);
        std::thread::sleep(Duration::from_millis(10));
    }
    Ok(peak_mib)
}
