//! Values of options: each has a range for which the work ends, and an error for values outside.

use crate::stepwise::bounds::{
    AZIMUTHS_DEG, ELEVATIONS_DEG, FREQUENCIES_GHZ, RANGES_M, UNIT_SCALES, or_infinite, outside,
};
use std::ops::RangeInclusive;

/// Values of an axis with the text that specified them.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    pub(crate) values: Vec<f64>,
}

/// Longest axis: a table of 10⁶ values per axis is a typing error.
const AXIS_LIMIT: usize = 1_000_000;

/// Reads an axis of frequencies in GHz.
pub(crate) fn frequencies(text: &str) -> Result<Axis, String> {
    axis(text, FREQUENCIES_GHZ)
}

pub(crate) fn azimuths(text: &str) -> Result<Axis, String> {
    axis(text, AZIMUTHS_DEG)
}

pub(crate) fn elevations(text: &str) -> Result<Axis, String> {
    axis(text, ELEVATIONS_DEG)
}

fn axis(text: &str, allowed: RangeInclusive<f64>) -> Result<Axis, String> {
    let parts: Vec<&str> = text.split(':').collect();
    let number = |text: &str| within(text, &allowed);
    match parts[..] {
        [one] => Ok(Axis { values: vec![number(one)?] }),
        [start, stop, count] => {
            let (start, stop) = (number(start)?, number(stop)?);
            let count: usize = count.parse().map_err(|_| format!("`{count}` is not a number of values"))?;
            match count {
                1 if start == stop => Ok(Axis { values: vec![start] }),
                2..=AXIS_LIMIT => Ok(Axis { values: evenly(start, stop, count) }),
                _ => Err(format!(
                    "START:STOP:N needs N from 2 to {AXIS_LIMIT}, both ends included; N is {count}"
                )),
            }
        }
        _ => Err("one number, or START:STOP:N".into()),
    }
}

fn evenly(start: f64, stop: f64, count: usize) -> Vec<f64> {
    let last = (count - 1) as f64;
    (0..count).map(|i| (start * (last - i as f64) + stop * i as f64) / last).collect()
}

pub(crate) fn azimuth_deg(text: &str) -> Result<f64, String> {
    within(text, &AZIMUTHS_DEG)
}

pub(crate) fn elevation_deg(text: &str) -> Result<f64, String> {
    within(text, &ELEVATIONS_DEG)
}

/// Reads a distance in metres, or infinity.
pub(crate) fn range(text: &str) -> Result<f64, String> {
    match text {
        "inf" | "infinite" => Ok(f64::INFINITY),
        text => within(text, &RANGES_M).map_err(or_infinite),
    }
}

/// Reads an accuracy below 0 dB, at which the error equals the result; f64 ends some way beyond −200 dB.
pub(crate) fn accuracy_db(text: &str) -> Result<f64, String> {
    match within(text, &(-200.0..=0.0))? {
        0.0 => Err("an error must be below 0 dB".into()),
        error_db => Ok(error_db),
    }
}

/// Reads samples or rays per wavelength.
pub(crate) fn density(text: &str) -> Result<f64, String> {
    within(text, &(0.1..=1000.0))
}

/// Reads metres per unit of a mesh file.
pub(crate) fn scale(text: &str) -> Result<f64, String> {
    within(text, &UNIT_SCALES)
}

/// Reads √W of one step of integer samples.
pub(crate) fn step(text: &str) -> Result<f32, String> {
    within(text, &(1e-30..=1e30)).map(|step| step as f32)
}

/// Reads the number of steps to a converter's full scale.
pub(crate) fn full_scale(text: &str) -> Result<f64, String> {
    within(text, &(1e-30..=1e30))
}

fn within(text: &str, allowed: &RangeInclusive<f64>) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| format!("`{text}` is not a number"))?;
    if allowed.contains(&value) { Ok(value) } else { Err(outside(allowed, text)) }
}

/// A place in world metres.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place(pub(crate) [f64; 3]);

/// Reads a place within the range of a scene's coordinates.
pub(crate) fn place(text: &str) -> Result<Place, String> {
    let parts: Result<Vec<f64>, _> = text.split(',').map(|part| within(part.trim(), &(-1e5..=1e5))).collect();
    parts?.try_into().map(Place).map_err(|_| "three numbers, X,Y,Z in metres".to_owned())
}

/// Part `number` of `of`, from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Number of the part, from 1.
    pub number: u32,
    /// Number of parts.
    pub of: u32,
}

/// Reads a shard of the form `K/N`.
///
/// # Errors
///
/// The text is not of this form, or K is not from 1 to N.
pub fn shard(text: &str) -> Result<Shard, String> {
    let parsed =
        text.split_once('/').and_then(|(k, n)| Some(Shard { number: k.parse().ok()?, of: n.parse().ok()? }));
    match parsed {
        Some(s) if s.number >= 1 && s.number <= s.of => Ok(s),
        _ => Err("K/N with 1 ≤ K ≤ N".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_includes_both_its_ends() {
        assert_eq!(azimuths("77:78:3").unwrap().values, [77.0, 77.5, 78.0]);
        assert_eq!(azimuths("-10").unwrap().values, [-10.0]);
        for bad in ["", "1:2", "1:2:0", "1:2:1", "nan", "1:inf:3", "a", "1:2:3:4"] {
            assert!(azimuths(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn an_elevation_lies_between_straight_down_and_straight_up() {
        assert!(elevations("-90:90:3").is_ok() && elevation_deg("90").is_ok());
        for bad in ["91", "-90.001", "0:91:2", "nan", "inf"] {
            assert!(elevations(bad).is_err(), "{bad}");
        }
        assert_eq!(elevation_deg("91").unwrap_err(), "it must be from -90 to 90, is 91");
    }

    #[test]
    fn every_number_of_an_option_is_finite_and_neither_subnormal_nor_endless() {
        let all: [fn(&str) -> bool; 6] = [
            |t| range(t).is_err(),
            |t| accuracy_db(t).is_err(),
            |t| density(t).is_err(),
            |t| scale(t).is_err(),
            |t| step(t).is_err(),
            |t| frequencies(t).is_err(),
        ];
        for bad in ["0", "nan", "-inf", "1e300", "5e-324", "-1e300", "1e999", ""] {
            assert!(all.iter().all(|refuses| refuses(bad)), "{bad}");
        }
        assert_eq!(range("inf"), Ok(f64::INFINITY));
        assert!(place("1,2,3").is_ok() && place("1,2").is_err() && place("1,2,nan").is_err());
    }
}
