//! References of one file to others: they name files of the same folder and below it, whoever wrote them.

use std::path::{Component, Path, PathBuf};

/// A reference that names no file which may be opened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ReferenceFault {
    /// It is empty, names a scheme such as `http:`, or is no text once its percent signs are decoded.
    Malformed,
    /// It leads out of the folder of the file that it stands in.
    Outside,
}

/// The file of a relative reference (RFC 3986, 4.2) in the folder of `path` or below it.
pub(crate) fn file_of(reference: &str, path: &Path) -> Result<PathBuf, ReferenceFault> {
    // A colon ends the name of a scheme: what follows is no file.
    let is_relative = !reference.is_empty() && !reference.contains(':');
    let name = is_relative.then(|| percent_decoded(reference)).flatten().ok_or(ReferenceFault::Malformed)?;
    match is_below(&name) {
        true => Ok(path.parent().unwrap_or(Path::new("")).join(name)),
        false => Err(ReferenceFault::Outside),
    }
}

/// Whether a name leads nowhere but down, on any system: a backslash parts folders on some, a colon stands
/// behind a drive.
fn is_below(name: &str) -> bool {
    let is_down = |part: Component| matches!(part, Component::Normal(_) | Component::CurDir);
    !name.contains(['\\', ':', '\0']) && Path::new(name).components().all(is_down)
}

/// The text without percent signs (RFC 3986, 2.1).
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
