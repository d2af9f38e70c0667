//! Writing of OSI messages into either container.

use crate::osi::common::VERSION;
use crate::trace::container::Container;
use crate::trace::mcap_file::{ChannelDefinition, McapFile};
use crate::trace::osi_file;
use prost::Message;
use std::collections::BTreeMap;
use std::io::{self, Write};

/// A kind of message: its name, topic and description.
pub(crate) struct MessageKind {
    pub(crate) schema: &'static str,
    pub(crate) topic: &'static str,
    pub(crate) descriptor: fn() -> Vec<u8>,
}

/// A file of messages of one kind being written.
pub(crate) enum TraceWriter<W: Write> {
    Osi(W),
    Mcap(Box<McapFile<W>>, u16),
}

/// Version of the wire encoding stated to readers; that of proto2 has not changed since.
const PROTOBUF_VERSION: &str = "3.0.0";

impl<W: Write> TraceWriter<W> {
    /// Begins a file.
    pub(crate) fn begin(sink: W, container: Container, kind: &MessageKind) -> io::Result<Self> {
        match container {
            Container::Osi => Ok(Self::Osi(sink)),
            Container::Mcap => {
                let mut file = McapFile::begin(sink, "")?;
                file.metadata("net.asam.osi.trace", of_file())?;
                let channel = file.channel(&ChannelDefinition {
                    topic: kind.topic,
                    schema: kind.schema,
                    schema_encoding: "protobuf",
                    definition: &(kind.descriptor)(),
                    message_encoding: "protobuf",
                    metadata: of_channel(),
                })?;
                Ok(Self::Mcap(Box::new(file), channel))
            }
        }
    }

    /// Writes a message at its time.
    pub(crate) fn write(&mut self, time_s: f64, message: &impl Message) -> io::Result<()> {
        let bytes = message.encode_to_vec();
        match self {
            Self::Osi(sink) => osi_file::write(sink, &bytes),
            Self::Mcap(file, channel) => file.write(*channel, time_s, &bytes),
        }
    }

    /// Writes the end of the file.
    pub(crate) fn finish(self) -> io::Result<()> {
        match self {
            Self::Osi(mut sink) => sink.flush(),
            Self::Mcap(file, _) => file.finish(),
        }
    }
}

fn osi_version() -> String {
    VERSION.map(|part| part.to_string()).join(".")
}

/// Metadata that OSI requires of every file.
fn of_file() -> BTreeMap<String, String> {
    let told = [
        ("version", osi_version()),
        ("min_osi_version", osi_version()),
        ("max_osi_version", osi_version()),
        ("min_protobuf_version", PROTOBUF_VERSION.into()),
        ("max_protobuf_version", PROTOBUF_VERSION.into()),
        ("description", "simulated by wayside".into()),
    ];
    told.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

/// Metadata that OSI requires of every channel.
fn of_channel() -> BTreeMap<String, String> {
    let told = [
        ("net.asam.osi.trace.channel.osi_version", osi_version()),
        ("net.asam.osi.trace.channel.protobuf_version", PROTOBUF_VERSION.into()),
    ];
    told.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}
