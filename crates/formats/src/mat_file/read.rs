//! Reading of the complex array of a file, compressed or not, with its lengths checked first.

use crate::mat_file::mat_error::MatError;
use crate::mat_file::{COMPLEX, COMPRESSED, HEAD_BYTES, INT8, INT32, MATRIX, UINT32};
use flate2::read::ZlibDecoder;
use num_complex::Complex32;
use std::io::Read;

/// Bytes of an uncompressed array besides its values.
const BESIDE_VALUES: u64 = 65_536;

/// Values of the file's first complex array with the expected sides, column-major, whatever precedes it.
///
/// # Errors
/// A file of another kind, truncated elements, no such array, or one with other sides.
pub(crate) fn complex_values(bytes: &[u8], shape: [usize; 4]) -> Result<Vec<Complex32>, MatError> {
    if bytes.len() < HEAD_BYTES || bytes[HEAD_BYTES - 4..HEAD_BYTES] != [0, 1, b'I', b'M'] {
        return Err(MatError::NotLevel5);
    }
    let (mut rest, mut why) = (&bytes[HEAD_BYTES..], MatError::NoComplexArray);
    while !rest.is_empty() {
        let (element, behind) = Element::split(rest)?;
        rest = behind;
        match of_element(&element, shape) {
            Ok(Some(values)) => return Ok(values),
            Ok(None) => {}
            Err(other @ MatError::OtherSides { .. }) => why = other,
            Err(error) => return Err(error),
        }
    }
    Err(why)
}

fn of_element(element: &Element<'_>, shape: [usize; 4]) -> Result<Option<Vec<Complex32>>, MatError> {
    match element.kind {
        MATRIX => of_matrix(element.content, shape),
        COMPRESSED => {
            let values = shape.iter().try_fold(1_u64, |product, side| product.checked_mul(*side as u64));
            let most = values.and_then(|values| values.checked_mul(16)).ok_or(MatError::SidesTooLong)?;
            let unpacked = unpacked(element.content, most + BESIDE_VALUES)?;
            let (kind, length, behind) = tag(&unpacked)?;
            // A longer array is truncated: its sides, which come first, show that it is another one.
            let content = behind.get(..length).unwrap_or(behind);
            if kind == MATRIX { of_matrix(content, shape) } else { Ok(None) }
        }
        _ => Ok(None),
    }
}

/// Decompresses at most `most` bytes; a longer element is truncated, and its length shows that.
fn unpacked(content: &[u8], most: u64) -> Result<Vec<u8>, MatError> {
    let mut bytes = vec![];
    ZlibDecoder::new(content).take(most).read_to_end(&mut bytes).map_err(MatError::Damaged)?;
    Ok(bytes)
}

/// Values of an array; `None` if it does not hold complex numbers.
fn of_matrix(content: &[u8], shape: [usize; 4]) -> Result<Option<Vec<Complex32>>, MatError> {
    let (flags, rest) = Element::split(content)?;
    let is_complex = flags.kind == UINT32 && flags.content.len() == 8 && {
        let word = u32::from_le_bytes(std::array::from_fn(|byte| flags.content[byte]));
        let is_of_numbers = matches!(word & 0xff, 6..=15);
        word & COMPLEX != 0 && is_of_numbers
    };
    if !is_complex {
        return Ok(None);
    }
    let (sides, rest) = Element::split(rest)?;
    let (name, rest) = Element::split(rest)?;
    if sides.kind != INT32 || name.kind != INT8 {
        return Err(MatError::NoSidesOrName);
    }
    let told: Vec<u32> =
        sides.content.chunks_exact(4).map(|b| u32::from_le_bytes(std::array::from_fn(|i| b[i]))).collect();
    let mut asked: Vec<u32> = shape.iter().map(|side| *side as u32).collect();
    // MATLAB omits trailing sides of 1, down to two sides.
    while asked.len() > 2 && asked.last() == Some(&1) && told.len() < asked.len() {
        asked.pop();
    }
    if told != asked {
        return Err(MatError::OtherSides { found: told, asked: shape });
    }
    let (re, rest) = Element::split(rest)?;
    let (im, _) = Element::split(rest)?;
    let count = shape.iter().product();
    let (re, im) = (re.numbers(count)?, im.numbers(count)?);
    Ok(Some(re.into_iter().zip(im).map(|(re, im)| Complex32::new(re, im)).collect()))
}

/// An element: its type and bytes.
struct Element<'a> {
    kind: u32,
    content: &'a [u8],
}

/// Type and length of the first element, and the bytes after its tag.
fn tag(bytes: &[u8]) -> Result<(u32, usize, &[u8]), MatError> {
    let (tag, behind) = bytes.split_first_chunk::<8>().ok_or(MatError::EndsInElement)?;
    let word = |at: usize| u32::from_le_bytes(std::array::from_fn(|byte| tag[at + byte]));
    Ok((word(0), word(4) as usize, behind))
}

impl<'a> Element<'a> {
    /// The first element, and the bytes after it. Elements of up to four bytes have their length in the upper
    /// half of the type, and their content in the tag.
    fn split(bytes: &'a [u8]) -> Result<(Self, &'a [u8]), MatError> {
        let (kind, length, behind) = tag(bytes)?;
        if kind >> 16 != 0 {
            let content = bytes.get(4..4 + (kind >> 16) as usize).filter(|content| content.len() <= 4);
            let content = content.ok_or(MatError::EndsInElement)?;
            return Ok((Self { kind: kind & 0xffff, content }, behind));
        }
        let content = behind.get(..length).ok_or(MatError::EndsInElement)?;
        // Compressed elements are not padded.
        let padded = if kind == COMPRESSED { length } else { length.next_multiple_of(8) };
        Ok((Self { kind, content }, behind.get(padded..).unwrap_or(&[])))
    }

    /// Reads `count` numbers of any stored type.
    fn numbers(&self, count: usize) -> Result<Vec<f32>, MatError> {
        let of = |bytes: usize, number: fn(&[u8]) -> f64| {
            if self.content.len().checked_div(bytes) != Some(count)
                || !self.content.len().is_multiple_of(bytes)
            {
                return Err(MatError::OtherCount { asked: count, bytes: self.content.len() });
            }
            Ok(self.content.chunks_exact(bytes).map(|bytes| number(bytes) as f32).collect())
        };
        match self.kind {
            1 => of(1, |b| f64::from(i8::from_le_bytes([b[0]]))),
            2 => of(1, |b| f64::from(b[0])),
            3 => of(2, |b| f64::from(i16::from_le_bytes([b[0], b[1]]))),
            4 => of(2, |b| f64::from(u16::from_le_bytes([b[0], b[1]]))),
            5 => of(4, |b| f64::from(i32::from_le_bytes(std::array::from_fn(|i| b[i])))),
            6 => of(4, |b| f64::from(u32::from_le_bytes(std::array::from_fn(|i| b[i])))),
            7 => of(4, |b| f64::from(f32::from_le_bytes(std::array::from_fn(|i| b[i])))),
            9 => of(8, |b| f64::from_le_bytes(std::array::from_fn(|i| b[i]))),
            other => Err(MatError::UnknownNumbers(other)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mat_file::ComplexArray;
    use flate2::{Compression, write::ZlibEncoder};
    use std::io::Write;

    const SHAPE: [usize; 4] = [3, 2, 2, 1];

    fn values() -> Vec<Complex32> {
        (0..12).map(|i| Complex32::new(i as f32, -0.5 * i as f32)).collect()
    }

    fn file() -> Vec<u8> {
        ComplexArray { name: "adcData", shape: SHAPE, values: &values() }.to_bytes()
    }

    fn packed(file: &[u8]) -> Vec<u8> {
        let mut encoder = ZlibEncoder::new(vec![], Compression::fast());
        encoder.write_all(&file[HEAD_BYTES..]).unwrap();
        let content = encoder.finish().unwrap();
        let tag = [COMPRESSED.to_le_bytes(), (content.len() as u32).to_le_bytes()].concat();
        [&file[..HEAD_BYTES], &tag, &content].concat()
    }

    #[test]
    fn an_array_comes_back_as_it_went_packed_or_not() {
        assert_eq!(complex_values(&file(), SHAPE).unwrap(), values());
        assert_eq!(complex_values(&packed(&file()), SHAPE).unwrap(), values());
    }

    /// MATLAB keeps an array of whole doubles so: its numbers as 16-bit integers, its last side of 1 left
    /// out, a short name in its tag, another array before it.
    #[test]
    fn an_array_by_hand_is_read_in_whatever_type_its_numbers_are_kept() {
        let tag = |kind: u32, length: u32| [kind.to_le_bytes(), length.to_le_bytes()].concat();
        let flags = |word: u32| [tag(UINT32, 8), word.to_le_bytes().to_vec(), vec![0; 4]].concat();
        let sides = [tag(INT32, 12), [3_u32, 2, 2].map(u32::to_le_bytes).concat(), vec![0; 4]].concat();
        let name = [(1 << 16 | INT8).to_le_bytes(), *b"x\0\0\0"].concat();
        let part: Vec<u8> =
            [tag(3, 24), (0..12_i16).flat_map(|i| (i - 6).to_le_bytes()).collect::<Vec<u8>>()].concat();
        let content = [flags(6 | COMPLEX), sides.clone(), name.clone(), part.clone(), part.clone()].concat();
        let other = [flags(6), sides, name, part].concat();
        let of = |content: &[u8]| [tag(MATRIX, content.len() as u32), content.to_vec()].concat();
        let bytes = [file()[..HEAD_BYTES].to_vec(), of(&other), of(&content)].concat();
        let found = complex_values(&bytes, SHAPE).unwrap();
        assert_eq!((found[0], found[11]), (Complex32::new(-6.0, -6.0), Complex32::new(5.0, 5.0)));
    }

    #[test]
    fn a_complex_array_of_other_sides_may_stand_before_the_one_that_is_meant() {
        let other = ComplexArray { name: "taps", shape: [5, 1, 1, 1], values: &values()[..5] }.to_bytes();
        let both = [&other, &file()[HEAD_BYTES..]].concat();
        assert_eq!(complex_values(&both, SHAPE).unwrap(), values());
        let long =
            ComplexArray { name: "long", shape: [9000, 1, 1, 1], values: &[Complex32::ONE; 9000] }.to_bytes();
        let both = [&packed(&long), &packed(&file())[HEAD_BYTES..]].concat();
        assert_eq!(complex_values(&both, SHAPE).unwrap(), values());
        assert!(complex_values(&other, SHAPE).is_err_and(|e| e.to_string().contains("the scene's radar")));
    }

    #[test]
    fn files_that_are_cut_off_or_of_something_else_are_refused() {
        for length in 0..file().len() {
            assert!(complex_values(&file()[..length], SHAPE).is_err(), "{length}");
        }
        assert!(
            complex_values(&file(), [3, 2, 1, 2]).is_err_and(|e| e.to_string().contains("the scene's radar"))
        );
        let bomb = packed(&[&file()[..HEAD_BYTES], &vec![0; 1 << 24][..]].concat());
        assert!(complex_values(&bomb, SHAPE).is_err());
        let hdf5 = [b"\x89HDF\r\n\x1a\n".to_vec(), vec![0; 200]].concat();
        assert!(complex_values(&hdf5, SHAPE).is_err_and(|e| e.to_string().contains("7.3")));
    }
}
