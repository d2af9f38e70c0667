//! Traces that are made here by hand and read back; what is wrong is refused with file, message and rule.

use super::*;
use crate::osi::common::{Dimension3d, Identifier, Orientation3d, Vector3d};
use crate::osi::moving_object::VehicleClassification;
use crate::trace::{ChannelOf, McapFile};
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
    let mut bytes = Vec::new();
    let mut file = McapFile::begin(&mut bytes, "").unwrap();
    let of = |topic| ChannelOf {
        topic,
        schema: SCHEMA,
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
        for whole in [osi(&messages), mcap_of(&["truth"], &messages)] {
            damaged(&whole, if is_whole { whole.len() } else { cut }, at, flip);
        }
    }
}
