//! Check of the ending of `--out`: one that belongs to another format is refused before the work, and the
//! error names the command that writes it.

use crate::program::cli::{Command, ExportArguments};
use crate::program::export_formats::{is_set, name_of};
#[cfg(feature = "classifier")]
use crate::program::learning_cli::LearningCommand;
use crate::program::option_words::FormatWord;
use crate::stepwise::extensions::{self, WRITERS};
use pipeline::host::failure::Failure;
use std::path::Path;

/// Refuses a result with the ending of another format. Unknown endings count as parts of names, and an
/// existing folder is accepted.
pub(crate) fn check(command: &Command, word: &str) -> Result<(), Failure> {
    let Some(CommandOutput { out, what, extensions }) = output_of(command) else { return Ok(()) };
    let rule = extensions::other_format(out, &extensions);
    let rule = rule.map(|written| format!("--out {}: {word} writes {what}; {written}", out.display()));
    rule.map_or(Ok(()), |rule| Err(Failure::System(rule)))
}

/// Result of a command.
struct CommandOutput<'a> {
    out: &'a Path,
    /// Name of the result in error messages.
    what: String,
    /// Allowed endings among those above.
    extensions: Vec<&'a str>,
}

/// Describes a command's result; `None` if that is a new folder or nothing: datasets, models.
fn output_of(command: &Command) -> Option<CommandOutput<'_>> {
    let of = |out, what: &str, extensions: &[&'static str]| {
        Some(CommandOutput { out, what: what.to_owned(), extensions: extensions.to_vec() })
    };
    match command {
        Command::Run(arguments) => of(arguments.out.as_deref()?, FOLDER, &[]),
        Command::Dsp(arguments) => of(&arguments.out, FOLDER, &[]),
        Command::Sweep(arguments) => of(&arguments.out, FOLDER, &[]),
        Command::Vehicles(arguments) => of(&arguments.out, FOLDER, &[]),
        Command::Rcs(arguments) => of(&arguments.out, "an array of NumPy (.npy)", &["npy"]),
        Command::Paths(arguments) => of(&arguments.out, "paths (.paths)", &["paths"]),
        Command::Echo(arguments) => of(&arguments.out, "radar cubes (.cube)", &["cube"]),
        Command::Import(arguments) => {
            of(&arguments.out, "radar cubes (.cube), of clouds points (.points)", &["cube", "points"])
        }
        Command::SceneFrom(arguments) => of(&arguments.out, "a scene file (.toml)", &["toml"]),
        Command::Calibrate(arguments) => of(&arguments.out, "a table (.csv)", &["csv"]),
        Command::Export(arguments) => exported(arguments),
        #[cfg(feature = "classifier")]
        Command::Learning(LearningCommand::Evaluate(arguments)) => of(arguments.out.as_deref()?, PAGE, &[]),
        #[cfg(feature = "classifier")]
        Command::Learning(LearningCommand::Protocols(arguments)) => of(arguments.out.as_deref()?, PAGE, &[]),
        _ => None,
    }
}

const FOLDER: &str = "a folder";
#[cfg(feature = "classifier")]
const PAGE: &str = "a page of text (.md, .txt)";

/// Describes an exported file; `None` for SigMF, whose endings are added to any name, for OSI, which accepts
/// two, and for dataset folders.
fn exported(arguments: &ExportArguments) -> Option<CommandOutput<'_>> {
    if is_set(arguments.to) || arguments.to == FormatWord::Osi {
        return None;
    }
    let format = name_of(arguments.to);
    // Its messages are in the same container as those of ROS 2.
    let alike = if arguments.to == FormatWord::Foxglove { FormatWord::Mcap } else { arguments.to };
    let writer = format!("export FILE --to {}", name_of(alike));
    let extensions: Vec<_> =
        WRITERS.iter().filter(|(_, by)| *by == writer).map(|(extension, _)| *extension).collect();
    let first = *extensions.first().filter(|_| arguments.to != FormatWord::Sigmf)?;
    Some(CommandOutput { out: &arguments.out, what: format!(".{first} with --to {format}"), extensions })
}
