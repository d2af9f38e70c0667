//! Ground truth as a Python pickle, which the loaders of RADDet read: a dictionary of lists of words and of
//! arrays of numbers. Protocol 2 (Python's module `pickletools` lists its opcodes). An array is a call of
//! `numpy.array` on lists, which every version of NumPy has under this name.

/// A value of the dictionary.
pub(crate) enum PickleValue {
    /// A list of words.
    Words(Vec<String>),
    /// An array of float64, row after row.
    Rows(Vec<Vec<f64>>),
}

/// Bytes of a dictionary.
pub(crate) fn dictionary(entries: &[(&str, PickleValue)]) -> Vec<u8> {
    let mut bytes = vec![0x80, 2, b'}', b'('];
    for (key, value) in entries {
        word(&mut bytes, key);
        match value {
            PickleValue::Words(words) => list(&mut bytes, words, |bytes, text| word(bytes, text)),
            PickleValue::Rows(rows) => array(&mut bytes, rows),
        }
    }
    bytes.extend(b"u.");
    bytes
}

fn array(bytes: &mut Vec<u8>, rows: &[Vec<f64>]) {
    bytes.extend(b"cnumpy\narray\n");
    list(bytes, rows, |bytes, row| list(bytes, row, |bytes, value| number(bytes, *value)));
    bytes.extend([0x85, b'R']); // a tuple of one, the call's argument
}

fn list<T>(bytes: &mut Vec<u8>, items: &[T], item: impl Fn(&mut Vec<u8>, &T)) {
    bytes.extend(b"](");
    items.iter().for_each(|each| item(bytes, each));
    bytes.push(b'e');
}

fn word(bytes: &mut Vec<u8>, text: &str) {
    bytes.push(b'X');
    bytes.extend((text.len() as u32).to_le_bytes());
    bytes.extend(text.as_bytes());
}

fn number(bytes: &mut Vec<u8>, value: f64) {
    bytes.push(b'G');
    bytes.extend(value.to_be_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Read back by Python in `docs/training-sets/check.py`; here the opcodes of the smallest one.
    #[test]
    fn a_dictionary_is_spelt_in_opcodes_of_protocol_2() {
        let words = PickleValue::Words(vec!["car".into()]);
        let rows = PickleValue::Rows(vec![vec![1.0]]);
        let bytes = dictionary(&[("classes", words), ("boxes", rows)]);
        let expected = [
            &b"\x80\x02}(X\x07\0\0\0classes](X\x03\0\0\0careX\x05\0\0\0boxes"[..],
            b"cnumpy\narray\n](](G\x3f\xf0\0\0\0\0\0\0ee\x85Ru.",
        ]
        .concat();
        assert_eq!(bytes, expected);
    }
}
