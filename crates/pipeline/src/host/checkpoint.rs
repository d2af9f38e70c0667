//! Checkpoint of long work, beside its future result: the next run of the same work resumes from it, a run of
//! other work ignores it, and a finished run removes it.
//!
//! ```text
//! magic "WAYSIDE CHECKPOINT 1\n", key in 64 hexadecimal digits, "\n"
//! record  length u32 | checksum 16 bytes | pass u32 | aspect u32 | bytes      (any number, in the order they were done)
//! ```
//!
//! Integers are little endian; checksums are the first half of BLAKE3 over the rest of the record. A killed
//! run leaves at most one incomplete record: reading ends at the first one.

use crate::host::progress;
use bart_rcs::{CheckpointKey, CheckpointStore};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

const MAGIC: &[u8] = b"WAYSIDE CHECKPOINT 1\n";
const CHECKSUM_BYTES: usize = 16;
/// Largest checkpoint: the largest table with all its orders.
const LIMIT_BYTES: u64 = 16 << 30;
const HEAD_BYTES: usize = size_of::<u32>() + CHECKSUM_BYTES;

/// The checkpoint of one piece of long work.
pub struct Checkpoint {
    place: PathBuf,
    head: Vec<u8>,
    kept: BTreeMap<CheckpointKey, Vec<u8>>,
    state: Arc<Mutex<State>>,
}

/// Part of the finished work (aspects, frames) that the next run of the same work finds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SavedWork {
    /// Nothing is kept, or nothing is finished yet.
    Nothing,
    /// Everything finished before a write failed, by a full disk for example.
    UntilFailure,
    /// All that is finished.
    All,
}

/// State of the file that receives the records.
enum State {
    /// The file is created with the first record.
    NotYet,
    /// Records go behind those that are there.
    Open(Records),
    /// The disk is full: those that are there are kept, and no more.
    Full(Records),
    /// Another run has the file, it is not ours, or it cannot be written: this run keeps nothing.
    GivenUp,
}

/// The open and locked file.
struct Records {
    file: File,
    /// Bytes up to the end of the last whole record.
    whole: u64,
}

impl Checkpoint {
    /// Opens the checkpoint of the work that `key` identifies and whose result goes to `out`; `key` has to
    /// cover everything the result depends on.
    pub fn open(out: &Path, key: &str) -> Self {
        let mut name = out.as_os_str().to_owned();
        name.push(".checkpoint");
        let mut checkpoint = Self {
            place: PathBuf::from(name),
            head: [MAGIC, key.as_bytes(), b"\n"].concat(),
            kept: BTreeMap::new(),
            state: Arc::new(Mutex::new(State::NotYet)),
        };
        // Opening a FIFO would block, and a link leads to a file of somebody else.
        let is_plain = std::fs::symlink_metadata(&checkpoint.place).is_ok_and(|about| about.is_file());
        let file =
            is_plain.then(|| File::options().read(true).write(true).open(&checkpoint.place).ok()).flatten();
        if let Some(file) = file {
            let state = checkpoint.resume_from(file).unwrap_or_else(|why| checkpoint.give_up(&why));
            *locked(&checkpoint.state) = state;
        }
        checkpoint
    }

    /// Number of aspects of the last pass that were found in the file.
    pub fn aspects(&self) -> usize {
        let last = self.kept.keys().map(|piece| piece.pass).max();
        self.kept.keys().filter(|piece| Some(piece.pass) == last).count()
    }

    /// Watch that tells, whenever it is asked, which part of the finished work the next run finds.
    pub fn watch(&self) -> impl Fn() -> SavedWork + Send + 'static + use<> {
        let (state, head_bytes) = (Arc::clone(&self.state), self.head.len() as u64);
        move || match &*locked(&state) {
            State::NotYet | State::GivenUp => SavedWork::Nothing,
            State::Open(records) if records.whole <= head_bytes => SavedWork::Nothing,
            State::Open(_) => SavedWork::All,
            State::Full(_) => SavedWork::UntilFailure,
        }
    }

    /// Removes the file once the work is done and its result written.
    pub fn finish(self) {
        let state = std::mem::replace(&mut *locked(&self.state), State::NotYet);
        if let State::Open(_locked) | State::Full(_locked) = state {
            remove(&self.place);
        }
    }

    /// Reads the complete records and moves to their end, or begins anew if the file belongs to other work.
    fn resume_from(&mut self, mut file: File) -> std::io::Result<State> {
        file.try_lock().map_err(|_| std::io::Error::other("another run has it"))?;
        let about = file.metadata()?;
        if !about.is_file() {
            return Err(std::io::Error::other("it is no plain file"));
        }
        if about.len() > LIMIT_BYTES {
            return Err(std::io::Error::other(format!("it has more than {LIMIT_BYTES} bytes")));
        }
        let mut bytes = Vec::new();
        Read::by_ref(&mut file).take(about.len()).read_to_end(&mut bytes)?;
        if !MAGIC.starts_with(&bytes[..bytes.len().min(MAGIC.len())]) {
            return Err(std::io::Error::other("it is no checkpoint"));
        }
        let whole = match bytes.strip_prefix(self.head.as_slice()) {
            Some(records) => self.head.len() + self.read(records),
            None => 0,
        };
        file.set_len(whole as u64)?;
        file.seek(SeekFrom::End(0))?;
        if whole == 0 {
            progress::note(format!("note: {}: of other work, begun anew", self.place.display()));
            return self.begin(file).map(State::Open);
        }
        Ok(State::Open(Records { file, whole: whole as u64 }))
    }

    /// Reads complete records and returns their size in bytes.
    fn read(&mut self, records: &[u8]) -> usize {
        let mut left = records;
        while let Some((piece, bytes, rest)) = record(left) {
            self.kept.insert(piece, bytes.to_vec());
            left = rest;
        }
        records.len() - left.len()
    }

    fn give_up(&self, why: &std::io::Error) -> State {
        progress::note(format!("note: {}: {why}; this run cannot be resumed", self.place.display()));
        State::GivenUp
    }

    /// The disk is full: what was kept before stays, to its last whole record, and nothing half-written
    /// behind it. Where no record is whole, nothing stays.
    fn stop_at_full_disk(&self, records: Records, why: &std::io::Error) -> State {
        if records.whole <= self.head.len() as u64 {
            remove(&self.place);
            return self.give_up(why);
        }
        let _ = records.file.set_len(records.whole); // else the next run ends its reading there
        let place = self.place.display();
        progress::note(format!(
            "note: {place}: {why}; no more is kept, the next run goes on from what it has"
        ));
        State::Full(records)
    }

    fn create(&self) -> std::io::Result<Records> {
        if let Some(folder) = self.place.parent().filter(|p| !p.as_os_str().is_empty()) {
            std::fs::create_dir_all(folder)?;
        }
        let file = File::options().write(true).create_new(true).open(&self.place)?;
        file.try_lock().map_err(|_| std::io::Error::other("another run has it"))?;
        self.begin(file)
    }

    /// Writes the head into the empty file, which goes where that fails.
    fn begin(&self, mut file: File) -> std::io::Result<Records> {
        file.write_all(&self.head).inspect_err(|_| remove(&self.place))?;
        Ok(Records { file, whole: self.head.len() as u64 })
    }
}

fn locked(state: &Mutex<State>) -> MutexGuard<'_, State> {
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A file that is left costs only its room: it is read or replaced.
fn remove(place: &Path) {
    let _ = std::fs::remove_file(place);
}

impl CheckpointStore for Checkpoint {
    fn load(&self, piece: CheckpointKey) -> Option<&[u8]> {
        self.kept.get(&piece).map(Vec::as_slice)
    }

    fn store(&self, piece: CheckpointKey, bytes: &[u8]) {
        let mut state = locked(&self.state);
        if matches!(*state, State::NotYet) {
            *state = self.create().map_or_else(|why| self.give_up(&why), State::Open);
        }
        let State::Open(records) = &mut *state else { return };
        if let Err(why) = records.append(piece, bytes)
            && let State::Open(records) = std::mem::replace(&mut *state, State::GivenUp)
        {
            *state = self.stop_at_full_disk(records, &why);
        }
    }
}

impl Records {
    /// One call to the system for a record: a run that is killed has written it or a part of it, and nothing
    /// behind it.
    fn append(&mut self, piece: CheckpointKey, bytes: &[u8]) -> std::io::Result<()> {
        let body = [&piece.pass.to_le_bytes(), &piece.aspect.to_le_bytes(), bytes].concat();
        let length = u32::try_from(body.len()).map_err(std::io::Error::other)?;
        let record = [&length.to_le_bytes(), checksum(&body).as_slice(), &body].concat();
        self.file.write_all(&record)?;
        self.whole += record.len() as u64;
        Ok(())
    }
}

/// Splits off the first record; `None` if it is incomplete.
fn record(bytes: &[u8]) -> Option<(CheckpointKey, &[u8], &[u8])> {
    let (head, rest) = bytes.split_at_checked(HEAD_BYTES)?;
    let (length, sum) = head.split_first_chunk()?;
    let (body, rest) = rest.split_at_checked(u32::from_le_bytes(*length) as usize)?;
    if checksum(body) != sum {
        return None;
    }
    let (pass, body) = body.split_first_chunk()?;
    let (aspect, bytes) = body.split_first_chunk()?;
    Some((
        CheckpointKey { pass: u32::from_le_bytes(*pass), aspect: u32::from_le_bytes(*aspect) },
        bytes,
        rest,
    ))
}

fn checksum(bytes: &[u8]) -> [u8; CHECKSUM_BYTES] {
    let mut short = [0; CHECKSUM_BYTES];
    short.copy_from_slice(&blake3::hash(bytes).as_bytes()[..CHECKSUM_BYTES]);
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIECES: [CheckpointKey; 3] = [
        CheckpointKey { pass: 0, aspect: 7 },
        CheckpointKey { pass: 0, aspect: 2 },
        CheckpointKey { pass: 1, aspect: 0 },
    ];

    fn written(out: &Path) -> Vec<u8> {
        let checkpoint = Checkpoint::open(out, "key");
        PIECES.iter().for_each(|piece| checkpoint.store(*piece, &piece.aspect.to_le_bytes()));
        drop(checkpoint); // as when the run is killed
        std::fs::read(beside(out)).unwrap()
    }

    fn beside(out: &Path) -> PathBuf {
        out.with_file_name("s.npy.checkpoint")
    }

    fn kept(out: &Path, key: &str) -> Vec<bool> {
        let checkpoint = Checkpoint::open(out, key);
        let is_kept =
            |piece: &CheckpointKey| checkpoint.load(*piece) == Some(&piece.aspect.to_le_bytes()[..]);
        PIECES.iter().map(is_kept).collect()
    }

    #[test]
    fn whole_records_are_found_again_and_no_other_byte_is_believed() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("s.npy");
        let whole = written(&out);
        assert_eq!(kept(&out, "key"), [true; 3]);
        let head = MAGIC.len() + "key\n".len();
        let record = (whole.len() - head) / 3;
        for cut in 0..whole.len() {
            std::fs::write(beside(&out), &whole[..cut]).unwrap();
            let found = kept(&out, "key");
            let expected: Vec<bool> = (1..=3).map(|n| cut >= head + n * record).collect();
            assert_eq!(found, expected, "cut at {cut}");
        }
        for at in head..whole.len() {
            let mut damaged = whole.clone();
            damaged[at] ^= 4;
            std::fs::write(beside(&out), damaged).unwrap();
            let found = kept(&out, "key");
            let first = (at - head) / record;
            assert_eq!(found, [0, 1, 2].map(|n| n < first), "a bit at {at}");
        }
    }

    #[test]
    fn other_work_begins_anew_and_a_finished_one_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("s.npy");
        written(&out);
        assert_eq!(kept(&out, "other"), [false; 3]);
        assert_eq!(kept(&out, "key"), [false; 3], "the other work has replaced it");
        written(&out);
        Checkpoint::open(&out, "key").finish();
        assert!(!beside(&out).exists());
    }

    #[test]
    fn a_file_of_that_name_that_is_no_checkpoint_is_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("s.npy");
        std::fs::write(beside(&out), "my notes").unwrap();
        assert_eq!(written(&out), b"my notes");
        Checkpoint::open(&out, "key").finish();
        assert_eq!(std::fs::read(beside(&out)).unwrap(), b"my notes");
    }

    #[cfg(unix)]
    #[test]
    fn a_fifo_of_that_name_is_not_waited_for() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("s.npy");
        assert!(std::process::Command::new("mkfifo").arg(beside(&out)).status().unwrap().success());
        assert_eq!(kept(&out, "key"), [false; 3]);
    }

    #[test]
    fn the_part_that_the_next_run_finds_is_told_at_any_time() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("s.npy");
        let checkpoint = Checkpoint::open(&out, "key");
        let found = checkpoint.watch();
        assert_eq!(found(), SavedWork::Nothing, "no aspect is finished");
        checkpoint.store(PIECES[0], b"first");
        assert_eq!(found(), SavedWork::All);
        let other = Checkpoint::open(&out, "key");
        other.store(PIECES[1], b"second");
        assert_eq!(other.watch()(), SavedWork::Nothing, "the first has the file");
        let full = |state: State| match state {
            State::Open(records) => checkpoint.stop_at_full_disk(records, &std::io::Error::other("full")),
            closed => closed,
        };
        let open = std::mem::replace(&mut *locked(&checkpoint.state), State::GivenUp);
        *locked(&checkpoint.state) = full(open);
        assert_eq!(found(), SavedWork::UntilFailure);
        checkpoint.finish();
        assert_eq!(found(), SavedWork::Nothing, "the result is written");
    }

    #[test]
    fn of_other_work_in_the_file_the_next_run_finds_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("s.npy");
        written(&out);
        assert_eq!(Checkpoint::open(&out, "other").watch()(), SavedWork::Nothing);
        written(&out);
        assert_eq!(Checkpoint::open(&out, "key").watch()(), SavedWork::All);
    }

    #[test]
    fn of_two_runs_at_once_one_keeps() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("s.npy");
        let first = Checkpoint::open(&out, "key");
        first.store(PIECES[0], b"first");
        let second = Checkpoint::open(&out, "key");
        second.store(PIECES[1], b"second");
        assert!(second.load(PIECES[0]).is_none());
        second.finish();
        assert!(beside(&out).exists(), "the first still has it");
        first.store(PIECES[1], b"too");
        drop(first);
        assert_eq!(Checkpoint::open(&out, "key").load(PIECES[1]), Some(&b"too"[..]));
    }
}
