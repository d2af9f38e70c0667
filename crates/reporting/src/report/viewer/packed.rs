//! Numbers of a page in few bytes: whole steps as little-endian integers, as base64.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

/// An array of numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(in crate::report) struct Packed {
    /// Type of the integers, as scripts call it.
    kind: &'static str,
    /// Value of one step.
    step: f64,
    base64: String,
}

impl Packed {
    /// Numbers in steps of `step`, or of as much more as the largest needs to fit into 16 bits: none is
    /// wrong by more than half a step.
    pub(in crate::report) fn steps(values: &[f64], step: f64) -> Self {
        let largest = values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        let step = step.max(largest / f64::from(i16::MAX));
        let bytes = values.iter().flat_map(|value| ((value / step).round() as i16).to_le_bytes());
        Self::of("Int16", step, &bytes.collect::<Vec<_>>())
    }

    /// Whole numbers from 0 to 255.
    pub(in crate::report) fn bytes(values: &[u8]) -> Self {
        Self::of("Uint8", 1.0, values)
    }

    /// Whole numbers.
    pub(in crate::report) fn numbers(values: &[u32]) -> Self {
        if values.iter().all(|value| *value <= u32::from(u16::MAX)) {
            let bytes = values.iter().flat_map(|value| (*value as u16).to_le_bytes());
            return Self::of("Uint16", 1.0, &bytes.collect::<Vec<_>>());
        }
        let bytes = values.iter().flat_map(|value| value.to_le_bytes());
        Self::of("Uint32", 1.0, &bytes.collect::<Vec<_>>())
    }

    fn of(kind: &'static str, step: f64, bytes: &[u8]) -> Self {
        Self { kind, step, base64: STANDARD.encode(bytes) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_beyond_sixteen_bits_get_a_longer_step_and_others_the_one_asked_for() {
        let packed = |values: &[f64]| Packed::steps(values, 0.01);
        // −0.02 and 3.00 are −2 and 300 steps.
        assert_eq!(packed(&[-0.02, 3.0]), Packed { kind: "Int16", step: 0.01, base64: "/v8sAQ==".into() });
        assert!((packed(&[3276.7]).step - 0.1).abs() < 1e-12);
        assert_eq!(Packed::numbers(&[1, 65_536]).kind, "Uint32");
        assert_eq!(Packed::numbers(&[258]).base64, "AgE=");
    }
}
