//! Names that an artifact gives to files.

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
