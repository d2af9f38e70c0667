//! Units of float samples in descriptions beside recordings.

use crate::raw_data::IntegerStep;
use artifact::cube::SampleUnit;
use pipeline::host::failure::Failure;
use serde_json::Value;
use std::ops::RangeInclusive;
use std::path::Path;

/// Keys of a description's unit and of the full scale in steps of a converter.
pub(crate) struct UnitKeys {
    pub(crate) unit: &'static str,
    pub(crate) full_scale: &'static str,
}

/// Keys in descriptions that are this program's own.
pub(crate) const OWN_KEYS: UnitKeys = UnitKeys { unit: "unit", full_scale: "full_scale" };

/// Full scales that are read, in steps, as those of `import --full-scale`.
const FULL_SCALES: RangeInclusive<f64> = 1e-30..=1e30;

impl UnitKeys {
    /// Meaning of float samples by `told`, the content of `place`, which need not give a unit.
    ///
    /// # Errors
    /// An unknown unit, or a full scale that is not a number of steps.
    pub(crate) fn meaning(&self, told: &Value, place: &Path) -> Result<IntegerStep, Failure> {
        let unit = match told[self.unit].as_str() {
            Some(name) if name == SampleUnit::RootWatts.name() => SampleUnit::RootWatts,
            Some(name) if name == SampleUnit::Steps.name() => self.steps(told, place)?,
            None if told[self.unit].is_null() => return Ok(IntegerStep::Floats),
            _ => {
                let [watts, steps] = [SampleUnit::RootWatts, SampleUnit::Steps].map(SampleUnit::name);
                let rule = format!("{} is {}; {watts} and {steps} are read", self.unit, told[self.unit]);
                return Err(Failure::refused(rule).about(place));
            }
        };
        Ok(IntegerStep::DescribedFloats(unit, place.to_owned()))
    }

    /// Steps of a converter, with their full scale if it is given.
    fn steps(&self, told: &Value, place: &Path) -> Result<SampleUnit, Failure> {
        match (&told[self.full_scale], told[self.full_scale].as_f64()) {
            (Value::Null, _) => Ok(SampleUnit::Steps),
            (_, Some(steps)) if FULL_SCALES.contains(&steps) => Ok(SampleUnit::FullScale(steps)),
            (other, _) => {
                let rule = format!("{} is {other}, which is no number of steps", self.full_scale);
                Err(Failure::refused(rule).about(place))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn units_come_back_by_the_names_that_exports_give_them_and_others_are_refused() {
        let place = Path::new("x.npy.json");
        let meaning = |told: Value| OWN_KEYS.meaning(&told, place).map_err(|failure| failure.to_string());
        for unit in [SampleUnit::RootWatts, SampleUnit::Steps, SampleUnit::FullScale(2048.0)] {
            let told = json!({ "unit": unit.name(), "full_scale": unit.full_scale() });
            assert_eq!(meaning(told), Ok(IntegerStep::DescribedFloats(unit, place.to_owned())));
        }
        assert_eq!(meaning(json!({ "full_scale": 1 })), Ok(IntegerStep::Floats));
        assert_eq!(meaning(json!([])), Ok(IntegerStep::Floats));
        for (told, rule) in [
            (json!({ "unit": "V" }), "x.npy.json: unit is \"V\"; sqrt(W) and ADC steps are read"),
            (json!({ "unit": 3 }), "x.npy.json: unit is 3; "),
            (json!({ "unit": "ADC steps", "full_scale": -1 }), "x.npy.json: full_scale is -1, which"),
            (json!({ "unit": "ADC steps", "full_scale": "1" }), "x.npy.json: full_scale is \"1\", which"),
        ] {
            let refused = meaning(told).unwrap_err();
            assert!(refused.starts_with(rule), "{refused}");
        }
    }
}
