//! Common Data Representation of DDS (OMG XCDR1, little-endian): values aligned to their own size, counted
//! from the end of the four bytes that identify the encoding.

use crate::osi::common::Timestamp;

/// Plain CDR, little-endian.
const ENCAPSULATION: [u8; 4] = [0, 1, 0, 0];

/// A message being encoded.
pub(crate) struct Cdr {
    bytes: Vec<u8>,
}

impl Cdr {
    /// Begins a message with a `std_msgs/Header`.
    pub(crate) fn stamped(time_s: f64, frame: &str) -> Self {
        let mut message = Self { bytes: ENCAPSULATION.to_vec() };
        let stamp = Timestamp::at(time_s);
        message.put((stamp.seconds.unwrap_or(0) as i32).to_le_bytes());
        message.put(stamp.nanos.unwrap_or(0).to_le_bytes());
        message.text(frame);
        message
    }

    /// Appends the bytes of a number, aligned to their count.
    pub(crate) fn put<const N: usize>(&mut self, bytes: [u8; N]) {
        let past = (self.bytes.len() - ENCAPSULATION.len()) % N;
        if past > 0 {
            self.bytes.extend(std::iter::repeat_n(0, N - past));
        }
        self.bytes.extend(bytes);
    }

    /// Appends the number of following elements, also of a sequence.
    pub(crate) fn count(&mut self, count: usize) {
        self.put((count as u32).to_le_bytes());
    }

    /// Appends a text with its length and a terminating zero.
    pub(crate) fn text(&mut self, text: &str) {
        self.count(text.len() + 1);
        self.bytes.extend(text.as_bytes());
        self.bytes.push(0);
    }

    /// Appends bytes without a length.
    pub(crate) fn raw(&mut self, bytes: &[u8]) {
        self.bytes.extend(bytes);
    }

    /// Appends numbers without a length.
    pub(crate) fn doubles(&mut self, values: &[f64]) {
        values.iter().for_each(|value| self.put(value.to_le_bytes()));
    }

    /// Appends numbers without a length, in single precision.
    pub(crate) fn floats(&mut self, values: &[f64]) {
        values.iter().for_each(|value| self.put((*value as f32).to_le_bytes()));
    }

    /// The whole message.
    pub(crate) fn finish(self) -> Vec<u8> {
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_aligned_to_their_size_behind_the_encapsulation() {
        let mut message = Cdr::stamped(1.5, "ab");
        message.put([7]);
        message.doubles(&[1.0]);
        let expected = [
            &[0, 1, 0, 0][..],
            &1_i32.to_le_bytes(),
            &500_000_000_u32.to_le_bytes(),
            &3_u32.to_le_bytes(),
            b"ab\0",
            &[7],
            &1.0_f64.to_le_bytes(),
        ];
        assert_eq!(message.finish(), expected.concat());
    }
}
