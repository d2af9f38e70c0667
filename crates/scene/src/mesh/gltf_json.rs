//! Size of a glTF's JSON, checked before parsing: typed values take a hundred times the bytes of their text.

use crate::mesh::error::MeshFault;

/// Largest number of values: some hundred for each part of the largest design-program models; a gibibyte when
/// typed.
const VALUE_LIMIT: usize = 1 << 22;

/// Refuses JSON with more values. Its reader limits the nesting depth (128 levels).
pub(crate) fn check_values(json: &[u8]) -> Result<(), MeshFault> {
    if values(json) <= VALUE_LIMIT { Ok(()) } else { Err(MeshFault::TooManyValues { limit: VALUE_LIMIT }) }
}

/// Upper bound of the number of values: opening brackets and separators outside texts.
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

/// Skips the rest of a text after its opening quote.
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
