//! File names from names in artifacts.

/// Largest part of a name that is kept, bytes: with its additions the file name fits any file system.
const KEPT_BYTES: usize = 120;

/// Turns a name from an artifact into a part of a file name: it leads into no other folder and is of limited
/// length. A changed name ends with a hash of the original, so that different names stay different.
pub(crate) fn safe_file_name(name: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || " -_.+()".contains(c) { c } else { '_' };
    let begin = name.char_indices().take_while(|(at, _)| *at < KEPT_BYTES);
    let mut kept: String = begin.map(|(_, c)| plain(c)).collect();
    if kept.starts_with('.') {
        kept.insert(0, '_');
    }
    if kept == name { kept } else { format!("{kept}-{}", &blake3::hash(name.as_bytes()).to_hex()[..8]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_in_their_folder_apart_and_short() {
        assert_eq!(safe_file_name("car-1 (left)"), "car-1 (left)");
        assert!(safe_file_name("../car").starts_with("_.._car-"));
        assert_ne!(safe_file_name("a/b"), safe_file_name("a_b"));
        assert_ne!(safe_file_name("a/b"), safe_file_name("a:b"));
        let (long, longer) = ("é".repeat(1 << 20), "é".repeat(1 + (1 << 20)));
        assert_eq!(safe_file_name(&long).len(), KEPT_BYTES + 9);
        assert_ne!(safe_file_name(&long), safe_file_name(&longer));
    }
}
