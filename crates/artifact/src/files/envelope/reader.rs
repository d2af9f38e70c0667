use crate::files::codec;
use crate::files::envelope::{
    ArtifactError, CHECKSUM_BYTES, END_BYTES, Fault, MAGIC, PREAMBLE_LIMIT, Preamble, Schema, checksum,
    end_mark,
};
use crate::files::inputs;
use serde::de::DeserializeOwned;
use std::fs::File;
use std::io::{BufReader, Cursor, Read, Seek, SeekFrom};
use std::marker::PhantomData;
use std::path::{Path, PathBuf};

/// Reads an artifact frame by frame, as an iterator over `Result<S::Frame, _>` that ends after the first
/// error.
pub struct Reader<S: Schema> {
    stream: Stream,
    preamble: Preamble,
    header: S::Header,
    told: u64,
    found: u64,
    done: bool,
    schema: PhantomData<S>,
}

impl<S: Schema> Reader<S> {
    /// Checks magic, schema, version, provenance, end mark and header; frames are read on request.
    pub fn open(file: &Path) -> Result<Self, ArtifactError> {
        Self::of(file, inputs::open)
    }

    /// Opens a file that this program has made for itself and may replace: like [`Reader::open`], but without
    /// registering it as an input.
    pub fn open_own(file: &Path) -> Result<Self, ArtifactError> {
        Self::of(file, |file| File::open(file))
    }

    /// Reads an artifact that is already in memory, like [`Reader::open`]; errors refer to it as the file
    /// `name`.
    pub fn of_bytes(name: &str, bytes: &'static [u8]) -> Result<Self, ArtifactError> {
        let file = Path::new(name);
        Self::of_stream(Stream::of(file, Box::new(Cursor::new(bytes)), bytes.len() as u64))
            .map_err(|f| f.of(file))
    }

    fn of(file: &Path, open: impl FnOnce(&Path) -> std::io::Result<File>) -> Result<Self, ArtifactError> {
        Self::of_stream(open_stream(file, open).map_err(|f| f.of(file))?).map_err(|f| f.of(file))
    }

    fn of_stream(mut stream: Stream) -> Result<Self, Fault> {
        let preamble = stream.preamble()?;
        let offset = stream.at;
        let (header, told) = stream.expect::<S>(&preamble)?;
        check_no_nan(&header, offset)?;
        stream.has_room(told, S::least_frame_bytes(&header))?;
        Ok(Self { stream, preamble, header, told, found: 0, done: false, schema: PhantomData })
    }

    /// Header, common to all frames.
    pub fn header(&self) -> &S::Header {
        &self.header
    }

    /// Header, common to all frames; consumes the reader.
    pub fn into_header(self) -> S::Header {
        self.header
    }

    /// Preamble of the artifact: its kind and origin.
    pub fn preamble(&self) -> &Preamble {
        &self.preamble
    }

    /// Number of frames according to the end mark.
    pub fn frames(&self) -> u64 {
        self.told
    }

    /// Next frame; `None` after the last.
    pub fn next_frame(&mut self) -> Result<Option<S::Frame>, ArtifactError> {
        if self.done {
            return Ok(None);
        }
        let frame = self.step();
        self.done = !matches!(frame, Ok(Some(_)));
        frame.map_err(|f| f.of(&self.stream.file))
    }

    fn step(&mut self) -> Result<Option<S::Frame>, Fault> {
        match self.stream.marker()? {
            b'F' => {
                self.found += 1;
                self.frame().map(Some)
            }
            b'E' if self.found == self.told && self.stream.at + END_BYTES - 1 == self.stream.size => Ok(None),
            b'E' => Err(Fault::Count { found: self.found, told: self.told }),
            found => Err(Fault::Marker { offset: self.stream.at - 1, found }),
        }
    }

    fn frame(&mut self) -> Result<S::Frame, Fault> {
        let (record, offset) = (format!("frame {}", self.found), self.stream.at);
        let frame = self.stream.record(&record, S::RECORD_LIMIT)?;
        match S::contradiction(&self.header, &frame) {
            None => Ok(frame),
            Some(why) => Err(Fault::Shape { record, offset, why }),
        }
    }
}

impl<S: Schema> Iterator for Reader<S> {
    type Item = Result<S::Frame, ArtifactError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.next_frame().transpose()
    }
}

/// Refuses a header that contains a NaN: later stages compare headers and plan from their numbers.
#[expect(clippy::eq_op, reason = "a value that does not equal itself contains a NaN")]
fn check_no_nan<H: PartialEq>(header: &H, offset: u64) -> Result<(), Fault> {
    if header == header {
        return Ok(());
    }
    Err(Fault::Shape { record: "the header".to_owned(), offset, why: "one of its numbers is NaN".to_owned() })
}

/// Reads the preamble of an artifact of any kind.
pub fn read_preamble(file: &Path) -> Result<Preamble, ArtifactError> {
    open_stream(file, inputs::open).and_then(|mut stream| stream.preamble()).map_err(|f| f.of(file))
}

/// Seekable source of bytes: a file or memory.
trait Source: Read + Seek + Send {}

impl<T: Read + Seek + Send> Source for T {}

/// A source with its read position.
struct Stream {
    file: PathBuf,
    bytes: BufReader<Box<dyn Source>>,
    at: u64,
    size: u64,
}

fn open_stream(file: &Path, open: impl FnOnce(&Path) -> std::io::Result<File>) -> Result<Stream, Fault> {
    let handle = open(file).map_err(Fault::system("open"))?;
    let about = handle.metadata().map_err(Fault::system("open"))?;
    if about.is_dir() {
        return Err(Fault::system("read")(std::io::Error::other("is a folder")));
    }
    Ok(Stream::of(file, Box::new(handle), about.len()))
}

impl Stream {
    fn of(file: &Path, source: Box<dyn Source>, size: u64) -> Self {
        Self { file: file.to_owned(), bytes: BufReader::new(source), at: 0, size }
    }

    fn preamble(&mut self) -> Result<Preamble, Fault> {
        if self.size < MAGIC.len() as u64 || self.take::<8>()? != *MAGIC {
            return Err(Fault::Magic);
        }
        self.record("the preamble", PREAMBLE_LIMIT)
    }

    fn expect<S: Schema>(&mut self, preamble: &Preamble) -> Result<(S::Header, u64), Fault> {
        if preamble.schema != S::NAME {
            return Err(Fault::Schema { expected: S::NAME, found: preamble.schema.clone() });
        }
        if preamble.version != S::VERSION {
            let schema = preamble.schema.clone();
            return Err(Fault::Version { schema, found: preamble.version, known: S::VERSION });
        }
        let told = self.end()?;
        match self.marker()? {
            b'H' => Ok((self.record("the header", S::RECORD_LIMIT)?, told)),
            found => Err(Fault::Marker { offset: self.at - 1, found }),
        }
    }

    /// Number of frames according to the end mark; the read position is unchanged.
    fn end(&mut self) -> Result<u64, Fault> {
        let start = self.size.checked_sub(END_BYTES).filter(|s| *s >= self.at).ok_or(Fault::MissingEnd)?;
        let mut mark = [0; END_BYTES as usize];
        self.bytes.seek(SeekFrom::Start(start)).map_err(Fault::system("read"))?;
        self.bytes.read_exact(&mut mark).map_err(Fault::system("read"))?;
        self.bytes.seek(SeekFrom::Start(self.at)).map_err(Fault::system("read"))?;
        let mut count = [0; 8];
        count.copy_from_slice(&mark[1..9]);
        let told = u64::from_le_bytes(count);
        if mark == end_mark(told) { Ok(told) } else { Err(Fault::MissingEnd) }
    }

    /// Refuses a header whose frames would be longer than the remaining bytes.
    fn has_room(&self, frames: u64, frame_bytes: u64) -> Result<(), Fault> {
        let (offset, left) = (self.at, self.size - self.at);
        if frames == 0 || frame_bytes <= left / frames {
            return Ok(());
        }
        let why =
            format!("{frames} frames of at least {frame_bytes} bytes do not fit in the {left} behind it");
        Err(Fault::Shape { record: "the header".into(), offset, why })
    }

    fn marker(&mut self) -> Result<u8, Fault> {
        Ok(self.take::<1>()?[0])
    }

    fn record<T: DeserializeOwned>(&mut self, name: &str, limit: u64) -> Result<T, Fault> {
        let (record, offset) = (name.to_owned(), self.at);
        let length = u64::from_le_bytes(self.take::<8>()?);
        let sum: [u8; CHECKSUM_BYTES] = self.take()?;
        let limit = limit.min(self.size - self.at);
        if length > limit {
            return Err(Fault::TooLong { record, offset, length, limit });
        }
        let mut bytes = vec![0; length as usize];
        self.fill(&mut bytes)?;
        if checksum(&bytes) != sum {
            return Err(Fault::Checksum { record, offset });
        }
        codec::decode(&bytes).map_err(|error| Fault::Shape { record, offset, why: error.to_string() })
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let mut bytes = [0; N];
        self.fill(&mut bytes)?;
        Ok(bytes)
    }

    fn fill(&mut self, bytes: &mut [u8]) -> Result<(), Fault> {
        if self.size - self.at < bytes.len() as u64 {
            return Err(Fault::MissingEnd);
        }
        self.bytes.read_exact(bytes).map_err(Fault::system("read"))?;
        self.at += bytes.len() as u64;
        Ok(())
    }
}
