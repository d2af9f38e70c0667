//! "Did you mean": the command that a misspelt one is, or that does what another program's does.

use clap::CommandFactory;
use clap::error::{ContextKind, ContextValue, ErrorKind};

/// Words of other programs for what commands here do.
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

/// The same error, with a command that may be meant where clap knows none: of a short word it finds no
/// letters exchanged.
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

/// A synonym, else the name that is fewest letters away: at most one in three.
fn meant<'n>(typed: &str, names: &[&'n str]) -> Option<&'n str> {
    let synonym = SYNONYMS.iter().find(|(word, _)| *word == typed).map(|(_, command)| *command);
    let named = |command: &str| names.iter().copied().find(|name| *name == command);
    synonym.and_then(named).or_else(|| {
        let apart = |name: &str| strsim::damerau_levenshtein(typed, name);
        let nearest = names.iter().copied().min_by_key(|name| apart(name))?;
        (3 * apart(nearest) <= typed.chars().count().max(3)).then_some(nearest)
    })
}
