//! The loop over readers: cases are made, read and counted.

use crate::log::{self, Tally};
use crate::rng::FuzzRng;
use crate::watchdog;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Something that reads files.
pub struct Reader {
    /// Name of the reader, by the format that it is for.
    name: &'static str,
    /// Cases of a plain test, so that all readers of a crate take seconds.
    cases: u64,
    /// Writes the files of a case into a folder.
    write: fn(&mut FuzzRng, &Path),
    /// Reads them; the sentence of a refusal, which names the file.
    read: fn(&Path) -> Result<(), String>,
    /// Fate of damage.
    damage: DamagePolicy,
}

impl Reader {
    /// A reader that refuses what is damaged.
    pub const fn refusing(
        name: &'static str,
        cases: u64,
        write: fn(&mut FuzzRng, &Path),
        read: fn(&Path) -> Result<(), String>,
    ) -> Self {
        Self { name, cases, write, read, damage: DamagePolicy::Refuse }
    }

    /// A reader that makes anew what is damaged.
    pub const fn regenerating(
        name: &'static str,
        cases: u64,
        write: fn(&mut FuzzRng, &Path),
        read: fn(&Path) -> Result<(), String>,
    ) -> Self {
        Self { name, cases, write, read, damage: DamagePolicy::Regenerate }
    }
}

/// Answer of a reader to a file that is not as it should be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum DamagePolicy {
    /// Refusal, with a sentence.
    Refuse,
    /// Making anew of what the file was for.
    Regenerate,
}

/// Tries every reader on as many cases as the environment asks for, or for as long; `prepare` readies the
/// folder before each case. Ends with a panic where a case breaks a limit, or nothing was read or refused.
pub fn fuzz(readers: &[Reader], prepare: fn(&Path)) {
    try_all(readers, prepare, &FuzzOptions::from_environment());
}

fn try_all(readers: &[Reader], prepare: fn(&Path), options: &FuzzOptions) {
    let folder = tempfile::Builder::new().prefix("wayside-fuzz-").tempdir().unwrap().keep();
    watchdog::start(&folder);
    let mut trials: Vec<Trial> = readers
        .iter()
        .filter(|reader| options.only.as_ref().is_none_or(|name| reader.name == *name))
        .map(|reader| Trial { reader, tally: Tally::default(), logged: Tally::default() })
        .collect();
    assert!(!trials.is_empty(), "no reader is called {:?}", options.only);
    while let Some(next) = least_tried(&trials, options) {
        trials[next].run_turn(options, prepare, &folder);
    }
    watchdog::set_idle();
    trials.iter_mut().for_each(|trial| trial.finish(options));
    match options.keep_files {
        KeepFiles::OnFailure => std::fs::remove_dir_all(folder).unwrap(),
        KeepFiles::Always => println!("the files stay in {}", folder.display()),
    }
}

/// Trials that the environment asks for.
#[derive(Default)]
struct FuzzOptions {
    cases: Option<u64>,
    minutes: Option<f64>,
    seed: u64,
    first: u64,
    keep_files: KeepFiles,
    only: Option<String>,
    log: Option<PathBuf>,
}

/// Whether the files of the last case stay.
#[derive(Default, Clone, Copy, PartialEq, Eq)]
enum KeepFiles {
    #[default]
    OnFailure,
    Always,
}

impl FuzzOptions {
    fn from_environment() -> Self {
        let one: Option<u64> = variable("WAYSIDE_FUZZ_CASE");
        Self {
            cases: one.map(|_| 1).or_else(|| variable("WAYSIDE_FUZZ_CASES")),
            minutes: variable("WAYSIDE_FUZZ_MINUTES").filter(|_| one.is_none()),
            seed: variable("WAYSIDE_FUZZ_SEED").unwrap_or(1),
            first: one.or_else(|| variable("WAYSIDE_FUZZ_FIRST")).unwrap_or(0),
            keep_files: one.map_or(KeepFiles::OnFailure, |_| KeepFiles::Always),
            only: variable("WAYSIDE_FUZZ_READER"),
            log: variable("WAYSIDE_FUZZ_LOG"),
        }
    }

    fn is_done(&self, trial: &Trial) -> bool {
        match self.minutes {
            Some(minutes) => trial.tally.spent.as_secs_f64() >= 60.0 * minutes,
            None => trial.tally.cases >= self.cases_of(trial),
        }
    }

    fn cases_of(&self, trial: &Trial) -> u64 {
        self.cases.unwrap_or(trial.reader.cases)
    }
}

fn variable<T: std::str::FromStr>(name: &str) -> Option<T> {
    let text = std::env::var(name).ok()?;
    Some(text.parse().unwrap_or_else(|_| panic!("{name}={text} is not understood")))
}

/// The reader that was tried least, until all were enough.
fn least_tried(trials: &[Trial], options: &FuzzOptions) -> Option<usize> {
    let least = |i: &usize| match options.minutes {
        Some(_) => trials[*i].tally.spent.as_millis() as u64,
        None => trials[*i].tally.cases,
    };
    (0..trials.len()).filter(|i| !options.is_done(&trials[*i])).min_by_key(least)
}

/// A reader with what came of its cases.
struct Trial<'a> {
    reader: &'a Reader,
    tally: Tally,
    /// Part of the tally that stands in the log.
    logged: Tally,
}

/// Number of cases of one reader in a row.
const TURN_CASES: u64 = 100;
const TURN: Duration = Duration::from_secs(2);
/// Processor time of a line of the log.
const LINE: Duration = Duration::from_secs(60);

impl Trial<'_> {
    /// Some cases, then the next reader has its turn.
    fn run_turn(&mut self, options: &FuzzOptions, prepare: fn(&Path), folder: &Path) {
        watchdog::reset_peak();
        let begin = watchdog::processor_time();
        for _ in 0..TURN_CASES {
            self.run_case(options, prepare, folder);
            let spent = watchdog::processor_time().saturating_sub(begin);
            let is_all = options.minutes.is_none() && self.tally.cases >= options.cases_of(self);
            if is_all || spent > TURN {
                break;
            }
        }
        self.tally.spent += watchdog::processor_time().saturating_sub(begin);
        self.tally.peak_mib = self.tally.peak_mib.max(watchdog::peak_mib().unwrap_or(0));
        if self.tally.since(&self.logged).spent >= LINE {
            self.log_line(options);
        }
    }

    fn run_case(&mut self, options: &FuzzOptions, prepare: fn(&Path), folder: &Path) {
        let (seed, case) = (options.seed, options.first + self.tally.cases);
        let about = format!("{}: seed {seed}, case {case}, in {}", self.reader.name, folder.display());
        prepare(folder);
        watchdog::begin_case(&about);
        let mut rng = FuzzRng::new(seed, case);
        let tried = catch_unwind(AssertUnwindSafe(|| try_case(self.reader, &mut rng, folder)));
        let read = tried.unwrap_or_else(|_| panic!("{about}"));
        watchdog::check_memory(&about);
        self.tally.cases += 1;
        self.tally.read += u64::from(read);
    }

    fn log_line(&mut self, options: &FuzzOptions) {
        if let Some(log) = &options.log {
            log::append(log, &self.tally.since(&self.logged).csv_line(self.reader.name, options.seed));
        }
        println!("{}", self.tally.summary(self.reader.name));
        self.logged = self.tally;
    }

    fn finish(&mut self, options: &FuzzOptions) {
        if self.tally.cases > self.logged.cases {
            self.log_line(options);
        }
        let Tally { cases, read, .. } = self.tally;
        let least_refused = u64::from(self.reader.damage == DamagePolicy::Refuse);
        // A few cases that are asked for may be of one kind.
        let is_both = cases < 10 || (read > 0 && cases - read >= least_refused);
        assert!(is_both, "{}: some are read and some refused", self.reader.name);
    }
}

/// Makes a case and reads it; whether it was read.
fn try_case(reader: &Reader, rng: &mut FuzzRng, folder: &Path) -> bool {
    (reader.write)(rng, folder);
    let Err(sentence) = (reader.read)(folder) else { return true };
    assert!(!sentence.trim().is_empty(), "{}: refused without a word", reader.name);
    assert!(sentence.len() < 1 << 20, "{}: refused in {} bytes", reader.name, sentence.len());
    let is_named = sentence.contains(&*folder.to_string_lossy());
    assert!(is_named, "{}: no file named: {sentence}", reader.name);
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    fn try_numbers(read: fn(&Path) -> Result<(), String>) {
        let write = |rng: &mut FuzzRng, at: &Path| std::fs::write(at.join("f"), rng.number_text()).unwrap();
        let options = FuzzOptions { seed: 1, cases: Some(40), ..FuzzOptions::default() };
        try_all(&[Reader::refusing("numbers", 1, write, read)], |_| {}, &options);
    }

    fn is_negative(at: &Path) -> bool {
        std::fs::read_to_string(at.join("f")).unwrap().starts_with('-')
    }

    #[test]
    fn a_reader_that_refuses_with_a_sentence_passes() {
        try_numbers(|at| match is_negative(at) {
            true => Err(format!("{}: is negative", at.join("f").display())),
            false => Ok(()),
        });
    }

    #[test]
    #[should_panic(expected = "numbers: seed 1, case ")]
    fn a_reader_that_panics_is_told_with_the_case() {
        try_numbers(|at| if is_negative(at) { panic!("as it should not") } else { Ok(()) });
    }

    #[test]
    #[should_panic(expected = "numbers: seed 1, case ")]
    fn a_refusal_that_names_no_file_is_no_refusal() {
        try_numbers(|at| if is_negative(at) { Err("no".to_owned()) } else { Ok(()) });
    }

    #[test]
    #[should_panic(expected = "numbers: some are read and some refused")]
    fn a_reader_that_refuses_nothing_is_not_tried_by_these_cases() {
        try_numbers(|_| Ok(()));
    }
}
