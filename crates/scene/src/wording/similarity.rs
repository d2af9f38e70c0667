//! Similar spellings.

/// The word of `known` most similar to `found`, if any is similar enough.
pub(crate) fn nearest(found: &str, known: &[&'static str]) -> Option<&'static str> {
    // 0.6 accepts one wrong or missing letter in three: `slope` finds `slope_mhz_per_us`, `velocty_mps` finds
    // `velocity_mps`, `colour` finds nothing. Jaro–Winkler favours common beginnings, which carry the meaning
    // of our keys.
    nearest_from(0.6, found, known)
}

/// The word of `known` most similar to `found`, if the similarity, from 0 to 1, is at least `least`.
pub(crate) fn nearest_from(least: f64, found: &str, known: &[&'static str]) -> Option<&'static str> {
    known
        .iter()
        .map(|word| (strsim::jaro_winkler(found, word), *word))
        .filter(|(similarity, _)| *similarity >= least)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, word)| word)
}
