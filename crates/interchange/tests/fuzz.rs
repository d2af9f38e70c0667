//! The readers of `interchange` against traces changed by their structure: lengths, tags, records, chunks and
//! numbers. Each is read or refused with a sentence that names the file; none panics, takes a minute, or
//! fills the memory. Longer runs and other cases: `fuzzing`.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

use fuzzing::{FuzzRng, Reader, mutate_word32};
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
fn inside(rng: &mut FuzzRng, number: u64, content: &[u8]) -> Vec<u8> {
    let told = if rng.one_in(40) { rng.next_u64() >> rng.below(64) } else { content.len() as u64 };
    [varint(number << 3 | 2), varint(told), content.to_vec()].concat()
}

fn double(rng: &mut FuzzRng, number: u64, value: f64) -> Vec<u8> {
    let mut bytes = value.to_le_bytes();
    if rng.one_in(60) {
        mutate_word32(rng, &mut bytes);
    }
    [varint(number << 3 | 1), bytes.to_vec()].concat()
}

fn vector(rng: &mut FuzzRng, values: [f64; 3]) -> Vec<u8> {
    (1..).zip(values).flat_map(|(number, value)| double(rng, number, value)).collect()
}

fn object(rng: &mut FuzzRng, id: u64, y_m: f64) -> Vec<u8> {
    let parts = [
        (1, vector(rng, [4.5, 1.8, 1.5])),
        (2, vector(rng, [5.0, y_m, 0.75])),
        (3, vector(rng, [0.0, 0.0, -1.57])),
        (4, vector(rng, [0.0, -9.0, 0.0])),
    ];
    let base: Vec<u8> = parts.iter().flat_map(|(number, part)| inside(rng, *number, part)).collect();
    let id = [vec![8], varint(id)].concat();
    let kind = [vec![8], varint(rng.below(26) as u64)].concat();
    let parts = [inside(rng, 1, &id), inside(rng, 2, &base), vec![24, 2], inside(rng, 6, &kind)];
    parts.concat()
}

fn message(rng: &mut FuzzRng, number: u64) -> Vec<u8> {
    let stamp = [vec![8], varint(number), vec![16], varint(500)].concat();
    let mut message = inside(rng, 2, &stamp);
    for id in 0..rng.below(4) as u64 {
        let content = object(rng, id, 40.0 - number as f64);
        message.extend(inside(rng, 5, &content));
    }
    // A map that is passed over.
    let lanes = vec![7; rng.below(50)];
    message.extend(inside(rng, 10, &lanes));
    if rng.one_in(20) {
        let at = rng.below(message.len());
        message[at] ^= 1 << rng.below(8);
    }
    message
}

/// A view of a sensor, with a ground truth in it now and then, or with reflections.
fn view(rng: &mut FuzzRng, number: u64) -> Vec<u8> {
    let stamp = [vec![8], varint(number), vec![16], varint(500)].concat();
    let mut message = inside(rng, 2, &stamp);
    if rng.one_in(2) {
        message.extend(inside(rng, 3, &[8, 3]));
    }
    if !rng.one_in(8) {
        let truth = self::message(rng, number);
        message.extend(inside(rng, 7, &truth));
    }
    if rng.one_in(2) {
        message.extend(inside(rng, 8, &[8, 11]));
    }
    let reflections = vec![7; rng.below(50)];
    message.extend(inside(rng, 1001, &reflections));
    message
}

fn trace(rng: &mut FuzzRng, message: fn(&mut FuzzRng, u64) -> Vec<u8>) -> Vec<u8> {
    let mut bytes = vec![];
    for number in 0..1 + rng.below(4) as u64 {
        let message = message(rng, number);
        let told = if rng.one_in(30) { rng.next_u64() as u32 >> rng.below(32) } else { message.len() as u32 };
        bytes.extend(told.to_le_bytes());
        bytes.extend(message);
    }
    if rng.one_in(6) {
        bytes.truncate(rng.below(bytes.len()));
    }
    bytes
}

/// A record of MCAP, its length told wrong now and then.
fn record(rng: &mut FuzzRng, kind: u8, content: &[u8]) -> Vec<u8> {
    let told = if rng.one_in(40) { rng.next_u64() >> rng.below(64) } else { content.len() as u64 };
    [vec![kind], told.to_le_bytes().to_vec(), content.to_vec()].concat()
}

fn text(text: &str) -> Vec<u8> {
    [(text.len() as u32).to_le_bytes().to_vec(), text.as_bytes().to_vec()].concat()
}

/// Schema, channel and messages.
fn content(rng: &mut FuzzRng) -> Vec<u8> {
    let name = rng.choose(&["osi3.GroundTruth", "osi3.GroundTruth", "osi3.SensorView", "osi3.SensorData"]);
    let schema = [vec![1, 0], text(name), text("protobuf"), text("")].concat();
    let channel = [vec![0, 0, 1, 0], text("truth"), text("protobuf"), text("")].concat();
    let mut bytes = [record(rng, 3, &schema), record(rng, 4, &channel)].concat();
    for number in 0..rng.below(4) as u64 {
        let head = [vec![0; 6], number.to_le_bytes().to_vec(), number.to_le_bytes().to_vec()].concat();
        let message = message(rng, number);
        bytes.extend(record(rng, 5, &[head, message].concat()));
    }
    bytes
}

/// A chunk as it is, or told to be packed.
fn chunk(rng: &mut FuzzRng) -> Vec<u8> {
    let content = content(rng);
    let packing = rng.choose(&["", "", "", "zstd", "lz4", "none"]);
    let told = if rng.one_in(12) { rng.next_u64() >> rng.below(64) } else { content.len() as u64 };
    let length = (content.len() as u64).to_le_bytes().to_vec();
    let head = [vec![0; 16], told.to_le_bytes().to_vec(), vec![0; 4], text(packing), length].concat();
    record(rng, 6, &[head, content].concat())
}

fn recording(rng: &mut FuzzRng) -> Vec<u8> {
    let magic = [0x89, b'M', b'C', b'A', b'P', b'0', b'\r', b'\n'];
    let header = [text(""), text("by hand")].concat();
    let mut bytes = [magic.to_vec(), record(rng, 1, &header)].concat();
    for _ in 0..1 + rng.below(3) {
        bytes.extend(if rng.one_in(3) { content(rng) } else { chunk(rng) });
    }
    bytes.extend(record(rng, 15, &[0; 4]));
    bytes.extend(record(rng, 2, &[0; 20]));
    bytes.extend(magic);
    if rng.one_in(6) {
        bytes.truncate(rng.below(bytes.len()));
    }
    bytes
}
