//! Ctrl-C and SIGTERM: incomplete files are removed, exit code 130.

use crate::program::terminal;
use pipeline::host::checkpoint::SavedWork;
use std::sync::{Mutex, PoisonError};

/// Answers, when an interrupt comes, which part of the work the next run finds done.
type Watch = Box<dyn Fn() -> SavedWork + Send>;

/// Parts of a command's work, in the plural, with their watch; `None` while none are kept.
static KEPT: Mutex<Option<(&'static str, Watch)>> = Mutex::new(None);

/// Declares which parts of the work are all kept from now on for the next run: whole frames, say.
pub fn declare_saved(parts: &'static str) {
    declare_saved_as(parts, || SavedWork::All);
}

/// Declares which parts of the work may be kept from now on; `watch` is asked when an interrupt comes.
pub(crate) fn declare_saved_as(parts: &'static str, watch: impl Fn() -> SavedWork + Send + 'static) {
    *KEPT.lock().unwrap_or_else(PoisonError::into_inner) = Some((parts, Box::new(watch)));
}

/// Handles interrupts from now on: an interrupt removes the temporary files of unfinished results and ends
/// the program.
pub(crate) fn install() {
    let handler = || {
        let _nothing_new = artifact::atomic_file::remove_all_temporaries();
        let told = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = told.as_ref().map(|(parts, watch)| (*parts, watch()));
        terminal::print_last_status(format_args!("interrupted; {}", left_behind(kept)));
        // The handler runs on a thread of its own, from which `main` cannot be made to return: the work would
        // go on to the end of its frame, for minutes.
        std::process::exit(130);
    };
    if let Err(error) = ctrlc::set_handler(handler) {
        terminal::print_status(format_args!("note: interrupts are not handled: {error}"));
    }
}

fn left_behind(kept: Option<(&str, SavedWork)>) -> String {
    match kept {
        Some((parts, SavedWork::All)) => {
            format!("whole {parts} are kept, the same command goes on from there")
        }
        Some((parts, SavedWork::UntilFailure)) => {
            format!("{parts} done before a write failed are kept, the same command goes on from there")
        }
        Some((_, SavedWork::Nothing)) | None => {
            "nothing is half-written, the same command begins anew".to_owned()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_kept_parts_are_said_to_be_kept() {
        for (kept, is_said) in
            [(SavedWork::All, true), (SavedWork::UntilFailure, true), (SavedWork::Nothing, false)]
        {
            let said = left_behind(Some(("aspects", kept)));
            assert_eq!(said.contains("are kept"), is_said, "{kept:?}: {said}");
            assert_eq!(said.contains("begins anew"), !is_said, "{kept:?}: {said}");
        }
        assert!(left_behind(None).contains("begins anew"));
    }
}
