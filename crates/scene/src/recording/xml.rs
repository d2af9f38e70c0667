//! SUMO's XML as a stream: plain or packed by gzip, of any length, each element with its line, in bounded
//! memory.

use crate::wording::excerpt::beginning;
use artifact::bounded;
use quick_xml::XmlVersion;
use quick_xml::events::{BytesEnd, BytesStart, Event};
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

/// Largest nesting depth of elements: SUMO's files have four.
const DEPTH_LIMIT: usize = 64;
/// Largest element, and largest gap between elements: SUMO's are some hundred bytes.
const ELEMENT_LIMIT_BYTES: u64 = 1 << 20;
/// Largest number of attributes of one element: SUMO's have up to thirty.
const ATTRIBUTE_LIMIT: usize = 256;

/// Reason why a file cannot be read further as XML.
#[derive(Debug, thiserror::Error)]
pub enum XmlFault {
    /// A system error, or the file is not a plain file.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] io::Error),
    /// A checksum of gzip is wrong, or the file ends before it.
    #[error("the gzip file is damaged or cut off: {0}")]
    DamagedGzip(#[source] io::Error),
    /// The file is not XML.
    #[error("not valid XML: {}", beginning(&.0.to_string(), 300))]
    Xml(quick_xml::Error),
    /// An element that never ends, or megabytes between elements.
    #[error("more than {0} bytes without an element")]
    ElementTooLong(u64),
    /// Too many nested elements.
    #[error("elements lie within one another more than {0} deep")]
    TooDeep(usize),
    /// An element with too many attributes.
    #[error("an element has more than {0} attributes")]
    TooManyAttributes(usize),
}

/// Next part of the file.
pub(crate) enum Element<'b> {
    /// An element, open until its end.
    Opens(BytesStart<'b>),
    /// An element without content.
    Empty(BytesStart<'b>),
    /// The end of an element.
    Closes(BytesEnd<'b>),
    /// Text, a comment, a declaration.
    Other,
    /// The end of the file.
    FileEnds,
}

/// A file of XML, read element by element.
pub(crate) struct XmlReader {
    xml: quick_xml::Reader<CountedLines>,
    buffer: Vec<u8>,
    depth: usize,
}

impl XmlReader {
    /// Opens a file; its first bytes, not its name, tell whether it is packed.
    pub(crate) fn open(file: &Path) -> Result<Self, XmlFault> {
        let source = CountedLines::open(file).map_err(XmlFault::Unreadable)?;
        Ok(Self { xml: quick_xml::Reader::from_reader(source), buffer: vec![], depth: 0 })
    }

    /// The line up to which the unpacked text was read, from 1.
    pub(crate) fn line(&self) -> u64 {
        self.xml.get_ref().line
    }

    /// Number of bytes of the unpacked text that were read.
    pub(crate) fn bytes(&self) -> u64 {
        self.xml.get_ref().bytes
    }

    /// Reads the next part, and returns it with the line on which it ends.
    pub(crate) fn next_element(&mut self) -> Result<(Element<'_>, u64), XmlFault> {
        self.buffer.clear();
        self.xml.get_mut().since_element = 0;
        let event = self.xml.read_event_into(&mut self.buffer);
        let CountedLines { line, compression, .. } = *self.xml.get_ref();
        let element = match event.map_err(|error| fault(error, compression))? {
            Event::Start(_) if self.depth == DEPTH_LIMIT => return Err(XmlFault::TooDeep(DEPTH_LIMIT)),
            Event::Start(tag) => {
                self.depth += 1;
                Element::Opens(tag)
            }
            Event::Empty(tag) => Element::Empty(tag),
            Event::End(tag) => {
                self.depth = self.depth.saturating_sub(1);
                Element::Closes(tag)
            }
            Event::Eof => Element::FileEnds,
            _ => Element::Other,
        };
        Ok((element, line))
    }
}

/// Names and values of an element's attributes.
pub(crate) fn attributes(tag: &BytesStart<'_>) -> Result<Vec<(String, String)>, XmlFault> {
    let mut values = Vec::with_capacity(12);
    // Attributes are read one by one, each compared with those before it.
    for attribute in tag.attributes() {
        if values.len() == ATTRIBUTE_LIMIT {
            return Err(XmlFault::TooManyAttributes(ATTRIBUTE_LIMIT));
        }
        let attribute = attribute.map_err(|e| XmlFault::Xml(e.into()))?;
        let value = attribute.normalized_value(XmlVersion::Implicit1_0).map_err(XmlFault::Xml)?;
        values.push((attribute.key.as_ref().to_owned(), value.into_owned()));
    }
    Ok(values)
}

fn fault(error: quick_xml::Error, compression: Compression) -> XmlFault {
    let quick_xml::Error::Io(io) = &error else { return XmlFault::Xml(error) };
    // Only the kind distinguishes a system error from an unpacking error.
    let copy = || io::Error::new(io.kind(), io.to_string());
    match io.kind() {
        io::ErrorKind::FileTooLarge => XmlFault::ElementTooLong(ELEMENT_LIMIT_BYTES),
        io::ErrorKind::UnexpectedEof | io::ErrorKind::InvalidData | io::ErrorKind::InvalidInput
            if compression == Compression::Gzip =>
        {
            XmlFault::DamagedGzip(copy())
        }
        _ => XmlFault::Unreadable(copy()),
    }
}

/// Compression of the text on disk.
#[derive(Clone, Copy, PartialEq)]
enum Compression {
    Plain,
    Gzip,
}

/// A text whose lines are counted while it is read.
struct CountedLines {
    source: BufReader<Box<dyn Read>>,
    compression: Compression,
    line: u64,
    bytes: u64,
    since_element: u64,
}

impl CountedLines {
    fn open(file: &Path) -> io::Result<Self> {
        let mut packed = BufReader::new(bounded::open(file)?);
        let compression = if packed.fill_buf()?.starts_with(&[0x1f, 0x8b]) {
            Compression::Gzip
        } else {
            Compression::Plain
        };
        let source: Box<dyn Read> = match compression {
            Compression::Gzip => Box::new(flate2::bufread::MultiGzDecoder::new(packed)),
            Compression::Plain => Box::new(packed),
        };
        let source = BufReader::with_capacity(1 << 16, source);
        Ok(Self { source, compression, line: 1, bytes: 0, since_element: 0 })
    }
}

impl Read for CountedLines {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.fill_buf()?.read(buffer)?;
        self.consume(read);
        Ok(read)
    }
}

impl BufRead for CountedLines {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.since_element > ELEMENT_LIMIT_BYTES {
            return Err(io::ErrorKind::FileTooLarge.into());
        }
        self.source.fill_buf()
    }

    fn consume(&mut self, amount: usize) {
        let read = self.source.buffer().get(..amount).unwrap_or_default();
        self.line += read.iter().filter(|byte| **byte == b'\n').count() as u64;
        self.bytes += amount as u64;
        self.since_element += amount as u64;
        self.source.consume(amount);
    }
}
