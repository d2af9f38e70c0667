//! References between files: any author's references may lead only to files in the same folder and below.

use std::path::{Component, Path, PathBuf};

/// Fault of a reference that must not be opened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ReferenceFault {
    /// The reference is empty, has a scheme such as `http:`, or is not text after percent-decoding.
    Malformed,
    /// The reference leads outside the folder of the referring file.
    Outside,
}

/// Resolves a relative reference (RFC 3986, 4.2) to a file in the folder of `path` or below.
pub(crate) fn file_of(reference: &str, path: &Path) -> Result<PathBuf, ReferenceFault> {
    // A colon ends the name of a scheme, after which there is no file name.
    let is_relative = !reference.is_empty() && !reference.contains(':');
    let name = is_relative.then(|| percent_decoded(reference)).flatten().ok_or(ReferenceFault::Malformed)?;
    match is_below(&name) {
        true => Ok(path.parent().unwrap_or(Path::new("")).join(name)),
        false => Err(ReferenceFault::Outside),
    }
}

/// Whether a name only descends, on any system: a backslash separates folders on some, a colon follows a
/// drive.
fn is_below(name: &str) -> bool {
    let is_down = |part: Component| matches!(part, Component::Normal(_) | Component::CurDir);
    !name.contains(['\\', ':', '\0']) && Path::new(name).components().all(is_down)
}

/// Decodes percent-encoding (RFC 3986, 2.1).
fn percent_decoded(reference: &str) -> Option<String> {
    let mut decoded = vec![];
    let mut bytes = reference.bytes();
    while let Some(byte) = bytes.next() {
        decoded.push(if byte == b'%' { 16 * hex(bytes.next()?)? + hex(bytes.next()?)? } else { byte });
    }
    String::from_utf8(decoded).ok()
}

fn hex(digit: u8) -> Option<u8> {
    char::from(digit).to_digit(16).map(|value| value as u8)
}
