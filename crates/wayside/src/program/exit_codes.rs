//! Exit code of the program.

use crate::program::terminal;
use pipeline::host::failure::Failure;
use pipeline::host::safe_text;
use std::process::ExitCode;

/// Ends the output after work with this end and returns the exit code: 0 if all went well and was printed.
pub(crate) fn of(ended: Result<(), Failure>) -> ExitCode {
    terminal::end_progress();
    match terminal::finish(ended) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => report(&failure),
    }
}

/// Prints the error on standard error; exit code 1 for a refusal, 2 for errors of the system or of the
/// arguments, 130 for a cancelled command.
fn report(failure: &Failure) -> ExitCode {
    terminal::print_status(format_args!("error: {}", printable(&failure.to_string())));
    match failure {
        Failure::Refused(_) | Failure::Unplaced(_) => ExitCode::from(1),
        Failure::System(_) => ExitCode::from(WRONG_USAGE),
        Failure::Cancelled => ExitCode::from(130),
    }
}

/// Exit code for wrong arguments, and for what the system refuses.
pub(crate) const WRONG_USAGE: u8 = 2;

/// Makes text of a file safe for a terminal: without cursor control, each line no longer than a screen.
fn printable(text: &str) -> String {
    const SHOWN: usize = 2000;
    let line = |line: &str| {
        let end = line.char_indices().nth(SHOWN).map(|(end, _)| end);
        let kept = safe_text::in_lines(end.map_or(line, |end| &line[..end])).into_owned();
        if end.is_some() { kept + "…" } else { kept }
    };
    text.split('\n').map(line).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_file_says_does_not_move_the_cursor_nor_fill_the_terminal() {
        assert_eq!(
            printable("a.toml:1:1: no `\u{1b}[2Jé\t\u{202e}`\nmore"),
            "a.toml:1:1: no `\\u{1b}[2Jé\t\\u{202e}`\nmore"
        );
        let long = printable(&"x".repeat(1 << 20));
        assert_eq!(long.chars().count(), 2001);
    }
}
