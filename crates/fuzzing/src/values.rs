//! JSON values changed by their structure.

use crate::rng::FuzzRng;
use serde_json::{Number, Value, json};

/// Changes a value somewhere: what it holds is removed, doubled, moved, or becomes what `strange` gives;
/// `words` are keys that may be added.
pub fn mutate(rng: &mut FuzzRng, value: &mut Value, words: &[&str], strange: fn(&mut FuzzRng) -> Value) {
    let here = rng.one_in(12);
    match value {
        Value::Array(array) if !here && !array.is_empty() => {
            if let Some(at) = mutate_array(rng, array) {
                mutate(rng, &mut array[at], words, strange);
            }
        }
        Value::Object(object) if !here && !object.is_empty() => {
            let key = object.keys().nth(rng.below(object.len())).unwrap().clone();
            match rng.below(10) {
                0 => drop(object.remove(&key)),
                1 => drop(object.insert(rng.choose(words).to_owned(), strange(rng))),
                _ => mutate(rng, &mut object[&key], words, strange),
            }
        }
        _ => *value = strange(rng),
    }
}

/// Changes the list itself, or tells the element that is to be changed.
fn mutate_array(rng: &mut FuzzRng, array: &mut Vec<Value>) -> Option<usize> {
    let (at, other) = (rng.below(array.len()), rng.below(array.len()));
    match rng.below(10) {
        0 => drop(array.remove(at)),
        1 => array.push(array[at].clone()),
        2 => array.swap(at, other),
        3 => {
            let bytes = array[at].to_string().len();
            array.extend(vec![array[at].clone(); rng.repeat_count().min(MAX_REPEATED_BYTES / bytes)]);
        }
        _ => return Some(at),
    }
    None
}

/// Changes a value somewhere to one that mostly is of the same kind: numbers stay numbers, texts texts, and
/// objects keep their keys, so that it is the value of the same type still.
pub fn mutate_keeping_types(rng: &mut FuzzRng, value: &mut Value) {
    match value {
        Value::Array(array) if !array.is_empty() && !rng.one_in(24) => {
            if let Some(at) = mutate_array(rng, array) {
                mutate_keeping_types(rng, &mut array[at]);
            }
        }
        Value::Object(object) if !object.is_empty() && !rng.one_in(24) => {
            let at = rng.below(object.len());
            mutate_keeping_types(rng, object.values_mut().nth(at).unwrap());
        }
        Value::Array(array) => array.clear(),
        Value::Object(_) | Value::Null => *value = Value::Null,
        Value::Bool(told) => *told = !*told,
        Value::String(text) => *text = mutated_string(rng, text),
        Value::Number(number) => *number = mutated_number(rng, number),
    }
}

/// Bytes that a repeated piece has at most: pieces of pieces would fill any memory.
const MAX_REPEATED_BYTES: usize = 1 << 24;

fn mutated_string(rng: &mut FuzzRng, text: &str) -> String {
    match rng.below(4) {
        0 => String::new(),
        1 => text.repeat(rng.repeat_count().min(MAX_REPEATED_BYTES / text.len().max(1))),
        2 => String::from_utf8_lossy(rng.stray_bytes()).into_owned(),
        _ => rng.choose(&["x", "../x", "\"", "car", "a,b\nc", "\u{1f697}"]).to_owned(),
    }
}

/// A whole number for a whole number; any for any.
fn mutated_number(rng: &mut FuzzRng, number: &Number) -> Number {
    const WHOLE: [u64; 14] =
        [0, 1, 2, 3, 7, 255, 256, 65_535, 65_536, 1 << 20, (1 << 31) - 1, u32::MAX as u64, 1 << 40, u64::MAX];
    match number.as_u64() {
        Some(known) if rng.one_in(2) => Number::from(known.wrapping_add(rng.below(5) as u64).max(2) - 2),
        Some(_) => Number::from(WHOLE[rng.below(WHOLE.len())]),
        None => match json!(extreme_number(rng)) {
            Value::Number(number) => number,
            _ => Number::from(0),
        },
    }
}

fn extreme_number(rng: &mut FuzzRng) -> f64 {
    const STRANGE: [f64; 14] = [
        NAN_PLACEHOLDER,
        NAN_PLACEHOLDER_F32,
        0.0,
        -0.0,
        1.0,
        -1.0,
        1e-9,
        1e9,
        1e19,
        -1e30,
        1e308,
        -1e308,
        5e-324,
        1e-310,
    ];
    match rng.below(3) {
        0 => (rng.unit_f64() - 0.5) * 10_f64.powi(rng.below(12) as i32 - 4),
        _ => STRANGE[rng.below(STRANGE.len())],
    }
}

/// Stands for what JSON cannot hold; who writes the value in binary puts NaN or an infinity in its place.
const NAN_PLACEHOLDER: f64 = 7.291_156_781_234e300;
/// Stands for the same where a number of 32 bits is written.
const NAN_PLACEHOLDER_F32: f64 = 7.291_156e30;

/// Puts NaN and infinities where [`mutate_keeping_types`] has left what stands for them, in a value
/// written in binary, little endian.
pub fn insert_nonfinite_floats(rng: &mut FuzzRng, bytes: &mut [u8]) {
    let wide = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][rng.below(3)];
    replace(bytes, NAN_PLACEHOLDER.to_le_bytes(), wide.to_le_bytes());
    let narrow = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY][rng.below(3)];
    replace(bytes, (NAN_PLACEHOLDER_F32 as f32).to_le_bytes(), narrow.to_le_bytes());
}

fn replace<const N: usize>(bytes: &mut [u8], from: [u8; N], to: [u8; N]) {
    let places: Vec<usize> = (0..bytes.len()).filter(|at| bytes[*at..].starts_with(&from)).collect();
    places.into_iter().for_each(|at| bytes[at..at + N].copy_from_slice(&to));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_changed_alike_keeps_its_keys_and_mostly_its_kinds() {
        let sound = json!({ "a": 1, "b": [0.5, 0.25], "c": { "d": "text", "e": true } });
        let mut kept = 0;
        for case in 0..1000 {
            let mut value = sound.clone();
            mutate_keeping_types(&mut FuzzRng::new(1, case), &mut value);
            let is_like = value["a"].is_u64() && value["b"].is_array() && value["c"]["d"].is_string();
            kept += u32::from(is_like);
            assert!(value.is_null() || value.as_object().unwrap().len() == 3, "{value}");
        }
        assert!((800..1000).contains(&kept), "{kept}");
    }

    #[test]
    fn what_stands_for_nan_becomes_it_in_binary() {
        let wide = [1.0, NAN_PLACEHOLDER].map(f64::to_le_bytes).concat();
        let mut bytes = [&wide[..], &(NAN_PLACEHOLDER_F32 as f32).to_le_bytes()].concat();
        insert_nonfinite_floats(&mut FuzzRng::new(1, 1), &mut bytes);
        assert_eq!(bytes[..8], 1_f64.to_le_bytes());
        assert!(!f64::from_le_bytes(bytes[8..16].try_into().unwrap()).is_finite());
        assert!(!f32::from_le_bytes(bytes[16..].try_into().unwrap()).is_finite());
    }

    #[test]
    fn every_part_of_a_value_is_changed_by_some_case() {
        let sound = json!({ "a": 1, "b": [1, 2], "c": "text" });
        let changed = |case| {
            let mut value = sound.clone();
            mutate(&mut FuzzRng::new(1, case), &mut value, &["z"], |rng| json!(rng.below(9)));
            value
        };
        let all: Vec<Value> = (0..300).map(changed).collect();
        let differs = |key: &str| all.iter().any(|value| value.get(key) != sound.get(key));
        assert!(["a", "b", "c", "z"].iter().all(|key| differs(key)));
    }
}
