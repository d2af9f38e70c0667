//! Ctrl-C and SIGTERM: incomplete files are removed, exit code 130.

use crate::program::terminal;
use std::sync::{Mutex, PoisonError};

/// Parts of a command's work that its next run finds done, in the plural; `None` while there are none.
static KEPT: Mutex<Option<&'static str>> = Mutex::new(None);

/// Declares which parts of the work are kept from now on for the next run: whole frames, say.
pub fn keeps(parts: &'static str) {
    *KEPT.lock().unwrap_or_else(PoisonError::into_inner) = Some(parts);
}

/// Handles interrupts from now on: an interrupt removes the temporary files of unfinished results and ends
/// the program.
pub(crate) fn install() {
    let handler = || {
        let _nothing_new = artifact::whole_file::abandon_all();
        let kept = *KEPT.lock().unwrap_or_else(PoisonError::into_inner);
        terminal::say_last(format_args!("interrupted; {}", left_behind(kept)));
        // The handler runs on a thread of its own, from which `main` cannot be made to return: the work would
        // go on to the end of its frame, for minutes.
        std::process::exit(130);
    };
    if let Err(error) = ctrlc::set_handler(handler) {
        terminal::say(format_args!("note: interrupts are not handled: {error}"));
    }
}

fn left_behind(kept: Option<&str>) -> String {
    match kept {
        Some(parts) => format!("whole {parts} are kept, the same command goes on from there"),
        None => "nothing is half-written, the same command begins anew".to_owned(),
    }
}
