//! Size of a glTF's JSON, told before it is read: typed values take a hundred times the bytes that say
//! them.

use crate::mesh::error::MeshFault;

/// Some hundred values for each of the parts that the largest models from design programs have; a gibibyte
/// once they are typed.
const VALUE_LIMIT: usize = 1 << 22;

/// Refuses JSON of more values than that. How deep they lie is its reader's to bound (128 levels).
pub(crate) fn check_values(json: &[u8]) -> Result<(), MeshFault> {
    if values(json) <= VALUE_LIMIT { Ok(()) } else { Err(MeshFault::TooManyValues { limit: VALUE_LIMIT }) }
}

/// Number of values, or more: what opens a list or an object, and what separates values, outside texts.
fn values(json: &[u8]) -> usize {
    let mut bytes = json.iter();
    let mut values = 1;
    while let Some(byte) = bytes.next() {
        match byte {
            b'"' => end_text(&mut bytes),
            b'[' | b'{' | b',' => values += 1,
            _ => {}
        }
    }
    values
}

/// Passes over a text of which the first quote is behind.
fn end_text(bytes: &mut std::slice::Iter<'_, u8>) {
    while let Some(byte) = bytes.next() {
        match byte {
            b'"' => return,
            b'\\' => drop(bytes.next()),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_counted_outside_texts() {
        for (json, expected) in
            [("{}", 2), (r#"{"a":[1,2,3]}"#, 5), (r#"{"[,{\\\",":1}"#, 2), (r#""\\""#, 1), (r#"",,,"#, 1)]
        {
            assert_eq!(values(json.as_bytes()), expected, "{json}");
        }
    }

    #[test]
    fn more_values_than_any_model_needs_are_refused_before_they_are_typed() {
        let json = |count: usize| format!("[{}]", ",".repeat(count));
        assert!(check_values(json(VALUE_LIMIT - 2).as_bytes()).is_ok());
        assert!(matches!(
            check_values(json(VALUE_LIMIT - 1).as_bytes()),
            Err(MeshFault::TooManyValues { .. })
        ));
    }
}
