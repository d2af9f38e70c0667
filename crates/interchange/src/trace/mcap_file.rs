//! Writing of MCAP files: uncompressed chunks, with indexes and without any clock, so that equal messages
//! give equal bytes.

use mcap::records::MessageHeader;
use mcap::write::{Metadata, NoSeek};
use mcap::{McapError, WriteOptions, Writer};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// A file being written.
pub(crate) struct McapFile<W: Write> {
    writer: Writer<NoSeek<W>>,
    /// Number of messages so far, by channel.
    sequences: BTreeMap<u16, u32>,
}

/// A channel with the descriptor of its messages.
pub(crate) struct ChannelDefinition<'a> {
    pub(crate) topic: &'a str,
    pub(crate) schema: &'a str,
    pub(crate) schema_encoding: &'a str,
    pub(crate) definition: &'a [u8],
    pub(crate) message_encoding: &'a str,
    pub(crate) metadata: BTreeMap<String, String>,
}

impl<W: Write> McapFile<W> {
    /// Begins a file with a profile, which may be empty.
    pub(crate) fn begin(sink: W, profile: &str) -> io::Result<Self> {
        let options = WriteOptions::new().compression(None).disable_seeking(true);
        let options = options.profile(profile).library("wayside");
        Ok(Self { writer: options.create(NoSeek::new(sink)).map_err(failed)?, sequences: BTreeMap::new() })
    }

    /// Adds a channel and returns its id.
    pub(crate) fn channel(&mut self, of: &ChannelDefinition<'_>) -> io::Result<u16> {
        let schema = self.writer.add_schema(of.schema, of.schema_encoding, of.definition).map_err(failed)?;
        self.writer.add_channel(schema, of.topic, of.message_encoding, &of.metadata).map_err(failed)
    }

    /// Writes a record of metadata about the whole file.
    pub(crate) fn metadata(&mut self, name: &str, metadata: BTreeMap<String, String>) -> io::Result<()> {
        self.writer.write_metadata(&Metadata { name: name.to_owned(), metadata }).map_err(failed)
    }

    /// Writes a message of a channel at a time; times before the origin become 0.
    pub(crate) fn write(&mut self, channel: u16, time_s: f64, message: &[u8]) -> io::Result<()> {
        let sequence = self.sequences.entry(channel).or_insert(0);
        let time_ns = (time_s * 1e9).round().max(0.0) as u64;
        let header = MessageHeader {
            channel_id: channel,
            sequence: *sequence,
            log_time: time_ns,
            publish_time: time_ns,
        };
        *sequence = sequence.wrapping_add(1);
        self.writer.write_to_known_channel(&header, message).map_err(failed)
    }

    /// Writes the indexes and the end of the file.
    pub(crate) fn finish(mut self) -> io::Result<()> {
        self.writer.finish().map_err(failed)?;
        Ok(())
    }
}

fn failed(error: McapError) -> io::Error {
    match error {
        McapError::Io(error) => error,
        other => io::Error::other(other),
    }
}
