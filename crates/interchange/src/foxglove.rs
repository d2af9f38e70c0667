//! Points for Foxglove without ROS, in MCAP: `foxglove.PointCloud` in Protocol Buffers, with the definitions
//! of <https://github.com/foxglove/foxglove-sdk> (MIT) as far as they are written.

use crate::descriptors::Kind::{Bytes, Double, Fixed32, Int32, Int64, Many, One, Text};
use crate::descriptors::{Definitions, MessageRow, described};
use crate::measured::frame_names::WORLD;
use crate::measured::packed_points::{FIELD_BYTES, FIELDS, Number, POINT_BYTES, packed};
use crate::osi::common::Timestamp;
use crate::trace::{ChannelDefinition, McapFile};
use artifact::points::PointsFrame;
use prost::Message;
use std::collections::BTreeMap;
use std::io::{self, Write};

/// A recording of clouds being written.
pub struct FoxgloveRecording<W: Write> {
    file: McapFile<W>,
    channel: u16,
}

impl<W: Write> FoxgloveRecording<W> {
    /// Begins a recording.
    ///
    /// # Errors
    /// The sink fails.
    pub fn create(sink: W) -> io::Result<Self> {
        let mut file = McapFile::begin(sink, "")?;
        let channel = file.channel(&ChannelDefinition {
            topic: "/radar/points",
            schema: "foxglove.PointCloud",
            schema_encoding: "protobuf",
            definition: &definitions(),
            message_encoding: "protobuf",
            metadata: BTreeMap::new(),
        })?;
        Ok(Self { file, channel })
    }

    /// Writes the points of a frame as a cloud in world coordinates.
    ///
    /// # Errors
    /// The sink fails.
    pub fn points(&mut self, frame: &PointsFrame) -> io::Result<()> {
        self.file.write(self.channel, frame.time_s, &cloud(frame).encode_to_vec())
    }

    /// Writes the indexes and the end of the file.
    ///
    /// # Errors
    /// The sink fails.
    pub fn finish(self) -> io::Result<()> {
        self.file.finish()
    }
}

fn cloud(frame: &PointsFrame) -> PointCloud {
    let field = |(place, (name, number)): (usize, &(&str, Number))| PackedElementField {
        name: (*name).to_owned(),
        offset: (place * FIELD_BYTES) as u32,
        kind: numeric_type(*number),
    };
    PointCloud {
        timestamp: Some(Timestamp::at(frame.time_s)),
        frame_id: WORLD.to_owned(),
        pose: Some(Pose { position: Some(Vector3::default()), orientation: Some(Quaternion { w: 1.0 }) }),
        point_stride: POINT_BYTES as u32,
        fields: FIELDS.iter().enumerate().map(field).collect(),
        data: packed(frame),
    }
}

/// Value of `foxglove.PackedElementField.NumericType`.
fn numeric_type(number: Number) -> i32 {
    match number {
        Number::Uint32 => 5,
        Number::Int32 => 6,
        Number::Float32 => 7,
    }
}

/// `foxglove.PointCloud`.
#[derive(Clone, PartialEq, Message)]
struct PointCloud {
    /// `google.protobuf.Timestamp`, which has the fields of OSI's.
    #[prost(message, optional, tag = "1")]
    timestamp: Option<Timestamp>,
    #[prost(string, tag = "2")]
    frame_id: String,
    #[prost(message, optional, tag = "3")]
    pose: Option<Pose>,
    #[prost(fixed32, tag = "4")]
    point_stride: u32,
    #[prost(message, repeated, tag = "5")]
    fields: Vec<PackedElementField>,
    #[prost(bytes = "vec", tag = "6")]
    data: Vec<u8>,
}

/// `foxglove.PackedElementField`.
#[derive(Clone, PartialEq, Message)]
struct PackedElementField {
    #[prost(string, tag = "1")]
    name: String,
    #[prost(fixed32, tag = "2")]
    offset: u32,
    /// `foxglove.PackedElementField.NumericType`.
    #[prost(int32, tag = "3")]
    kind: i32,
}

/// `foxglove.Pose`.
#[derive(Clone, PartialEq, Message)]
struct Pose {
    #[prost(message, optional, tag = "1")]
    position: Option<Vector3>,
    #[prost(message, optional, tag = "2")]
    orientation: Option<Quaternion>,
}

/// `foxglove.Vector3`, always the origin: zeros are not on the wire.
#[derive(Clone, PartialEq, Message)]
struct Vector3 {}

/// `foxglove.Quaternion` without a vector part, whose zeros are not on the wire.
#[derive(Clone, PartialEq, Message)]
struct Quaternion {
    #[prost(double, tag = "4")]
    w: f64,
}

const TIMESTAMP_FILE: &str = "google/protobuf/timestamp.proto";
const TIMESTAMP: &[MessageRow] = &[("Timestamp", &[("seconds", 1, Int64), ("nanos", 2, Int32)])];
const POINT_CLOUD: &[MessageRow] = &[
    (
        "PointCloud",
        &[
            ("timestamp", 1, One(".google.protobuf.Timestamp")),
            ("frame_id", 2, Text),
            ("pose", 3, One("Pose")),
            ("point_stride", 4, Fixed32),
            ("fields", 5, Many("PackedElementField")),
            ("data", 6, Bytes),
        ],
    ),
    ("PackedElementField", &[("name", 1, Text), ("offset", 2, Fixed32), ("type", 3, Int32)]),
    ("Pose", &[("position", 1, One("Vector3")), ("orientation", 2, One("Quaternion"))]),
    ("Vector3", &[("x", 1, Double), ("y", 2, Double), ("z", 3, Double)]),
    ("Quaternion", &[("x", 1, Double), ("y", 2, Double), ("z", 3, Double), ("w", 4, Double)]),
];

fn definitions() -> Vec<u8> {
    let timestamp = Definitions {
        name: TIMESTAMP_FILE,
        package: "google.protobuf",
        imports: &[],
        syntax: "proto3",
        messages: TIMESTAMP.to_vec(),
    };
    let clouds = Definitions {
        name: "foxglove/PointCloud.proto",
        package: "foxglove",
        imports: &[TIMESTAMP_FILE],
        syntax: "proto3",
        messages: POINT_CLOUD.to_vec(),
    };
    described(&[timestamp, clouds])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_empty_frame_is_a_cloud_of_seven_fields_without_data_and_equal_frames_give_equal_bytes() {
        let frame = PointsFrame { index: 0, time_s: 1.5, points: vec![], objects: vec![] };
        let seen = PointCloud::decode(&cloud(&frame).encode_to_vec()[..]).unwrap();
        assert_eq!((seen.point_stride, seen.fields.len(), seen.data.len()), (28, 7, 0));
        let last = &seen.fields[6];
        assert_eq!((last.name.as_str(), last.offset, last.kind), ("height_measured", 24, 5));
        assert_eq!(seen.timestamp.unwrap().nanos, Some(500_000_000));
        let written = || {
            let mut bytes = vec![];
            let mut recording = FoxgloveRecording::create(&mut bytes).unwrap();
            recording.points(&frame).unwrap();
            recording.finish().unwrap();
            bytes
        };
        assert_eq!(written(), written());
    }
}
