//! Results that a table made in several runs passes from one run to the next.

use crate::table::aspect::Scattering;
use crate::table::aspect_settings::{AspectSettings, Check, Checks, IntegralsCheck};
use crate::table::order_joints::LeftOutEdges;
use num_complex::Complex64;

/// Storage of a table's finished aspects, for a run that continues an interrupted one.
///
/// A store must return only bytes given to it for the same mesh, the same request and the same program:
/// their shape is checked against the request, their values are trusted.
pub trait CheckpointStore: Sync {
    /// Stored bytes of an aspect; if `None`, the aspect is computed.
    fn load(&self, key: CheckpointKey) -> Option<&[u8]>;
    /// Stores an aspect that has just been finished.
    fn store(&self, key: CheckpointKey, bytes: &[u8]);
}

/// Key of a stored aspect: an aspect of a table in one pass of integration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct CheckpointKey {
    /// Number of times that the whole table was integrated before.
    pub pass: u32,
    /// Index of the aspect, row-major `[elevation, azimuth]`.
    pub aspect: u32,
}

/// No storage: every run starts from the beginning.
pub struct NoCheckpoint;

impl CheckpointStore for NoCheckpoint {
    fn load(&self, _: CheckpointKey) -> Option<&[u8]> {
        None
    }

    fn store(&self, _: CheckpointKey, _: &[u8]) {}
}

impl Scattering {
    /// Exact bytes of every number, little endian.
    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let mut words = CheckpointWriter::default();
        words.orders(&self.chosen_m);
        words.option(self.other_m.as_ref(), |words, orders| words.orders(orders));
        for power in [self.error_power, self.left_out_power] {
            words.option(power, |words, power| words.number(power));
        }
        words.option(self.left_out_edges, |words, edges| {
            [edges.power, edges.ends_power].iter().for_each(|power| words.number(*power));
        });
        words.count(self.beams.len());
        self.beams.iter().for_each(|n| words.0.push(*n));
        [self.whole_power, self.accuracy, self.dropped_m, self.dropped_at_most_m]
            .iter()
            .for_each(|number| words.number(*number));
        [self.trace_seconds, self.integrate_seconds, self.check_seconds]
            .iter()
            .for_each(|s| words.number(*s));
        words.0.iter().flat_map(|word| word.to_le_bytes()).collect()
    }

    /// Result from its bytes; `None` unless these are exactly the bytes of one.
    pub(crate) fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let mut words = CheckpointReader { left: bytes };
        let found = Self {
            chosen_m: words.orders()?,
            other_m: words.option(CheckpointReader::orders)?,
            error_power: words.option(CheckpointReader::number)?,
            left_out_power: words.option(CheckpointReader::number)?,
            left_out_edges: words.option(CheckpointReader::left_out_edges)?,
            beams: words.list(CheckpointReader::word)?,
            whole_power: words.number()?,
            accuracy: words.number()?,
            dropped_m: words.number()?,
            dropped_at_most_m: words.number()?,
            trace_seconds: words.number()?,
            integrate_seconds: words.number()?,
            check_seconds: words.number()?,
        };
        words.left.is_empty().then_some(found)
    }

    /// Whether it has a value for each requested order and frequency, and the requested measurements.
    pub(crate) fn is_of(&self, settings: &AspectSettings, checks: Checks) -> bool {
        let (orders, frequencies) = (usize::from(settings.bounces), settings.wavenumbers_per_m.len());
        let is_whole = |all: &Vec<Vec<Complex64>>| {
            all.len() == orders && all.iter().all(|order| order.len() == frequencies)
        };
        is_whole(&self.chosen_m)
            && self.other_m.as_ref().map(is_whole) == (checks.model == Check::Measured).then_some(true)
            && self.error_power.is_some() == (checks.integrals != IntegralsCheck::Skipped)
    }
}

/// Sequence of 64-bit numbers.
#[derive(Default)]
struct CheckpointWriter(Vec<u64>);

impl CheckpointWriter {
    fn count(&mut self, count: usize) {
        self.0.push(count as u64);
    }

    fn number(&mut self, number: f64) {
        self.0.push(number.to_bits());
    }

    fn option<T>(&mut self, value: Option<T>, add: impl FnOnce(&mut Self, T)) {
        self.count(usize::from(value.is_some()));
        if let Some(value) = value {
            add(self, value);
        }
    }

    fn orders(&mut self, orders: &Vec<Vec<Complex64>>) {
        self.count(orders.len());
        for order in orders {
            self.count(order.len());
            order.iter().flat_map(|s| [s.re, s.im]).for_each(|part| self.number(part));
        }
    }
}

/// Unread rest of [`CheckpointWriter`].
struct CheckpointReader<'a> {
    left: &'a [u8],
}

impl CheckpointReader<'_> {
    fn word(&mut self) -> Option<u64> {
        let (word, left) = self.left.split_first_chunk()?;
        self.left = left;
        Some(u64::from_le_bytes(*word))
    }

    fn number(&mut self) -> Option<f64> {
        self.word().map(f64::from_bits)
    }

    fn left_out_edges(&mut self) -> Option<LeftOutEdges> {
        Some(LeftOutEdges { power: self.number()?, ends_power: self.number()? })
    }

    fn option<T>(&mut self, value: impl FnOnce(&mut Self) -> Option<T>) -> Option<Option<T>> {
        match self.word()? {
            0 => Some(None),
            1 => value(self).map(Some),
            _ => None,
        }
    }

    /// Reads a list; its length cannot exceed the remaining words, since every element takes one.
    fn list<T>(&mut self, mut element: impl FnMut(&mut Self) -> Option<T>) -> Option<Vec<T>> {
        let count = usize::try_from(self.word()?)
            .ok()
            .filter(|count| *count <= self.left.len() / size_of::<u64>())?;
        (0..count).map(|_| element(self)).collect()
    }

    fn orders(&mut self) -> Option<Vec<Vec<Complex64>>> {
        self.list(|words| words.list(|words| Some(Complex64::new(words.number()?, words.number()?))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scattering() -> Scattering {
        let order = |of: f64| vec![Complex64::new(of, -0.0), Complex64::new(1.0 / 3.0, f64::MIN_POSITIVE)];
        Scattering {
            chosen_m: vec![order(1.0), order(-2.5)],
            other_m: Some(vec![order(0.1), vec![]]),
            error_power: None,
            left_out_power: Some(1e-300),
            left_out_edges: Some(LeftOutEdges { power: 0.0, ends_power: 1e-9 }),
            beams: vec![7, u64::MAX],
            whole_power: 2.0,
            accuracy: 1e-2,
            dropped_m: 1e-9,
            dropped_at_most_m: 2e-9,
            trace_seconds: 0.5,
            integrate_seconds: 0.25,
            check_seconds: 0.0,
        }
    }

    #[test]
    fn an_aspect_comes_back_from_its_bytes_to_the_bit_and_from_no_others() {
        let whole = scattering();
        let bytes = whole.to_bytes();
        let back = Scattering::from_bytes(&bytes).unwrap();
        assert_eq!(format!("{back:?}"), format!("{whole:?}"));
        assert_eq!(back.to_bytes(), bytes);
        (0..bytes.len()).for_each(|cut| assert!(Scattering::from_bytes(&bytes[..cut]).is_none(), "{cut}"));
        assert!(Scattering::from_bytes(&[bytes.as_slice(), &[0; 8]].concat()).is_none());
        let claims_too_much = [&u64::MAX.to_le_bytes(), &bytes[8..]].concat();
        assert!(Scattering::from_bytes(&claims_too_much).is_none());
    }
}
