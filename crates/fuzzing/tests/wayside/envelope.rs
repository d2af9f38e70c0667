//! Artifacts with their records changed and sealed again: every checksum is right, whatever is under it.

use artifact::{Preamble, Provenance, Schema};
use fuzzing::{FuzzRng, insert_nonfinite_floats, mutate_json_keeping_types};
use serde::Serialize;
use serde::de::DeserializeOwned;

const MAGIC: &[u8] = b"WAYSIDE\n";
const CHECKSUM_BYTES: usize = 16;

/// Contents of an artifact's records: preamble, header, frames.
pub(crate) struct Envelope {
    pub(crate) records: Vec<Vec<u8>>,
}

impl Envelope {
    /// An artifact of these values.
    pub(crate) fn new<S: Schema>(header: &S::Header, frames: &[S::Frame]) -> Self {
        let preamble =
            Preamble { schema: S::NAME.into(), version: S::VERSION, provenance: Provenance::default() };
        let frames = frames.iter().map(encoded);
        Self { records: [encoded(&preamble), encoded(header)].into_iter().chain(frames).collect() }
    }

    /// Records of a sound file.
    pub(crate) fn parse(bytes: &[u8]) -> Self {
        let (mut records, mut at) = (vec![], MAGIC.len());
        loop {
            let length = u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()) as usize;
            let start = at + 8 + CHECKSUM_BYTES;
            records.push(bytes[start..start + length].to_vec());
            if bytes[start + length] == b'E' {
                return Self { records };
            }
            at = start + length + 1;
        }
    }

    /// The value of a record.
    pub(crate) fn decoded<T: DeserializeOwned>(&self, record: usize) -> Option<T> {
        decoded(&self.records[record])
    }

    /// The file, its lengths, checksums and end mark right.
    pub(crate) fn to_file_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        for (number, record) in self.records.iter().enumerate() {
            bytes.extend([&b""[..], b"H", b"F"][number.min(2)]);
            bytes.extend((record.len() as u64).to_le_bytes());
            bytes.extend(checksum(record));
            bytes.extend(record);
        }
        let mut end = vec![b'E'];
        end.extend((self.records.len() as u64 - 2).to_le_bytes());
        end.extend(checksum(&end));
        bytes.extend(end);
        bytes
    }
}

fn checksum(bytes: &[u8]) -> [u8; CHECKSUM_BYTES] {
    blake3::hash(bytes).as_bytes()[..CHECKSUM_BYTES].try_into().unwrap()
}

/// A value as records hold it.
pub(crate) fn encoded<T: Serialize>(value: &T) -> Vec<u8> {
    bincode::serde::encode_to_vec(value, bincode::config::standard()).unwrap()
}

/// Damaged records may tell of lengths beyond any memory.
fn decoded<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    let bounded = bincode::config::standard().with_limit::<{ 1 << 26 }>();
    Some(bincode::serde::decode_from_slice(bytes, bounded).ok()?.0)
}

/// A sound artifact changed: values of its records, their bytes, their order and number, and sometimes what
/// stands around them.
pub(crate) fn mutated_artifact<S: Schema>(rng: &mut FuzzRng, sound: &[u8]) -> Vec<u8> {
    let mut envelope = Envelope::parse(sound);
    for _ in 0..=rng.below(2) {
        mutate_records::<S>(rng, &mut envelope.records);
    }
    let mut bytes = envelope.to_file_bytes();
    if rng.one_in(12) {
        corrupt(rng, &mut bytes);
    }
    bytes
}

fn mutate_records<S: Schema>(rng: &mut FuzzRng, records: &mut Vec<Vec<u8>>) {
    let frames = records.len() - 2;
    let frame = 2 + rng.below(frames);
    match rng.below(12) {
        0 if frames > 0 => drop(records.remove(frame)),
        1 if frames > 0 => records.insert(2, records[frame].clone()),
        2 if frames > 0 => records.swap(2, frame),
        3 => mutate_value::<Preamble>(rng, &mut records[0]),
        4..=6 => mutate_value::<S::Header>(rng, &mut records[1]),
        7 => corrupt(rng, &mut records[1]),
        8 | 9 if frames > 0 => corrupt(rng, &mut records[frame]),
        _ if frames > 0 => mutate_value::<S::Frame>(rng, &mut records[frame]),
        _ => {}
    }
}

/// Changes the value that a record holds to another one of its type; its bytes where the tries make none.
fn mutate_value<T: Serialize + DeserializeOwned>(rng: &mut FuzzRng, record: &mut Vec<u8>) {
    let value = decoded::<T>(record).and_then(|value| serde_json::to_value(&value).ok());
    let changed = value.and_then(|value| {
        (0..8).find_map(|_| {
            let mut tried = value.clone();
            (0..=rng.below(3)).for_each(|_| mutate_json_keeping_types(rng, &mut tried));
            serde_json::from_value::<T>(tried).ok()
        })
    });
    match changed {
        Some(value) => {
            *record = encoded(&value);
            insert_nonfinite_floats(rng, record);
        }
        None => corrupt(rng, record),
    }
}

/// A byte, a number, or a piece that is moved, removed or put in; the beginning, where lengths stand, more
/// often.
pub(crate) fn corrupt(rng: &mut FuzzRng, content: &mut Vec<u8>) {
    let end = [content.len(), content.len().min(300), content.len().min(24)][rng.below(3)];
    if end == 0 {
        return;
    }
    let at = rng.below(end);
    let strange = [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e308, 5e-324, -0.0, 1e19][rng.below(8)];
    let small = [f32::NAN, f32::INFINITY, -f32::MAX, 1e-45][rng.below(4)].to_le_bytes();
    let piece = at..(at + 1 + rng.below(9)).min(content.len());
    match rng.below(8) {
        0 => content[at] ^= 1 << rng.below(8),
        1 => content[at] = [0, 1, 250, 251, 252, 253, 255][rng.below(7)],
        2 => content.iter_mut().skip(at).zip(strange.to_le_bytes()).for_each(|(byte, new)| *byte = new),
        3 => content.iter_mut().skip(at).zip(small).for_each(|(byte, new)| *byte = new),
        4 => {
            content.iter_mut().skip(at).zip(rng.next_u64().to_le_bytes()).for_each(|(byte, new)| *byte = new)
        }
        5 => drop(content.drain(piece)),
        6 => content.extend_from_within(piece),
        _ => content[at..].rotate_left(rng.below(9).min(end - at)),
    }
}
