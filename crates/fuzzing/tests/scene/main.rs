//! Every reader of `scene` against files changed by their structure: lengths, counts, indices, heads of
//! chunks, values of JSON, tags, words and numbers. Each is read or refused with a sentence that names the
//! file; none panics, takes a minute, or fills the memory. Longer runs and other cases: `fuzzing`.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

mod gltf;
mod openmaterial;
mod readers;
mod corpus;

#[test]
fn files_of_changed_structure_are_read_or_refused_with_a_sentence() {
    fuzzing::fuzz(&readers::READERS, readers::prepare);
}
