//! The program with a bound on its processor time and its memory.

use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// Largest address space of the program, KiB; threads reserve some of it.
const MOST_KIB: u64 = 8 << 20;
/// Longest processor time of the program, s: what other programs take of the processor does not count.
const LONGEST_PROCESSOR_S: u64 = 60;
/// A program that waits for something takes no processor time.
const LONGEST_WAIT: Duration = Duration::from_secs(1200);

/// End of a command, what it said and how long it took.
pub(crate) struct Ended {
    pub(crate) status: ExitStatus,
    /// Text on standard output.
    pub(crate) printed: String,
    /// Text on standard error.
    pub(crate) said: String,
    pub(crate) after: Duration,
}

impl Ended {
    /// Refused: exit code 1 or 2 and a sentence.
    pub(crate) fn is_refused(&self) -> bool {
        matches!(self.status.code(), Some(1 | 2)) && self.said.contains("error: ")
    }
}

/// Runs the program in a folder; it is killed where it takes a minute of the processor, and gets no more than
/// gibibytes.
pub(crate) fn run(folder: &Path, words: impl IntoIterator<Item = impl AsRef<OsStr>>) -> Ended {
    run_within(MOST_KIB, folder, words)
}

/// Runs the program as [`run`] does, in an address space of so many KiB.
pub(crate) fn run_within(
    most_kib: u64,
    folder: &Path,
    words: impl IntoIterator<Item = impl AsRef<OsStr>>,
) -> Ended {
    let bounds = format!("ulimit -v {most_kib}; ulimit -t {LONGEST_PROCESSOR_S}; exec \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &bounds, "sh", super::PROGRAM]).args(words).current_dir(folder);
    let [log, output] = ["said", "printed"].map(|name| std::fs::File::create(folder.join(name)).unwrap());
    command.stdin(Stdio::null()).stdout(output).stderr(log);
    let start = Instant::now();
    let mut child = command.spawn().unwrap();
    let status = loop {
        match child.try_wait().unwrap() {
            Some(status) => break status,
            None if start.elapsed() > LONGEST_WAIT => {
                child.kill().unwrap();
                break child.wait().unwrap();
            }
            None => std::thread::sleep(Duration::from_millis(2)),
        }
    };
    let [said, printed] = ["said", "printed"]
        .map(|name| String::from_utf8_lossy(&std::fs::read(folder.join(name)).unwrap()).into_owned());
    Ended { status, printed, said, after: start.elapsed() }
}
