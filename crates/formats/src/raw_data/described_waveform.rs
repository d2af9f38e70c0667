//! Waveforms in descriptions beside recordings, compared with the radar that the samples are read for.

use artifact::radar::Waveform;
use pipeline::host::failure::Failure;
use serde_json::Value;
use std::path::Path;

/// Keys of a description's numbers of the waveform.
pub(crate) struct WaveformKeys {
    pub(crate) sample_rate: NumberKey,
    pub(crate) start_frequency: NumberKey,
    pub(crate) slope: NumberKey,
}

/// Key of a number, and its unit in Hz or Hz/s.
pub(crate) struct NumberKey {
    pub(crate) name: &'static str,
    pub(crate) unit: f64,
}

impl NumberKey {
    /// Key of a number in Hz or Hz/s.
    pub(crate) const fn of_base_unit(name: &'static str) -> Self {
        Self { name, unit: 1.0 }
    }
}

/// Keys in descriptions that are this program's own.
pub(crate) const OWN_KEYS: WaveformKeys = WaveformKeys {
    sample_rate: NumberKey::of_base_unit("sample_rate_hz"),
    start_frequency: NumberKey::of_base_unit("start_frequency_hz"),
    slope: NumberKey::of_base_unit("slope_hz_per_s"),
};

impl WaveformKeys {
    /// Refuses numbers of `told`, the content of `place`, that differ from the radar's.
    pub(crate) fn check(&self, told: &Value, place: &Path, waveform: &Waveform) -> Result<(), Failure> {
        let numbers = [
            (&self.sample_rate, waveform.sample_rate_hz),
            (&self.start_frequency, waveform.start_frequency_hz),
            (&self.slope, waveform.slope_hz_per_s),
        ];
        numbers.into_iter().try_for_each(|(key, radars)| same(told, place, key.name, radars / key.unit))
    }
}

/// Refuses a value that is not a number, or differs from the radar's; numbers agree within a millionth,
/// because people round what a device has in steps.
pub(crate) fn same(told: &Value, place: &Path, key: &str, radars: f64) -> Result<(), Failure> {
    let refused = |found: &dyn std::fmt::Display| {
        let rule = format!("{key} is {found}, the scene's radar has {radars:?}");
        Err(Failure::Refused(format!("{}: {rule}", place.display())))
    };
    match (told[key].as_f64(), &told[key]) {
        (Some(number), _) if (number - radars).abs() > 1e-6 * radars.abs() => refused(&format!("{number:?}")),
        (Some(_), _) | (None, Value::Null) => Ok(()),
        (None, other) => refused(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn numbers_that_contradict_are_refused_by_key_with_both_values() {
        let told = |number: Value| {
            let same = same(&json!({ "rate": number }), Path::new("x.json"), "rate", 5e6);
            same.err().map(|failure| failure.to_string())
        };
        assert_eq!(told(json!(5e6)), None);
        assert_eq!(told(json!(5_000_001)), None);
        assert_eq!(told(json!(null)), None);
        let text = told(json!(2.5e6));
        assert_eq!(text.as_deref(), Some("x.json: rate is 2500000.0, the scene's radar has 5000000.0"));
        let text = told(json!("2.5 MHz"));
        assert_eq!(text.as_deref(), Some("x.json: rate is \"2.5 MHz\", the scene's radar has 5000000.0"));
    }
}
