//! The `id` of each of several tables.

use crate::document::errors::Rule;
use crate::document::keys::bodies::ID;
use crate::document::section::Section;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// Reads the `id` of each; notes missing and duplicate ones.
pub(crate) fn read_ids<'d>(sections: &[Section<'d>]) -> Vec<Option<&'d str>> {
    let mut lines: HashMap<&str, u32> = HashMap::new();
    let mut read = |section: &Section<'d>| {
        section.require(ID.name);
        let id = section.read(&ID)?;
        match lines.entry(id) {
            Entry::Occupied(first) => {
                section.note(ID.name, Rule::DuplicateId { id: id.to_owned(), first_line: *first.get() });
            }
            Entry::Vacant(new) => drop(new.insert(section.line())),
        }
        Some(id)
    };
    sections.iter().map(&mut read).collect()
}
