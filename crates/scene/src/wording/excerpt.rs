//! Excerpts of files.

/// The beginning of a file's text, for a sentence about it.
pub(crate) fn excerpt(text: &str) -> String {
    beginning(text, 80)
}

/// The first `shown` characters of a text, and a sign if there are more.
pub(crate) fn beginning(text: &str, shown: usize) -> String {
    match text.char_indices().nth(shown) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
