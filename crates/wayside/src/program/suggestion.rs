//! "Did you mean": suggests the command for a misspelt one, or for another program's name.

use clap::CommandFactory;
use clap::error::{ContextKind, ContextValue, ErrorKind};

/// Other programs' names for the commands here.
pub(crate) const SYNONYMS: [(&str, &str); 22] = [
    ("simulate", "run"),
    ("sim", "run"),
    ("start", "run"),
    ("scene", "run"),
    ("all", "run"),
    ("predict", "run"),
    ("trace", "paths"),
    ("raytrace", "paths"),
    ("synthesize", "echo"),
    ("cubes", "echo"),
    ("process", "dsp"),
    ("detect", "dsp"),
    ("track", "dsp"),
    ("learn", "train"),
    ("infer", "classify"),
    ("convert", "export"),
    ("save", "export"),
    ("load", "import"),
    ("info", "inspect"),
    ("show", "inspect"),
    ("benchmark", "bench"),
    ("check", "ci"),
];

/// Adds a suggested command to an error where clap finds none: clap does not find exchanged letters in short
/// words.
pub(crate) fn suggest<C: CommandFactory>(mut error: clap::Error) -> clap::Error {
    let knows = error.get(ContextKind::SuggestedSubcommand).is_some();
    if error.kind() != ErrorKind::InvalidSubcommand || knows {
        return error;
    }
    let Some(ContextValue::String(typed)) = error.get(ContextKind::InvalidSubcommand) else { return error };
    let commands = C::command();
    let names: Vec<&str> = commands.get_subcommands().map(clap::Command::get_name).collect();
    if let Some(meant) = meant(&typed.to_lowercase(), &names) {
        error.insert(ContextKind::SuggestedSubcommand, ContextValue::Strings(vec![meant.to_owned()]));
    }
    error
}

/// A synonym, otherwise the name with the smallest edit distance: at most one letter in three.
fn meant<'n>(typed: &str, names: &[&'n str]) -> Option<&'n str> {
    let synonym = SYNONYMS.iter().find(|(word, _)| *word == typed).map(|(_, command)| *command);
    let named = |command: &str| names.iter().copied().find(|name| *name == command);
    synonym.and_then(named).or_else(|| {
        let apart = |name: &str| strsim::damerau_levenshtein(typed, name);
        let nearest = names.iter().copied().min_by_key(|name| apart(name))?;
        (3 * apart(nearest) <= typed.chars().count().max(3)).then_some(nearest)
    })
}
