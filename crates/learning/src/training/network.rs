//! The program that trains the paper's network, `classifier-training`: it depends on a learning library that
//! takes most of a first build, so it is built on demand, and runs as a separate process.

use crate::training::settings::{PAPER_ITERATIONS, TrainingSettings};
use pipeline::host::default_paths;
use pipeline::host::failure::Failure;
use pipeline::host::progress::Work;
use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// Package and program.
pub const PROGRAM: &str = "classifier-training";

/// Trains the network by the program with the learning library.
pub(super) fn train(settings: &TrainingSettings, shards: &[PathBuf]) -> Result<(), Failure> {
    let mut command = Command::new(build_program()?);
    command.arg("--out").arg(&settings.out);
    let iterations = settings.iterations.unwrap_or(PAPER_ITERATIONS);
    command.args(["--seed", &settings.seed.to_string(), "--iterations", &iterations.to_string()]);
    run_program(command, shards, &Work::begin("training"), settings.tell).map(drop)
}

/// Runs the program on shards; returns its metrics if requested.
pub(crate) fn run_program(
    mut command: Command,
    shards: &[PathBuf],
    work: &Work,
    tell: &dyn Fn(&str),
) -> Result<Value, Failure> {
    command.arg("--").args(shards);
    command.env("RAYON_NUM_THREADS", rayon::current_num_threads().to_string());
    let child = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn();
    follow_output(child.map_err(|e| Failure::System(format!("{PROGRAM}: cannot be run: {e}")))?, work, tell)
}

/// Build folder of the training program: its dependencies have other features than those of the main job, and
/// separate folders avoid rebuilding either.
pub fn target_folder(project: &Path) -> PathBuf {
    project.join("target/training")
}

/// Builds the program if its code has changed, and returns its place as cargo reports it.
pub(crate) fn build_program() -> Result<PathBuf, Failure> {
    let project = default_paths::project_folder().ok_or_else(|| {
        let rule = "it is built from the project's source: run this inside the project's folder, or name that in WAYSIDE_PROJECT";
        Failure::System(format!("{PROGRAM}: {rule}"))
    })?;
    let _under_way = Work::begin("building the program that trains (minutes the first time)");
    let words = [
        "build",
        "--release",
        "--quiet",
        "--package",
        PROGRAM,
        "--message-format",
        "json-render-diagnostics",
    ];
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let ended = Command::new(cargo)
        .args(words)
        .env("CARGO_TARGET_DIR", target_folder(&project))
        .current_dir(&project)
        .stdin(Stdio::null())
        .stderr(Stdio::inherit())
        .output();
    let unbuilt = |why: String| {
        Failure::System(format!(
            "{PROGRAM}: {why}; it is built by `cargo build --release --package {PROGRAM}` in {}",
            project.display()
        ))
    };
    let output = ended.map_err(|e| unbuilt(format!("cargo cannot be run: {e}")))?;
    let messages = output.stdout.split(|byte| *byte == b'\n');
    let program =
        messages.filter_map(|message| program_of(&serde_json::from_slice(message).ok()?)).next_back();
    program
        .filter(|_| output.status.success())
        .ok_or_else(|| unbuilt(format!("its build ended with {}", output.status)))
}

/// Place of the program in a message of cargo, if present.
fn program_of(message: &Value) -> Option<PathBuf> {
    let is_it = message["target"]["name"] == PROGRAM;
    message["executable"].as_str().filter(|_| is_it).map(PathBuf::from)
}

/// Passes on the program's output until it ends.
fn follow_output(mut child: Child, work: &Work, tell: &dyn Fn(&str)) -> Result<Value, Failure> {
    let (mut ended_badly, mut answer) = (None, Value::Null);
    for line in child
        .stdout
        .take()
        .into_iter()
        .flat_map(|stdout| BufReader::new(stdout).lines())
        .map_while(Result::ok)
    {
        let said: Value = serde_json::from_str(&line).unwrap_or(Value::Null);
        let text = |key: &str| said[key].as_str().map(str::to_owned);
        if let (Some(at), Some(of)) = (said["at"].as_u64(), said["of"].as_u64()) {
            work.at(at as usize, of as usize);
        }
        text("told").iter().for_each(|line| tell(line));
        if said["metrics"].is_object() {
            answer = said.clone();
        }
        ended_badly =
            text("refused").map(Failure::Refused).or(text("system").map(Failure::System)).or(ended_badly);
    }
    let status = child.wait().map_err(|e| Failure::System(format!("{PROGRAM}: {e}")))?;
    match ended_badly {
        Some(failure) => Err(failure),
        None if status.success() => Ok(answer),
        None => Err(Failure::System(format!("{PROGRAM} ended with {status}"))),
    }
}
