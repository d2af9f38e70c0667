//! Ctrl-C and SIGTERM: incomplete files are removed, exit code 130.

use crate::program::terminal;
use pipeline::host::checkpoint::KeptWork;
use std::sync::{Mutex, PoisonError};

/// Answers, when an interrupt comes, which part of the work the next run finds done.
type Watch = Box<dyn Fn() -> KeptWork + Send>;

/// Parts of a command's work, in the plural, with their watch; `None` while none are kept.
static KEPT: Mutex<Option<(&'static str, Watch)>> = Mutex::new(None);

/// Declares which parts of the work are all kept from now on for the next run: whole frames, say.
pub fn keeps(parts: &'static str) {
    keeps_as_told(parts, || KeptWork::All);
}

/// Declares which parts of the work may be kept from now on; `watch` is asked when an interrupt comes.
pub(crate) fn keeps_as_told(parts: &'static str, watch: impl Fn() -> KeptWork + Send + 'static) {
    *KEPT.lock().unwrap_or_else(PoisonError::into_inner) = Some((parts, Box::new(watch)));
}

/// Handles interrupts from now on: an interrupt removes the temporary files of unfinished results and ends
/// the program.
pub(crate) fn install() {
    let handler = || {
        let _nothing_new = artifact::whole_file::abandon_all();
        let told = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = told.as_ref().map(|(parts, watch)| (*parts, watch()));
        terminal::say_last(format_args!("interrupted; {}", left_behind(kept)));
        // The handler runs on a thread of its own, from which `main` cannot be made to return: the work would
        // go on to the end of its frame, for minutes.
        std::process::exit(130);
    };
    if let Err(error) = ctrlc::set_handler(handler) {
        terminal::say(format_args!("note: interrupts are not handled: {error}"));
    }
}

fn left_behind(kept: Option<(&str, KeptWork)>) -> String {
    match kept {
        Some((parts, KeptWork::All)) => {
            format!("whole {parts} are kept, the same command goes on from there")
        }
        Some((parts, KeptWork::UntilFailure)) => {
            format!("{parts} done before a write failed are kept, the same command goes on from there")
        }
        Some((_, KeptWork::Nothing)) | None => {
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
            [(KeptWork::All, true), (KeptWork::UntilFailure, true), (KeptWork::Nothing, false)]
        {
            let said = left_behind(Some(("aspects", kept)));
            assert_eq!(said.contains("are kept"), is_said, "{kept:?}: {said}");
            assert_eq!(said.contains("begins anew"), !is_said, "{kept:?}: {said}");
        }
        assert!(left_behind(None).contains("begins anew"));
    }
}
