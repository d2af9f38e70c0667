//! Words that are spelt alike.

/// The word of `known` spelt most like `found`, if any is like it at all.
pub(crate) fn nearest(found: &str, known: &[&'static str]) -> Option<&'static str> {
    // 0.6 lets one wrong or missing letter in three pass: `slope` finds `slope_mhz_per_us`, `velocty_mps`
    // finds `velocity_mps`, `colour` finds nothing. Jaro–Winkler favours common beginnings, where our keys
    // carry their sense.
    nearest_from(0.6, found, known)
}

/// The word of `known` spelt most like `found`, if any is as like to it as `least`, from 0 to 1.
pub(crate) fn nearest_from(least: f64, found: &str, known: &[&'static str]) -> Option<&'static str> {
    known
        .iter()
        .map(|word| (strsim::jaro_winkler(found, word), *word))
        .filter(|(likeness, _)| *likeness >= least)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, word)| word)
}
