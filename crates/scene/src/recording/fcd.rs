//! SUMO's floating-car data, step by step: `.xml`, plain or packed by gzip, of any length; one step is held
//! at a time.
//!
//! Schema: `fcd_file.xsd` of SUMO (<https://sumo.dlr.de/docs/Simulation/Output/FCDOutput.html>):
//! `<fcd-export>` holds `<timestep time>`, which hold `<vehicle id x y angle type speed …>`. Other attributes
//! (`pos`, `lane`, `slope`, `acceleration`, signals and more) are ignored, as are elements other than
//! vehicles (`<person>`, `<container>`), for which there are no models.

use crate::recording::step_order::{Disorder, StepOrder};
use crate::recording::xml::{self, Element, XmlFault, XmlReader};
use crate::wording::excerpt::excerpt;
use glam::DVec3;
use quick_xml::events::BytesStart;
use std::path::{Path, PathBuf};

/// One step of a recording.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FcdStep {
    /// The simulation's clock.
    pub time_s: f64,
    /// Line on which the step begins, from 1.
    pub line: u64,
    /// Vehicles in the order of the file.
    pub vehicles: Vec<FcdVehicle>,
}

impl FcdStep {
    /// Refuses a step that breaks the order, with the line at fault.
    pub(crate) fn checked(&self, order: &mut StepOrder) -> Result<(), (u64, FcdRule)> {
        let ids = self.vehicles.iter().map(|vehicle| (vehicle.id.as_str(), vehicle.line));
        order.check(self.time_s, ids).map_err(|disorder| match disorder {
            Disorder::TimeNotGrowing { before_s } => {
                (self.line, FcdRule::TimeNotGrowing { found_s: self.time_s, before_s })
            }
            Disorder::Twice { id, line } => (line, FcdRule::Twice(id)),
        })
    }
}

/// A vehicle at one step, as recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct FcdVehicle {
    /// Id, unique among the vehicles of a step.
    pub id: String,
    /// Type of the vehicle, its vType: the attribute `type`.
    pub kind: String,
    /// Middle of the front bumper: the attributes `x`, `y` and, if present, `z` (else 0).
    pub front_m: [f64; 3],
    /// Heading clockwise from +y, as on a compass: the attribute `angle`.
    pub angle_deg: f64,
    /// Velocity as far as it is recorded: the attribute `speed`.
    pub velocity: RecordedVelocity,
    /// Line of the file, from 1.
    pub line: u64,
}

/// Recorded velocity of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RecordedVelocity {
    /// Speed along the heading, as in SUMO.
    AlongHeading {
        /// Speed.
        speed_mps: f64,
    },
    /// The whole vector, as in OSI.
    Vector {
        /// Velocity along world x, y and z.
        velocity_mps: [f64; 3],
    },
    /// No velocity, which OSI allows.
    Unknown,
}

impl RecordedVelocity {
    /// Speed, 0 if no velocity is recorded.
    pub fn speed_mps(self) -> f64 {
        match self {
            Self::AlongHeading { speed_mps } => speed_mps,
            Self::Vector { velocity_mps } => DVec3::from(velocity_mps).length(),
            Self::Unknown => 0.0,
        }
    }
}

/// Fault of a recording, and its place.
#[derive(Debug, thiserror::Error)]
#[error("{}{place}: {rule}", file.display())]
pub struct FcdError {
    /// File of the recording.
    pub file: PathBuf,
    /// Place in the recording.
    pub place: RecordingPlace,
    /// Rule that the recording breaks.
    pub rule: Box<FcdRule>,
}

/// Place in a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RecordingPlace {
    /// The file as a whole.
    File,
    /// Line of the unpacked text, from 1.
    Line(u64),
    /// Number of a message, from 1.
    Message(u64),
}

/// Place as it follows the name of the file.
impl std::fmt::Display for RecordingPlace {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::File => Ok(()),
            Self::Line(line) => write!(out, ":{line}"),
            Self::Message(message) => write!(out, ": message {message}"),
        }
    }
}

impl FcdError {
    /// Whether the system is at fault, not the content of the file.
    pub fn is_system(&self) -> bool {
        matches!(*self.rule, FcdRule::Text(XmlFault::Unreadable(_)) | FcdRule::Unreadable(_))
    }
}

/// Broken rules of a recording.
#[derive(Debug, thiserror::Error)]
pub enum FcdRule {
    /// The file cannot be read, or is not XML.
    #[error("{0}")]
    Text(#[source] XmlFault),
    /// A trace that cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] std::io::Error),
    /// A trace of OSI that breaks a rule of its own, in its reader's words.
    #[error("{0}")]
    Trace(String),
    /// A trace of OSI in a program built without its reader.
    #[error(
        "this program was built without the reader of OSI; `cargo install --path crates/wayside --features \
         interchange` in the project's folder builds one with it, `pip install ./crates/wayside-python -C \
         build-args=\"--features interchange\"` the Python package"
    )]
    WithoutInterchange,
    /// Positions that are inconsistent with the speeds.
    #[error(
        "its vehicles drive {told_m:.0} m by their speeds and {way_m:.3} m by their places: coordinates in \
         degrees (SUMO's `--fcd-output.geo`) are not read, metres are"
    )]
    NotMetres {
        /// Distance driven by all vehicles according to the recorded speeds, m.
        told_m: f64,
        /// Distance driven according to the positions, m.
        way_m: f64,
    },
    /// XML of another kind.
    #[error("the first element is <{0}>; floating-car data begin with <fcd-export>")]
    NotFcd(String),
    /// No element at all.
    #[error("there is no XML element in it; floating-car data begin with <fcd-export>")]
    Empty,
    /// The file has much text without a step.
    #[error("more than {0} bytes without a <timestep>")]
    StepTooLong(u64),
    /// A step has more vehicles than any simulation.
    #[error("the step has more than {0} vehicles, the most that are read")]
    TooManyVehicles(usize),
    /// An id or a type that is too long for a name.
    #[error("`{attribute}` has more than {limit} bytes: `{found}`")]
    NameTooLong {
        /// Name of the attribute: `id` or `type`.
        attribute: &'static str,
        /// Beginning of the name.
        found: String,
        /// Largest number of bytes.
        limit: usize,
    },
    /// A recording with more frames than any run.
    #[error(
        "from {begin_s} s on, every {interval_s} s, it holds more than {limit} frames: say `frames`, `end_s` or a longer `frame_interval_s`"
    )]
    TooManyFrames {
        /// Time of the first frame, s.
        begin_s: f64,
        /// Interval from one frame to the next.
        interval_s: f64,
        /// Largest number of frames of a run.
        limit: u32,
    },
    /// More poses of vehicles are in view than memory should hold.
    #[error(
        "more than {0} poses of vehicles are in view: ask for fewer frames, or see less far by `view_range_m`"
    )]
    TooManyPoses(usize),
    /// The text ends within an element.
    #[error("the file ends before </fcd-export>: it was cut off or is still being written")]
    CutOff,
    /// A vehicle outside any step.
    #[error("<vehicle> outside a <timestep>")]
    OutsideStep,
    /// A required attribute is missing.
    #[error("<{element}{}>: attribute `{attribute}` is missing", named(.id))]
    Missing {
        /// Name of the element.
        element: &'static str,
        /// Id of the vehicle, if known.
        id: Option<String>,
        /// Name of the attribute.
        attribute: &'static str,
    },
    /// An attribute that should be a number in a range.
    #[error("<{element}{}>: `{attribute}` is `{found}`; it must be {allowed}", named(.id))]
    NotANumber {
        /// Name of the element.
        element: &'static str,
        /// Id of the vehicle, if known.
        id: Option<String>,
        /// Name of the attribute.
        attribute: &'static str,
        /// Value in the file.
        found: String,
        /// Values that the attribute may have, in words.
        allowed: &'static str,
    },
    /// Time that does not increase.
    #[error("the step's time {found_s} s does not come after {before_s} s")]
    TimeNotGrowing {
        /// Time of the step, s.
        found_s: f64,
        /// Time of the step before, s.
        before_s: f64,
    },
    /// Two vehicles of one name in one step.
    #[error("vehicle `{0}` is there twice in one step")]
    Twice(String),
    /// Some vTypes have no model.
    #[error("{}not in `models` of [traffic]; known are {}", unknown_types(.found), .known.join(", "))]
    UnknownTypes {
        /// Unknown vTypes, each with the first vehicle that has it.
        found: Vec<UnknownType>,
        /// Types that have a model.
        known: Vec<String>,
    },
    /// A name without vehicles, and a type with the default model that was probably meant.
    #[error(
        "type `{}` of vehicle `{}` has the default model, and `{name}`, which `models` of [traffic] names, no \
         vehicle has: one of the two is misspelt",
        .found.kind, .found.id
    )]
    Misspelt {
        /// Type with the default model, and its first vehicle.
        found: UnknownType,
        /// Name in `models`.
        name: String,
    },
    /// An id with characters that would break a table of results.
    #[error("the id `{0}` holds a comma, a quote or a control character")]
    BadId(String),
    /// An id that a target already has.
    #[error("vehicle `{0}` has the id of a [[target]] of the scene")]
    IdOfTarget(String),
    /// The recording does not reach the requested time.
    #[error(
        "the recording runs from {first_s} s to {last_s} s; frames from {begin_s} s to {end_s} s were asked for"
    )]
    OutsideRecording {
        /// Time of the first step, s.
        first_s: f64,
        /// Time of the last step read.
        last_s: f64,
        /// Time of the first frame, s.
        begin_s: f64,
        /// Time of the last frame, s.
        end_s: f64,
    },
    /// An `end_s` before the recording begins.
    #[error(
        "`end_s` is {end_s} s, before the recording begins: the recording runs from {first_s} s to {last_s} s"
    )]
    EndsBeforeRecording {
        /// Latest time of the last frame.
        end_s: f64,
        /// Time of the first step, s.
        first_s: f64,
        /// Time of the last step, s.
        last_s: f64,
    },
    /// Frames of which the last is later than `end_s`.
    #[error(
        "{frames} frames from {begin_s} s on reach to {found_s:.6} s, beyond `end_s`, {end_s} s: the recording runs from \
         {first_s} s to {last_s} s"
    )]
    FramesBeyondEnd {
        /// Number of requested frames.
        frames: u32,
        /// Time of the first frame, s.
        begin_s: f64,
        /// Time of the last frame, s.
        found_s: f64,
        /// Latest time of the last frame.
        end_s: f64,
        /// Time of the first step, s.
        first_s: f64,
        /// Time of the last step read.
        last_s: f64,
    },
    /// A recording without steps.
    #[error("there is no <timestep> in it")]
    NoSteps,
    /// A trace of OSI without a message.
    #[error("there is none: a trace of OSI has a GroundTruth for each step, or a SensorView with one in it")]
    NoMessages,
}

fn named(id: &Option<String>) -> String {
    id.as_ref().map_or(String::new(), |id| format!(" id=\"{id}\""))
}

/// A vType without a model, with its first vehicle.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownType {
    /// Name of the type as written.
    pub kind: String,
    /// Id of the vehicle.
    pub id: String,
    /// Line of the vehicle.
    pub line: u64,
}

/// Beginning of the sentence about unknown types.
fn unknown_types(found: &[UnknownType]) -> String {
    let named = |t: &UnknownType| format!("type `{}` of vehicle `{}`", t.kind, t.id);
    match found {
        [] => String::new(),
        [one] => format!("{} is ", named(one)),
        [first, others @ ..] => {
            let other = |t: &UnknownType| format!(", {} (line {})", named(t), t.line);
            format!("{}{} are ", named(first), others.iter().map(other).collect::<String>())
        }
    }
}

/// Largest step in bytes: one with the most vehicles takes less, as does SUMO's text before the first.
const STEP_LIMIT_BYTES: u64 = 1 << 30;
/// Largest number of vehicles: a country's rush hour.
const VEHICLE_LIMIT: usize = 1 << 19;
const NAME_LIMIT_BYTES: usize = 256;

/// Steps of a recording, in order; [`FcdReader::next_step`] returns one after the other.
pub struct FcdReader {
    file: PathBuf,
    text: XmlReader,
    order: StepOrder,
    place: FcdPlace,
}

/// Place of the reader in the document.
#[derive(Clone, Copy, PartialEq)]
enum FcdPlace {
    Before,
    Inside,
    Behind,
}

impl FcdReader {
    /// Opens a recording; its first bytes, not its name, tell whether it is packed.
    pub fn open(file: &Path) -> Result<Self, FcdError> {
        let place = RecordingPlace::Line(1);
        let error = |rule| FcdError { file: file.to_owned(), place, rule: Box::new(rule) };
        let text = XmlReader::open(file).map_err(|fault| error(FcdRule::Text(fault)))?;
        Ok(Self { file: file.to_owned(), text, order: StepOrder::default(), place: FcdPlace::Before })
    }

    /// File of the recording.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// The next step; `None` after the last.
    pub fn next_step(&mut self) -> Result<Option<FcdStep>, FcdError> {
        let mut step = None;
        let end = self.text.bytes() + STEP_LIMIT_BYTES;
        loop {
            match self.advance(&mut step) {
                Ok(true) if self.text.bytes() > end => {
                    return Err(self.error_at(self.text.line(), FcdRule::StepTooLong(STEP_LIMIT_BYTES)));
                }
                Ok(true) => {}
                Ok(false) => break,
                Err(rule) => return Err(self.error_at(self.text.line(), rule)),
            }
        }
        if let Some(step) = &step {
            step.checked(&mut self.order).map_err(|(line, rule)| self.error_at(line, rule))?;
        }
        Ok(step)
    }

    /// An error of this recording at a line.
    pub(crate) fn error_at(&self, line: u64, rule: FcdRule) -> FcdError {
        FcdError { file: self.file.clone(), place: RecordingPlace::Line(line), rule: Box::new(rule) }
    }

    /// Reads one element; false at the end of a step or of the document.
    fn advance(&mut self, step: &mut Option<FcdStep>) -> Result<bool, FcdRule> {
        let (element, line) = self.text.next_element().map_err(FcdRule::Text)?;
        match element {
            Element::Opens(tag) => open_element(&tag, line, &mut self.place, step, Extent::ToItsEnd),
            Element::Empty(tag) => open_element(&tag, line, &mut self.place, step, Extent::Empty),
            Element::Closes(tag) => {
                if tag.name().as_ref() == "fcd-export" {
                    self.place = FcdPlace::Behind;
                }
                Ok(tag.name().as_ref() != "timestep")
            }
            Element::FileEnds => match self.place {
                FcdPlace::Before => Err(FcdRule::Empty),
                FcdPlace::Inside => Err(FcdRule::CutOff),
                FcdPlace::Behind => Ok(false),
            },
            Element::Other => Ok(true),
        }
    }
}

/// Whether an element has content.
#[derive(Clone, Copy, PartialEq)]
enum Extent {
    ToItsEnd,
    Empty,
}

/// Handles an opening element; false if a step is complete.
fn open_element(
    tag: &BytesStart<'_>,
    line: u64,
    place: &mut FcdPlace,
    step: &mut Option<FcdStep>,
    extent: Extent,
) -> Result<bool, FcdRule> {
    match (tag.name().as_ref(), *place) {
        ("fcd-export", FcdPlace::Before) => {
            *place = if extent == Extent::Empty { FcdPlace::Behind } else { FcdPlace::Inside };
            Ok(true)
        }
        (other, FcdPlace::Before) => Err(FcdRule::NotFcd(excerpt(other))),
        ("timestep", _) => {
            let time_s =
                Attributes::of(tag, "timestep")?.number("time", "a number of seconds", |t| t.is_finite())?;
            *step = Some(FcdStep { time_s, line, vehicles: vec![] });
            Ok(extent == Extent::ToItsEnd)
        }
        ("vehicle", _) => {
            let step = step.as_mut().ok_or(FcdRule::OutsideStep)?;
            if step.vehicles.len() == VEHICLE_LIMIT {
                return Err(FcdRule::TooManyVehicles(VEHICLE_LIMIT));
            }
            step.vehicles.push(vehicle(tag, line)?);
            Ok(true)
        }
        _ => Ok(true),
    }
}

/// Coordinates beyond this are an error of units (docs/scenes.md).
const COORDINATE_LIMIT_M: f64 = 1e5;
/// Speed of sound, beyond which nothing drives.
const SPEED_LIMIT_MPS: f64 = 340.0;

fn vehicle(tag: &BytesStart<'_>, line: u64) -> Result<FcdVehicle, FcdRule> {
    let attributes = Attributes::of(tag, "vehicle")?;
    let coordinate = |name| attributes.number(name, "m within ±1e5", |x| x.abs() <= COORDINATE_LIMIT_M);
    let z = if attributes.find("z").is_some() { coordinate("z")? } else { 0.0 };
    Ok(FcdVehicle {
        id: attributes.name("id")?.to_owned(),
        kind: attributes.name("type")?.to_owned(),
        front_m: [coordinate("x")?, coordinate("y")?, z],
        angle_deg: attributes.number("angle", "degrees within ±3600", |a| a.abs() <= 3600.0)?,
        velocity: RecordedVelocity::AlongHeading {
            speed_mps: attributes
                .number("speed", "m/s from 0 to 340", |v| (0.0..=SPEED_LIMIT_MPS).contains(&v))?,
        },
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
        Ok(Self { element, values: xml::attributes(tag).map_err(FcdRule::Text)? })
    }

    fn find(&self, name: &str) -> Option<&str> {
        self.values.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    fn id(&self) -> Option<String> {
        self.find("id").map(excerpt)
    }

    fn text(&self, name: &'static str) -> Result<&str, FcdRule> {
        let missing = || FcdRule::Missing { element: self.element, id: self.id(), attribute: name };
        self.find(name).filter(|text| !text.is_empty()).ok_or_else(missing)
    }

    /// Reads a name of limited length.
    fn name(&self, name: &'static str) -> Result<&str, FcdRule> {
        let text = self.text(name)?;
        if text.len() <= NAME_LIMIT_BYTES {
            return Ok(text);
        }
        Err(FcdRule::NameTooLong { attribute: name, found: excerpt(text), limit: NAME_LIMIT_BYTES })
    }

    fn number(
        &self,
        name: &'static str,
        allowed: &'static str,
        holds: impl Fn(f64) -> bool,
    ) -> Result<f64, FcdRule> {
        let text = self.text(name)?;
        let wrong = || {
            let found = excerpt(text);
            FcdRule::NotANumber { element: self.element, id: self.id(), attribute: name, found, allowed }
        };
        text.trim().parse().ok().filter(|number: &f64| number.is_finite() && holds(*number)).ok_or_else(wrong)
    }
}
