//! Check of the training program, built, linted and tested in a separate folder, with the tests of `train`.

use crate::ci::commands::{Tally, run_tests};
use crate::project::project_root;
use std::fs::File;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use wayside::host::failure::Failure;
use wayside::program::commands::training_target_folder as target_folder;

pub(super) use wayside::program::commands::TRAINING_PROGRAM as PACKAGE;

/// Running checks of the training program; they end with the parent process.
pub(super) struct Training {
    child: Child,
    log: PathBuf,
}

impl Training {
    /// Begins with the tests, whose build takes most of the time; then lints and docs, as for the other
    /// crates.
    pub(super) fn begin() -> Result<Self, Failure> {
        let log = target_folder(&project_root()).join("ci.log");
        let failed = |e: std::io::Error| Failure::system(&log, "write", e);
        std::fs::create_dir_all(target_folder(&project_root())).map_err(failed)?;
        let file = File::create(&log).map_err(failed)?;
        let words = format!(
            "cargo test --release --package {PACKAGE} && \
             cargo clippy --release --package {PACKAGE} --all-targets -- -D warnings && \
             RUSTDOCFLAGS='-D warnings' cargo doc --release --package {PACKAGE} --no-deps"
        );
        let mut command = Command::new("sh");
        command
            .args(["-c", &words])
            .env("CARGO_TARGET_DIR", target_folder(&project_root()))
            .current_dir(project_root());
        command.stdin(Stdio::null()).stderr(file.try_clone().map_err(failed)?).stdout(file);
        Ok(Self { child: command.spawn().map_err(|e| Failure::System(format!("sh: {e}")))?, log })
    }

    /// Waits for the checks, counts their tests, and runs those of the command.
    pub(super) fn end(mut self, tally: &mut Tally) -> Result<(), Failure> {
        let status = self.child.wait().map_err(|e| Failure::system(&self.log, "wait for", e))?;
        let text = std::fs::read_to_string(&self.log).map_err(|e| Failure::system(&self.log, "read", e))?;
        text.lines().for_each(|line| tally.count(line));
        if !status.success() {
            return Err(Failure::Refused(format!("{text}\n{PACKAGE} ended with {status}")));
        }
        let words = "test --release --package wayside --test kills --test files -- --ignored a_training";
        // They run in separate folders, outside the project.
        let mut tests = Command::new("cargo");
        run_tests(tests.args(words.split(' ')).env("WAYSIDE_PROJECT", project_root()), tally)
    }
}

impl Drop for Training {
    fn drop(&mut self) {
        let _ = self.child.kill();
    }
}
