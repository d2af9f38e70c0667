//! Values from texts of TOML, whose depth is bounded first.

use scene::toml_text;
use serde::de::DeserializeOwned;

/// The value that a text says; else the rule that it breaks, for who knows the file.
pub fn read<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    toml_text::check_text(text).map_err(|too_deep| {
        let line = text.bytes().take(too_deep.byte).filter(|byte| *byte == b'\n').count() + 1;
        format!("line {line}: {too_deep}")
    })?;
    toml::from_str(text).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_that_would_be_walked_too_deep_is_refused_with_its_line() {
        let key = vec!["a"; 79].join(".");
        let deep = (0..79).fold("1".to_owned(), |inner, _| format!("{{ {key} = {inner} }}"));
        let said = read::<toml::Table>(&format!("x = 1\na = {deep}\n")).unwrap_err();
        assert_eq!(said, "line 2: a value lies within more than 64 tables and lists, the most that are read");
        assert!(read::<toml::Table>("x = 1\na = [[2]]").is_ok());
        assert!(read::<toml::Table>("x = ").unwrap_err().contains("line 1"));
    }
}
