//! Values parsed from TOML, whose nesting depth is checked first.

use scene::toml_text::{self, TooDeep};
use serde::de::DeserializeOwned;

/// Parses a value from a text; the error names the broken rule, and the caller knows the file.
pub fn read<T: DeserializeOwned>(text: &str) -> Result<T, TomlFault> {
    toml_text::check_text(text).map_err(|fault| {
        let line = text.bytes().take(fault.byte).filter(|byte| *byte == b'\n').count() + 1;
        TomlFault::TooDeep { line, fault }
    })?;
    Ok(toml::from_str(text)?)
}

/// Fault of a TOML text.
#[derive(Debug, thiserror::Error)]
pub enum TomlFault {
    /// A value is nested too deeply.
    #[error("line {line}: {fault}")]
    TooDeep {
        /// Number of the line at which the value begins, from 1.
        line: usize,
        /// Fault of the value.
        #[source]
        fault: TooDeep,
    },
    /// The text is not TOML, or does not describe such a value.
    #[error(transparent)]
    Refused(#[from] toml::de::Error),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_that_would_be_walked_too_deep_is_refused_with_its_line() {
        let key = vec!["a"; 79].join(".");
        let deep = (0..79).fold("1".to_owned(), |inner, _| format!("{{ {key} = {inner} }}"));
        let said = read::<toml::Table>(&format!("x = 1\na = {deep}\n")).unwrap_err();
        assert_eq!(
            said.to_string(),
            "line 2: a value lies within more than 64 tables and lists, the most that are read"
        );
        assert!(read::<toml::Table>("x = 1\na = [[2]]").is_ok());
        assert!(read::<toml::Table>("x = ").unwrap_err().to_string().contains("line 1"));
    }
}
