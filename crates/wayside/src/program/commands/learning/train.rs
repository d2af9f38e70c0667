//! `train`: a dataset to a model with its curves and its evaluation.
//!
//! Trees learn here. The program that trains the paper's network, `classifier-training`, stands on a learning
//! library that is most of a first build; so it is built when it is asked for, and runs as a process of its
//! own.

mod trees;

use crate::program::learning_cli::{LearnerWord, PAPER_ITERATIONS, TrainArguments};
use crate::program::terminal;
use pipeline::chain::loaded_model::of_classifier_about;
use pipeline::chain::loading;
use pipeline::host::failure::Failure;
use pipeline::host::files;
use pipeline::host::places;
use pipeline::host::progress::Work;
use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// Package and program.
pub const PROGRAM: &str = "classifier-training";

pub(crate) fn run(arguments: &TrainArguments) -> Result<(), Failure> {
    check(arguments)?;
    let datasets: Vec<Vec<PathBuf>> =
        arguments.datasets.iter().map(|folder| loading::shards(folder)).collect();
    for (folder, shards) in arguments.datasets.iter().zip(&datasets) {
        if classifier::format_of(shards).map_err(of_classifier_about(folder))?.is_none() {
            return Err(Failure::System(format!("{}: no shards of a dataset here", folder.display())));
        }
    }
    files::claim(&classifier::MODEL_FILES.map(|name| arguments.out.join(name)))?;
    match arguments.learner {
        LearnerWord::Trees => trees::train(arguments, &datasets),
        LearnerWord::Paper => network(arguments, &datasets.concat()),
    }
}

/// Refuses what means nothing to the learner.
fn check(arguments: &TrainArguments) -> Result<(), Failure> {
    match (arguments.learner, &arguments.attributions) {
        (LearnerWord::Trees, _) if arguments.iterations.is_some() => Err(iterations_of_trees()),
        (LearnerWord::Paper, Some(file)) => Err(Failure::System(format!(
            "{}: --attributions is for --learner trees: a model of the network would not name them",
            file.display()
        ))),
        _ => Ok(()),
    }
}

/// Refusal of steps of an optimizer where trees learn.
pub(super) fn iterations_of_trees() -> Failure {
    let rule = "--iterations is for --learner paper: trees have no steps, they end where they are best";
    Failure::System(rule.to_owned())
}

/// Trains the network by the program that stands on the learning library.
fn network(arguments: &TrainArguments, shards: &[PathBuf]) -> Result<(), Failure> {
    let mut command = Command::new(built()?);
    command.arg("--out").arg(&arguments.out);
    let iterations = arguments.iterations.unwrap_or(PAPER_ITERATIONS);
    command.args(["--seed", &arguments.seed.to_string(), "--iterations", &iterations.to_string()]);
    ran(command, shards, &Work::begin("training")).map(drop)
}

/// Runs the program on shards; gives what it said of metrics, if it was asked for that.
pub(super) fn ran(mut command: Command, shards: &[PathBuf], work: &Work) -> Result<Value, Failure> {
    command.arg("--").args(shards);
    command.env("RAYON_NUM_THREADS", rayon::current_num_threads().to_string());
    let child = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn();
    heard(child.map_err(|e| Failure::System(format!("{PROGRAM}: cannot be run: {e}")))?, work)
}

/// Folder in which the training program is built: what it stands on has other features than what the main job
/// stands on, and neither undoes the other's work.
pub fn target_folder(project: &Path) -> PathBuf {
    project.join("target/training")
}

/// The program, made anew where its code has changed; cargo says where it lies.
pub(super) fn built() -> Result<PathBuf, Failure> {
    let project = places::project_folder().ok_or_else(|| {
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

/// Place of the program, where a message of cargo's tells it.
fn program_of(message: &Value) -> Option<PathBuf> {
    let is_it = message["target"]["name"] == PROGRAM;
    message["executable"].as_str().filter(|_| is_it).map(PathBuf::from)
}

/// Tells what the program says until it ends.
fn heard(mut child: Child, work: &Work) -> Result<Value, Failure> {
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
        text("told").into_iter().for_each(terminal::line);
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
