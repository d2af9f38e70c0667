//! The head of NumPy's `.npy`, checked before its reader believes it: the values that it tells of have to be there.

/// Bytes of a complex64.
const VALUE_BYTES: u64 = 8;

/// Refuses a head that is cut off, tells no shape, or a shape of none or of more values than stand behind it. What kind of
/// values they are is left to the reader.
pub(crate) fn check(bytes: &[u8]) -> Result<(), String> {
    let (head, values) = head_and_values(bytes).ok_or("it ends within its head")?;
    let shape = shape(&String::from_utf8_lossy(head)).ok_or("its head tells no shape")?;
    match shape.iter().try_fold(VALUE_BYTES, |bytes, side| bytes.checked_mul(*side)) {
        Some(0) => Err("it holds no values".to_owned()),
        Some(told) if told <= values.len() as u64 => Ok(()),
        _ => Err(format!("its head tells of {shape:?} values, behind it are {} bytes", values.len())),
    }
}

/// Magic, version, length of the head in two bytes or, from version 2 on, four, the head (NumPy Enhancement Proposal 1).
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

/// The numbers in the brackets behind `shape`.
fn shape(head: &str) -> Option<Vec<u64>> {
    let (_, behind) = head.split_once("shape")?;
    let (_, behind) = behind.split_once('(')?;
    let (inside, _) = behind.split_once(')')?;
    inside.split(',').map(str::trim).filter(|side| !side.is_empty()).map(|side| side.parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(shape: &str, values: usize) -> Vec<u8> {
        let head = format!("{{'descr': '<c8', 'fortran_order': False, 'shape': {shape}, }}\n");
        [&b"\x93NUMPY\x01\0"[..], &(head.len() as u16).to_le_bytes(), head.as_bytes(), &vec![0; 8 * values]].concat()
    }

    #[test]
    fn a_head_is_believed_as_far_as_there_are_values() {
        assert_eq!(check(&file("(2, 3)", 6)), Ok(()));
        assert_eq!(check(&file("(7,)", 7)), Ok(()));
        for shape in ["(2, 4)", "(0, 6)", "(-1, 6)", "(4294967296, 4294967296, 4294967296)", "2, 3", "(1.0, 6)"] {
            assert!(check(&file(shape, 6)).is_err(), "{shape}");
        }
        let long = [&b"\x93NUMPY\x02\0"[..], &u32::MAX.to_le_bytes(), b"{}"].concat();
        assert_eq!(check(&long).unwrap_err(), "it ends within its head");
        assert!(check(b"\x93NUMPY").is_err() && check(b"").is_err());
    }
}
