//! Ctrl-C and SIGTERM: nothing half-written stays behind, exit code 130.

use crate::program::terminal;

/// Handles interrupts from now on: one removes the temporary files of what is being written and ends the
/// program.
pub(crate) fn install() {
    let handler = || {
        let _nothing_new = artifact::whole_file::abandon_all();
        terminal::end_progress();
        terminal::say("interrupted; whole frames and aspects are kept, the next run goes on from there");
        std::process::exit(130);
    };
    if let Err(error) = ctrlc::set_handler(handler) {
        terminal::say(format_args!("note: interrupts are not handled: {error}"));
    }
}
