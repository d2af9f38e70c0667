//! An axis of a study: keys of a scene that change together, with their values.

use crate::study::study_text::Position;

/// Keys of a scene that change together, with their values.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    /// Place in the study's file of each listed choice, or of the single draw.
    pub(crate) places: Vec<Position>,
    /// Name in tables and reports.
    pub(crate) name: String,
    pub(crate) keys: Vec<String>,
    pub(crate) source: Source,
}

/// Source of an axis's values.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Source {
    Listed(Vec<AxisChoice>),
    /// Any number in an interval.
    Uniform([f64; 2]),
    /// Any whole number in an interval, both ends included.
    Whole([i64; 2]),
}

/// A choice of an axis: a value for each of its keys, in TOML.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct AxisChoice {
    /// Name in tables and reports.
    pub(crate) label: String,
    pub(crate) values: Vec<String>,
}

impl Axis {
    /// Listed choices; `None` for a drawn axis.
    pub(crate) fn listed(&self) -> Option<&[AxisChoice]> {
        match &self.source {
            Source::Listed(picks) => Some(picks),
            Source::Uniform(_) | Source::Whole(_) => None,
        }
    }

    /// Place of a choice in the study's file.
    pub(crate) fn place_of(&self, pick: &AxisChoice) -> Option<Position> {
        let index = self.listed().and_then(|picks| picks.iter().position(|listed| listed == pick));
        self.places.get(index.unwrap_or(0)).copied()
    }

    /// Choice at a fraction of the axis, from 0 to below 1.
    pub(crate) fn at(&self, share: f64) -> AxisChoice {
        match &self.source {
            Source::Listed(picks) => picks[(share * picks.len() as f64) as usize].clone(),
            Source::Uniform([low, high]) => self.drawn(rounded(low + (high - low) * share, [*low, *high])),
            Source::Whole([low, high]) => {
                let count = (high - low + 1) as f64;
                self.drawn((low + (share * count) as i64).to_string())
            }
        }
    }

    /// A drawn value, common to all keys.
    fn drawn(&self, value: String) -> AxisChoice {
        AxisChoice { label: value.clone(), values: vec![value; self.keys.len()] }
    }
}

/// Rounds a number to at least a ten-thousandth of its span, so that it can be read and typed; beyond an end,
/// returns the end itself in full.
fn rounded(value: f64, [low, high]: [f64; 2]) -> String {
    const MOST_DIGITS: f64 = 12.0;
    let digits = (4.0 - (high - low).log10().floor()).max(0.0);
    let short =
        if digits > MOST_DIGITS { format!("{value:e}") } else { format!("{value:.*}", digits as usize) };
    match short.parse::<f64>() {
        Ok(told) if told < low => format!("{low:?}"),
        Ok(told) if told > high => format!("{high:?}"),
        _ => short,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(source: Source) -> Axis {
        Axis { places: vec![], name: "a".into(), keys: vec!["x".into(), "y".into()], source }
    }

    #[test]
    fn a_draw_stays_within_its_bounds_and_reaches_both_ends() {
        let whole = axis(Source::Whole([-1, 1]));
        assert_eq!([0.0, 0.5, 0.999].map(|share| whole.at(share).label), ["-1", "0", "1"]);
        let uniform = axis(Source::Uniform([4.0, 8.0]));
        assert_eq!(
            [0.0, 0.25, 0.999_999].map(|share| uniform.at(share).label),
            ["4.0000", "5.0000", "8.0000"]
        );
        assert_eq!(uniform.at(0.25).values, ["5.0000", "5.0000"], "one value for all keys of an axis");
    }

    #[test]
    fn no_rounding_leads_past_an_end_of_the_axis() {
        for ends in [[0.123_444, 0.987_656], [3.7, 2.0e6 + 0.7], [-7.000_06, 2.000_06], [1e-20, 1e-13]] {
            let uniform = axis(Source::Uniform(ends));
            for share in [0.0, 1e-7, 0.5, 0.999_999_9, 1.0 - f64::EPSILON] {
                let told: f64 = uniform.at(share).label.parse().unwrap();
                assert!((ends[0]..=ends[1]).contains(&told), "{told} of {ends:?}");
            }
        }
    }

    #[test]
    fn every_listed_value_has_an_equal_share() {
        let pick = |label: &str| AxisChoice { label: label.into(), values: vec![label.into(); 2] };
        let listed = axis(Source::Listed(["a", "b", "c"].map(pick).to_vec()));
        assert_eq!([0.0, 0.34, 0.999].map(|share| listed.at(share).label), ["a", "b", "c"]);
    }
}
