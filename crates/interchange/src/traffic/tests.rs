//! Traces that are made here by hand and read back; what is wrong is refused with file, message and rule.

use super::*;
use crate::osi::common::{Dimension3d, Identifier, MountingPosition, Orientation3d, Vector3d};
use crate::osi::moving_object::VehicleClassification;
use crate::osi::sensor_data::{DetectedMovingObject, FeatureData, SensorData};
use crate::osi::sensor_view::{RadarSensorView, SensorView};
use crate::trace::{ChannelDefinition, McapFile};
use proptest::prelude::*;
use std::collections::BTreeMap;

/// `osi3.GroundTruth` with a map beside its objects.
#[derive(Clone, PartialEq, Message)]
struct GroundTruth {
    #[prost(message, optional, tag = "2")]
    timestamp: Option<Timestamp>,
    #[prost(message, repeated, tag = "5")]
    moving_object: Vec<MovingObject>,
    #[prost(uint32, optional, tag = "13")]
    country_code: Option<u32>,
    #[prost(string, optional, tag = "15")]
    map_reference: Option<String>,
}

fn truth(time_s: f64, moving_object: Vec<MovingObject>) -> Vec<u8> {
    let timestamp = Some(Timestamp::at(time_s));
    let map_reference = Some("junction.xodr".to_owned());
    GroundTruth { timestamp, moving_object, country_code: Some(276), map_reference }.encode_to_vec()
}

fn bus(id: u64, position: [f64; 3]) -> MovingObject {
    let base = BaseMoving {
        dimension: Some(Dimension3d { length: Some(12.0), width: Some(2.5), height: Some(3.0) }),
        position: Vector3d::of(position),
        orientation: Some(Orientation3d { yaw: Some(1.5), ..Orientation3d::default() }),
        velocity: Vector3d::of([5.0 * 1.5_f64.cos(), 5.0 * 1.5_f64.sin(), 0.0]),
    };
    MovingObject {
        id: Identifier::of(id),
        base: Some(base),
        kind: Some(2),
        vehicle_classification: Some(VehicleClassification { kind: Some(12) }),
    }
}

fn osi(messages: &[Vec<u8>]) -> Vec<u8> {
    let length = |message: &Vec<u8>| (message.len() as u32).to_le_bytes().to_vec();
    messages.iter().flat_map(|message| [length(message), message.clone()].concat()).collect()
}

fn mcap_of(topics: &[&str], messages: &[Vec<u8>]) -> Vec<u8> {
    mcap_of_kind(SCHEMA, topics, messages)
}

fn mcap_of_kind(schema: &str, topics: &[&str], messages: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut file = McapFile::begin(&mut bytes, "").unwrap();
    let of = |topic| ChannelDefinition {
        topic,
        schema,
        schema_encoding: "protobuf",
        definition: b"",
        message_encoding: "protobuf",
        metadata: BTreeMap::new(),
    };
    let channels: Vec<u16> = topics.iter().map(|topic| file.channel(&of(topic)).unwrap()).collect();
    for (number, message) in messages.iter().enumerate() {
        file.write(channels[number % channels.len()], number as f64, message).unwrap();
    }
    file.finish().unwrap();
    bytes
}

/// `osi3.SensorView` with a ground truth in it.
#[derive(Clone, PartialEq, Message)]
struct ViewOfTruth {
    #[prost(message, optional, tag = "2")]
    timestamp: Option<Timestamp>,
    #[prost(message, optional, tag = "3")]
    sensor_id: Option<Identifier>,
    #[prost(message, optional, tag = "7")]
    global_ground_truth: Option<GroundTruth>,
    #[prost(message, optional, tag = "8")]
    host_vehicle_id: Option<Identifier>,
}

/// `osi3.TrafficUpdate`.
#[derive(Clone, PartialEq, Message)]
struct TrafficUpdate {
    #[prost(message, optional, tag = "2")]
    timestamp: Option<Timestamp>,
    #[prost(message, repeated, tag = "3")]
    update: Vec<MovingObject>,
}

/// `osi3.StreamingUpdate`.
#[derive(Clone, PartialEq, Message)]
struct StreamingUpdate {
    #[prost(message, optional, tag = "2")]
    timestamp: Option<Timestamp>,
    #[prost(message, repeated, tag = "4")]
    moving_object_update: Vec<MovingObject>,
}

/// A view of all its own fields, or of as few as there may be.
fn views_of(truth: &[u8]) -> [Vec<u8>; 2] {
    let of_truth = GroundTruth::decode(truth).unwrap();
    let bare = ViewOfTruth { global_ground_truth: Some(of_truth), ..ViewOfTruth::default() };
    let (timestamp, sensor_id) = (Some(Timestamp::at(77.0)), Identifier::of(3));
    let whole = ViewOfTruth { timestamp, sensor_id, host_vehicle_id: Identifier::of(11), ..bare.clone() };
    [bare.encode_to_vec(), whole.encode_to_vec()]
}

/// Everything in a trace; errors without the folder.
fn read(bytes: &[u8]) -> Result<Vec<TrafficStep>, String> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("trace.osi");
    std::fs::write(&file, bytes).unwrap();
    let told = |error: TraceError| error.to_string().replace(&format!("{}/", folder.path().display()), "");
    let mut reader = GroundTruthReader::open(&file).map_err(told)?;
    let mut steps = vec![];
    while let Some(step) = reader.next_step().map_err(told)? {
        steps.push(step);
    }
    Ok(steps)
}

#[test]
fn moving_objects_of_both_containers_are_read_alike() {
    let messages = [truth(0.0, vec![bus(7, [1.0, 40.0, 1.5])]), truth(0.1, vec![])];
    let steps = read(&osi(&messages)).unwrap();
    assert_eq!(steps, read(&mcap_of(&["truth"], &messages)).unwrap());
    assert_eq!((steps.len(), steps[1].time_s, steps[1].message), (2, 0.1, 2));
    let object = &steps[0].objects[0];
    assert_eq!((object.id.as_str(), object.kind.as_str()), ("7", "TYPE_BUS"));
    assert_eq!((object.foot_m, object.size_m), ([1.0, 40.0, 0.0], Some([12.0, 2.5, 3.0])));
    assert_eq!(object.velocity_mps, Some([5.0 * 1.5_f64.cos(), 5.0 * 1.5_f64.sin(), 0.0]));
}

#[test]
fn a_ground_truth_in_a_view_of_a_sensor_is_that_of_its_own_trace() {
    let truths = [truth(0.0, vec![bus(7, [1.0, 40.0, 1.5])]), truth(0.1, vec![])];
    let alone = read(&osi(&truths)).unwrap();
    for kind in 0..2 {
        let views = [0, 1].map(|place: usize| views_of(&truths[place])[kind].clone());
        assert_eq!(read(&osi(&views)).unwrap(), alone, "{kind}");
        assert_eq!(read(&mcap_of_kind("osi3.SensorView", &["view"], &views)).unwrap(), alone, "{kind}");
    }
    let timeless = GroundTruth { moving_object: vec![bus(7, [1.0, 40.0, 1.5])], ..GroundTruth::default() };
    let views = views_of(&timeless.encode_to_vec());
    assert_eq!(read(&osi(&[views[1].clone()])).unwrap()[0].time_s, 77.0, "the view's own");
    let told = read(&osi(&[views[0].clone()])).unwrap_err();
    assert_eq!(told, "trace.osi: message 1: SensorView: `timestamp` is missing");
}

/// Messages that the program itself writes of points, tracks and paths, and others of parts of a road.
fn without_truth() -> [(&'static str, Vec<u8>); 7] {
    let mounting_position =
        Some(MountingPosition { position: Vector3d::of([0.0, 0.0, 6.0]), orientation: None });
    let (timestamp, sensor_id) = (Some(Timestamp::at(0.0)), Identifier::of(3));
    let data = SensorData { timestamp, sensor_id, mounting_position, ..SensorData::default() };
    let feature_data = Some(FeatureData::default());
    let nameless = SensorData { timestamp, feature_data, ..SensorData::default() };
    let moving_object = vec![DetectedMovingObject::default()];
    let tracks = SensorData { timestamp, moving_object, ..SensorData::default() };
    let view = SensorView { timestamp, sensor_id, mounting_position, ..SensorView::default() };
    let radar_sensor_view = vec![RadarSensorView::default()];
    let unmounted = SensorView { timestamp, radar_sensor_view, ..SensorView::default() };
    let moving = vec![bus(7, [1.0, 40.0, 1.5])];
    let update = TrafficUpdate { timestamp, update: moving.clone() };
    let stream = StreamingUpdate { timestamp, moving_object_update: moving };
    [
        ("SensorData", data.encode_to_vec()),
        ("SensorData", nameless.encode_to_vec()),
        ("SensorData", tracks.encode_to_vec()),
        ("SensorView", view.encode_to_vec()),
        ("SensorView", unmounted.encode_to_vec()),
        ("TrafficUpdate", update.encode_to_vec()),
        ("StreamingUpdate", stream.encode_to_vec()),
    ]
}

#[test]
fn messages_without_a_ground_truth_are_refused_and_never_a_road_without_vehicles() {
    for (name, message) in without_truth() {
        let text = read(&osi(&[message])).unwrap_err();
        let rule = match name {
            "SensorView" => "SensorView: `global_ground_truth` is missing".to_owned(),
            _ => format!(
                "it is a {name}; a recording of traffic consists of GroundTruth, or of SensorView with one in it"
            ),
        };
        assert_eq!(text, format!("trace.osi: message 1: {rule}"));
    }
    // A field 3 that is a number: `motion_request_type` of a MotionRequest.
    let other = [&[0x12, 2, 8, 0][..], &[0x18, 1]].concat();
    let text = read(&osi(&[other])).unwrap_err();
    assert!(
        text.ends_with("its fields are neither those of a GroundTruth of OSI nor those of a SensorView"),
        "{text}"
    );
}

#[test]
fn what_an_object_does_not_tell_is_not_made_up_and_what_it_tells_counts_alone() {
    let mut told = bus(7, [1.0, 40.0, 1.5]);
    let base = told.base.as_mut().unwrap();
    base.velocity = None;
    base.dimension.as_mut().unwrap().length = None;
    let object = &read(&osi(&[truth(0.0, vec![told])])).unwrap()[0].objects[0];
    assert_eq!((object.velocity_mps, object.size_m), (None, None));
    assert_eq!(object.foot_m, [1.0, 40.0, 0.0], "half the told height below the middle");
}

#[test]
fn what_is_wrong_is_told_with_file_message_and_rule() {
    let sound = truth(0.0, vec![bus(7, [1.0, 40.0, 1.5])]);
    let refused = |messages: &[Vec<u8>], rule: &str| {
        let number = messages.len();
        let text = read(&osi(messages)).unwrap_err();
        assert_eq!(text, format!("trace.osi: message {number}: {rule}"));
    };
    let nameless = MovingObject { id: None, ..bus(7, [0.0; 3]) };
    refused(&[sound.clone(), truth(1.0, vec![nameless])], "MovingObject: `id` is missing");
    let nowhere = MovingObject { base: None, ..bus(7, [0.0; 3]) };
    refused(&[truth(1.0, vec![nowhere])], "MovingObject 7: `base` is missing");
    let away = bus(8, [1e6, 0.0, 0.0]);
    refused(
        &[truth(1.0, vec![away])],
        "MovingObject 8: `base.position` is 1000000; it must be m within ±1e5",
    );
    refused(&[sound.clone(), vec![]], "GroundTruth: `timestamp` is missing");
    let whole = osi(&[sound.clone(), sound.clone()]);
    let cut = read(&whole[..whole.len() - 1]).unwrap_err();
    assert!(cut.starts_with("trace.osi: message 2: the file ends within it"), "{cut}");
    let long = read(&[&u32::MAX.to_le_bytes()[..], &sound].concat()).unwrap_err();
    assert!(long.contains("message 1: a message of 4294967295 bytes, more than the 67108864"), "{long}");
    let two = read(&mcap_of(&["a", "b"], &[sound.clone(), sound])).unwrap_err();
    assert!(two.contains("two channels of `osi3.GroundTruth` in it, `a` and `b`"), "{two}");
    let none = read(&mcap_of(&[], &[])).unwrap_err();
    assert!(none.contains("no channel of `osi3.GroundTruth`"), "{none}");
}

#[test]
fn numbers_that_are_none_are_refused() {
    for place in 0..3 {
        let mut position = [0.0; 3];
        position[place] = f64::NAN;
        assert!(read(&osi(&[truth(0.0, vec![bus(1, position)])])).is_err());
    }
    let mut long = bus(1, [0.0; 3]);
    long.base.as_mut().unwrap().dimension.as_mut().unwrap().length = Some(f64::NAN);
    assert!(read(&osi(&[truth(0.0, vec![long])])).is_err());
}

/// A file that was cut or in which a byte was changed is read or refused; nothing panics.
fn damaged(whole: &[u8], cut: usize, at: usize, flip: u8) {
    let mut bytes = whole[..cut % (whole.len() + 1)].to_vec();
    let length = bytes.len();
    if length > 0 {
        bytes[at % length] ^= flip;
    }
    let _ = read(&bytes);
}

proptest! {
    #[test]
    fn no_damage_makes_the_reader_panic(cut: usize, at: usize, flip: u8, is_whole: bool) {
        let messages = [truth(0.0, vec![bus(7, [1.0, 40.0, 1.5])]), truth(0.1, vec![])];
        let views = [0, 1].map(|place: usize| views_of(&messages[place])[1].clone());
        for whole in [osi(&messages), mcap_of(&["truth"], &messages), osi(&views)] {
            damaged(&whole, if is_whole { whole.len() } else { cut }, at, flip);
        }
    }
}
