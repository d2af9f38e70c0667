//! SUMO's floating-car data, step by step: `.xml` as it is or packed by gzip, of any length; one step is held at a time.
//!
//! Schema: `fcd_file.xsd` of SUMO (<https://sumo.dlr.de/docs/Simulation/Output/FCDOutput.html>): `<fcd-export>` holds
//! `<timestep time>`, which hold `<vehicle id x y angle type speed …>`. Attributes that are not read (`pos`, `lane`, `slope`,
//! `acceleration`, signals and more) may be there or not; elements other than vehicles (`<person>`, `<container>`) are
//! passed over, since no model of ours is meant by them.

use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

/// One step of a recording.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FcdStep {
    /// The simulation's clock.
    pub time_s: f64,
    /// Line on which the step begins, from 1.
    pub line: u64,
    /// In the order of the file.
    pub vehicles: Vec<FcdVehicle>,
}

/// A vehicle at one step, as recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct FcdVehicle {
    /// Unique among the vehicles of a step.
    pub id: String,
    /// `type`: the recording's vType.
    pub kind: String,
    /// `x`, `y` and, where there is one, `z` (else 0): the middle of the front bumper.
    pub front_m: [f64; 3],
    /// `angle`: clockwise from +y, as a compass.
    pub angle_deg: f64,
    /// `speed`: along the heading.
    pub speed_mps: f64,
    /// Line of the file, from 1.
    pub line: u64,
}

/// What is wrong with a recording, and where.
#[derive(Debug, thiserror::Error)]
#[error("{}:{line}: {rule}", file.display())]
pub struct FcdError {
    /// The recording.
    pub file: PathBuf,
    /// From 1; of the unpacked text.
    pub line: u64,
    /// What is broken.
    pub rule: Box<FcdRule>,
}

impl FcdError {
    /// Whether the machine is at fault, not the content of the file.
    pub fn is_system(&self) -> bool {
        matches!(*self.rule, FcdRule::Unreadable(_))
    }
}

/// The rules of a recording, broken.
#[derive(Debug, thiserror::Error)]
pub enum FcdRule {
    /// The system refused.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] io::Error),
    /// gzip's own checks failed, or the file ends too early for them.
    #[error("the gzip file is damaged or cut off: {0}")]
    DamagedGzip(#[source] io::Error),
    /// Not XML.
    #[error("not valid XML: {0}")]
    Xml(quick_xml::Error),
    /// XML, but of something else.
    #[error("the first element is <{0}>; floating-car data begin with <fcd-export>")]
    NotFcd(String),
    /// No element at all.
    #[error("there is no XML element in it; floating-car data begin with <fcd-export>")]
    Empty,
    /// An element that never ends, or megabytes between elements.
    #[error("more than {0} bytes without an element")]
    ElementTooLong(u64),
    /// The text ends within an element.
    #[error("the file ends before </fcd-export>: it was cut off or is still being written")]
    CutOff,
    /// A vehicle outside any step.
    #[error("<vehicle> outside a <timestep>")]
    OutsideStep,
    /// An attribute that is needed.
    #[error("<{element}{}>: attribute `{attribute}` is missing", named(.id))]
    Missing {
        /// Of the element.
        element: &'static str,
        /// Of the vehicle, where it is known.
        id: Option<String>,
        /// Its name.
        attribute: &'static str,
    },
    /// An attribute that should be a number in a range.
    #[error("<{element}{}>: `{attribute}` is `{found}`; it must be {allowed}", named(.id))]
    NotANumber {
        /// Of the element.
        element: &'static str,
        /// Of the vehicle, where it is known.
        id: Option<String>,
        /// Its name.
        attribute: &'static str,
        /// As written.
        found: String,
        /// What may stand there.
        allowed: &'static str,
    },
    /// Time that stands still or runs back.
    #[error("the step's time {found} s does not come after {before} s")]
    TimeNotGrowing {
        /// Of this step.
        found: f64,
        /// Of the step before.
        before: f64,
    },
    /// Two vehicles of one name in one step.
    #[error("vehicle `{0}` is there twice in one step")]
    Twice(String),
    /// A vType without a model.
    #[error("type `{found}` of vehicle `{id}` is not in `models` of [traffic]; known are {}", .known.join(", "))]
    UnknownType {
        /// As written.
        found: String,
        /// Of the vehicle.
        id: String,
        /// Types that have a model.
        known: Vec<String>,
    },
    /// An id that would break a table of results.
    #[error("the id `{0}` holds a comma, a quote or a control character")]
    BadId(String),
    /// An id that is taken.
    #[error("vehicle `{0}` has the id of a [[target]] of the scene")]
    IdOfTarget(String),
    /// The recording does not reach the time asked for.
    #[error("the recording runs from {first} s to {last} s; frames from {begin} s to {end} s were asked for")]
    OutsideRecording {
        /// Of the first step.
        first: f64,
        /// Of the last step read.
        last: f64,
        /// Of the first frame.
        begin: f64,
        /// Of the last frame.
        end: f64,
    },
    /// Steps, but not one.
    #[error("there is no <timestep> in it")]
    NoSteps,
}

fn named(id: &Option<String>) -> String {
    id.as_ref().map_or(String::new(), |id| format!(" id=\"{id}\""))
}

/// Largest element, and largest gap between elements, that is read: SUMO's are some hundred bytes.
const ELEMENT_LIMIT_BYTES: u64 = 1 << 20;

/// Steps of a recording, in order; [`FcdReader::next_step`] hands out one after the other.
pub struct FcdReader {
    file: PathBuf,
    xml: quick_xml::Reader<Lines>,
    buffer: Vec<u8>,
    last_time_s: Option<f64>,
    place: Place,
}

/// Where in the document the reader stands.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    Before,
    Inside,
    Behind,
}

impl FcdReader {
    /// Opens a recording; whether it is packed is told by its first bytes, not by its name.
    pub fn open(file: &Path) -> Result<Self, FcdError> {
        let error = |rule| FcdError { file: file.to_owned(), line: 1, rule: Box::new(rule) };
        let source = open(file).map_err(|e| error(FcdRule::Unreadable(e)))?;
        let xml = quick_xml::Reader::from_reader(source);
        Ok(Self { file: file.to_owned(), xml, buffer: vec![], last_time_s: None, place: Place::Before })
    }

    /// The recording.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// The next step; `None` behind the last.
    pub fn next_step(&mut self) -> Result<Option<FcdStep>, FcdError> {
        let mut step = None;
        loop {
            match self.advance(&mut step) {
                Ok(true) => {}
                Ok(false) => break,
                Err(rule) => return Err(self.error_at(self.xml.get_ref().line, rule)),
            }
        }
        match step {
            Some(step) => self.checked(step).map(Some),
            None => Ok(None),
        }
    }

    /// An error of this recording at a line.
    pub(crate) fn error_at(&self, line: u64, rule: FcdRule) -> FcdError {
        FcdError { file: self.file.clone(), line, rule: Box::new(rule) }
    }

    /// Reads one element; false where a step or the document ends.
    fn advance(&mut self, step: &mut Option<FcdStep>) -> Result<bool, FcdRule> {
        self.buffer.clear();
        self.xml.get_mut().since_element = 0;
        let event = self.xml.read_event_into(&mut self.buffer);
        let line = self.xml.get_ref().line;
        match event.map_err(|e| of_xml(e, self.xml.get_ref().packing))? {
            Event::Start(tag) => open_element(&tag, line, &mut self.place, step, Extent::ToItsEnd),
            Event::Empty(tag) => open_element(&tag, line, &mut self.place, step, Extent::Empty),
            Event::End(tag) => {
                if tag.name().as_ref() == "fcd-export" {
                    self.place = Place::Behind;
                }
                Ok(tag.name().as_ref() != "timestep")
            }
            Event::Eof => match self.place {
                Place::Before => Err(FcdRule::Empty),
                Place::Inside => Err(FcdRule::CutOff),
                Place::Behind => Ok(false),
            },
            _ => Ok(true),
        }
    }

    /// Time must grow, and a name is a vehicle's own.
    fn checked(&mut self, step: FcdStep) -> Result<FcdStep, FcdError> {
        if let Some(before) = self.last_time_s.filter(|before| step.time_s <= *before) {
            return Err(self.error_at(step.line, FcdRule::TimeNotGrowing { found: step.time_s, before }));
        }
        let mut ids: Vec<(&str, u64)> = step.vehicles.iter().map(|v| (v.id.as_str(), v.line)).collect();
        ids.sort_unstable();
        if let Some(pair) = ids.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            return Err(self.error_at(pair[1].1, FcdRule::Twice(pair[1].0.to_owned())));
        }
        self.last_time_s = Some(step.time_s);
        Ok(step)
    }
}

/// Whether an element has an inside.
#[derive(Clone, Copy, PartialEq)]
enum Extent {
    ToItsEnd,
    Empty,
}

/// False where a step is whole already.
fn open_element(
    tag: &BytesStart<'_>,
    line: u64,
    place: &mut Place,
    step: &mut Option<FcdStep>,
    extent: Extent,
) -> Result<bool, FcdRule> {
    match (tag.name().as_ref(), *place) {
        ("fcd-export", Place::Before) => {
            *place = if extent == Extent::Empty { Place::Behind } else { Place::Inside };
            Ok(true)
        }
        (other, Place::Before) => Err(FcdRule::NotFcd(other.to_owned())),
        ("timestep", _) => {
            let time_s = Attributes::of(tag, "timestep")?.number("time", "a number of seconds", |t| t.is_finite())?;
            *step = Some(FcdStep { time_s, line, vehicles: vec![] });
            Ok(extent == Extent::ToItsEnd)
        }
        ("vehicle", _) => {
            let step = step.as_mut().ok_or(FcdRule::OutsideStep)?;
            step.vehicles.push(vehicle(tag, line)?);
            Ok(true)
        }
        _ => Ok(true),
    }
}

/// Coordinates beyond this are a slip of units, or degrees of a map (docs/scenes.md).
const COORDINATE_LIMIT_M: f64 = 1e5;
/// Beyond the speed of sound nothing drives.
const SPEED_LIMIT_MPS: f64 = 340.0;

fn vehicle(tag: &BytesStart<'_>, line: u64) -> Result<FcdVehicle, FcdRule> {
    let attributes = Attributes::of(tag, "vehicle")?;
    let coordinate = |name| attributes.number(name, "m within ±1e5", |x| x.abs() <= COORDINATE_LIMIT_M);
    let z = if attributes.find("z").is_some() { coordinate("z")? } else { 0.0 };
    Ok(FcdVehicle {
        id: attributes.text("id")?.to_owned(),
        kind: attributes.text("type")?.to_owned(),
        front_m: [coordinate("x")?, coordinate("y")?, z],
        angle_deg: attributes.number("angle", "degrees within ±3600", |a| a.abs() <= 3600.0)?,
        speed_mps: attributes.number("speed", "m/s from 0 to 340", |v| (0.0..=SPEED_LIMIT_MPS).contains(&v))?,
        line,
    })
}

/// Attributes of one element.
struct Attributes {
    element: &'static str,
    values: Vec<(String, String)>,
}

impl Attributes {
    fn of(tag: &BytesStart<'_>, element: &'static str) -> Result<Self, FcdRule> {
        let mut values = Vec::with_capacity(12);
        for attribute in tag.attributes() {
            let attribute = attribute.map_err(|e| FcdRule::Xml(e.into()))?;
            let value = attribute.normalized_value(XmlVersion::Implicit1_0).map_err(FcdRule::Xml)?;
            values.push((attribute.key.as_ref().to_owned(), value.into_owned()));
        }
        Ok(Self { element, values })
    }

    fn find(&self, name: &str) -> Option<&str> {
        self.values.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    fn id(&self) -> Option<String> {
        self.find("id").map(str::to_owned)
    }

    fn text(&self, name: &'static str) -> Result<&str, FcdRule> {
        let missing = || FcdRule::Missing { element: self.element, id: self.id(), attribute: name };
        self.find(name).filter(|text| !text.is_empty()).ok_or_else(missing)
    }

    fn number(&self, name: &'static str, allowed: &'static str, holds: impl Fn(f64) -> bool) -> Result<f64, FcdRule> {
        let text = self.text(name)?;
        let wrong = || {
            let found = text.to_owned();
            FcdRule::NotANumber { element: self.element, id: self.id(), attribute: name, found, allowed }
        };
        text.trim().parse().ok().filter(|number: &f64| number.is_finite() && holds(*number)).ok_or_else(wrong)
    }
}

fn of_xml(error: quick_xml::Error, packing: Packing) -> FcdRule {
    let quick_xml::Error::Io(io) = &error else { return FcdRule::Xml(error) };
    // Whether the system or the unpacking failed is told by the kind alone.
    let copy = || io::Error::new(io.kind(), io.to_string());
    match io.kind() {
        io::ErrorKind::FileTooLarge => FcdRule::ElementTooLong(ELEMENT_LIMIT_BYTES),
        io::ErrorKind::UnexpectedEof | io::ErrorKind::InvalidData | io::ErrorKind::InvalidInput
            if packing == Packing::Gzip =>
        {
            FcdRule::DamagedGzip(copy())
        }
        _ => FcdRule::Unreadable(copy()),
    }
}

/// How the text lies on disk.
#[derive(Clone, Copy, PartialEq)]
enum Packing {
    Plain,
    Gzip,
}

/// A text that counts its lines as it is read.
struct Lines {
    source: BufReader<Box<dyn Read>>,
    packing: Packing,
    line: u64,
    since_element: u64,
}

fn open(file: &Path) -> io::Result<Lines> {
    let mut packed = BufReader::new(File::open(file)?);
    let packing = if packed.fill_buf()?.starts_with(&[0x1f, 0x8b]) { Packing::Gzip } else { Packing::Plain };
    let source: Box<dyn Read> = if packing == Packing::Gzip {
        Box::new(flate2::bufread::MultiGzDecoder::new(packed))
    } else {
        Box::new(packed)
    };
    Ok(Lines { source: BufReader::with_capacity(1 << 16, source), packing, line: 1, since_element: 0 })
}

impl Read for Lines {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.fill_buf()?.read(buffer)?;
        self.consume(read);
        Ok(read)
    }
}

impl BufRead for Lines {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.since_element > ELEMENT_LIMIT_BYTES {
            return Err(io::ErrorKind::FileTooLarge.into());
        }
        self.source.fill_buf()
    }

    fn consume(&mut self, amount: usize) {
        let read = self.source.buffer().get(..amount).unwrap_or_default();
        self.line += read.iter().filter(|byte| **byte == b'\n').count() as u64;
        self.since_element += amount as u64;
        self.source.consume(amount);
    }
}
