//! Messages of one schema in an MCAP file, in the order of the file, chunks decompressed one at a time.

use crate::trace::fault::TraceRule;
use crate::trace::mcap_records::{self, RECORD_LIMIT_BYTES};
use mcap::parse_record;
use mcap::records::{Channel, ChunkHeader, Record, op};
use std::collections::BTreeSet;
use std::io::{BufReader, Cursor, Read};

/// Reader after the magic of a file.
pub(crate) struct McapMessages<R> {
    schema: &'static str,
    file: BufReader<R>,
    chunk: Option<Cursor<Vec<u8>>>,
    /// Ids of schemas with that name.
    schemas: BTreeSet<u16>,
    channel: Option<Channel>,
}

const KINDS: [u8; 6] = [op::SCHEMA, op::CHANNEL, op::MESSAGE, op::CHUNK, op::FOOTER, op::DATA_END];

/// Result of reading a record.
enum RecordOutcome {
    Message(Vec<u8>),
    Nothing,
    End,
}

impl<R: Read> McapMessages<R> {
    /// Messages of the schema in the data after the magic.
    pub(crate) fn new(file: BufReader<R>, schema: &'static str) -> Self {
        Self { schema, file, chunk: None, schemas: BTreeSet::new(), channel: None }
    }

    /// The next message; `None` after the last.
    pub(crate) fn next(&mut self) -> Result<Option<Vec<u8>>, TraceRule> {
        loop {
            let record = match &mut self.chunk {
                Some(chunk) => mcap_records::next(chunk, &KINDS)?,
                None => mcap_records::next(&mut self.file, &KINDS)?,
            };
            match record {
                Some((kind, content)) => match self.take(kind, &content)? {
                    RecordOutcome::Message(message) => return Ok(Some(message)),
                    RecordOutcome::Nothing => {}
                    RecordOutcome::End => return self.finish(),
                },
                None if self.chunk.is_some() => self.chunk = None,
                None => return Err(TraceRule::CutOff),
            }
        }
    }

    fn finish(&self) -> Result<Option<Vec<u8>>, TraceRule> {
        if self.channel.is_some() { Ok(None) } else { Err(TraceRule::NoChannel(self.schema)) }
    }

    fn take(&mut self, kind: u8, content: &[u8]) -> Result<RecordOutcome, TraceRule> {
        let record = parse_record(kind, content).map_err(|e| TraceRule::Record(e.to_string()))?;
        match record {
            Record::Schema { header, .. } if header.name == self.schema => {
                self.schemas.insert(header.id);
            }
            Record::Channel(channel) if self.schemas.contains(&channel.schema_id) => {
                self.select_channel(channel)?
            }
            Record::Message { header, data } if self.is_selected(header.channel_id) => {
                return Ok(RecordOutcome::Message(data.into_owned()));
            }
            Record::Chunk { header, data } if self.chunk.is_none() => {
                self.chunk = Some(Cursor::new(unpacked(&header, &data)?));
            }
            Record::Footer(_) | Record::DataEnd(_) => return Ok(RecordOutcome::End),
            _ => {}
        }
        Ok(RecordOutcome::Nothing)
    }

    fn is_selected(&self, channel: u16) -> bool {
        self.channel.as_ref().is_some_and(|selected| selected.id == channel)
    }

    /// Registers a channel; channels are repeated in every chunk and at the end, but two different ones are
    /// refused.
    fn select_channel(&mut self, channel: Channel) -> Result<(), TraceRule> {
        match &self.channel {
            Some(selected) if selected.id != channel.id => Err(TraceRule::SeveralChannels {
                schema: self.schema,
                first: selected.topic.clone(),
                second: channel.topic,
            }),
            _ => {
                self.channel = Some(channel);
                Ok(())
            }
        }
    }
}

/// Content of a chunk, checked against its declared length and checksum.
fn unpacked(header: &ChunkHeader, data: &[u8]) -> Result<Vec<u8>, TraceRule> {
    let expected = header.uncompressed_size;
    if expected > RECORD_LIMIT_BYTES {
        return Err(TraceRule::TooLong {
            what: "a chunk unpacked",
            length: expected,
            limit: RECORD_LIMIT_BYTES,
        });
    }
    let compression = header.compression.as_str();
    let wrong = || TraceRule::Chunk { compression: compression.to_owned(), expected };
    let content = match compression {
        "" => data.to_vec(),
        "zstd" => {
            let unpacker =
                ruzstd::decoding::StreamingDecoder::new_with_max_window_size(data, RECORD_LIMIT_BYTES);
            at_most(unpacker.map_err(|_| wrong())?, expected).ok_or_else(wrong)?
        }
        "lz4" => at_most(lz4_flex::frame::FrameDecoder::new(data), expected).ok_or_else(wrong)?,
        other => return Err(TraceRule::Compression(other.to_owned())),
    };
    if content.len() as u64 != expected {
        return Err(wrong());
    }
    let sum = header.uncompressed_crc;
    if sum == 0 || crc32fast::hash(&content) == sum { Ok(content) } else { Err(TraceRule::ChunkSum) }
}

/// Reads a stream to its end, at most one byte beyond the limit.
fn at_most(stream: impl Read, limit: u64) -> Option<Vec<u8>> {
    let mut content = Vec::new();
    stream.take(limit + 1).read_to_end(&mut content).ok()?;
    Some(content)
}
