//! Every reader of this crate against files changed by their structure: lengths, counts, indices, heads of
//! chunks, values of JSON, tags, words and numbers. Each is read or refused with a sentence that names the
//! file; none panics, takes a minute, or fills the memory.
//!
//! ```text
//! WAYSIDE_FUZZ_CASES=100000   cases for each reader (400)
//! WAYSIDE_FUZZ_MINUTES=30     as many processor minutes for each reader instead, in turn
//! WAYSIDE_FUZZ_SEED=2         other cases (1)
//! WAYSIDE_FUZZ_READER=fcd     one reader
//! ```
//!
//! A case that fails stays in the folder that is told; its seed and number make it again.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

mod gltf;
mod noise;
mod readers;
mod sound;
mod tokens;
mod watch;

use noise::Noise;
use readers::{READERS, Reader};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::Duration;

/// Number of trials of a reader, and what came of them.
#[derive(Default, Clone)]
struct Tally {
    cases: u64,
    read: u64,
    /// Processor time, making the cases included.
    spent: Duration,
}

fn asked<T: std::str::FromStr>(name: &str) -> Option<T> {
    std::env::var(name).ok()?.parse().ok()
}

#[test]
fn files_of_changed_structure_are_read_or_refused_with_a_sentence() {
    let folder = tempfile::Builder::new().prefix("wayside-fuzz-").tempdir().unwrap().keep();
    watch::start(&folder);
    let only: Option<String> = asked("WAYSIDE_FUZZ_READER");
    let chosen: Vec<&Reader> =
        READERS.iter().filter(|r| only.as_ref().is_none_or(|name| r.name == *name)).collect();
    let mut tallies = vec![Tally::default(); chosen.len()];
    while let Some(next) = next_of(&tallies) {
        let begin = watch::processor_time();
        for _ in 0..100 {
            one_case(chosen[next], &mut tallies[next], &folder);
        }
        tallies[next].spent += watch::processor_time().saturating_sub(begin);
        if tallies[next].cases.is_multiple_of(10_000) {
            tell(chosen[next], &tallies[next]);
        }
    }
    chosen.iter().zip(&tallies).for_each(|(reader, tally)| tell(reader, tally));
    watch::rest();
    assert!(
        tallies.iter().all(|tally| tally.read > 0 && tally.read < tally.cases),
        "some are read and some refused"
    );
    std::fs::remove_dir_all(folder).unwrap();
}

/// The reader that was tried least, until all were enough.
fn next_of(tallies: &[Tally]) -> Option<usize> {
    let minutes: Option<f64> = asked("WAYSIDE_FUZZ_MINUTES");
    let cases = asked("WAYSIDE_FUZZ_CASES").unwrap_or(400);
    let is_enough = |tally: &Tally| match minutes {
        Some(minutes) => tally.spent.as_secs_f64() >= 60.0 * minutes,
        None => tally.cases >= cases,
    };
    let open = (0..tallies.len()).filter(|i| !is_enough(&tallies[*i]));
    open.min_by_key(
        |i| if minutes.is_some() { tallies[*i].spent.as_millis() as u64 } else { tallies[*i].cases },
    )
}

fn one_case(reader: &Reader, tally: &mut Tally, folder: &Path) {
    let seed = asked("WAYSIDE_FUZZ_SEED").unwrap_or(1);
    readers::prepare(folder);
    watch::begin(tally.cases);
    let mut noise = Noise::of(seed, tally.cases);
    let tried = catch_unwind(AssertUnwindSafe(|| reader.try_case(&mut noise, folder)));
    let about = format!("{}: seed {seed}, case {}, in {}", reader.name, tally.cases, folder.display());
    let read = tried.unwrap_or_else(|_| panic!("{about}"));
    watch::check_memory(&about);
    tally.cases += 1;
    tally.read += u64::from(read);
}

fn tell(reader: &Reader, tally: &Tally) {
    let Tally { cases, read, spent } = tally;
    let (minutes, peak) = (spent.as_secs_f64() / 60.0, watch::peak_mib().unwrap_or(0));
    println!(
        "{}: {cases} cases, {read} read, {} refused, {minutes:.1} minutes, at most {peak} MiB",
        reader.name,
        cases - read
    );
}
