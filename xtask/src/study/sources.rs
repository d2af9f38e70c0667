//! Sources that the figures of a study depend on, and their short hash.

#[path = "../../../crates/pipeline/sources.rs"]
mod hashed;

use crate::project::project_root;
use wayside::host::failure::Failure;

/// Paths relative to the project's root, in lists shared by studies.
pub(crate) type SourcePaths = &'static [&'static [&'static str]];

/// Leaves that every stage uses.
const LEAVES: &[&str] = &["crates/artifact", "crates/bodies", "crates/radar"];

/// Maps, detectors, directions.
pub(super) const SIGNALS: &[&str] = &["crates/dsp", "crates/dsp/tests/common"];

/// Bodies and their scattering.
pub(super) const SCATTERING: &[&str] = &["crates/scene", "crates/bart-rcs", "crates/po-sbr"];

/// The stages from a scene to points.
pub(super) const CHAIN: &[&str] = &["crates/scene", "crates/bart-rcs", "crates/fmcw-echo", "crates/dsp"];

/// Whole runs beside the stages: the linked chain, truth and what a summary tells.
pub(super) const RUN: &[&str] =
    &["crates/evaluation", "crates/pipeline/src/chain", "crates/pipeline/src/outcome"];

/// Eight digits of the hash of these places and of the leaves.
pub(super) fn hash(places: SourcePaths) -> Result<String, Failure> {
    let root = project_root();
    let all: Vec<_> = LEAVES.iter().chain(places.iter().copied().flatten()).map(|p| root.join(p)).collect();
    let hash = hashed::hash_of(&all, code_of).map_err(|error| Failure::System(error.to_string()))?;
    Ok(hash.to_hex()[..8].to_owned())
}

/// A source without what changes no figure: lines of comments, blank lines, and the tests at its end; of a
/// file that is no text, all bytes.
fn code_of(source: Vec<u8>) -> Vec<u8> {
    let text = match String::from_utf8(source) {
        Ok(text) => text,
        Err(no_text) => return no_text.into_bytes(),
    };
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let counts = |line: &&str| !line.is_empty() && !line.starts_with("//");
    code.lines().map(str::trim).filter(counts).flat_map(|line| [line, "\n"]).collect::<String>().into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hash_is_that_of_its_places() {
        let (signals, scattering) = (hash(&[SIGNALS]).unwrap(), hash(&[SCATTERING]).unwrap());
        assert_eq!(signals, hash(&[SIGNALS]).unwrap());
        assert!(signals.len() == 8 && signals != scattering);
        assert!(hash(&[&["crates/nothing"]]).is_err());
    }

    #[test]
    fn comments_and_tests_make_no_page_older() {
        let code = "fn f() {\n    g(); // of a\n}\n";
        let more =
            format!("//! Of f.\n\n/// Calls g.\n{code}\n#[cfg(test)]\nmod tests {{\n    fn t() {{}}\n}}\n");
        let of = |text: &str| code_of(text.as_bytes().to_vec());
        assert_eq!(of(code), of(&more));
        assert_ne!(of(code), of("fn f() {\n    h(); // of a\n}\n"));
        assert_ne!(code_of(vec![0xff, 1]), code_of(vec![0xff, 2]), "a recording or a model");
    }
}
