//! Orders in which a DCA1000EVM writes the samples of a chirp: little-endian integers of 16 bits (Texas
//! Instruments, Mmwave Radar Device ADC Raw Data Capture, SWRA581, data formats of the DCA1000).
//!
//! - Two lanes (xWR16xx, 18xx, 68xx): receiver after receiver; complex samples in pairs, I₀ I₁ Q₀ Q₁, real
//!   ones one after the other.
//! - Four lanes (xWR12xx, 14xx, AWR2243): sample after sample; I of the four receivers, then their Q, or for
//!   real samples the four receivers.
//!
//! All four lanes are recorded, each for its receiver. Some configurations put Q before I.

use crate::devices::{IqOrder, Lanes};
use crate::raw_data::RecordingShape;
use artifact::radar::Sampling;
use num_complex::Complex32;
use pipeline::host::failure::Failure;
use std::path::Path;

/// Order of the samples in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    /// Lanes between device and capture card.
    pub lanes: Lanes,
    /// First part of a complex sample.
    pub order: IqOrder,
}

/// Order used for writing.
pub(crate) const TWO_LANES: Layout = Layout { lanes: Lanes::Two, order: IqOrder::InPhaseFirst };

/// Number of lanes, and of receivers, of devices with four.
const FOUR: usize = 4;

impl Layout {
    /// Refuses a radar whose samples cannot be in such a file.
    pub(crate) fn check(
        &self,
        file: &Path,
        recording: &RecordingShape,
        sampling: Sampling,
    ) -> Result<(), Failure> {
        let text = match (self.lanes, sampling) {
            (Lanes::Two, Sampling::Complex) if !recording.samples.is_multiple_of(2) => {
                format!("a chirp has {} samples: they are recorded by twos", recording.samples)
            }
            (Lanes::Four, _) if recording.receivers != FOUR => {
                format!(
                    "four lanes are those of four receivers, the scene's radar has {}",
                    recording.receivers
                )
            }
            _ => return Ok(()),
        };
        Err(Failure::Refused(format!("{}: {text}", file.display())))
    }

    /// Name of the smallest group of values.
    pub(crate) fn unit(&self, sampling: Sampling) -> &'static str {
        match (self.lanes, sampling) {
            (Lanes::Two, Sampling::Complex) => "two complex samples of 16 bits",
            (Lanes::Two, Sampling::Real) => "a real sample of 16 bits",
            (Lanes::Four, Sampling::Complex) => "a complex sample of 16 bits of each lane",
            (Lanes::Four, Sampling::Real) => "a real sample of 16 bits of each lane",
        }
    }

    /// Bytes of the smallest group of values.
    pub(crate) fn unit_bytes(&self, sampling: Sampling) -> usize {
        match (self.lanes, sampling) {
            (Lanes::Two, Sampling::Complex) => 8,
            (Lanes::Two, Sampling::Real) => 2,
            (Lanes::Four, _) => FOUR * self.value_bytes(sampling),
        }
    }

    /// Bytes of a sample.
    pub(crate) fn value_bytes(&self, sampling: Sampling) -> usize {
        match sampling {
            Sampling::Complex => 4,
            Sampling::Real => 2,
        }
    }

    /// Samples `[slot][receiver][sample]`, integers times `step`.
    pub(crate) fn by_slot(
        &self,
        bytes: &[u8],
        recording: &RecordingShape,
        sampling: Sampling,
        step: f32,
    ) -> Vec<Complex32> {
        let number = |pair: &[u8; 2]| f32::from(i16::from_le_bytes(*pair)) * step;
        let numbers: Vec<f32> = bytes.as_chunks::<2>().0.iter().map(number).collect();
        match (self.lanes, sampling) {
            (Lanes::Two, Sampling::Real) => real(&numbers),
            (Lanes::Two, Sampling::Complex) => self.complex::<2>(&numbers),
            (Lanes::Four, Sampling::Real) => recording.deinterleaved(&real(&numbers)),
            (Lanes::Four, Sampling::Complex) => recording.deinterleaved(&self.complex::<FOUR>(&numbers)),
        }
    }

    /// Complex samples from groups of `N` values of one part followed by `N` of the other.
    fn complex<const N: usize>(&self, numbers: &[f32]) -> Vec<Complex32> {
        let (groups, _) = numbers.as_chunks::<N>();
        let of_two = |pair: &[[f32; N]; 2]| {
            let [in_phase, quadrature] = match self.order {
                IqOrder::InPhaseFirst => *pair,
                IqOrder::QuadratureFirst => [pair[1], pair[0]],
            };
            std::array::from_fn::<Complex32, N, _>(|i| Complex32::new(in_phase[i], quadrature[i]))
        };
        groups.as_chunks::<2>().0.iter().flat_map(of_two).collect()
    }
}

fn real(numbers: &[f32]) -> Vec<Complex32> {
    numbers.iter().map(|number| Complex32::new(*number, 0.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of a file as its table says, each telling part, receiver and sample: 100·Q + 10·receiver +
    /// sample.
    fn bytes(numbers: &[i16]) -> Vec<u8> {
        numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
    }

    fn samples(receivers: usize, length: usize, sampling: Sampling) -> Vec<Complex32> {
        let told = |rx: usize, n: usize| (10 * rx + n) as f32;
        let value = |rx: usize, n: usize| match sampling {
            Sampling::Real => Complex32::new(told(rx, n), 0.0),
            Sampling::Complex => Complex32::new(told(rx, n), 100.0 + told(rx, n)),
        };
        (0..receivers).flat_map(|rx| (0..length).map(move |n| value(rx, n))).collect()
    }

    #[test]
    fn every_layout_is_read_as_its_table_says() {
        let two = [0, 1, 100, 101, 2, 3, 102, 103, 10, 11, 110, 111, 12, 13, 112, 113];
        let two_real = [0, 1, 2, 3, 10, 11, 12, 13];
        let four = [0, 10, 20, 30, 100, 110, 120, 130, 1, 11, 21, 31, 101, 111, 121, 131];
        let four_real = [0, 10, 20, 30, 1, 11, 21, 31];
        for (numbers, lanes, receivers, length, sampling) in [
            (&two[..], Lanes::Two, 2, 4, Sampling::Complex),
            (&two_real[..], Lanes::Two, 2, 4, Sampling::Real),
            (&four[..], Lanes::Four, 4, 2, Sampling::Complex),
            (&four_real[..], Lanes::Four, 4, 2, Sampling::Real),
        ] {
            let recording = RecordingShape::of_sizes(receivers, length);
            let layout = Layout { lanes, order: IqOrder::InPhaseFirst };
            let bytes = bytes(numbers);
            assert!(bytes.len().is_multiple_of(layout.unit_bytes(sampling)));
            assert_eq!(bytes.len(), receivers * length * layout.value_bytes(sampling));
            let expected = samples(receivers, length, sampling);
            assert_eq!(
                layout.by_slot(&bytes, &recording, sampling, 1.0),
                expected,
                "{lanes:?}, {sampling:?}"
            );
            let exchanged = Layout { order: IqOrder::QuadratureFirst, ..layout };
            let turned = |x: &Complex32| match sampling {
                Sampling::Real => *x,
                Sampling::Complex => Complex32::new(x.im, x.re),
            };
            let found = exchanged.by_slot(&bytes, &recording, sampling, 1.0);
            assert_eq!(found, expected.iter().map(turned).collect::<Vec<_>>());
        }
    }

    #[test]
    fn lanes_that_do_not_hold_the_receivers_are_refused() {
        let told = |lanes, receivers, length, sampling| {
            let layout = Layout { lanes, order: IqOrder::InPhaseFirst };
            let checked =
                layout.check(Path::new("x.bin"), &RecordingShape::of_sizes(receivers, length), sampling);
            checked.err().map(|failure| failure.to_string())
        };
        assert!(told(Lanes::Four, 2, 4, Sampling::Complex).is_some_and(|text| text.contains("has 2")));
        assert!(told(Lanes::Two, 2, 3, Sampling::Complex).is_some_and(|text| text.contains("by twos")));
        assert_eq!(told(Lanes::Two, 2, 3, Sampling::Real), None);
        assert_eq!(told(Lanes::Four, 4, 3, Sampling::Complex), None);
    }
}
