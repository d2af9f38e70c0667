//! Every reader of `wayside`, and of the stages through it, against files changed by their structure:
//! artifacts of every kind with checksums made anew, recordings of devices, studies, recipes, manifests,
//! what a cache and earlier runs have left. Each is read or refused with a sentence that names the file; none
//! panics, takes a minute, or fills the memory. Longer runs and other cases: `fuzzing`.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

mod commands;
mod corpus;
mod envelope;
mod artifacts;
mod recordings;
mod documents;
mod persisted_state;

use fuzzing::Reader;

#[test]
fn files_of_changed_structure_are_read_or_refused_with_a_sentence() {
    let readers: Vec<Reader> =
        [artifacts::readers(), recordings::readers(), documents::readers(), persisted_state::readers()]
            .into_iter()
            .flatten()
            .collect();
    fuzzing::fuzz(&readers, commands::prepare);
}
