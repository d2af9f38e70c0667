//! Functions that all writers of formats need.

/// Bytes of a name that are kept: with what stands around it the file's name fits any file system.
const KEPT_BYTES: usize = 120;

/// A name that an artifact gives as a part of a file's: it leads into no other folder and is of bounded
/// length. One that cannot stand as it is ends with a hash of all of it, so that no two names become one.
pub(crate) fn plain_name(name: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || " -_.+()".contains(c) { c } else { '_' };
    let begin = name.char_indices().take_while(|(at, _)| *at < KEPT_BYTES);
    let mut kept: String = begin.map(|(_, c)| plain(c)).collect();
    if kept.starts_with('.') {
        kept.insert(0, '_');
    }
    if kept == name { kept } else { format!("{kept}-{}", &blake3::hash(name.as_bytes()).to_hex()[..8]) }
}

/// Keeps an artifact's error while a stream that can only fail with I/O errors is given up.
pub(crate) fn fail(
    keep: &mut Option<artifact::ArtifactError>,
    error: artifact::ArtifactError,
) -> std::io::Error {
    *keep = Some(error);
    std::io::Error::other("the artifact is damaged")
}

/// Writes a file whose frames may turn out to be damaged.
#[cfg(feature = "interchange")]
pub(crate) fn streamed(
    out: &std::path::Path,
    content: impl FnOnce(
        &mut artifact::whole_file::WholeFile,
        &mut Option<artifact::ArtifactError>,
    ) -> std::io::Result<()>,
) -> Result<(), pipeline::host::failure::Failure> {
    let mut failed = None;
    let written = pipeline::host::files::write_with(out, |stream| content(stream, &mut failed));
    failed.map_or(written, |error| Err(error.into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_in_their_folder_apart_and_short() {
        assert_eq!(plain_name("car-1 (left)"), "car-1 (left)");
        assert!(plain_name("../car").starts_with("_.._car-"));
        assert_ne!(plain_name("a/b"), plain_name("a_b"));
        assert_ne!(plain_name("a/b"), plain_name("a:b"));
        let (long, longer) = ("é".repeat(1 << 20), "é".repeat(1 + (1 << 20)));
        assert_eq!(plain_name(&long).len(), KEPT_BYTES + 9);
        assert_ne!(plain_name(&long), plain_name(&longer));
    }
}
