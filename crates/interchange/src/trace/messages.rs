//! Messages of one kind in a file of either container, which its first bytes identify.

use crate::trace::fault::{TraceError, TraceRule};
use crate::trace::mcap_messages::McapMessages;
use crate::trace::mcap_records::MAGIC;
use crate::trace::osi_file;
use std::fs::File;
use std::io::{BufReader, Chain, Cursor, Read};
use std::path::{Path, PathBuf};

/// Bytes that were already examined, followed by the file.
type RewoundFile = Chain<Cursor<Vec<u8>>, File>;

enum Source {
    Osi(BufReader<RewoundFile>),
    Mcap(Box<McapMessages<File>>),
}

/// Messages in the order of the file.
pub(crate) struct Messages {
    file: PathBuf,
    source: Source,
    number: u64,
}

impl Messages {
    /// Opens a plain file; of MCAP only the messages of that schema are returned.
    pub(crate) fn open(file: &Path, schema: &'static str) -> Result<Self, TraceError> {
        let failed = |rule: TraceRule| TraceError { file: file.to_owned(), message: 1, rule };
        let unreadable = |error| failed(TraceRule::Unreadable(error));
        let mut handle = artifact::bounded::open(file).map_err(unreadable)?;
        let mut first = [0; MAGIC.len()];
        let known = osi_file::read_up_to(&mut handle, &mut first).map_err(unreadable)?;
        let source = if first == MAGIC {
            Source::Mcap(Box::new(McapMessages::new(BufReader::new(handle), schema)))
        } else {
            Source::Osi(BufReader::new(Cursor::new(first[..known].to_vec()).chain(handle)))
        };
        Ok(Self { file: file.to_owned(), source, number: 0 })
    }

    /// The file.
    pub(crate) fn file(&self) -> &Path {
        &self.file
    }

    /// Number of the last returned message, from 1.
    pub(crate) fn number(&self) -> u64 {
        self.number
    }

    /// The next message; `None` after the last.
    pub(crate) fn next(&mut self) -> Result<Option<Vec<u8>>, TraceError> {
        self.number += 1;
        let message = match &mut self.source {
            Source::Osi(source) => osi_file::next(source),
            Source::Mcap(messages) => messages.next(),
        };
        message.map_err(|rule| self.error(rule))
    }

    /// An error of the last returned message.
    pub(crate) fn error(&self, rule: TraceRule) -> TraceError {
        TraceError { file: self.file.clone(), message: self.number, rule }
    }
}
