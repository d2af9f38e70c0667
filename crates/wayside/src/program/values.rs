//! Values of options: each has a range for which the work ends, and an error for values outside.

use crate::program::numbers::{Numbers, whole, with_example};
use crate::stepwise::bounds::{
    ACCURACIES_DB, AZIMUTHS_DEG, BOUNCES, ELEVATIONS_DEG, FREQUENCIES_GHZ, RANGES_M, SCENE_ACCURACIES_DB,
    UNIT_SCALES, or_infinite,
};
use std::ops::RangeInclusive;

/// Values of an axis with the text that specified them.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    pub(crate) values: Vec<f64>,
}

/// Reads the name of one of the project's own vehicles.
pub(crate) fn vehicle_name(text: &str) -> Result<&'static str, String> {
    let known = scene::vehicles::names().into_iter().find(|name| *name == text);
    known.ok_or_else(|| scene::unknown_vehicle(text).to_string())
}

/// Longest axis: a table of 10⁶ values per axis is a typing error.
const AXIS_LIMIT: usize = 1_000_000;

/// Reads an axis of frequencies in GHz.
pub(crate) fn frequencies(text: &str) -> Result<Axis, String> {
    axis(text, &Numbers { allowed: FREQUENCIES_GHZ, example: "77 or 76:78:21" })
}

pub(crate) fn azimuths(text: &str) -> Result<Axis, String> {
    axis(text, &Numbers { allowed: AZIMUTHS_DEG, example: "30 or 0:360:361" })
}

pub(crate) fn elevations(text: &str) -> Result<Axis, String> {
    axis(text, &Numbers { allowed: ELEVATIONS_DEG, example: "20 or 0:30:4" })
}

fn axis(text: &str, numbers: &Numbers) -> Result<Axis, String> {
    let values = values_of(text, numbers).map_err(|refusal| numbers.with_example(&refusal))?;
    Ok(Axis { values })
}

fn values_of(text: &str, numbers: &Numbers) -> Result<Vec<f64>, String> {
    let parts: Vec<&str> = text.split(':').collect();
    match parts[..] {
        [one] => Ok(vec![numbers.part(one)?]),
        [start, stop, count] => {
            let (start, stop) = (numbers.part(start)?, numbers.part(stop)?);
            let count: usize = count.parse().map_err(|_| format!("`{count}` is not a number of values"))?;
            match count {
                1 if start == stop => Ok(vec![start]),
                2..=AXIS_LIMIT => Ok(evenly(start, stop, count)),
                _ => Err(format!(
                    "START:STOP:N needs N from 2 to {AXIS_LIMIT}, both ends included; N is {count}"
                )),
            }
        }
        _ => Err("it must be one number, or START:STOP:N".into()),
    }
}

fn evenly(start: f64, stop: f64, count: usize) -> Vec<f64> {
    let last = (count - 1) as f64;
    (0..count).map(|i| (start * (last - i as f64) + stop * i as f64) / last).collect()
}

pub(crate) fn azimuth_deg(text: &str) -> Result<f64, String> {
    Numbers { allowed: AZIMUTHS_DEG, example: "30" }.value(text)
}

pub(crate) fn elevation_deg(text: &str) -> Result<f64, String> {
    Numbers { allowed: ELEVATIONS_DEG, example: "20" }.value(text)
}

/// Reads a distance in metres, or infinity.
pub(crate) fn range(text: &str) -> Result<f64, String> {
    let distances = Numbers { allowed: RANGES_M, example: "30" };
    match text {
        "inf" | "infinite" => Ok(f64::INFINITY),
        text => distances.part(text).map_err(|refusal| distances.with_example(&or_infinite(refusal))),
    }
}

/// Reads the accuracy of a table of S.
pub(crate) fn accuracy_db(text: &str) -> Result<f64, String> {
    accuracy_from(ACCURACIES_DB, text)
}

/// Reads the accuracy of a scene, as its key `accuracy_db` takes it.
pub(crate) fn scene_accuracy_db(text: &str) -> Result<f64, String> {
    accuracy_from(SCENE_ACCURACIES_DB, text)
}

fn accuracy_from(allowed: RangeInclusive<f64>, text: &str) -> Result<f64, String> {
    let errors = Numbers { allowed, example: "-20" };
    match errors.value(text)? {
        0.0 => Err(errors.with_example("an error must be below 0 dB")),
        error_db => Ok(error_db),
    }
}

/// Reads samples or rays per wavelength.
pub(crate) fn density(text: &str) -> Result<f64, String> {
    Numbers { allowed: 0.1..=1000.0, example: "6" }.value(text)
}

/// Reads metres per unit of a mesh file.
pub(crate) fn scale(text: &str) -> Result<f64, String> {
    Numbers { allowed: UNIT_SCALES, example: "0.001" }.value(text)
}

/// Reads √W of one step of integer samples.
pub(crate) fn step(text: &str) -> Result<f32, String> {
    Numbers { allowed: 1e-30..=1e30, example: "1e-9" }.value(text).map(|step| step as f32)
}

/// Reads the number of steps to a converter's full scale.
pub(crate) fn full_scale(text: &str) -> Result<f64, String> {
    Numbers { allowed: 1e-30..=1e30, example: "32768" }.value(text)
}

/// Reads the highest bounce order.
pub(crate) fn bounces(text: &str) -> Result<u8, String> {
    whole(BOUNCES, 3)(text).map(|bounces| bounces as u8)
}

/// A place in world metres.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WorldPosition(pub(crate) [f64; 3]);

/// Reads a place within the range of a scene's coordinates.
pub(crate) fn place(text: &str) -> Result<WorldPosition, String> {
    let coordinates = Numbers { allowed: -1e5..=1e5, example: "2,30,1" };
    let parts: Result<Vec<f64>, String> = text.split(',').map(|part| coordinates.part(part.trim())).collect();
    let place: Result<[f64; 3], String> = parts.and_then(|parts| {
        parts.try_into().map_err(|_| "it must be three numbers, X,Y,Z in metres".to_owned())
    });
    place.map(WorldPosition).map_err(|refusal| coordinates.with_example(&refusal))
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
        _ => Err(with_example("it must be K/N with 1 ≤ K ≤ N", "1/4")),
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
        assert_eq!(elevation_deg("91").unwrap_err(), "it must be from -90 to 90, is 91; for example 20");
        let told = "`low` is not a number; it must be one from -90 to 90; for example 20 or 0:30:4";
        assert_eq!(elevations("0:low:2").unwrap_err(), told);
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
