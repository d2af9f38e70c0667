//! The README's two commands, taken from its text and run as they stand there.

use super::{Tally, counted, finished};
use crate::cache::project_root;
use crate::failure::Failure;
use std::process::Command;

/// The second command: all tests and doctests.
pub(super) fn tests(tally: &mut Tally) -> Result<(), Failure> {
    counted(&mut command(1)?, tally)
}

/// The first command: the main job.
pub(super) fn main_job() -> Result<(), Failure> {
    finished(&mut command(0)?)
}

fn command(number: usize) -> Result<Command, Failure> {
    let file = project_root().join("README.md");
    let text = std::fs::read_to_string(&file).map_err(|e| Failure::system(&file, "read", e))?;
    let commands = shell_lines(&text);
    let line =
        commands.get(number).ok_or_else(|| Failure::refused("README.md: two commands in ```sh blocks are promised"))?;
    let mut words = line.split_whitespace();
    let mut command = Command::new(words.next().unwrap_or("cargo"));
    command.args(words);
    Ok(command)
}

/// Lines that begin with `cargo` in the blocks marked `sh`.
fn shell_lines(text: &str) -> Vec<String> {
    let mut inside = false;
    let mut lines = Vec::new();
    for line in text.lines() {
        match line.trim() {
            "```sh" => inside = true,
            "```" => inside = false,
            line if inside && line.starts_with("cargo ") => {
                lines.push(line.split(" #").next().unwrap_or(line).trim().to_owned())
            }
            _ => {}
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_are_read_from_shell_blocks_without_their_remarks() {
        let text = "text `cargo no`\n```sh\ncargo xtask run a.toml   # the main job\n```\n```toml\ncargo no\n```\n```sh\ncargo test\n```";
        assert_eq!(shell_lines(text), ["cargo xtask run a.toml", "cargo test"]);
    }
}
