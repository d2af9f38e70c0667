//! Log of what was tried: lines that add up over runs and sessions.

use std::fmt::Display;
use std::io::Write;
use std::path::Path;
use std::time::Duration;

/// Number of cases that a reader was given, and what came of them.
#[derive(Default, Clone, Copy)]
pub(crate) struct Tally {
    pub(crate) cases: u64,
    pub(crate) read: u64,
    /// Processor time, making the cases included.
    pub(crate) spent: Duration,
    /// Most memory that the process has had during them; 0 where the system does not tell.
    pub(crate) peak_mib: u64,
}

impl Tally {
    /// Counts since an earlier state of the same tally; the memory is that of now.
    pub(crate) fn since(self, earlier: &Self) -> Self {
        Self {
            cases: self.cases - earlier.cases,
            read: self.read - earlier.read,
            spent: self.spent.saturating_sub(earlier.spent),
            peak_mib: self.peak_mib,
        }
    }

    /// Sentence for a person.
    pub(crate) fn summary(&self, reader: &str) -> String {
        let Self { cases, read, peak_mib, .. } = self;
        let (refused, minutes) = (cases - read, self.spent.as_secs_f64() / 60.0);
        format!(
            "{reader}: {cases} cases, {read} read, {refused} refused, {minutes:.1} minutes, at most \
             {peak_mib} MiB"
        )
    }

    /// A line of the log: reader, seed, cases, read, refused, processor minutes, most memory in MiB.
    pub(crate) fn csv_line(&self, reader: &str, seed: impl Display) -> String {
        let Self { cases, read, peak_mib, .. } = self;
        let (refused, minutes) = (cases - read, self.spent.as_secs_f64() / 60.0);
        format!("{reader},{seed},{cases},{read},{refused},{minutes:.4},{peak_mib}")
    }
}

/// Appends a line.
pub(crate) fn append(log: &Path, line: &str) {
    let mut file = std::fs::File::options().append(true).create(true).open(log).unwrap();
    file.write_all(format!("{line}\n").as_bytes()).unwrap();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_parts_add_up_to_the_whole() {
        let part = Tally { cases: 7, read: 2, spent: Duration::from_secs(30), peak_mib: 5 };
        let whole = Tally { cases: 10, read: 4, spent: Duration::from_secs(90), peak_mib: 9 };
        assert_eq!(whole.since(&part).csv_line("fcd", 3), "fcd,3,3,2,1,1.0000,9");
        assert_eq!(whole.summary("fcd"), "fcd: 10 cases, 4 read, 6 refused, 1.5 minutes, at most 9 MiB");
    }
}
