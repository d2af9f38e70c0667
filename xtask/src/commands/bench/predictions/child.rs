//! One run of the program as a process of its own: its processor time and its largest size are that run's alone.

use crate::failure::Failure;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// What a run took.
#[derive(Debug, Clone, Copy)]
pub(super) struct Taken {
    pub(super) processor_s: f64,
    pub(super) peak_mib: f64,
}

/// `run` of a scene without a cache; `None` where the system does not tell what a process took.
pub(super) fn run(scene: &Path, out: &Path, threads: Option<u16>) -> Result<Option<Taken>, Failure> {
    let program = std::env::current_exe().map_err(|e| Failure::System(format!("no program to run: {e}")))?;
    let mut command = Command::new(program);
    command.arg("run").arg(scene).arg("--out").arg(out).args(["--no-cache", "--quiet"]);
    command.args(threads.iter().flat_map(|n| ["--threads".to_owned(), n.to_string()]));
    let before = of_children();
    let system = |e: std::io::Error| Failure::System(format!("{}: cannot be run: {e}", scene.display()));
    let mut child = command.stdout(Stdio::null()).spawn().map_err(system)?;
    let peak_mib = watch(&mut child).map_err(system)?;
    let status = child.wait().map_err(system)?;
    if !status.success() {
        return Err(Failure::refused(format!("{}: {status}", scene.display())));
    }
    let taken = |((before, after), peak_mib): ((f64, f64), f64)| Taken { processor_s: after - before, peak_mib };
    Ok(before.zip(of_children()).zip(peak_mib).map(taken))
}

/// The largest size that is seen until the process ends: the system keeps the maximum, so only what grows in the last
/// hundredth of a second may be missed.
fn watch(child: &mut Child) -> std::io::Result<Option<f64>> {
    let mut peak_mib = None;
    while child.try_wait()?.is_none() {
        peak_mib = crate::memory::peak_mib_of(&child.id().to_string()).or(peak_mib);
        std::thread::sleep(Duration::from_millis(10));
    }
    Ok(peak_mib)
}

fn of_children() -> Option<f64> {
    crate::processor_time::of_ended_children()
}
