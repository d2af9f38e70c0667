//! Functions that all writers of formats need.

/// A name that an artifact gives as a part of a file's: it leads into no other folder.
pub(crate) fn plain_name(name: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || " -_.+()".contains(c) { c } else { '_' };
    let name: String = name.chars().map(plain).collect();
    if name.starts_with('.') { format!("_{name}") } else { name }
}

/// Keeps an artifact's error while a stream that can only fail with I/O errors is given up.
pub(crate) fn fail(
    keep: &mut Option<artifact::ArtifactError>,
    error: artifact::ArtifactError,
) -> std::io::Error {
    *keep = Some(error);
    std::io::Error::other("the artifact is damaged")
}
