//! A folder of its own for each test, and the program to run in it.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a helper of tests fails the test")]
#![allow(dead_code, reason = "each test file uses a part of it")]

pub(crate) mod bounded;
pub(crate) mod crops;
pub(crate) mod killing;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The program that is tested: that of the crate that the tests belong to.
pub(crate) const PROGRAM: &str =
    match (option_env!("CARGO_BIN_EXE_wayside"), option_env!("CARGO_BIN_EXE_xtask")) {
        (Some(program), _) | (None, Some(program)) => program,
        (None, None) => panic!("tests of a crate without a program"),
    };

/// A scene that takes a tenth of a second: a small radar (cells of 0.96 m × 5.4 m/s), a corner reflector and
/// a point.
pub(crate) const SMALL_SCENE: &str = r#"
name = "small"
seed = 3
frames = 2

[radar.waveform]
samples = 64
chirps = 16

[radar.array]
preset = "1x4"

[noise]
noise_figure_db = 12.0

[dsp]
training_cells = [3, 6]

[[target]]
kind = "mesh"
id = "corner-1"
class = "car"
model = "corner.obj"
position_m = [-5.75, 40.0, 0.0]
velocity_mps = [0.0, -3.0, 0.0]

[[target]]
kind = "point"
id = "reflector"
rcs_m2 = 10.0
position_m = [2.0, 30.0, 1.0]
velocity_mps = [0.0, 0.0, 0.0]
"#;

/// Three square plates of half a metre that meet at right angles, open towards the front and above.
pub(crate) const CORNER: &str = "v 0 0 0\nv 0.5 0 0\nv 0 0.5 0\nv 0.5 0.5 0\nv 0 0 0.5\nv 0.5 0 0.5\nv 0 0.5 0.5\n\
f 1 2 4 3\nf 1 5 6 2\nf 1 3 7 5\n";

/// A board's configuration: four receivers, one transmitter, 64 complex samples, 8 chirps.
pub(crate) const BOARD: &str = "channelCfg 15 1 0\nadcCfg 2 1\nprofileCfg 0 77 10 6 40 0 0 12.5 1 64 5120 0 0 30\n\
chirpCfg 0 0 0 0 0 0 0 1\nframeCfg 0 0 8 0 50 1 0\n";

pub(crate) struct Workplace {
    folder: tempfile::TempDir,
}

impl Workplace {
    /// A folder with the small scene in it.
    pub(crate) fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("small.toml"), SMALL_SCENE).unwrap();
        std::fs::write(folder.path().join("corner.obj"), CORNER).unwrap();
        Self { folder }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// A file of the project.
    pub(crate) fn project_file(name: &str) -> String {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name).display().to_string()
    }

    pub(crate) fn root(&self) -> &Path {
        self.folder.path()
    }

    /// The program in this folder, with a cache of its own, words split at blanks.
    pub(crate) fn command(&self, words: &str) -> Command {
        let mut command = Command::new(PROGRAM);
        command.args(words.split_whitespace()).current_dir(self.folder.path());
        let has_cache = words.starts_with("run") || words.starts_with("cache");
        if has_cache && !words.contains("--no-cache") {
            command.args(["--cache", "cache"]);
        }
        command
    }

    pub(crate) fn try_run(&self, words: &str) -> Output {
        self.command(words).output().unwrap()
    }

    /// Standard output of a command that has to succeed.
    pub(crate) fn run(&self, words: &str) -> String {
        let output = self.try_run(words);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "`{words}`: {} {said}", output.status);
        String::from_utf8(output.stdout).unwrap()
    }

    pub(crate) fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// JSON that a command wrote; a `summary.json` has to be the library's, to the byte.
    pub(crate) fn summary(&self, name: &str) -> serde_json::Value {
        let bytes = self.bytes(name);
        if name.ends_with("summary.json") {
            let summary = wayside::Summary::read(&self.path(name)).unwrap();
            assert_eq!(summary.json().unwrap().as_bytes(), bytes, "{name} is read and written again");
        }
        serde_json::from_slice(&bytes).unwrap()
    }
}

/// Tells how many cases a test has tried and what came of them, in the line that `cargo xtask study force`
/// reads.
pub(crate) fn tell_cases(kind: &str, cases: u64, came: &str) {
    println!("force: {kind}: {cases} cases: {came}");
}

/// Amount of a test that is asked for: the value of an environment variable, else `otherwise`.
pub(crate) fn asked(variable: &str, otherwise: u64) -> u64 {
    std::env::var(variable).map_or(otherwise, |text| text.parse().unwrap())
}
