//! NumPy's `.npy` of complex64 (NumPy Enhancement Proposal 1), with its head checked first: the described
//! values must be there.

use ndarray::{ArrayD, IxDyn, ShapeBuilder, ShapeError};
use num_complex::Complex32;
use std::ops::RangeInclusive;

/// Bytes of a complex64.
const VALUE_BYTES: u64 = 8;
/// NumPy's name of a little-endian complex64.
const COMPLEX64: &str = "<c8";

/// The values of an array with the given numbers of axes, row- or column-major.
///
/// # Errors
/// A truncated head, another type or number of axes, no values, or a number of values other than the head's.
pub(super) fn of_bytes(bytes: &[u8], axes: RangeInclusive<usize>) -> Result<ArrayD<Complex32>, NpyError> {
    let (head, values) = head_and_values(bytes).ok_or(NpyError::EndsInHead)?;
    let head = std::str::from_utf8(head).map_err(|_| NpyError::NoText)?;
    let [descr, order, shape] = told(head).ok_or(NpyError::OtherKeys)?;
    if descr != COMPLEX64 {
        return Err(NpyError::OtherType(descr.to_owned()));
    }
    let shape = sides(shape).ok_or(NpyError::NoShape)?;
    match shape.iter().try_fold(VALUE_BYTES, |bytes, side| bytes.checked_mul(*side)) {
        Some(0) => return Err(NpyError::Empty),
        Some(told) if told == values.len() as u64 => {}
        _ => return Err(NpyError::OtherLength { shape, bytes: values.len() }),
    }
    let sides: Vec<usize> = shape.iter().map(|side| *side as usize).collect();
    if !axes.contains(&sides.len()) {
        return Err(NpyError::OtherAxes(sides.len()));
    }
    let is_column_major = match order {
        "True" => true,
        "False" => false,
        other => return Err(NpyError::NoOrder(other.to_owned())),
    };
    let part = |bytes: &[u8]| f32::from_le_bytes(std::array::from_fn(|i| bytes[i]));
    let value = |bytes: &[u8]| Complex32::new(part(bytes), part(&bytes[4..]));
    let values = values.chunks_exact(VALUE_BYTES as usize).map(value).collect();
    ArrayD::from_shape_vec(IxDyn(&sides).set_f(is_column_major), values).map_err(NpyError::Shape)
}

/// A refused file of an array.
#[derive(Debug, thiserror::Error)]
pub(super) enum NpyError {
    /// The file is not NumPy's, or is shorter than its head.
    #[error("it ends within its head")]
    EndsInHead,
    /// The head is not UTF-8.
    #[error("its head is no text")]
    NoText,
    /// The head is not a dictionary, or has other keys.
    #[error("its head tells no shape, type and order alone")]
    OtherKeys,
    /// The shape is not a list of whole numbers.
    #[error("its head tells no shape")]
    NoShape,
    /// A side of the array is 0.
    #[error("it holds no values")]
    Empty,
    /// Fewer or more values follow the head than it describes.
    #[error("its head tells of {shape:?} values, behind it are {bytes} bytes")]
    OtherLength {
        /// Sides of the array.
        shape: Vec<u64>,
        /// Bytes after the head.
        bytes: usize,
    },
    /// The values are not complex64.
    #[error("its values are of type {0}")]
    OtherType(String),
    /// The array has another number of axes.
    #[error("it has {0} axes")]
    OtherAxes(usize),
    /// The order of the values is unknown.
    #[error("fortran_order is True or False, not {0}")]
    NoOrder(String),
    /// The values do not fill the shape.
    #[error("{0}")]
    Shape(#[source] ShapeError),
}

/// The values of `descr`, `fortran_order` and `shape`, the only keys of a head.
fn told(head: &str) -> Option<[&str; 3]> {
    let mut entries = entries(head)?;
    entries.sort_unstable();
    match entries[..] {
        [("descr", descr), ("fortran_order", order), ("shape", shape)] => Some([descr, order, shape]),
        _ => None,
    }
}

/// Keys and values of a dictionary in Python's notation.
fn entries(head: &str) -> Option<Vec<(&str, &str)>> {
    let mut rest = head.trim().strip_prefix('{')?.strip_suffix('}')?.trim();
    let mut all = Vec::new();
    while !rest.is_empty() {
        let (key, behind) = rest.strip_prefix('\'')?.split_once('\'')?;
        let (value, behind) = value_and_rest(behind.trim_start().strip_prefix(':')?.trim_start())?;
        all.push((key, value.trim()));
        rest = behind.trim_start();
        rest = rest.strip_prefix(',').unwrap_or(rest).trim_start();
    }
    Some(all)
}

/// Splits off a number, a word, a quoted text or a bracketed value.
fn value_and_rest(text: &str) -> Option<(&str, &str)> {
    if let Some(quoted) = text.strip_prefix('\'') {
        return quoted.split_once('\'');
    }
    let end = if text.starts_with('(') { text.find(')')? + 1 } else { text.find(',').unwrap_or(text.len()) };
    Some(text.split_at(end))
}

/// Splits a file into magic, version, length of the head in two bytes or, from version 2 on, four, and the
/// head (NumPy Enhancement Proposal 1).
fn head_and_values(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let behind = bytes.strip_prefix(b"\x93NUMPY")?;
    let ([major, _], behind) = behind.split_first_chunk::<2>()?;
    let (length, behind) = if *major == 1 {
        let (length, behind) = behind.split_first_chunk::<2>()?;
        (u32::from(u16::from_le_bytes(*length)), behind)
    } else {
        let (length, behind) = behind.split_first_chunk::<4>()?;
        (u32::from_le_bytes(*length), behind)
    };
    behind.split_at_checked(length as usize)
}

/// Numbers in brackets.
fn sides(shape: &str) -> Option<Vec<u64>> {
    let inside = shape.strip_prefix('(')?.strip_suffix(')')?;
    inside.split(',').map(str::trim).filter(|side| !side.is_empty()).map(|side| side.parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ndarray::Array4;
    use ndarray_npy::WriteNpyExt;

    fn file(shape: &str, values: usize) -> Vec<u8> {
        let head = format!("{{'descr': '<c8', 'fortran_order': False, 'shape': {shape}, }}\n");
        [&b"\x93NUMPY\x01\0"[..], &(head.len() as u16).to_le_bytes(), head.as_bytes(), &vec![0; 8 * values]]
            .concat()
    }

    #[test]
    fn a_head_is_believed_as_far_as_there_are_values() {
        assert_eq!(of_bytes(&file("(2, 3, 1, 1)", 6), 4..=4).unwrap().shape(), [2, 3, 1, 1]);
        for shape in [
            "(2, 4)",
            "(2, 3)",
            "(0, 6)",
            "(-1, 6)",
            "(4294967296, 4294967296, 4294967296)",
            "2, 3",
            "(1.0, 6)",
        ] {
            assert!(of_bytes(&file(shape, 6), 4..=4).is_err(), "{shape}");
        }
        let long = [&b"\x93NUMPY\x02\0"[..], &u32::MAX.to_le_bytes(), b"{}"].concat();
        assert_eq!(of_bytes(&long, 3..=4).unwrap_err().to_string(), "it ends within its head");
        assert!(of_bytes(b"\x93NUMPY", 3..=4).is_err() && of_bytes(b"", 3..=4).is_err());
    }

    #[test]
    fn another_type_is_told_as_one_however_many_bytes_its_values_take() {
        for descr in ["<f8", "<f4", "<i2", "<c16", ">c8"] {
            let head = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': (2, 1, 1, 1), }}\n");
            let length = (head.len() as u16).to_le_bytes();
            for values in [4, 16, 32] {
                let bytes = [&b"\x93NUMPY\x01\0"[..], &length, head.as_bytes(), &vec![0; values]].concat();
                let told = of_bytes(&bytes, 4..=4).unwrap_err().to_string();
                assert_eq!(told, format!("its values are of type {descr}"));
            }
        }
    }

    /// Written by another library, in both orders.
    #[test]
    fn values_stand_where_another_library_has_put_them() {
        let value = |(a, b, c, d): (usize, usize, usize, usize)| {
            Complex32::new((1000 * a + 100 * b + 10 * c + d) as f32, -(d as f32))
        };
        let array = Array4::from_shape_fn((2, 3, 4, 5), value);
        let turned = Array4::from_shape_fn((2, 3, 4, 5).f(), value);
        for array in [array, turned] {
            let mut bytes = Vec::new();
            array.write_npy(&mut bytes).unwrap();
            assert_eq!(of_bytes(&bytes, 4..=4).unwrap(), array.into_dyn());
        }
    }
}
