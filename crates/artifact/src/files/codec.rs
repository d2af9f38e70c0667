//! Encoding by bincode 2, confined to this module so that it can be replaced
//! (docs/decisions/serialization.md).

use serde::{Serialize, de::DeserializeOwned};

/// Fixed configuration, part of the format: little endian, variable-length integers.
fn configuration() -> impl bincode::config::Config {
    bincode::config::standard()
}

/// Encodes a record.
pub(crate) fn encode<T: Serialize>(value: &T) -> Result<Vec<u8>, bincode::error::EncodeError> {
    bincode::serde::encode_to_vec(value, configuration())
}

/// Reason that bytes are not a valid record.
#[derive(Debug, thiserror::Error)]
pub(crate) enum DecodeError {
    /// Invalid values, or a length beyond the bound.
    #[error(transparent)]
    Content(#[from] bincode::error::DecodeError),
    /// Bytes left over after the record.
    #[error("{0} bytes left over")]
    LeftOver(usize),
}

/// Decodes a record from exactly these bytes; left-over bytes are an error.
///
/// A length inside may claim no more memory than a bound that grows with the bytes: the smallest power of 16
/// with room for every number that they can hold (a byte may stand for one of eight bytes).
pub(crate) fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, DecodeError> {
    match 16 * bytes.len() {
        0..=0x1_0000 => decode_within::<T, 0x1_0000>(bytes),
        0x1_0001..=0x10_0000 => decode_within::<T, 0x10_0000>(bytes),
        0x10_0001..=0x100_0000 => decode_within::<T, 0x100_0000>(bytes),
        0x100_0001..=0x1000_0000 => decode_within::<T, 0x1000_0000>(bytes),
        0x1000_0001..=0x1_0000_0000 => decode_within::<T, 0x1_0000_0000>(bytes),
        _ => decode_within::<T, 0x100_0000_0000>(bytes),
    }
}

fn decode_within<T: DeserializeOwned, const BOUND: usize>(bytes: &[u8]) -> Result<T, DecodeError> {
    let bounded = bincode::config::standard().with_limit::<BOUND>();
    let (value, used) = bincode::serde::decode_from_slice(bytes, bounded)?;
    match bytes.len() - used {
        0 => Ok(value),
        left => Err(DecodeError::LeftOver(left)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_length_that_no_memory_has_is_refused_and_not_reserved() {
        for length in [u64::MAX, 1 << 62, 1 << 40, 1 << 28] {
            let claimed = encode(&length).unwrap();
            assert!(decode::<String>(&claimed).is_err(), "{length}");
            assert!(decode::<Vec<f64>>(&claimed).is_err(), "{length}");
            assert!(decode::<(String, Vec<String>)>(&claimed).is_err(), "{length}");
        }
    }

    #[test]
    fn what_is_written_is_read_however_much_it_is() {
        for count in [0, 1, 500, 5_000, 70_000, 1_200_000] {
            let numbers: Vec<u64> = vec![7; count];
            assert_eq!(decode::<Vec<u64>>(&encode(&numbers).unwrap()).unwrap(), numbers);
            let words: Vec<String> = vec!["m/s".into(); count];
            assert_eq!(decode::<Vec<String>>(&encode(&words).unwrap()).unwrap(), words);
        }
    }
}
