//! Refusals of every option that is a number.

use crate::program::cli::Arguments;
use clap::{Arg, Command, CommandFactory};
use std::any::TypeId;

/// Long names of the options of a command that are numbers.
fn numbers_of(command: &Command) -> Vec<&str> {
    let of_numbers = [
        TypeId::of::<u8>(),
        TypeId::of::<u16>(),
        TypeId::of::<u32>(),
        TypeId::of::<u64>(),
        TypeId::of::<f32>(),
        TypeId::of::<f64>(),
    ];
    let is_number = |arg: &&Arg| of_numbers.iter().any(|id| arg.get_value_parser().type_id() == *id);
    command.get_arguments().filter(is_number).filter_map(|arg| arg.get_long()).collect()
}

/// Words that are said of `foo` as the value of an option.
fn said_of_foo(command: Option<&str>, option: &str) -> String {
    let option = format!("--{option}");
    let words = ["wayside"].into_iter().chain(command).chain([option.as_str(), "foo"]);
    Arguments::command().try_get_matches_from(words).unwrap_err().render().to_string()
}

#[test]
fn every_number_is_refused_with_option_value_range_and_an_example() {
    let program = Arguments::command();
    let mut all: Vec<(Option<&str>, &str)> =
        numbers_of(&program).into_iter().map(|option| (None, option)).collect();
    for command in program.get_subcommands() {
        all.extend(numbers_of(command).into_iter().map(|option| (Some(command.get_name()), option)));
    }
    assert!(all.contains(&(None, "threads")) && all.contains(&(Some("run"), "accuracy-db")), "{all:?}");
    for (command, option) in all {
        let said = said_of_foo(command, option);
        let named = format!("invalid value 'foo' for '--{option} <");
        for words in [named.as_str(), "`foo` is not a ", "number; it must be one from ", "; for example "] {
            assert!(said.contains(words), "{command:?}: `{words}` is not in: {said}");
        }
    }
}
