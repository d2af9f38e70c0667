//! "Did you mean": the command that a misspelt one is, or that does what another program's does.

use clap::CommandFactory;
use clap::error::{ContextKind, ContextValue, ErrorKind};

/// Words of other programs for what commands here do.
const SYNONYMS: [(&str, &str); 22] = [
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

/// The same error, with a command that may be meant where clap knows none: of a short word it finds no letters exchanged.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Arguments;

    #[test]
    fn a_misspelt_command_and_another_programs_word_are_told_the_command_that_is_meant() {
        for (typed, expected) in [
            ("rnu", Some("run")),
            ("rsc", Some("rcs")),
            ("simulate", Some("run")),
            ("Info", Some("inspect")),
            ("xyzzy", None),
        ] {
            let error = Arguments::command().try_get_matches_from(["xtask", typed]).unwrap_err();
            let told = suggest::<Arguments>(error).render().to_string();
            match expected {
                Some(name) => assert!(told.contains(&format!("'{name}'")), "{typed}: {told}"),
                None => assert!(!told.contains("similar"), "{typed}: {told}"),
            }
        }
    }

    #[test]
    fn every_synonym_is_of_a_command() {
        let commands = Arguments::command();
        for (_, command) in SYNONYMS {
            assert!(commands.find_subcommand(command).is_some(), "{command}");
        }
    }
}
