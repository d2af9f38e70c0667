//! Numbers of a page in few bytes: multiples of a step as little-endian integers, in base64.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

/// An array of numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(in crate::report) struct Packed {
    /// Type of the integers, as named in scripts.
    kind: &'static str,
    /// Value of one step.
    step: f64,
    /// Origin of places; `None` for numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    from: Option<[f64; 3]>,
    base64: String,
}

impl Packed {
    /// Numbers in steps of `step`, or of a larger step if the largest number needs it to fit into 16 bits: no
    /// error exceeds half a step.
    pub(in crate::report) fn steps(values: &[f64], step: f64) -> Self {
        let largest = values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        let step = step.max(largest / f64::from(i16::MAX));
        let bytes = values.iter().flat_map(|value| ((value / step).round() as i16).to_le_bytes());
        Self::of("Int16", step, &bytes.collect::<Vec<_>>())
    }

    /// Places in steps as in [`Self::steps`], relative to an origin: relative to the radar they are limited
    /// by its range, wherever in the world it is.
    pub(in crate::report) fn places(places_m: &[[f64; 3]], from_m: [f64; 3], step: f64) -> Self {
        let away = |place_m: &[f64; 3]| [0, 1, 2].map(|axis: usize| place_m[axis] - from_m[axis]);
        let away_m: Vec<f64> = places_m.iter().flat_map(away).collect();
        Self { from: Some(from_m), ..Self::steps(&away_m, step) }
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
        Self { kind, step, from: None, base64: STANDARD.encode(bytes) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_far_from_the_worlds_origin_are_told_as_finely_as_near_it() {
        let from_m = [-45_000.0, 80_000.0, 6.0];
        let packed = Packed::places(&[[-44_999.98, 80_003.0, 6.0]], from_m, 0.01);
        // 0.02, 3.00 and 0 are 2, 300 and no steps.
        assert_eq!((packed.step, packed.base64.as_str(), packed.from), (0.01, "AgAsAQAA", Some(from_m)));
    }

    #[test]
    fn numbers_beyond_sixteen_bits_get_a_longer_step_and_others_the_one_asked_for() {
        let packed = |values: &[f64]| Packed::steps(values, 0.01);
        // −0.02 and 3.00 are −2 and 300 steps.
        assert_eq!(
            packed(&[-0.02, 3.0]),
            Packed { kind: "Int16", step: 0.01, from: None, base64: "/v8sAQ==".into() }
        );
        assert!((packed(&[3276.7]).step - 0.1).abs() < 1e-12);
        assert_eq!(Packed::numbers(&[1, 65_536]).kind, "Uint32");
        assert_eq!(Packed::numbers(&[258]).base64, "AgE=");
    }
}
