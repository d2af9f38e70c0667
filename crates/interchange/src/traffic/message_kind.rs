//! Kinds of messages of OSI, recognized by their fields: a `.osi` trace does not name its messages.
//!
//! Messages of all kinds begin alike (version, timestamp), and field numbers have different meanings in each.
//! The kind of a message is the one whose fields have the wire types found, including nested fields; among
//! several such, the one with the fewest unknown field numbers.

use crate::traffic::wire_fields;
use prost::encoding::WireType;

/// Possible kinds of messages in a trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MessageKind {
    GroundTruth,
    SensorView,
    SensorData,
    TrafficUpdate,
    StreamingUpdate,
}

/// Fields of a kind; the first kind is assumed for messages with too few fields.
const KINDS: [(MessageKind, Fields); 5] = [
    (MessageKind::GroundTruth, GROUND_TRUTH),
    (MessageKind::SensorView, SENSOR_VIEW),
    (MessageKind::SensorData, SENSOR_DATA),
    (MessageKind::TrafficUpdate, TRAFFIC_UPDATE),
    (MessageKind::StreamingUpdate, STREAMING_UPDATE),
];

impl MessageKind {
    /// The kind of a message; `None` if its fields match none.
    pub(crate) fn of(message: &[u8]) -> Option<Self> {
        let fitting = KINDS.iter().filter_map(|(kind, fields)| Some((*kind, unknown_in(message, fields)?)));
        fitting.min_by_key(|(_, unknown)| *unknown).map(|(kind, _)| kind)
    }

    /// Name of the message in the standard.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::GroundTruth => "GroundTruth",
            Self::SensorView => "SensorView",
            Self::SensorData => "SensorData",
            Self::TrafficUpdate => "TrafficUpdate",
            Self::StreamingUpdate => "StreamingUpdate",
        }
    }
}

/// Ranges of field numbers, first and last, with the form of their content.
type Fields = &'static [(u32, u32, Shape)];

/// Form of a field.
enum Shape {
    Varint,
    Double,
    /// A text, or a message that is not examined.
    Bytes,
    Message(Fields),
}

use Shape::{Bytes, Double, Varint};

const VERSION: Shape = Shape::Message(&[(1, 3, Varint)]);
const TIMESTAMP: Shape = Shape::Message(&[(1, 2, Varint)]);
const ID: Shape = Shape::Message(&[(1, 1, Varint)]);
/// A vector, three sides, or three angles.
const TRIPLE: Shape = Shape::Message(&[(1, 3, Double)]);
const MOUNTING: Shape = Shape::Message(&[(1, 2, TRIPLE)]);
const BASE: Shape = Shape::Message(&[(1, 6, TRIPLE), (7, 7, Bytes), (8, 8, TRIPLE), (9, 9, Bytes)]);
const MOVING_OBJECT: Shape =
    Shape::Message(&[(1, 1, ID), (2, 2, BASE), (3, 3, Varint), (4, 4, ID), (5, 12, Bytes)]);
const STATIONARY_OBJECT: Shape = Shape::Message(&[(1, 1, ID), (2, 6, Bytes)]);
const TRAFFIC_LIGHT: Shape = Shape::Message(&[
    (1, 1, ID),
    (2, 2, Shape::Message(&[(1, 5, Bytes)])),
    (3, 4, Bytes),
    (5, 5, Shape::Message(&[(1, 3, Bytes)])),
    (6, 6, Bytes),
]);
/// Signs and markings, of which only the id is examined.
const WITH_ID: Shape = Shape::Message(&[(1, 1, ID), (2, 6, Bytes)]);
/// Data of a host vehicle, of which only the positions are examined.
const HOST_VEHICLE: Shape = Shape::Message(&[(1, 2, BASE), (3, 14, Bytes)]);
const HEADER: Shape = Shape::Message(&[(1, 1, TIMESTAMP), (2, 3, Varint)]);

const GROUND_TRUTH: Fields = &[
    (1, 1, VERSION),
    (2, 2, TIMESTAMP),
    (3, 3, ID),
    (4, 4, STATIONARY_OBJECT),
    (5, 5, MOVING_OBJECT),
    (6, 6, WITH_ID),
    (7, 7, TRAFFIC_LIGHT),
    (8, 8, WITH_ID),
    (9, 12, Bytes),
    (13, 13, Varint),
    (14, 20, Bytes),
];
const SENSOR_VIEW: Fields = &[
    (1, 1, VERSION),
    (2, 2, TIMESTAMP),
    (3, 3, ID),
    (4, 5, MOUNTING),
    (6, 6, Bytes),
    (7, 7, Shape::Message(GROUND_TRUTH)),
    (8, 8, ID),
    (1000, 1004, Bytes),
];
const SENSOR_DATA: Fields = &[
    (1, 1, VERSION),
    (2, 2, TIMESTAMP),
    (3, 4, BASE),
    (5, 5, ID),
    (6, 7, MOUNTING),
    (8, 8, Bytes),
    (9, 9, TIMESTAMP),
    (10, 10, HEADER),
    (11, 11, Bytes),
    (12, 12, HEADER),
    (13, 13, Bytes),
    (14, 14, HEADER),
    (15, 15, Bytes),
    (16, 16, HEADER),
    (17, 17, Bytes),
    (18, 18, HEADER),
    (19, 19, Bytes),
    (20, 20, HEADER),
    (21, 28, Bytes),
    (29, 29, TIMESTAMP),
];
const TRAFFIC_UPDATE: Fields =
    &[(1, 1, VERSION), (2, 2, TIMESTAMP), (3, 3, MOVING_OBJECT), (4, 4, HOST_VEHICLE)];
const STREAMING_UPDATE: Fields = &[
    (1, 1, VERSION),
    (2, 2, TIMESTAMP),
    (3, 3, STATIONARY_OBJECT),
    (4, 4, MOVING_OBJECT),
    (5, 8, Bytes),
    (9, 9, ID),
];

/// Number of fields with unknown numbers, including nested ones; `None` if a known number has another form.
fn unknown_in(message: &[u8], fields: Fields) -> Option<usize> {
    let mut unknown = 0;
    for field in wire_fields::fields(message) {
        let field = field.ok()?;
        let known = fields.iter().find(|(first, last, _)| (*first..=*last).contains(&field.number));
        unknown += match (known.map(|(_, _, shape)| shape), field.wire, field.content) {
            (None, ..) => 1,
            (Some(Varint), WireType::Varint, _)
            | (Some(Double), WireType::SixtyFourBit, _)
            | (Some(Bytes), _, Some(_)) => 0,
            (Some(Shape::Message(inner)), _, Some(content)) => unknown_in(content, inner)?,
            _ => return None,
        };
    }
    Some(unknown)
}
