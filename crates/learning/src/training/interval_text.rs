//! Intervals of shares as text of results.

/// Text of an interval of shares in per cent; single vehicles have none.
pub(crate) fn interval_text(shares: Option<[f64; 2]>) -> String {
    let text = |[low, high]: [f64; 2]| format!("{:.1} … {:.1} %", 100.0 * low, 100.0 * high);
    shares.map_or("–".to_owned(), text)
}
