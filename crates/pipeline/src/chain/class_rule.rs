//! The decision for a class from probabilities, of one frame and of a track.

use artifact::settings::Class;
use serde::{Deserialize, Serialize};

/// Rule that decides for a class from probabilities.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ClassRule {
    /// Least probability of the likeliest class; below it the answer is "unknown".
    pub least_probability: f32,
    /// Correlation between the frames of a track, from 0 (independent) to 1 (identical).
    pub frame_correlation: f32,
}

impl ClassRule {
    /// Predicted class, or "unknown".
    pub fn predict(&self, probabilities: &[f32; 4]) -> Predicted {
        let likeliest =
            (0..4).fold(0, |best, i| if probabilities[i] > probabilities[best] { i } else { best });
        if probabilities[likeliest] >= self.least_probability {
            Predicted::Class(Class::ALL[likeliest])
        } else {
            Predicted::Unknown
        }
    }

    /// Probabilities of a track from the sums of their logarithms over its frames. Frames of one vehicle are
    /// correlated, so n of them count as n/(1 + (n − 1)ρ), as does the mean of values of correlation ρ.
    pub(crate) fn combined(&self, log_sums: &[f64; 4], frames: u32) -> [f32; 4] {
        let more = f64::from(frames.max(1) - 1);
        let per_frame = 1.0 / (1.0 + more * f64::from(self.frame_correlation));
        let largest = log_sums.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let powers = log_sums.map(|sum| ((sum - largest) * per_frame).exp());
        let total: f64 = powers.iter().sum();
        powers.map(|power| (power / total) as f32)
    }
}

/// Answer of a classifier about a vehicle; JSON holds its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Predicted {
    /// No class is likely enough.
    Unknown,
    /// The likeliest class.
    #[serde(untagged)]
    Class(Class),
}

impl Predicted {
    /// The class as people write it, or "unknown".
    pub fn name(self) -> &'static str {
        match self {
            Self::Unknown => "unknown",
            Self::Class(class) => class.name(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_that_agree_make_a_track_surer_and_frames_that_are_the_same_do_not() {
        let p = [0.6_f64, 0.2, 0.1, 0.1];
        let joined = |frames: u32, frame_correlation: f32| {
            let rule = ClassRule { least_probability: 0.5, frame_correlation };
            rule.combined(&p.map(|p| f64::from(frames) * p.ln()), frames)[0]
        };
        assert!((joined(1, 0.5) - 0.6).abs() < 1e-6 && (joined(9, 1.0) - 0.6).abs() < 1e-6);
        // Independent: 0.6³/(0.6³ + 0.2³ + 2·0.1³).
        assert!((joined(3, 0.0) - 0.216 / 0.226).abs() < 1e-6);
        assert!(joined(3, 0.5) > 0.6 && joined(3, 0.5) < joined(3, 0.0));
    }

    #[test]
    fn a_class_that_is_not_likely_enough_is_unknown() {
        let rule = ClassRule { least_probability: 0.5, frame_correlation: 0.5 };
        assert_eq!(rule.predict(&[0.1, 0.2, 0.6, 0.1]), Predicted::Class(Class::Truck));
        assert_eq!(rule.predict(&[0.3, 0.2, 0.4, 0.1]), Predicted::Unknown);
    }
}
