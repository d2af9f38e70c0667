//! The readers of `interchange` against traces changed by their structure: lengths, tags, records, chunks and
//! numbers. Each is read or refused with a sentence that names the file; none panics, takes a minute, or
//! fills the memory. Longer runs and other cases: `fuzzing`.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

use fuzzing::{Noise, Reader, change_numbers};
use interchange::traffic::GroundTruthReader;
use std::path::Path;

const READERS: [Reader; 3] = [
    Reader::refusing("osi", 400, |n, at| put(at, &trace(n, message)), read),
    Reader::refusing("osi-view", 400, |n, at| put(at, &trace(n, view)), read),
    Reader::refusing("osi-mcap", 400, |n, at| put(at, &recording(n)), read),
];

#[test]
fn traces_of_changed_structure_are_read_or_refused_with_a_sentence() {
    fuzzing::fuzz(&READERS, |_| {});
}

const NAME: &str = "t.osi";

fn put(folder: &Path, bytes: &[u8]) {
    std::fs::write(folder.join(NAME), bytes).unwrap();
}

fn read(folder: &Path) -> Result<(), String> {
    let mut reader = GroundTruthReader::open(&folder.join(NAME)).map_err(|error| error.to_string())?;
    while let Some(step) = reader.next_step().map_err(|error| error.to_string())? {
        for object in &step.objects {
            assert!(object.foot_m.iter().all(|x| x.is_finite()) && object.yaw_rad.is_finite());
            assert!(
                object.velocity_mps.is_none_or(|v| v.iter().all(|v| v.is_finite()))
                    && object.size_m.is_none_or(|size| size[0].is_finite())
            );
        }
    }
    Ok(())
}

/// A number in groups of seven bits.
fn varint(mut value: u64) -> Vec<u8> {
    let mut bytes = vec![];
    while value >= 128 {
        bytes.push(value as u8 | 128);
        value >>= 7;
    }
    bytes.push(value as u8);
    bytes
}

/// A field of bytes, its length told wrong now and then.
fn inside(noise: &mut Noise, number: u64, content: &[u8]) -> Vec<u8> {
    let told = if noise.one_in(40) { noise.next() >> noise.below(64) } else { content.len() as u64 };
    [varint(number << 3 | 2), varint(told), content.to_vec()].concat()
}

fn double(noise: &mut Noise, number: u64, value: f64) -> Vec<u8> {
    let mut bytes = value.to_le_bytes();
    if noise.one_in(60) {
        change_numbers(noise, &mut bytes);
    }
    [varint(number << 3 | 1), bytes.to_vec()].concat()
}

fn vector(noise: &mut Noise, values: [f64; 3]) -> Vec<u8> {
    (1..).zip(values).flat_map(|(number, value)| double(noise, number, value)).collect()
}

fn object(noise: &mut Noise, id: u64, y_m: f64) -> Vec<u8> {
    let parts = [
        (1, vector(noise, [4.5, 1.8, 1.5])),
        (2, vector(noise, [5.0, y_m, 0.75])),
        (3, vector(noise, [0.0, 0.0, -1.57])),
        (4, vector(noise, [0.0, -9.0, 0.0])),
    ];
    let base: Vec<u8> = parts.iter().flat_map(|(number, part)| inside(noise, *number, part)).collect();
    let id = [vec![8], varint(id)].concat();
    let kind = [vec![8], varint(noise.below(26) as u64)].concat();
    let parts = [inside(noise, 1, &id), inside(noise, 2, &base), vec![24, 2], inside(noise, 6, &kind)];
    parts.concat()
}

fn message(noise: &mut Noise, number: u64) -> Vec<u8> {
    let stamp = [vec![8], varint(number), vec![16], varint(500)].concat();
    let mut message = inside(noise, 2, &stamp);
    for id in 0..noise.below(4) as u64 {
        let content = object(noise, id, 40.0 - number as f64);
        message.extend(inside(noise, 5, &content));
    }
    // A map that is passed over.
    let lanes = vec![7; noise.below(50)];
    message.extend(inside(noise, 10, &lanes));
    if noise.one_in(20) {
        let at = noise.below(message.len());
        message[at] ^= 1 << noise.below(8);
    }
    message
}

/// A view of a sensor, with a ground truth in it now and then, or with reflections.
fn view(noise: &mut Noise, number: u64) -> Vec<u8> {
    let stamp = [vec![8], varint(number), vec![16], varint(500)].concat();
    let mut message = inside(noise, 2, &stamp);
    if noise.one_in(2) {
        message.extend(inside(noise, 3, &[8, 3]));
    }
    if !noise.one_in(8) {
        let truth = self::message(noise, number);
        message.extend(inside(noise, 7, &truth));
    }
    if noise.one_in(2) {
        message.extend(inside(noise, 8, &[8, 11]));
    }
    let reflections = vec![7; noise.below(50)];
    message.extend(inside(noise, 1001, &reflections));
    message
}

fn trace(noise: &mut Noise, message: fn(&mut Noise, u64) -> Vec<u8>) -> Vec<u8> {
    let mut bytes = vec![];
    for number in 0..1 + noise.below(4) as u64 {
        let message = message(noise, number);
        let told =
            if noise.one_in(30) { noise.next() as u32 >> noise.below(32) } else { message.len() as u32 };
        bytes.extend(told.to_le_bytes());
        bytes.extend(message);
    }
    if noise.one_in(6) {
        bytes.truncate(noise.below(bytes.len()));
    }
    bytes
}

/// A record of MCAP, its length told wrong now and then.
fn record(noise: &mut Noise, kind: u8, content: &[u8]) -> Vec<u8> {
    let told = if noise.one_in(40) { noise.next() >> noise.below(64) } else { content.len() as u64 };
    [vec![kind], told.to_le_bytes().to_vec(), content.to_vec()].concat()
}

fn text(text: &str) -> Vec<u8> {
    [(text.len() as u32).to_le_bytes().to_vec(), text.as_bytes().to_vec()].concat()
}

/// Schema, channel and messages.
fn content(noise: &mut Noise) -> Vec<u8> {
    let name = noise.pick(&["osi3.GroundTruth", "osi3.GroundTruth", "osi3.SensorView", "osi3.SensorData"]);
    let schema = [vec![1, 0], text(name), text("protobuf"), text("")].concat();
    let channel = [vec![0, 0, 1, 0], text("truth"), text("protobuf"), text("")].concat();
    let mut bytes = [record(noise, 3, &schema), record(noise, 4, &channel)].concat();
    for number in 0..noise.below(4) as u64 {
        let head = [vec![0; 6], number.to_le_bytes().to_vec(), number.to_le_bytes().to_vec()].concat();
        let message = message(noise, number);
        bytes.extend(record(noise, 5, &[head, message].concat()));
    }
    bytes
}

/// A chunk as it is, or told to be packed.
fn chunk(noise: &mut Noise) -> Vec<u8> {
    let content = content(noise);
    let packing = noise.pick(&["", "", "", "zstd", "lz4", "none"]);
    let told = if noise.one_in(12) { noise.next() >> noise.below(64) } else { content.len() as u64 };
    let length = (content.len() as u64).to_le_bytes().to_vec();
    let head = [vec![0; 16], told.to_le_bytes().to_vec(), vec![0; 4], text(packing), length].concat();
    record(noise, 6, &[head, content].concat())
}

fn recording(noise: &mut Noise) -> Vec<u8> {
    let magic = [0x89, b'M', b'C', b'A', b'P', b'0', b'\r', b'\n'];
    let header = [text(""), text("by hand")].concat();
    let mut bytes = [magic.to_vec(), record(noise, 1, &header)].concat();
    for _ in 0..1 + noise.below(3) {
        bytes.extend(if noise.one_in(3) { content(noise) } else { chunk(noise) });
    }
    bytes.extend(record(noise, 15, &[0; 4]));
    bytes.extend(record(noise, 2, &[0; 20]));
    bytes.extend(magic);
    if noise.one_in(6) {
        bytes.truncate(noise.below(bytes.len()));
    }
    bytes
}
