//! Ground truth of OSI read as traffic: moving objects, message by message, in plain numbers.
//!
//! Messages are traversed without unpacking: moving objects are extracted one by one, and lanes, signs and
//! other parts of a ground truth are skipped. The ground truth within a sensor's view is read as well; the
//! kind of a message is recognized by its fields.

mod wire_fields;
mod message_kind;

pub use crate::osi::moving_object::{canonical_type_name, type_names};
pub use crate::trace::{TraceError, TraceRule};

use crate::osi::common::{BaseMoving, Timestamp};
use crate::osi::moving_object::MovingObject;
use crate::trace::Messages;
use message_kind::MessageKind;
use prost::Message;
use std::path::Path;
use wire_fields::{Field, encoding};

/// Moving objects at one time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TrafficStep {
    /// Simulation time.
    pub time_s: f64,
    /// Number of the message, from 1.
    pub message: u64,
    /// Objects in the order of the message.
    pub objects: Vec<TrafficObject>,
}

/// A moving object.
#[derive(Debug, Clone, PartialEq)]
pub struct TrafficObject {
    /// The object's id, in decimal digits.
    pub id: String,
    /// Name of its type in the standard: `TYPE_MEDIUM_CAR`, `TYPE_BUS`, `TYPE_PEDESTRIAN`.
    pub kind: String,
    /// Middle of the lower side of the bounding box.
    pub foot_m: [f64; 3],
    /// Length, width and height of the bounding box; `None` if not in the message.
    pub size_m: Option<[f64; 3]>,
    /// Heading from +x towards +y.
    pub yaw_rad: f64,
    /// Velocity along world x, y and z; `None` if not in the message.
    pub velocity_mps: Option<[f64; 3]>,
}

/// Messages of a ground truth, in order.
pub struct GroundTruthReader {
    messages: Messages,
}

/// Names of the messages that are read; in an MCAP file the views only if there is no channel of the first.
const SCHEMA: &str = "osi3.GroundTruth";
const SCHEMA_OF_VIEWS: &str = "osi3.SensorView";
/// Field numbers of `osi3.GroundTruth`; `osi3.SensorView` shares the first.
const TIMESTAMP: u32 = 2;
const MOVING_OBJECT: u32 = 5;
/// Field number in `osi3.SensorView`.
const GLOBAL_GROUND_TRUTH: u32 = 7;
/// Largest number of objects: a country's rush hour.
const OBJECT_LIMIT: usize = 1 << 19;
/// Largest coordinate; larger ones are an error of units, or degrees of a map.
const COORDINATE_LIMIT_M: f64 = 1e5;
/// Speed of sound, beyond which nothing drives.
const SPEED_LIMIT_MPS: f64 = 340.0;
/// Largest magnitude of a heading, which may include some turns.
const YAW_LIMIT_RAD: f64 = 60.0;
/// Largest size: only trains are longer.
const SIZE_LIMIT_M: f64 = 1000.0;

impl GroundTruthReader {
    /// Opens a trace, `.osi` or MCAP, according to its first bytes, not its name.
    ///
    /// # Errors
    /// The file is missing, unreadable or not a plain file.
    pub fn open(file: &Path) -> Result<Self, TraceError> {
        Ok(Self { messages: Messages::open(file, SCHEMA)? })
    }

    /// The trace.
    pub fn file(&self) -> &Path {
        self.messages.file()
    }

    /// Number of the last returned message, from 1.
    pub fn message(&self) -> u64 {
        self.messages.number()
    }

    /// The next message; `None` after the last.
    ///
    /// # Errors
    /// The trace is truncated, or a message breaks a rule, or is of a kind without ground truth.
    pub fn next_step(&mut self) -> Result<Option<TrafficStep>, TraceError> {
        let Some(bytes) = self.next_message()? else { return Ok(None) };
        let message = self.messages.number();
        step(&bytes, message).map(Some).map_err(|rule| self.messages.error(rule))
    }

    fn next_message(&mut self) -> Result<Option<Vec<u8>>, TraceError> {
        let next = self.messages.next();
        let Err(TraceError { rule: TraceRule::NoChannel(SCHEMA), .. }) = &next else { return next };
        let mut views = Messages::open(self.messages.file(), SCHEMA_OF_VIEWS)?;
        match views.next() {
            Err(TraceError { rule: TraceRule::NoChannel(_), .. }) => next,
            found => {
                self.messages = views;
                found
            }
        }
    }
}

fn step(bytes: &[u8], message: u64) -> Result<TrafficStep, TraceRule> {
    let mut told = MessageObjects::default();
    let (owner, time) = match MessageKind::of(bytes) {
        Some(MessageKind::GroundTruth) => ("GroundTruth", told.take(bytes)?),
        Some(MessageKind::SensorView) => ("SensorView", told.take_view(bytes)?),
        Some(other) => return Err(TraceRule::OtherMessage(other.name())),
        // Damaged messages are reported as damaged.
        None => return Err(told.take(bytes).err().unwrap_or(TraceRule::NoGroundTruth)),
    };
    let missing = || TraceRule::Missing { owner: owner.into(), field: "timestamp" };
    Ok(TrafficStep { time_s: time.ok_or_else(missing)?.time_s(), message, objects: told.objects })
}

/// Objects of a message so far.
#[derive(Default)]
struct MessageObjects {
    objects: Vec<TrafficObject>,
}

impl MessageObjects {
    /// Extracts the objects of a ground truth, and returns its time.
    fn take(&mut self, truth: &[u8]) -> Result<Option<Timestamp>, TraceRule> {
        let mut stamp = None;
        for field in wire_fields::fields(truth) {
            match field? {
                Field { number: TIMESTAMP, content: Some(content), .. } => {
                    stamp = Some(Timestamp::decode(content).map_err(encoding)?);
                }
                Field { number: MOVING_OBJECT, content: Some(content), .. } => {
                    if self.objects.len() == OBJECT_LIMIT {
                        return Err(TraceRule::TooManyObjects(OBJECT_LIMIT));
                    }
                    self.objects.push(object(&MovingObject::decode(content).map_err(encoding)?)?);
                }
                _ => {}
            }
        }
        Ok(stamp)
    }

    /// Extracts the objects of a sensor's view, and returns the time of the ground truth in it, or else its
    /// own.
    fn take_view(&mut self, view: &[u8]) -> Result<Option<Timestamp>, TraceRule> {
        let (mut of_view, mut of_truth, mut is_there) = (None, None, false);
        for field in wire_fields::fields(view) {
            match field? {
                Field { number: TIMESTAMP, content: Some(content), .. } => {
                    of_view = Some(Timestamp::decode(content).map_err(encoding)?);
                }
                Field { number: GLOBAL_GROUND_TRUTH, content: Some(content), .. } => {
                    is_there = true;
                    of_truth = self.take(content)?.or(of_truth);
                }
                _ => {}
            }
        }
        let missing = TraceRule::Missing { owner: "SensorView".into(), field: "global_ground_truth" };
        if is_there { Ok(of_truth.or(of_view)) } else { Err(missing) }
    }
}

fn object(told: &MovingObject) -> Result<TrafficObject, TraceRule> {
    let missing = |owner: &str, field| TraceRule::Missing { owner: owner.to_owned(), field };
    let id = told.id.and_then(|id| id.value).ok_or_else(|| missing("MovingObject", "id"))?;
    let owner = format!("MovingObject {id}");
    let base = told.base.as_ref().ok_or_else(|| missing(&owner, "base"))?;
    let middle = base.position.ok_or_else(|| missing(&owner, "base.position"))?.array();
    let yaw_rad = base.orientation.and_then(|turned| turned.yaw).unwrap_or(0.0);
    let velocity_mps = base.velocity.map(|velocity| velocity.array());
    let height_m =
        base.dimension.and_then(|told| told.height).filter(|height| *height > 0.0 || height.is_nan());
    let size_m = size(base);
    let of = Bounds { owner: &owner };
    for x in middle {
        of.within("base.position", x, COORDINATE_LIMIT_M, "m within ±1e5")?;
    }
    of.within("base.orientation.yaw", yaw_rad, YAW_LIMIT_RAD, "rad within ±60")?;
    for x in velocity_mps.unwrap_or_default() {
        of.within("base.velocity", x, SPEED_LIMIT_MPS, "m/s within ±340")?;
    }
    for x in size_m.into_iter().flatten().chain(height_m) {
        of.within("base.dimension", x, SIZE_LIMIT_M, "m from 0 to 1000")?;
    }
    let foot_m = [middle[0], middle[1], middle[2] - 0.5 * height_m.unwrap_or(0.0)];
    Ok(TrafficObject { id: id.to_string(), kind: told.type_name(), foot_m, size_m, yaw_rad, velocity_mps })
}

/// Length, width and height if all three are present.
fn size(base: &BaseMoving) -> Option<[f64; 3]> {
    let told = base.dimension?;
    let size = [told.length?, told.width?, told.height?];
    size.iter().all(|side| *side > 0.0 || side.is_nan()).then_some(size)
}

/// Allowed ranges of an object's numbers.
struct Bounds<'a> {
    owner: &'a str,
}

impl Bounds<'_> {
    fn within(
        &self,
        field: &'static str,
        found: f64,
        limit: f64,
        allowed: &'static str,
    ) -> Result<(), TraceRule> {
        let rule = || TraceRule::OutOfRange { owner: self.owner.to_owned(), field, found, allowed };
        if found.abs() <= limit { Ok(()) } else { Err(rule()) }
    }
}

#[cfg(test)]
mod tests;
